// Light or dark: as the system prefers, until the visitor chooses.
const key = 'pillowmesh-theme';
const system = matchMedia('(prefers-color-scheme: dark)');

export type Theme = 'light' | 'dark';

function stored(): Theme | null {
  try {
    const value = localStorage.getItem(key);
    return value === 'light' || value === 'dark' ? value : null;
  } catch {
    return null; // storage may be forbidden, e.g. in a sandboxed frame
  }
}

export function currentTheme(): Theme {
  return (document.documentElement.dataset.theme as Theme | undefined) ?? (system.matches ? 'dark' : 'light');
}

export function toggleTheme(): void {
  const next: Theme = currentTheme() === 'dark' ? 'light' : 'dark';
  document.documentElement.dataset.theme = next;
  try {
    localStorage.setItem(key, next);
  } catch {
    // chosen for this visit only
  }
}

/** Applies the stored choice and calls back whenever the theme changes. */
export function followTheme(changed: () => void): void {
  const choice = stored();
  if (choice) document.documentElement.dataset.theme = choice;
  system.addEventListener('change', changed);
  new MutationObserver(changed).observe(document.documentElement, {
    attributes: true,
    attributeFilter: ['data-theme'],
  });
}

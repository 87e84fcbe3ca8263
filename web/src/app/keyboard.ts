// Keys of the page. They stay out of the way of text fields and of controls that use the same keys.
export type KeyActions = Record<string, () => unknown>;

function usesKey(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.closest('dialog')) return true;
  if (target instanceof HTMLTextAreaElement || target.isContentEditable) return true;
  // The timeline's keys are the page's; other sliders keep theirs.
  if (target instanceof HTMLInputElement && target.type === 'range')
    return !target.closest('.timeline') && /^(Arrow|Page|Home|End)/.test(key);
  if (target instanceof HTMLInputElement && target.type === 'checkbox') return key === ' ';
  if (target instanceof HTMLInputElement && target.type === 'radio') return key === ' ' || key.startsWith('Arrow');
  if (target instanceof HTMLInputElement || target instanceof HTMLSelectElement) return true;
  return key === ' ' && target.closest('button, summary, a') !== null;
}

/** Names: KeyboardEvent.key, letters in lower case, "Shift+" before arrows, "Ctrl+" before letters (the command key counts as such). */
export function listenToKeys(actions: KeyActions, where: Document | ShadowRoot = document): void {
  where.addEventListener('keydown', (event) => {
    if (!(event instanceof KeyboardEvent)) return;
    if (event.altKey || usesKey(event.target, event.key)) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const control = event.ctrlKey || event.metaKey;
    const shift = event.shiftKey && (control || event.key.startsWith('Arrow'));
    const action = actions[`${control ? 'Ctrl+' : ''}${shift ? 'Shift+' : ''}${key}`];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

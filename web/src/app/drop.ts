// Dropping a file anywhere on the page.
import { h } from '../ui/dom.ts';

export function acceptDrops(take: (file: File) => void): void {
  const veil = h(
    'div',
    { class: 'veil', hidden: true },
    h('p', {}, 'Drop a mesh (.mesh, .msh, .vtk, .vtu), a picture, or a metric (.sol)'),
  );
  document.body.append(veil);
  let depth = 0;
  const carriesFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  const leave = (): void => {
    depth = 0;
    veil.hidden = true;
  };
  document.addEventListener('dragenter', (event) => {
    if (!carriesFile(event)) return;
    ++depth;
    veil.hidden = false;
  });
  document.addEventListener('dragleave', () => {
    if (--depth <= 0) leave();
  });
  document.addEventListener('dragover', (event) => {
    if (carriesFile(event)) event.preventDefault();
  });
  document.addEventListener('drop', (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault();
    leave();
    const file = event.dataTransfer?.files[0];
    if (file) take(file);
  });
}

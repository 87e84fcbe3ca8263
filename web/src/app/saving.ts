// The displayed mesh as a file, a picture or a report.
import type { SaveFormat } from '../panels/header.ts';
import type { Stage } from '../stage/stage.ts';
import type { MeshChoice } from '../state/settings.ts';
import { h } from '../ui/dom.ts';

function stemOf(mesh: MeshChoice): string {
  const name = mesh.kind === 'grid' ? 'grid' : mesh.kind === 'file' ? mesh.name.replace(/\.\w+$/, '') : mesh.name;
  return name.replace(/[^\w-]+/g, '-');
}

function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  h('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Saves what is shown and gives the name of the file. */
export async function saveShown(format: SaveFormat, stage: Stage): Promise<string> {
  const { player, picture, workshop } = stage;
  player.pause();
  const name = `${stemOf(stage.settings().mesh)}-${player.index}.${format}`;
  if (format === 'png') {
    download(await picture.capture(), name);
    return name;
  }
  if (format === 'svg') {
    if (player.mesh.dim === 3) throw new Error('Only meshes of quadrilaterals are saved as a drawing.');
    const { svgOf } = await import('../export/svg.ts');
    download(new Blob([svgOf(picture.drawing())], { type: 'image/svg+xml' }), name);
    return name;
  }
  if (format === 'webm') {
    const { recordRun } = await import('../export/video.ts');
    if (!picture.canvas) throw new Error('There is no picture to film: this browser gives no WebGL 2.');
    download(await recordRun(player, picture.canvas, () => picture.repaint()), name);
    return name;
  }
  const last = player.complete && player.atEnd;
  const bytes = await workshop.call('write', { name, ...(last ? {} : { events: player.index }) });
  download(new Blob([bytes as Uint8Array<ArrayBuffer>], { type: 'application/octet-stream' }), name);
  return name;
}

// The shown mesh of quadrilaterals as a drawing: cells with their colours, lines, boundary, tags and hull.
import type { ReplayMesh } from '../replay/replay_mesh.ts';
import type { Scene } from '../replay/scene.ts';
import type { Palette } from '../viewport/palette.ts';
import { boundaryEdges } from '../viewport/segments.ts';

export interface Drawing {
  mesh: ReplayMesh;
  scene: Scene;
  palette: Palette;
  /** 256 RGBA colours, null for plain cells. */
  colours: Uint8Array | null;
  /** 0 to 1, or -1 for no colour. */
  value(cell: number): number;
}

const width = 1000;

export function svgOf({ mesh, scene, palette, colours, value }: Drawing): string {
  const { low, high } = mesh.bounds();
  const scale = width / (high[0] - low[0]);
  const height = (high[1] - low[1]) * scale;
  const at = (vertex: number): string => {
    const x = (mesh.points[2 * vertex] - low[0]) * scale;
    const y = height - (mesh.points[2 * vertex + 1] - low[1]) * scale;
    return `${x.toFixed(2)} ${y.toFixed(2)}`;
  };
  const outline = (cell: number): string =>
    `M${[0, 1, 3, 2].map((corner) => at(mesh.cells[4 * cell + corner])).join('L')}Z`;
  const lines = (edges: Int32Array): string => {
    let path = '';
    for (let i = 0; i < edges.length; i += 2)
      if (edges[i] < mesh.vertexCount && edges[i + 1] < mesh.vertexCount) path += `M${at(edges[i])}L${at(edges[i + 1])}`;
    return path;
  };
  // Cells of one colour are one path: files stay small.
  const byFill = new Map<string, string>();
  for (let c = 0; c < mesh.cellCount; ++c) {
    if (!mesh.alive(c)) continue;
    const v = value(c);
    const k = 4 * Math.round(255 * Math.min(1, Math.max(0, v)));
    const fill = colours && v >= 0 ? `rgb(${colours[k]},${colours[k + 1]},${colours[k + 2]})` : palette.cell;
    byFill.set(fill, (byFill.get(fill) ?? '') + outline(c));
  }
  const marked = (cells: Int32Array): string => [...cells].filter((c) => mesh.alive(c)).map(outline).join('');
  const stroke = (path: string, colour: string, thick: number, rest = ''): string =>
    path && `<path d="${path}" fill="none" stroke="${colour}" stroke-width="${thick}" stroke-linecap="round"${rest}/>\n`;
  const tint = (path: string, colour: string): string => path && `<path d="${path}" fill="${colour}" fill-opacity="0.4"/>\n`;
  const margin = 8;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${-margin} ${-margin} ${width + 2 * margin} ${(height + 2 * margin).toFixed(1)}">\n` +
    [...byFill].map(([fill, path]) => `<path d="${path}" fill="${fill}" stroke="${palette.line}" stroke-width="0.8"/>\n`).join('') +
    tint(marked(scene.layer), palette.layer) +
    tint(marked(scene.buffer), palette.buffer) +
    stroke(lines(boundaryEdges(mesh)), palette.outline, 2.2) +
    stroke(lines(scene.tags), palette.tag, 4) +
    stroke(lines(scene.layerEdges), palette.tag, 5) +
    stroke(lines(scene.hull), palette.hull, 2.6, ' stroke-dasharray="7 5"') +
    '</svg>\n'
  );
}

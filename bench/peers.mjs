// Other programs on the metric of case iso2d, for comparison: BAMG (Debian: freefem++) and Gmsh, when installed.
// Both see the metric through a background mesh, as their users would give it, and their file input and output counts.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { timed } from './process.mjs';
import { which } from '../scripts/run.mjs';

const width = 7;
const height = 9;
/**
 * The background grid for sizes multiplied by `scale`: lines at the kinks of the metric, and no edge that is split in
 * more than 10, which is BAMG's limit.
 */
function grid(scale) {
  const columns = 7 * Math.max(1, Math.ceil(1 / scale));
  const rows = 180 * Math.max(1, Math.ceil(1 / (10 * scale)));
  return {
    columns,
    rows,
    x: (i) => (width * i) / columns,
    y: (j) => (height * j) / rows,
    id: (i, j) => j * (columns + 1) + i + 1,
  };
}

/** Case iso2d, [Paper] Eq. (3). */
export function size(y) {
  if (y <= 2) return 1 - (19 * y) / 40;
  if (y <= 4.5) return 20 ** ((2 * y - 9) / 5);
  if (y <= 7) return 5 ** ((9 - 2 * y) / 5);
  return 0.2 + (y - 7) ** 4 / 20;
}

/** The background grid as triangles in BAMG's format, with the domain's four corners marked. */
function bamgBackground(scale) {
  const { columns, rows, x, y, id } = grid(scale);
  const vertices = [];
  const edges = [];
  const triangles = [];
  for (let j = 0; j <= rows; ++j) for (let i = 0; i <= columns; ++i) vertices.push(`${x(i)} ${y(j)} 1`);
  for (let i = 0; i < columns; ++i) edges.push(`${id(i, 0)} ${id(i + 1, 0)} 1`, `${id(i + 1, rows)} ${id(i, rows)} 3`);
  for (let j = 0; j < rows; ++j) {
    edges.push(`${id(columns, j)} ${id(columns, j + 1)} 2`, `${id(0, j + 1)} ${id(0, j)} 4`);
    for (let i = 0; i < columns; ++i) {
      const far = id(i + 1, j + 1);
      triangles.push(`${id(i, j)} ${id(i + 1, j)} ${far} 1`, `${id(i, j)} ${far} ${id(i, j + 1)} 1`);
    }
  }
  const block = (name, lines) => `${name}\n${lines.length}\n${lines.join('\n')}\n`;
  return `MeshVersionFormatted 0\nDimension\n2\n${block('Vertices', vertices)}${block('Edges', edges)}`
    + `${block('Triangles', triangles)}End\n`;
}

/** BAMG's metric file: sizes at the background grid's vertices, doubled because each triangle is to be split. */
function bamgMetric(scale) {
  const { columns, rows, y } = grid(scale);
  const sizes = [];
  for (let j = 0; j <= rows; ++j) for (let i = 0; i <= columns; ++i) sizes.push(2 * scale * size(y(j)));
  return `${sizes.length} 1\n${sizes.join('\n')}\n`;
}

/** A Gmsh script: the rectangle, and the sizes as a view on the background grid. */
function gmshScript(scale) {
  const { columns, rows, x, y } = grid(1);
  const quads = [];
  for (let j = 0; j < rows; ++j) {
    for (let i = 0; i < columns; ++i) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
      const places = corners.map(([a, b]) => `${x(a)},${y(b)},0`).join(',');
      quads.push(`SQ(${places}){${corners.map(([, b]) => scale * size(y(b))).join(',')}};`);
    }
  }
  return `View "size" {\n${quads.join('\n')}\n};
Point(1) = {0, 0, 0}; Point(2) = {${width}, 0, 0}; Point(3) = {${width}, ${height}, 0}; Point(4) = {0, ${height}, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Field[1] = PostView; Field[1].ViewIndex = 0; Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeFromCurvature = 0;
Mesh.Algorithm = 6; Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 3;
Mesh.MshFileVersion = 2.2; Mesh.Binary = 0; General.NumThreads = 1;
`;
}

/** How many cells a Medit-like file has under `keyword`. */
const countAfter = (text, keyword) => Number(new RegExp(`${keyword}\\s+(\\d+)`).exec(text)?.[1] ?? 0);
/** Quadrilaterals (type 3) of a Gmsh 2.2 file. */
const gmshQuads = (text) => (text.match(/^\d+ 3 /gm) ?? []).length;

const programs = {
  // Triangles of twice the size, counted as the three quads that each would be split in. BAMG's own split (-2q) is not
  // used: it stops with "Big Bug" on meshes of more than about ten thousand triangles.
  bamg: {
    command: 'ffbamg',
    files: (scale) => ({ 'background.mesh': bamgBackground(scale), 'size.mtr': bamgMetric(scale) }),
    // -nbv: memory set aside for vertices, background included.
    args: (scale) => ['-b', 'background.mesh', '-M', 'size.mtr', '-o', 'out.mesh', '-v', '0',
      '-nbv', String(Math.ceil(5000 / scale ** 2) + 50_000)],
    output: 'out.mesh',
    count: (text) => 3 * countAfter(text, 'Triangles'),
  },
  gmsh: {
    command: 'gmsh',
    files: (scale) => ({ 'case.geo': gmshScript(scale) }),
    args: () => ['-2', 'case.geo', '-o', 'out.msh', '-v', '2'],
    output: 'out.msh',
    count: gmshQuads,
  },
};

export const peerNames = Object.keys(programs).filter((name) => which(programs[name].command) !== null);

/** Runs a peer with all sizes multiplied by `scale`: { program, scale, cells, process_seconds, ... }. */
export function runPeer(name, scale) {
  const program = programs[name];
  const folder = mkdtempSync(join(tmpdir(), 'pillowmesh-bench-'));
  try {
    for (const [file, text] of Object.entries(program.files(scale))) writeFileSync(join(folder, file), text);
    const { seconds, peakBytes, status } = timed(program.command, program.args(scale), folder);
    if (status !== 0) return { program: name, scale, error: `status ${status}` };
    const cells = program.count(readFileSync(join(folder, program.output), 'latin1'));
    return {
      program: name,
      scale,
      cells,
      process_seconds: seconds,
      process_cells_per_second: cells / seconds,
      peak_bytes_per_cell: peakBytes / cells,
    };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

// Runs the solver loop of examples/solver and writes docs/convergence.md and docs/images/convergence.svg.
//
//   node scripts/convergence.mjs [rows.txt]     rows.txt: the output of an earlier `convergence --all`
import { spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Failure, root } from './run.mjs';

const program = join(root, 'build/release/bin/examples/convergence');
const titles = { shock: 'Interior shock', layer: 'Boundary layer', corner: 'Singular corner' };
const kinds = ['uniform', 'isotropic', 'anisotropic'];
const colours = { uniform: '#7a7a7a', isotropic: '#1f77b4', anisotropic: '#d2501e' };

function rows() {
  if (process.argv[2]) return readFileSync(process.argv[2], 'utf8');
  const run = spawnSync(program, ['--all'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] });
  if (run.status !== 0) throw new Failure(`${program} --all failed; build the preset release first`);
  return run.stdout;
}

const all = rows()
  .trim()
  .split('\n')
  .map((line) => {
    const [problem, kind, cells, error, carried] = line.split(' ');
    return { problem, kind, cells: Number(cells), error: Number(error), carried: Number(carried) };
  });
const of = (problem, kind) => all.filter((r) => r.problem === problem && r.kind === kind);

/** Order in the size of cells, N^(-1/2): minus twice the slope of the line that fits the rows in logarithms. Of uniform
 * meshes only the last three rows, which resolve the feature. */
function order(list) {
  const used = list[0].kind === 'uniform' ? list.slice(-3) : list;
  const mean = (f) => used.reduce((sum, r) => sum + f(r), 0) / used.length;
  const x = mean((r) => Math.log(r.cells)), y = mean((r) => Math.log(r.error));
  return (
    (-2 * mean((r) => (Math.log(r.cells) - x) * (Math.log(r.error) - y))) / mean((r) => (Math.log(r.cells) - x) ** 2)
  );
}

/** Cells at which the error is `error`, between rows on the line through them in logarithms; null where none reaches it. */
function cellsAt(list, error) {
  for (let i = 1; i < list.length; ++i) {
    const a = list[i - 1], b = list[i];
    if (a.error < error || b.error > error) continue;
    const t = Math.log(a.error / error) / Math.log(a.error / b.error);
    return Math.exp(Math.log(a.cells) + t * Math.log(b.cells / a.cells));
  }
  return null;
}

const number = (n) => (n === null ? 'not reached' : Math.round(n).toLocaleString('en').replaceAll(',', ' '));

function table(problem) {
  const lines = ['| mesh | cells | L2 error | carried |', '|---|---:|---:|---:|'];
  for (const kind of kinds)
    for (const r of of(problem, kind))
      lines.push(`| ${kind} | ${number(r.cells)} | ${r.error.toExponential(2)} | ${Number.isNaN(r.carried) ? '' : r.carried.toExponential(2)} |`);
  return lines.join('\n');
}

function plot() {
  const width = 300, height = 260, left = 48, top = 34;
  const x = (cells) => left + ((Math.log10(cells) - 2) / 3.6) * (width - left - 14);
  const y = (error) => top + ((-0.5 - Math.log10(error)) / 5) * (height - top - 40);
  let svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${3 * width} ${height + 26}" font-family="system-ui, sans-serif" font-size="11">\n`;
  svg += `<title>L2 error against cells</title>\n<rect width="100%" height="100%" fill="#fff"/>\n`;
  Object.entries(titles).forEach(([problem, title], i) => {
    svg += `<g transform="translate(${i * width} 0)">\n<text x="${left}" y="20" font-size="13" font-weight="600">${title}</text>\n`;
    for (let e = -1; e >= -5; --e)
      svg += `<path d="M${left} ${y(10 ** e).toFixed(1)}H${width - 14}" stroke="#e4e4e4"/><text x="${left - 6}" y="${(y(10 ** e) + 4).toFixed(1)}" text-anchor="end">1e${e}</text>\n`;
    for (let n = 2; n <= 5; ++n)
      svg += `<path d="M${x(10 ** n).toFixed(1)} ${top}V${height - 40}" stroke="#e4e4e4"/><text x="${x(10 ** n).toFixed(1)}" y="${height - 24}" text-anchor="middle">1e${n}</text>\n`;
    svg += `<text x="${(left + width) / 2}" y="${height - 8}" text-anchor="middle">cells</text>\n`;
    svg += `<path d="M${x(1e4).toFixed(1)} ${y(0.1).toFixed(1)}L${x(1e5).toFixed(1)} ${y(0.01).toFixed(1)}" stroke="#222" stroke-dasharray="3 3" fill="none"/><text x="${x(3.4e4).toFixed(1)}" y="${(y(0.03) - 6).toFixed(1)}">2nd order</text>\n`;
    for (const kind of kinds) {
      const list = of(problem, kind);
      const points = list.map((r) => `${x(r.cells).toFixed(1)},${y(r.error).toFixed(1)}`);
      svg += `<polyline points="${points.join(' ')}" fill="none" stroke="${colours[kind]}" stroke-width="2"/>\n`;
      for (const p of points) svg += `<circle cx="${p.split(',')[0]}" cy="${p.split(',')[1]}" r="2.6" fill="${colours[kind]}"/>\n`;
    }
    svg += '</g>\n';
  });
  kinds.forEach((kind, i) => {
    svg += `<circle cx="${60 + i * 130}" cy="${height + 12}" r="4" fill="${colours[kind]}"/><text x="${70 + i * 130}" y="${height + 16}">${kind}</text>\n`;
  });
  return `${svg}</svg>\n`;
}

const summary = Object.entries(titles).map(([problem, title]) => {
  const cells = kinds.map((kind) => cellsAt(of(problem, kind), 1e-3));
  const ratio = cells[0] && cells[2] ? (cells[0] / cells[2]).toFixed(1) : '';
  const texts = kinds.map((kind, i) => {
    const first = of(problem, kind)[0];
    return first.error < 1e-3 ? `below ${number(first.cells)}` : number(cells[i]);
  });
  return `| ${title} | ${kinds.map((kind) => order(of(problem, kind)).toFixed(2)).join(' | ')} | ${texts.join(' | ')} | ${ratio} |`;
});

writeFileSync(join(root, 'docs/images/convergence.svg'), plot());
writeFileSync(
  join(root, 'docs/convergence.md'),
  `# Convergence of a solver that adapts

\`examples/solver\` holds a finite element solver of some 150 lines (Q1 on quads and hexahedra; diffusion, advection with
streamline upwinding) and the loop around it: solve, recover the Hessian, make the metric that minimises the L2 error of
interpolation for a number of cells, adapt, carry the solution over, solve again. Four turns at each number of cells, each
level from the last mesh of the one before. All numbers are from \`node scripts/convergence.mjs\`, which runs
\`build/release/bin/examples/convergence --all\` and writes this page. Errors are against the exact solutions
(\`examples/solver/problems.cpp\`), by five Gauss points per axis.

![L2 error against cells, for three problems](images/convergence.svg)

| problem | order: uniform | isotropic | anisotropic | cells for 1e-3: uniform | isotropic | anisotropic | uniform / anisotropic |
|---|---:|---:|---:|---:|---:|---:|---:|
${summary.join('\n')}

The order is that in the size of cells, N^(-1/2), of the line that fits all rows in logarithms (uniform: the last three).
"Carried" is the L2 error of the solution of the turn before, interpolated on the new mesh: what a time step or an iterative
solver would start from.

${Object.entries(titles)
  .map(([problem, title]) => `## ${title}\n\n${table(problem)}\n`)
  .join('\n')}`,
);

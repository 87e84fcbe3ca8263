// Lessons are written as articles; this puts the page around them: head, navigation, what comes before and after.
import { readFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

interface Lesson {
  file: string;
  title: string;
  idea: string;
  /** What is inside of an SVG of 48 x 48 units. */
  drawing: string;
}

const folder = join(dirname(fileURLToPath(import.meta.url)), 'lessons');
const lessons = JSON.parse(readFileSync(join(folder, 'lessons.json'), 'utf8')) as Lesson[];

function list(current: string): string {
  const items = lessons.map(
    ({ file, title }) => `<li><a href="./${file}"${file === current ? ' aria-current="page"' : ''}>${title}</a></li>`,
  );
  return `<ol>${items.join('')}</ol>`;
}

/** On the page of all lessons each has its idea in a sentence. */
function cards(): string {
  const items = lessons.map(
    ({ file, title, idea, drawing }) =>
      `<li><a href="./${file}"><svg viewBox="0 0 48 48" aria-hidden="true">${drawing}</svg>` +
      `<strong>${title}</strong><span>${idea}</span></a></li>`,
  );
  return `<ol class="cards">${items.join('')}</ol>`;
}

function around(at: number): string {
  const [before, after] = [lessons[at - 1], lessons[at + 1]];
  const link = (lesson: Lesson | undefined, word: string, rel: string): string =>
    lesson ? `<a rel="${rel}" href="./${lesson.file}"><span>${word}</span> ${lesson.title}</a>` : '<span></span>';
  return `<nav class="around" aria-label="Next lesson">${link(before, 'Before:', 'prev')}${link(after, 'Next:', 'next')}</nav>`;
}

function page(article: string, file: string): string {
  const at = lessons.findIndex((lesson) => lesson.file === file);
  const lesson = lessons[at];
  const title = lesson ? `${lesson.title} · pillowmesh` : 'Lessons · pillowmesh';
  return `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <meta name="description" content="${lesson?.idea ?? 'How meshes of quadrilaterals and hexahedra adapt, in nine small pages that compute.'}" />
    <title>${title}</title>
    <link rel="icon" href="../icon.svg" type="image/svg+xml" />
    <link rel="stylesheet" href="../style/lesson.css" />
    <script type="module" src="../src/lesson/main.ts"></script>
    <script src="../fallback.js" data-start="startLesson" defer vite-ignore></script>
  </head>
  <body>
    <a class="skip" href="#article">To the text</a>
    <header>
      <a class="home" href="../index.html">pillowmesh</a>
      <details class="contents"><summary>Lessons</summary><nav aria-label="Lessons">${list(file)}</nav></details>
    </header>
    <main id="article">
      <article>
        ${lesson ? `<p class="number">Lesson ${at + 1} of ${lessons.length}</p><h1>${lesson.title}</h1>` : ''}
${article.replace('<!-- lessons -->', cards())}
      </article>
      ${lesson ? around(at) : ''}
    </main>
    <footer>
      <p>Every figure computes in your browser. The method: K.-F. Tchon, J. Dompierre and R. Camarero, <cite>Conformal
      refinement of all-quadrilateral and all-hexahedral meshes according to an anisotropic metric</cite>, 11th
      International Meshing Roundtable, 2002.</p>
    </footer>
  </body>
</html>`;
}

export function lessonFrame(): Plugin {
  return {
    name: 'lesson-frame',
    transformIndexHtml: {
      order: 'pre',
      handler: (html, { filename }) => (dirname(filename) === folder ? page(html, basename(filename)) : html),
    },
  };
}

// The page in a frame: a <pillow-mesh> made of the address, `embed.html#case=iso2d&event=14&controls=step`, and a frame
// that grows with it.
import sheetText from '../../style/embed.css?inline';
import '../element/index.ts';
import { behaviourAttributes, stateAttributes } from '../element/attributes.ts';
import { offerHeight } from './resize.ts';

const known: ReadonlySet<string> = new Set([...stateAttributes, ...behaviourAttributes]);

/** Makes the element show what the address says. */
function read(element: HTMLElement): void {
  const query = new URLSearchParams(location.hash.slice(1));
  for (const name of known) {
    const value = query.get(name);
    if (value === null) element.removeAttribute(name);
    else element.setAttribute(name, value);
  }
  const theme = query.get('theme');
  if (theme) document.documentElement.dataset.theme = theme;
}

/** Fills the page. */
export function startEmbed(): void {
  const sheet = new CSSStyleSheet(); // a link to a style sheet would need CORS headers in a sandboxed frame
  sheet.replaceSync(sheetText);
  document.adoptedStyleSheets.push(sheet);
  const element = document.createElement('pillow-mesh');
  element.setAttribute('loading', 'eager');
  read(element);
  addEventListener('hashchange', () => read(element));

  const source = document.createElement('a');
  source.className = 'source';
  source.target = '_blank';
  source.rel = 'noopener';
  source.textContent = 'Open in pillowmesh';
  const link = (): void => void (source.href = `./index.html#${element.link}`);
  for (const name of ['load', 'step'] as const) element.addEventListener(name, link);

  document.body.append(element, source);
  link();
  offerHeight(document.body);
}

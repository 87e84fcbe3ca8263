// What a lesson has beside its text and its figures: questions with a check, buttons that drive a figure, the theme.
import { PillowMeshElement } from '../element/pillow_mesh.ts';
import { makeTagEditor } from './tag_editor.ts';

/**
 * A question is a form of radio buttons whose right answer has the value "right"; what is said to an answer stands in
 * its `data-reply`.
 */
function listenToQuestion(form: HTMLFormElement): void {
  const reply = form.querySelector('output')!;
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const chosen = form.querySelector<HTMLInputElement>('input:checked');
    const right = chosen?.value === 'right';
    form.dataset.answer = chosen ? (right ? 'right' : 'wrong') : 'none';
    reply.textContent = chosen
      ? `${right ? 'Yes.' : 'Not quite.'} ${chosen.dataset.reply ?? ''}`
      : 'Choose an answer first.';
  });
}

/** `<button data-figure="id" data-set="name=value&name=value">` sets attributes of a figure; an empty value removes. */
function listenToSetter(button: HTMLButtonElement): void {
  button.addEventListener('click', () => {
    const figure = document.getElementById(button.dataset.figure ?? '');
    if (!(figure instanceof PillowMeshElement)) return;
    for (const [name, value] of new URLSearchParams(button.dataset.set)) {
      if (value === '') figure.removeAttribute(name);
      else figure.setAttribute(name, value);
    }
    for (const other of button.parentElement?.querySelectorAll('button[data-set]') ?? [])
      other.setAttribute('aria-pressed', String(other === button));
    if (button.dataset.play !== undefined) figure.play();
  });
}

export function startLesson(): void {
  document.querySelectorAll<HTMLFormElement>('form.question').forEach(listenToQuestion);
  document.querySelectorAll<HTMLElement>('.tag-editor').forEach(makeTagEditor);
  document.querySelectorAll<HTMLButtonElement>('button[data-set]').forEach(listenToSetter);
  const loops = document.querySelectorAll<HTMLElement>('.solver-loop');
  if (loops.length > 0) void import('./solver_loop.ts').then(({ makeSolverLoop }) => loops.forEach(makeSolverLoop));
}

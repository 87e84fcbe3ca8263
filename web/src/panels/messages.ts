// What went wrong, in a sentence, and what can be done about it.
import { h } from '../ui/dom.ts';
import { icon } from '../ui/icons.ts';

export interface Message {
  text: string;
  kind: 'error' | 'note';
  /** A remedy that the visitor can choose. */
  action?: { label: string; run(): void };
}

export interface Messages {
  element: HTMLElement;
  show(message: Message): void;
  clear(): void;
}

const noteMilliseconds = 4500;

export function makeMessages(): Messages {
  const element = h('div', { class: 'messages' });
  return {
    element,
    show({ text, kind, action }) {
      const close = (): void => box.remove();
      const box = h(
        'div',
        { class: `message ${kind}`, role: kind === 'error' ? 'alert' : 'status' },
        h('p', {}, text),
        action
          ? h('button', { type: 'button', class: 'plain', onclick: () => (close(), action.run()) }, action.label)
          : null,
        h('button', { type: 'button', class: 'round small', 'aria-label': 'Dismiss', onclick: close }, icon('close')),
      );
      element.replaceChildren(box); // the latest one counts
      if (kind === 'note') setTimeout(close, noteMilliseconds);
    },
    clear: () => element.replaceChildren(),
  };
}

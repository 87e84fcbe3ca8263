// Dialogs of the page, loaded when they are wanted, and its link.
import type { Messages } from '../panels/messages.ts';
import { showOnce } from '../ui/dom.ts';

export async function showHelp(version: () => string): Promise<void> {
  const { makeHelp } = await import('../panels/help.ts');
  showOnce(makeHelp(version)).showModal();
}

/** The code to embed the state that `link` says, described by `caption`. */
export async function showEmbed(link: string, caption: string, messages: Messages): Promise<void> {
  const { makeEmbedDialog } = await import('../panels/embed_dialog.ts');
  const dialog = makeEmbedDialog((done) =>
    messages.show({ kind: 'note', text: done ? 'The code is copied.' : 'The code is selected; copy it from there.' }),
  );
  showOnce(dialog.element);
  dialog.show(link, caption);
}

/** The address, which holds all of the state, to the clipboard where that is allowed. */
export async function copyAddress(messages: Messages): Promise<void> {
  let text = 'The link is copied: it shows exactly this, event and camera included.';
  try {
    await navigator.clipboard.writeText(location.href);
  } catch {
    text = 'The address bar holds the link to exactly this; copy it from there.'; // forbidden, or no clipboard there
  }
  messages.show({ kind: 'note', text });
}

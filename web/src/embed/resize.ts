// Tells the page around a frame how high its content is, in the words that course systems and common scripts listen to.

/** The start of a message of iframe-resizer, both ways. */
const resizer = '[iFrameSizer]';

/**
 * Sends `height` whenever it changes: as `lti.frameResize` (Canvas, Moodle, Open edX and others), as `pillowmesh.resize`
 * for scripts of one's own, and to iframe-resizer once it has said its frame's id. Nothing but numbers is sent, to any
 * origin: who embeds a page may know its height.
 */
export function offerHeight(body: HTMLElement): void {
  if (window.parent === window) return;
  let sent = 0;
  let id: string | null = null;
  const send = (force = false): void => {
    const height = Math.ceil(body.getBoundingClientRect().height);
    if (height === 0 || (height === sent && !force)) return;
    sent = height;
    window.parent.postMessage({ subject: 'lti.frameResize', height }, '*');
    window.parent.postMessage({ subject: 'pillowmesh.resize', height }, '*');
    if (id !== null) window.parent.postMessage(`${resizer}${id}:${height}:${body.clientWidth}:size`, '*');
  };
  addEventListener('message', ({ data, source }) => {
    if (source !== window.parent || typeof data !== 'string' || !data.startsWith(resizer)) return;
    id = data.slice(resizer.length).split(':')[0];
    send(true);
  });
  new ResizeObserver(() => send()).observe(body);
  send();
}

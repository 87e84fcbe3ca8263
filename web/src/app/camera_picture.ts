// A picture from the camera, which is asked for only when the visitor has asked for it, and let go at once afterwards.
import '../../style/dialogs.css';
import { h, showOnce } from '../ui/dom.ts';

const refusals: Record<string, string> = {
  NotAllowedError: 'The camera was refused. Allow it for this page in the browser’s settings, or open a picture instead.',
  NotFoundError: 'No camera was found. Open a picture instead.',
  NotReadableError: 'The camera is in use elsewhere.',
};

/** Shows what the camera sees until a picture is taken; null when it is not. Rejects with a sentence without a camera. */
export async function takePicture(): Promise<File | null> {
  if (!navigator.mediaDevices) throw new Error('This page may ask for a camera only where it is served by https.');
  const stream = await navigator.mediaDevices.getUserMedia({ video: { facingMode: 'environment' } }).catch((error: Error) => {
    throw new Error(refusals[error.name] ?? `The camera does not work: ${error.message}`);
  });
  const video = h('video', { autoplay: true, muted: true, playsinline: true, 'aria-label': 'What the camera sees' });
  video.srcObject = stream;
  const dialog = h(
    'dialog',
    { class: 'help-dialog', 'aria-label': 'Camera' },
    video,
    h('p', { class: 'hint' }, 'Cells become fine where brightness changes. The picture stays in your browser.'),
    h(
      'form',
      { method: 'dialog' },
      h('button', { class: 'primary', value: 'take' }, 'Take the picture'),
      h('button', { class: 'plain', value: '' }, 'Cancel'),
    ),
  );
  showOnce(dialog).showModal();
  await new Promise((resolve) => dialog.addEventListener('close', resolve, { once: true }));
  const picture = dialog.returnValue === 'take' && video.videoWidth > 0 ? await still(video) : null;
  for (const track of stream.getTracks()) track.stop();
  return picture;
}

async function still(video: HTMLVideoElement): Promise<File> {
  const canvas = new OffscreenCanvas(video.videoWidth, video.videoHeight);
  canvas.getContext('2d')!.drawImage(video, 0, 0);
  return new File([await canvas.convertToBlob()], 'the camera', { type: 'image/png' });
}

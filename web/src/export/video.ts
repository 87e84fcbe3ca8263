// A short film of the run: plays it from the start and records what is drawn.
import type { Player } from '../replay/player.ts';

const longest = 30_000;
/** A file of fewer bytes has no picture in it. */
const least = 1000;

const wait = (milliseconds: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Rejects where the browser cannot record. The film ends with the run, or after half a minute. `draw` draws once more. */
export async function recordRun(player: Player, canvas: HTMLCanvasElement, draw: () => void): Promise<Blob> {
  const type = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'].find((name) => globalThis.MediaRecorder?.isTypeSupported(name));
  if (!type)
    throw new Error('This browser cannot record a film: it has no MediaRecorder for one. Pictures of single moments can be saved as .png.');
  if (player.events.length === 0) throw new Error('There is nothing to film yet: run it first.');
  player.pause();
  player.seek(0);
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 4_000_000 });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const over = new Promise<void>((resolve, reject) => {
    recorder.onstop = () => resolve();
    recorder.onerror = () => reject(new Error('The film could not be recorded.'));
  });
  recorder.start();
  player.play();
  const started = performance.now();
  while (player.playing && performance.now() - started < longest)
    await wait(100);
  player.pause();
  await wait(600); // the last picture stands
  for (let i = 0; i < 50 && parts.reduce((all, { size }) => all + size, 0) < least; ++i) {
    draw(); // a busy machine may have recorded none so far
    await wait(100);
    recorder.requestData();
  }
  recorder.stop();
  await over;
  return new Blob(parts, { type });
}

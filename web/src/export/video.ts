// A short film of the run: plays it from the start and records what is drawn.
import type { Player } from '../replay/player.ts';

const longest = 30_000;

/** Rejects where the browser cannot record. The film ends with the run, or after half a minute. */
export async function recordRun(player: Player, canvas: HTMLCanvasElement): Promise<Blob> {
  const type = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'].find((name) => globalThis.MediaRecorder?.isTypeSupported(name));
  if (!type) throw new Error('This browser cannot record a film.');
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
    await new Promise((resolve) => setTimeout(resolve, 100));
  player.pause();
  await new Promise((resolve) => setTimeout(resolve, 600)); // the last picture stands
  recorder.stop();
  await over;
  return new Blob(parts, { type });
}

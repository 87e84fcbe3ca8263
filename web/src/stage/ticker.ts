// Drives the player by the display's frames, only while it plays.
import type { Player } from '../replay/player.ts';

/** Makes a function to be called whenever the player may have started or stopped. */
export function makeTicker(player: Player): () => void {
  let last = 0;
  let running = false;
  const tick = (now: number): void => {
    if (!player.playing) {
      running = false;
      return;
    }
    player.tick(Math.max(0, now - last));
    last = now;
    requestAnimationFrame(tick);
  };
  return () => {
    if (running || !player.playing) return;
    running = true;
    last = performance.now();
    requestAnimationFrame(tick);
  };
}

// The picture over the whole screen, and back.
export async function toggleFullScreen(): Promise<void> {
  if (document.fullscreenElement) return document.exitFullscreen();
  await document.querySelector('.view')?.requestFullscreen().catch(() => undefined); // a frame may forbid it
}

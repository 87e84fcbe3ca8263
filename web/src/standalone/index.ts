// Everything in one classic script: three.js, worker and WebAssembly included. For pages opened from a folder without a
// server, for sandboxed frames, and for course systems that take a single file.
import '../element/index.ts';

export { PillowMeshElement, definePillowMesh } from '../element/index.ts';
export { startEmbed } from '../embed/embed.ts';
export { startLesson } from '../lesson/lesson.ts';

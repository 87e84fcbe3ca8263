// The script that a page loads: defines <pillow-mesh>.
import { definePillowMesh } from './pillow_mesh.ts';

definePillowMesh();

export type { PillowMeshEventMap } from './event_map.ts';
export { PillowMeshElement, definePillowMesh } from './pillow_mesh.ts';

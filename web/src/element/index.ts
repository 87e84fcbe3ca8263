// The script that a page loads: defines <pillow-mesh>.
import { definePillowMesh } from './pillow_mesh.ts';

definePillowMesh();

export { PillowMeshElement, definePillowMesh, type PillowMeshEventMap } from './pillow_mesh.ts';

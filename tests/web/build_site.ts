// Before the suite: what its files look at, where scripts/test.mjs has not made it already.
import { buildSite } from './site.ts';

export default async (): Promise<void> => {
  if (process.env.PILLOWMESH_SITE !== 'built') await buildSite();
};

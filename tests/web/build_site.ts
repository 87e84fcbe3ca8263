// Before the suite: what its files look at.
import { buildSite } from './site.ts';

export default buildSite;

// The first frame plays by itself, once for each visitor.
const key = 'pillowmesh-visited';

/** True the first time that it is asked in this browser; false where that cannot be known. */
export function firstVisit(): boolean {
  try {
    if (localStorage.getItem(key) !== null) return false;
    localStorage.setItem(key, 'yes');
    return true;
  } catch {
    return false;
  }
}

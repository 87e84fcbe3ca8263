// What an answer can be compared with.

/** What one can compare with: options that differ from those set. The value is what a link holds. */
export const rivals: readonly { value: string; label: string }[] = [
  { value: '', label: 'nothing' },
  { value: 'initial', label: 'the initial mesh' },
  { value: 'method=paper', label: 'the paper’s method' },
  { value: 'method=paper&smooth=none', label: 'no smoothing' },
  { value: 'method=paper&smooth=between', label: 'smoothing between iterations' },
  { value: 'method=full&effort=fast', label: 'full adaptation, fast' },
];

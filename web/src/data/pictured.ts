// The cases that are chosen by a picture: public/cases/NAME.svg, drawn by scripts/case_pictures.mjs.

export const pictured: readonly { name: string; label: string }[] = [
  { name: 'iso2d', label: 'Lines' },
  { name: 'aniso2d', label: 'Bands' },
  { name: 'circle2d', label: 'Circle' },
  { name: 'shock2d', label: 'Shock' },
  { name: 'riemann', label: 'Portrait' },
  { name: 'masabl-1', label: 'Layer' },
  { name: 'linear3d', label: 'Cubes' },
  { name: 'sphere3d', label: 'Sphere' },
];

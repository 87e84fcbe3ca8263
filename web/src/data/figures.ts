// The figures of the paper, each as a link to the state of the page that shows its counterpart.

export interface Figure {
  number: string;
  title: string;
  /** As state/permalink.ts reads it. */
  link: string;
}

export const figures: readonly Figure[] = [
  { number: '5', title: 'Two lines of fine squares', link: 'case=iso2d&hide=ellipses&event=last' },
  { number: '6', title: 'The same, stretched', link: 'case=aniso2d&hide=ellipses&event=last' },
  { number: '7', title: 'A circle that no row follows', link: 'case=circle2d&smooth=between&hide=ellipses&event=last' },
  {
    number: '9',
    title: 'Cubes that grow upwards',
    link: 'case=linear3d&cut=plane:-90,0,0.5&event=last&view=0.5,0.7,0.5;1.1;0.45,-0.8,0.35',
  },
  {
    number: '10',
    title: 'Flat cells along a sphere',
    link: 'case=sphere3d-paper&cut=plane:0,90,0.28&event=last&view=0.45,0.45,0.15;1.1;-0.45,-0.55,0.75',
  },
];

// The rows that the paper published for its cases (Tables 1 to 5). Its column sigma is std / mean, called cv here.

/** count, min, mean, max, cv */
export type Row = readonly [count: number, min: number, mean: number, max: number, cv: number];

export interface PublishedMesh {
  label: string;
  lengths: Row;
  shapes: Row;
}

export const published: Readonly<Record<string, readonly PublishedMesh[]>> = {
  iso2d: [
    { label: 'initial', lengths: [142, 1.0, 4.205, 20.0, 1.042], shapes: [63, 0.179, 0.642, 1.04, 0.398] },
    { label: 'quads', lengths: [4427, 0.321, 0.919, 1.88, 0.303], shapes: [2182, 0.271, 0.782, 0.98, 0.247] },
    { label: 'triangles', lengths: [6326, 0.789, 0.998, 1.31, 0.076], shapes: [4189, 0.88, 0.982, 1.0, 0.018] },
  ],
  aniso2d: [
    { label: 'initial', lengths: [142, 1.275, 3.875, 11.7, 0.703], shapes: [63, 0.229, 0.73, 1.0, 0.28] },
    { label: 'quads', lengths: [1372, 1.181, 1.197, 1.21, 0.012], shapes: [660, 0.953, 0.993, 1.0, 0.007] },
    { label: 'triangles', lengths: [3238, 0.768, 1.022, 1.35, 0.071], shapes: [2119, 0.806, 0.985, 1.0, 0.02] },
  ],
  circle2d: [
    { label: 'initial', lengths: [220, 0.447, 2.126, 10.3, 1.246], shapes: [100, 0.103, 0.689, 0.94, 0.375] },
    { label: 'refine, smooth', lengths: [6660, 0.295, 0.663, 1.39, 0.292], shapes: [3316, 0.215, 0.645, 0.97, 0.269] },
    { label: 'coarse + dice', lengths: [9400, 0.139, 0.529, 1.32, 0.474], shapes: [4672, 0.205, 0.743, 0.98, 0.156] },
    { label: 'combined', lengths: [4968, 0.199, 0.775, 2.05, 0.307], shapes: [2460, 0.139, 0.672, 0.98, 0.26] },
  ],
  linear3d: [
    { label: 'initial', lengths: [300, 1.25, 2.456, 5.0, 0.497], shapes: [64, 0.815, 0.895, 0.94, 0.056] },
    { label: 'hexes', lengths: [4168, 0.272, 1.072, 2.12, 0.251], shapes: [1144, 0.244, 0.77, 0.95, 0.179] },
    { label: 'tets', lengths: [14219, 0.726, 1.034, 1.38, 0.124], shapes: [10899, 0.582, 0.914, 1.0, 0.053] },
  ],
  'sphere3d-paper': [
    { label: 'initial', lengths: [540, 0.105, 0.464, 4.69, 1.406], shapes: [125, 0.099, 0.784, 0.95, 0.26] },
    { label: 'hexes', lengths: [18385, 0.02, 0.339, 1.48, 0.459], shapes: [5638, 0.002, 0.566, 0.93, 0.394] },
  ],
};

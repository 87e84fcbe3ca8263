// GLSL of the layers. Positions go from `from` to `to` with `progress`, so that a change is animated without touching
// a buffer.

/** three.js tone maps and encodes through this include; colours given as uniforms are linear. */
const output = /* glsl */ `
  #include <colorspace_fragment>
`;

export const faceVertexShader = /* glsl */ `
  in vec3 from;
  in vec3 to;
  in vec2 paint;
  in vec4 facing;
  uniform float progress;
  out vec2 corner;
  flat out vec3 normalSeen;
  flat out vec2 painted;
  out float hollow;

  void main() {
    corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1);
    painted = paint;
    normalSeen = normalMatrix * facing.xyz;
    hollow = facing.w;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(mix(from, to, progress), 1.0);
  }
`;

export const faceFragmentShader = /* glsl */ `
  in vec2 corner;
  flat in vec3 normalSeen;
  flat in vec2 painted;
  in float hollow;
  uniform float progress;
  uniform sampler2D colours;
  uniform float coloured;
  uniform float lineWidth;
  uniform float lit;
  uniform vec3 cellColour;
  uniform vec3 lineColour;
  uniform vec3 layerColour;
  uniform vec3 bufferColour;
  uniform vec3 cutColour;
  uniform float glass;
  uniform vec3 background;
  uniform vec3 chordColour;
  uniform vec3 otherChordColour;

  void main() {
    bool isLayer = painted.y > 0.5 && painted.y < 1.5;
    bool isBuffer = painted.y > 1.5 && painted.y < 2.5;
    bool isCut = painted.y > 2.5 && painted.y < 3.5;
    bool isFaded = painted.y > 3.5 && painted.y < 4.5;
    bool isChord = painted.y > 4.5;
    vec3 colour = cellColour;
    if (coloured > 0.5 && painted.x >= 0.0)
      colour = texture2D(colours, vec2((painted.x * 255.0 + 0.5) / 256.0, 0.5)).rgb;

    else if (isCut)
      colour = cutColour;

    if (isChord) colour = mix(colour, painted.y > 5.5 ? otherChordColour : chordColour, 0.5);

    // The layer is tinted, the buffer layer hatched: they differ without colour, too.
    if (isLayer) colour = mix(colour, layerColour, 0.42);
    float hatched = 0.0;
    if (isBuffer) {
      float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / (9.0 * lineWidth)) - 0.5) * 9.0 * lineWidth;
      float hatch = 1.0 - smoothstep(1.4 * lineWidth, 1.4 * lineWidth + 1.0, stripe);
      hatched = mix(0.16, 0.72, hatch) * progress;
      colour = mix(colour, bufferColour, glass > 0.5 ? 1.0 : hatched);
    }

    if (lit > 0.5) {
      float upwards = normalSeen.z < 0.0 ? -normalSeen.y : normalSeen.y;
      colour *= 0.66 + 0.34 * abs(normalSeen.z) + 0.06 * upwards;
      colour *= 1.0 - (hollow < 0.0 ? 0.1 : coloured > 0.5 ? 0.42 : 0.62) * hollow; // less sky in hollows, more light on edges
    }

    // Distance in pixels to the four sides; lines fade where cells become as small as the lines.
    vec2 alongX = dFdx(corner);
    vec2 alongY = dFdy(corner);
    vec2 slope = max(sqrt(alongX * alongX + alongY * alongY), 1e-9);
    vec2 side = min(corner, 1.0 - corner) / slope;
    float distance = min(side.x, side.y);
    float size = 1.0 / max(slope.x, slope.y);
    float half_ = 0.5 * lineWidth;
    float line = 1.0 - smoothstep(half_ - 0.5, half_ + 0.5, distance);
    line *= mix(0.4, 1.0, smoothstep(1.5, 5.0, size / lineWidth));
    float alpha = 1.0;
    if (glass > 0.5) {
      bool plain = coloured < 0.5 || painted.x < 0.0;
      alpha = isBuffer ? mix(0.5 * hatched, 0.7 * progress, line) : mix(plain ? 0.05 : 0.16, 0.2, line);
      if (isBuffer) colour = bufferColour;
      if (alpha < 0.004) discard;
    }
    vec3 shown = mix(colour, isBuffer && glass > 0.5 ? bufferColour : lineColour, line);
    gl_FragColor = vec4(isFaded ? mix(background, shown, 0.12) : shown, alpha);
    ${output}
  }
`;

/** Segments of a width in pixels with round ends, `trim` of their length left out at each end. */
export const strokeVertexShader = /* glsl */ `
  in vec3 start;
  in vec3 finish;
  uniform float width;
  uniform float trim;
  uniform vec2 resolution;
  uniform float lift;
  uniform bool outline;
  in vec3 facing1;
  in vec3 facing2;
  out vec2 along; // pixels along the segment from its start, and across
  flat out float pixels;

  void main() {
    vec4 a = projectionMatrix * modelViewMatrix * vec4(mix(start, finish, trim), 1.0);
    vec4 b = projectionMatrix * modelViewMatrix * vec4(mix(finish, start, trim), 1.0);
    vec2 p = a.xy / a.w * 0.5 * resolution;
    vec2 q = b.xy / b.w * 0.5 * resolution;
    pixels = length(q - p);
    vec2 tangent = pixels > 1e-6 ? (q - p) / pixels : vec2(1.0, 0.0);
    vec2 normal = vec2(-tangent.y, tangent.x);
    float reach = 0.5 * width + 1.0;
    bool far = position.x > 0.5;
    vec2 at = (far ? q : p) + (far ? reach : -reach) * tangent + position.y * reach * normal;
    along = vec2(far ? pixels + reach : -reach, position.y * reach);
    vec4 base = far ? b : a;
    gl_Position = vec4(at / (0.5 * resolution) * base.w, base.z - lift * base.w, base.w);
    // An outline: one facet is seen from its front, the other from behind.
    if (outline && (normalMatrix * facing1).z * (normalMatrix * facing2).z > 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

export const strokeFragmentShader = /* glsl */ `
  in vec2 along;
  flat in float pixels;
  uniform float width;
  uniform vec3 colour;
  uniform float opacity;
  uniform float dash;

  void main() {
    float beyond = max(max(-along.x, along.x - pixels), 0.0);
    float distance = length(vec2(beyond, along.y));
    float alpha = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, distance);
    if (dash > 0.0) {
      float phase = abs(fract(along.x / dash) - 0.5) * dash;
      alpha *= smoothstep(0.18 * dash - 0.7, 0.18 * dash + 0.7, phase);
    }
    if (alpha < 0.004) discard;
    gl_FragColor = vec4(colour, alpha * opacity);
    ${output}
  }
`;

/** Ellipses as the image of the unit circle: centre + u * axis1 + v * axis2. */
export const ellipseVertexShader = /* glsl */ `
  in vec3 centre;
  in vec3 axis1;
  in vec3 axis2;
  out vec2 disk;

  void main() {
    disk = position.xy * 1.15;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(centre + disk.x * axis1 + disk.y * axis2, 1.0);
  }
`;

export const ellipseFragmentShader = /* glsl */ `
  in vec2 disk;
  uniform vec3 colour;
  uniform float width;
  uniform float strength;

  void main() {
    float radius = length(disk);
    float slope = max(length(vec2(dFdx(radius), dFdy(radius))), 1e-9);
    float inside = (1.0 - radius) / slope; // pixels from the rim
    float rim = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, abs(inside - 0.5 * width));
    float fill = smoothstep(-0.5, 0.5, inside);
    float size = 1.0 / slope;
    float alpha = max(0.85 * rim, 0.13 * fill) * mix(0.5, 1.0, smoothstep(2.0, 8.0, size)) * strength;
    if (alpha < 0.004) discard;
    gl_FragColor = vec4(colour, alpha);
    ${output}
  }
`;

/** Ellipsoids as the image of the unit ball, whose normals go by the inverse transpose. */
export const ellipsoidVertexShader = /* glsl */ `
  in vec3 centre;
  in vec3 axis1;
  in vec3 axis2;
  in vec3 axis3;
  out vec3 normalSeen;

  void main() {
    mat3 axes = mat3(axis1, axis2, axis3);
    normalSeen = normalMatrix * (transpose(inverse(axes)) * position);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(centre + axes * position, 1.0);
  }
`;

export const ellipsoidFragmentShader = /* glsl */ `
  in vec3 normalSeen;
  uniform vec3 colour;

  void main() {
    vec3 n = normalize(normalSeen);
    gl_FragColor = vec4(colour * (0.55 + 0.45 * n.z + 0.1 * n.y) + 0.05 * (1.0 + n.y), 1.0);
    ${output}
  }
`;

// Rectangles of faces: four vertices each, coloured a face by a texture.
"use strict";

const faces = {};

const kVertexShader = `
attribute vec4 rectangle;  // the least voxel's key, and the shape: see packed.hpp
attribute float firstFace;
uniform vec3 origin;       // the key that lies at the map's origin
uniform float resolution;
varying vec2 face;         // in the rectangle
varying float height;
flat varying vec2 size;    // of the rectangle, faces
flat varying float first;
flat varying float shade;

void main() {
  float width = 1.0 + mod(rectangle.w, 32.0);
  float rows = 1.0 + mod(floor(rectangle.w / 32.0), 32.0);
  float normal = floor(rectangle.w / 1024.0);
  float axis = floor(normal / 2.0);
  bool positive = mod(normal, 2.0) > 0.5;
  // Outside is where corners run counter-clockwise.
  int corner = gl_VertexID & 3;
  bool isFar = corner == 1 || corner == 2;
  vec2 place = vec2(isFar == positive ? width : 0.0, corner > 1 ? rows : 0.0);
  vec3 along = vec3(positive ? 1.0 : 0.0, place);  // across, along width, along height
  vec3 cell = axis < 0.5 ? along.xyz : axis < 1.5 ? along.zxy : along.yzx;
  vec3 p = (rectangle.xyz + cell - origin) * resolution;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0);
  face = place;
  height = p.z;
  size = vec2(width, rows);
  first = firstFace;
  shade = axis > 1.5 ? (positive ? 1.0 : 0.62) : axis > 0.5 ? 0.86 : 0.74;
}`;

const kFragmentShader = `
precision highp float;
precision highp sampler2D;
uniform sampler2D values;  // a byte a face, a row of valuesWidth after the other
uniform sampler2D ramp;
uniform sampler2D captures; // of each face the first that saw it, in the same places
uniform float lastCapture; // faces that later ones saw first are left out; below 0: none are
uniform float valuesWidth;
uniform vec2 heights;      // of the ramp's ends
uniform float byHeight;    // 1: the height, 0: the value
uniform float cutHeight;
uniform float fade;        // share of grey
uniform vec3 plainColour;
uniform float opacity;     // below 1: no values, plainColour
varying vec2 face;
varying float height;
flat varying vec2 size;
flat varying float first;
flat varying float shade;

void main() {
  if (height > cutHeight) discard;
  if (opacity < 1.0) {
    gl_FragColor = vec4(plainColour * (0.7 + 0.3 * shade), opacity);
    return;
  }
  vec2 cell = clamp(floor(face), vec2(0.0), size - 1.0);
  float index = first + cell.y * size.x + cell.x;
  float row = floor((index + 0.5) / valuesWidth);
  ivec2 texel = ivec2(index - row * valuesWidth, row);
  if (lastCapture >= 0.0 && texelFetch(captures, texel, 0).r > lastCapture) discard;
  float value = texelFetch(values, texel, 0).r;
  float share = byHeight > 0.5 ? (height - heights.x) / max(heights.y - heights.x, 1e-3) : value;
  vec3 colour = texelFetch(ramp, ivec2(clamp(share, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
  colour = mix(colour, vec3(0.55), fade);
  // Voxels are told apart where they are large enough on the screen.
  vec2 pixel = fwidth(face);
  vec2 edge = abs(fract(face - 0.5) - 0.5) / max(pixel, vec2(1e-6));
  float line = 1.0 - min(min(edge.x, edge.y), 1.0);
  colour *= 1.0 - 0.28 * line * smoothstep(0.25, 0.08, max(pixel.x, pixel.y));
  gl_FragColor = vec4(colour * shade, 1.0);
}`;

/** A texture of bytes or colours that is read by whole texels. */
faces.texture = (texels, width, rows, format, type = THREE.UnsignedByteType) => {
  const texture = new THREE.DataTexture(texels, width, rows, format, type);
  texture.magFilter = texture.minFilter = THREE.NearestFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
};

/** Of each rectangle of packed.hpp the number of its first face, and of the faces after the last. */
const firstFaces = rectangles => {
  const firstFace = new Float32Array(rectangles.length / 4);
  let next = 0;
  for (let i = 0; i < firstFace.length; ++i) {
    firstFace[i] = next;
    const shape = rectangles[4 * i + 3];
    next += (1 + (shape & 31)) * (1 + (shape >> 5 & 31));
  }
  return [firstFace, next];
};

/**
 * Unpacks a set of faces: its rectangles, the number of each one's first face, their values and, of
 * an episode, the captures that first saw them.
 */
faces.unpack = async id => {
  const rectangles = new Uint16Array(await page.bytes(id));
  const values = new Uint8Array(await page.bytes(id + "-values"));
  const captures = new Uint16Array(await page.bytes(id + "-captures"));
  const [firstFace] = firstFaces(rectangles);
  return {rectangles, firstFace, values, captures, count: firstFace.length};
};

/** Unpacks the sets of a brick, as packed_surface() packs them. */
faces.unpackBrick = async packed => {
  const bytes = await page.unpack(packed);
  const counts = new Uint32Array(bytes, 0, 3);
  let at = counts.byteLength;
  const sets = Array.from(counts, count => {
    const rectangles = new Uint16Array(bytes, at, 4 * count);
    at += rectangles.byteLength;
    return {rectangles, count, captures: new Uint16Array(0)};
  });
  const [seen, backs, frontier] = sets;
  for (const set of sets) {
    const [firstFace, faceCount] = firstFaces(set.rectangles);
    set.firstFace = firstFace;
    set.values = new Uint8Array(bytes, at, set === frontier ? 0 : faceCount);
    at += set.values.byteLength;
  }
  return {seen, backs, frontier};
};

/** The settings that all sets share; those of the lattice are the map's, see faces.setLattice. */
faces.sharedUniforms = () => ({
  origin: {value: new THREE.Vector3()},
  resolution: {value: 1},
  ramp: {value: null},
  heights: {value: new THREE.Vector2(0, 1)},
  byHeight: {value: 0},
  cutHeight: {value: 1e9},
  lastCapture: {value: -1},
  fade: {value: 0},
});

faces.setLattice = (shared, {key_of_origin, resolution_m}) => {
  shared.origin.value.setScalar(key_of_origin);
  shared.resolution.value = resolution_m;
};

/** A set's rectangles as vertices; `bounds` is a sphere around them, metres, if one is known. */
faces.geometry = (set, bounds) => {
  // Each number four times: instances of a square would be fewer bytes, but many times slower.
  const rectangles = new Uint16Array(16 * set.count);
  const firstFace = new Float32Array(4 * set.count);
  const index = new Uint32Array(6 * set.count);
  for (let i = 0; i < set.count; ++i) {
    const rectangle = set.rectangles.subarray(4 * i, 4 * i + 4);
    for (let corner = 0; corner < 4; ++corner) rectangles.set(rectangle, 16 * i + 4 * corner);
    firstFace.fill(set.firstFace[i], 4 * i, 4 * i + 4);
    const v = 4 * i;
    index.set([v, v + 1, v + 2, v, v + 2, v + 3], 6 * i);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  const keys = new THREE.BufferAttribute(rectangles, 4);
  geometry.setAttribute("rectangle", keys);
  geometry.setAttribute("position", keys);  // three.js draws nothing without
  geometry.setAttribute("firstFace", new THREE.BufferAttribute(firstFace, 1));
  geometry.boundingSphere = bounds;
  return geometry;
};

/** In place of a texture of a set that has none. */
const kNothing = faces.texture(new Uint8Array(1), 1, 1, THREE.RedFormat);

/** A texture of one number a face, `width` a row. */
const faceTexture = (numbers, width, type) => {
  if (numbers.length === 0) return kNothing;
  const rows = Math.ceil(numbers.length / width);
  const texels = new numbers.constructor(width * rows);
  texels.set(numbers);
  return faces.texture(texels, width, rows, THREE.RedFormat, type);
};

/** A mesh of a set. `look`: {side, opacity, colour}; opaque sets are coloured by their values. */
faces.mesh = (set, shared, look) => {
  const width = Math.min(4096, Math.max(1, set.values.length));
  const opacity = look.opacity || 1;
  const material = new THREE.ShaderMaterial({
    vertexShader: kVertexShader,
    fragmentShader: kFragmentShader,
    side: look.side === undefined ? THREE.FrontSide : look.side,
    transparent: opacity < 1,
    depthWrite: opacity === 1,
    uniforms: Object.assign({}, shared, {
      values: {value: faceTexture(set.values, width)},
      captures: {value: faceTexture(Float32Array.from(set.captures), width, THREE.FloatType)},
      valuesWidth: {value: width},
      plainColour: {value: new THREE.Color(look.colour || 0)},
      opacity: {value: opacity},
    }),
  });
  const mesh = new THREE.Mesh(set.geometry, material);
  mesh.frustumCulled = !!set.geometry.boundingSphere;  // three.js cannot tell where vertices are
  return mesh;
};

/** Gives back what an object that is shown no more holds of the graphics' memory. */
faces.forget = object => object.traverse(part => {
  if (part.geometry) part.geometry.dispose();
  const {material} = part;
  if (!material) return;
  for (const name of ["values", "captures"]) {  // the other textures are shared
    const texture = material.uniforms && material.uniforms[name] && material.uniforms[name].value;
    if (texture && texture !== kNothing) texture.dispose();
  }
  material.dispose();
});

/**
 * The face of a set that a ray meets first: {distance, value, centre_m}; null for none. `ray` is a
 * THREE.Ray in the map frame; the shared settings leave out what is not drawn.
 */
faces.pick = (set, ray, {cutHeight, lastCapture}) => {
  const {resolution_m, key_of_origin} = page.data.map;
  const from = ray.origin.toArray().map(c => c / resolution_m + key_of_origin);
  const along = ray.direction.toArray();
  const r = set.rectangles;
  let best = Infinity, found = -1, bestU = 0, bestV = 0;
  for (let i = 0; i < set.count; ++i) {
    const shape = r[4 * i + 3];
    const normal = shape >> 10, axis = normal >> 1, positive = normal & 1;
    const speed = along[axis];
    if (positive ? speed >= 0 : speed <= 0) continue;  // seen from behind
    const t = (r[4 * i + axis] + positive - from[axis]) / speed;
    if (t <= 0 || t >= best) continue;
    const a = (axis + 1) % 3, b = (axis + 2) % 3;
    const u = Math.floor(from[a] + t * along[a] - r[4 * i + a]);
    if (u < 0 || u > (shape & 31)) continue;
    const v = Math.floor(from[b] + t * along[b] - r[4 * i + b]);
    if (v < 0 || v > (shape >> 5 & 31)) continue;
    if ((from[2] + t * along[2] - key_of_origin) * resolution_m > cutHeight.value) continue;
    if (lastCapture.value >= 0
      && set.captures[set.firstFace[i] + v * (1 + (shape & 31)) + u] > lastCapture.value) continue;
    best = t, found = i, bestU = u, bestV = v;
  }
  if (found < 0) return null;
  const shape = r[4 * found + 3], axis = shape >> 11;
  const key = [r[4 * found], r[4 * found + 1], r[4 * found + 2]];
  key[(axis + 1) % 3] += bestU;
  key[(axis + 2) % 3] += bestV;
  return {
    distance: best * resolution_m,
    value: set.values[set.firstFace[found] + bestV * (1 + (shape & 31)) + bestU],
    centre_m: key.map(k => (k + 0.5 - key_of_origin) * resolution_m),
  };
};

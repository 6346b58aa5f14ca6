// The map's surfaces: sets of faces by the part of the map that they are of, each replaced on its
// own where the map grows.
"use strict";

const surface = {};

/** A brick's width in voxels: what the server makes and sends at a time. */
const kBrickVoxels = 32;

/** An object of the scene by the name of its switch, with its set and look: see faces.mesh. */
const kLooks = {
  seen: {set: "seen"},
  backs: {set: "backs"},
  unknown: {set: "frontier", side: THREE.BackSide, opacity: 0.45, colour: "#8d6bb8"},
  free: {set: "frontier", opacity: 0.3, colour: "#5aa5c8"},
};

/** No surface yet. `groups` are the objects; `shared` the settings of all faces. */
surface.create = shared => {
  const groups = {};
  for (const name of Object.keys(kLooks)) groups[name] = new THREE.Group();
  return {groups, shared, parts: new Map()};
};

/** The sets of that name of all parts. */
surface.sets = (all, name) => [...all.parts.values()].map(part => part.sets[name]);

surface.count = (all, name) => surface.sets(all, name).reduce((sum, set) => sum + set.count, 0);

/** Takes a part away. */
surface.remove = (all, key) => {
  const part = all.parts.get(key);
  if (!part) return;
  for (const [name, mesh] of Object.entries(part.meshes)) {
    all.groups[name].remove(mesh);
    faces.forget(mesh);
  }
  all.parts.delete(key);
};

surface.clear = all => {
  for (const key of [...all.parts.keys()]) surface.remove(all, key);
};

/** Puts a part in place of the one of that key; `sets`: {seen, backs, frontier} as unpacked. */
surface.put = (all, key, sets, bounds = null) => {
  surface.remove(all, key);
  const meshes = {};
  for (const [name, look] of Object.entries(kLooks)) {
    const set = sets[look.set];
    if (set.count === 0) continue;
    if (!set.geometry) set.geometry = faces.geometry(set, bounds);
    meshes[name] = faces.mesh(set, all.shared, look);
    all.groups[name].add(meshes[name]);
  }
  all.parts.set(key, {sets, meshes, bounds});
};

/** The sphere around a brick of that name, "x,y,z" in keys, metres. */
const brickBounds = name => {
  const {resolution_m, key_of_origin} = page.data.map;
  const middle = name.split(",").map(k => (+k + kBrickVoxels / 2 - key_of_origin) * resolution_m);
  return new THREE.Sphere(new THREE.Vector3(...middle), 0.87 * kBrickVoxels * resolution_m);
};

/** Takes bricks as a server sends them: packed by name, empty where nothing is left of one. */
surface.putBricks = async (all, bricks, isWhole) => {
  const unpacked = await Promise.all(Object.entries(bricks).map(async ([name, packed]) =>
    [name, packed && await faces.unpackBrick(packed)]));
  if (isWhole) surface.clear(all);
  for (const [name, sets] of unpacked) {
    if (sets) surface.put(all, name, sets, brickBounds(name));
    else surface.remove(all, name);
  }
};

/** The face that a ray meets first of those that are drawn: see faces.pick; null for none. */
surface.pick = (all, ray) => {
  let best = null;
  for (const name of ["seen", "backs"]) {
    if (!all.groups[name].visible) continue;
    for (const {sets, bounds} of all.parts.values()) {
      if (bounds && !ray.intersectsSphere(bounds)) continue;
      const hit = faces.pick(sets[name], ray, all.shared);
      if (hit && (!best || hit.distance < best.distance)) best = hit;
    }
  }
  return best;
};

/** The box of the map without its outermost hundredths, metres: stray voxels count for nothing. */
surface.usualBox = all => {
  const {resolution_m, key_of_origin} = page.data.map;
  const hasVoxels = surface.count(all, "seen") + surface.count(all, "backs") > 0;
  const sets = (hasVoxels ? ["seen", "backs"] : ["frontier"]).flatMap(name => surface.sets(all, name));
  const step = Math.max(1, Math.floor(sets.reduce((sum, set) => sum + set.count, 0) / 40000));
  const keys = [[], [], []];
  let next = 0;  // rectangles until the one that counts
  for (const {rectangles, count} of sets) {
    for (; next < count; next += step) {
      for (let axis = 0; axis < 3; ++axis) keys[axis].push(rectangles[4 * next + axis]);
    }
    next -= count;
  }
  const box = new THREE.Box3();
  if (keys[0].length === 0) return box.set(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1));
  keys.forEach((sorted, axis) => {
    sorted.sort((a, b) => a - b);
    const at = share => sorted[Math.round(share * (sorted.length - 1))];
    box.min.setComponent(axis, (at(0.01) - key_of_origin) * resolution_m);
    box.max.setComponent(axis, (at(0.99) + 1 - key_of_origin) * resolution_m);
  });
  return box;
};

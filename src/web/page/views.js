// The robot and what its camera sees: as lines and translucent cones.
"use strict";

const views = {};

const kMastRadius_m = 0.02;
const kBaseRadius_m = 0.2;

/** A point of the image's border at a share of its sides from -1 to 1, a range away. */
const imagePoint = (camera, x, y, range_m) => {
  const direction = new THREE.Vector3(x * Math.tan(camera.half_fov_horizontal_rad),
    y * Math.tan(camera.half_fov_vertical_rad), 1);
  if (!camera.is_range_along_axis) direction.normalize();
  return direction.multiplyScalar(range_m);
};

/** Points along the image's border, closed, a range away, in the sensor's frame. */
const border = (camera, range_m) => {
  const kSteps = 12, corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const points = [];
  corners.forEach(([x, y], i) => {
    const [toX, toY] = corners[(i + 1) % 4];
    for (let k = 0; k < kSteps; ++k) {
      const share = k / kSteps;
      points.push(imagePoint(camera, x + (toX - x) * share, y + (toY - y) * share, range_m));
    }
  });
  return points;
};

/** The space that a camera sees, in its own frame. `options`: {colour, dashed, fill}. */
views.frustum = (camera, {colour, dashed = false, fill = 0}) => {
  const near = border(camera, camera.range_min_m);
  const far = border(camera, camera.range_max_m);
  const lines = [];
  const count = far.length;
  for (let i = 0; i < count; ++i) {
    lines.push(near[i], near[(i + 1) % count], far[i], far[(i + 1) % count]);
    if (i % (count / 4) === 0) lines.push(new THREE.Vector3(), far[i]);
  }
  const geometry = new THREE.BufferGeometry().setFromPoints(lines);
  const material = dashed
    ? new THREE.LineDashedMaterial({color: colour, dashSize: 0.08, gapSize: 0.06})
    : new THREE.LineBasicMaterial({color: colour});
  const outline = new THREE.LineSegments(geometry, material);
  if (dashed) outline.computeLineDistances();
  const group = new THREE.Group();
  group.add(outline);
  if (fill > 0) {
    const sides = [];
    for (let i = 0; i < count; ++i) sides.push(near[i], far[i], far[(i + 1) % count]);
    for (let i = 0; i < count; ++i) sides.push(near[i], far[(i + 1) % count], near[(i + 1) % count]);
    group.add(new THREE.Mesh(new THREE.BufferGeometry().setFromPoints(sides),
      new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity: fill,
        side: THREE.DoubleSide, depthWrite: false})));
  }
  return group;
};

/** Puts an object of the sensor's or base's frame into the map: `matrix` is column by column. */
views.place = (object, matrix) => {
  object.matrixAutoUpdate = false;
  object.matrix.fromArray(matrix);
  object.matrixWorldNeedsUpdate = true;
};

/** A rod between two points, as objects to add: none where they are one. */
const rod = (from, to, colour) => {
  const length = from.distanceTo(to);
  if (length < 1e-6) return [];
  const mesh = new THREE.Mesh(
    new THREE.CylinderBufferGeometry(kMastRadius_m, kMastRadius_m, length, 12),
    new THREE.MeshBasicMaterial({color: colour}));
  mesh.position.copy(from).lerp(to, 0.5);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0),
    to.clone().sub(from).divideScalar(length));
  return [mesh];
};

/** T_map_mast of a base: where the pan axis stands, which may be beside the base's origin. */
views.mastOn = T_map_base => {
  const {pan_axis_x_m, pan_axis_y_m} = page.data.mast;
  return new THREE.Matrix4().fromArray(T_map_base)
    .multiply(new THREE.Matrix4().makeTranslation(pan_axis_x_m, pan_axis_y_m, 0));
};

/** The base as a disc with its heading, and the mast up to the camera. */
views.robot = (view, colour) => {
  const T_map_base = new THREE.Matrix4().fromArray(view.T_map_base);
  const camera_m = new THREE.Vector3().setFromMatrixPosition(
    new THREE.Matrix4().fromArray(view.T_map_sensor));
  const group = new THREE.Group();
  const material = new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity: 0.55,
    side: THREE.DoubleSide});
  const disc = new THREE.Mesh(new THREE.CircleBufferGeometry(kBaseRadius_m, 32), material);
  const heading = new THREE.Mesh(new THREE.BufferGeometry().setFromPoints([[0.2, 0.09, 0],
    [0.2, -0.09, 0], [0.34, 0, 0]].map(p => new THREE.Vector3(...p))), material);
  const base = new THREE.Group();
  base.add(disc, heading);
  views.place(base, new THREE.Matrix4().makeTranslation(0, 0, 0.01).premultiply(T_map_base).elements);
  const T_map_mast = views.mastOn(view.T_map_base);
  const foot = new THREE.Vector3().setFromMatrixPosition(T_map_mast);
  const top = new THREE.Vector3(0, 0, view.joints.height_m).applyMatrix4(T_map_mast);
  group.add(base, ...rod(foot, top, colour), ...rod(top, camera_m, colour));
  const head = new THREE.Mesh(new THREE.BoxBufferGeometry(0.1, 0.05, 0.05),
    new THREE.MeshBasicMaterial({color: colour}));
  head.applyMatrix(new THREE.Matrix4().fromArray(view.T_map_sensor));
  group.add(head);
  return group;
};

/** The answer: the robot as it stands and as it should look. */
views.answer = (answer, camera) => {
  const colour = name => new THREE.Color(page.styleColour(name));
  const group = new THREE.Group();
  for (const [name, look] of [["current", {dashed: true}], ["chosen", {fill: 0.1}]]) {
    const frustum = views.frustum(camera, Object.assign({colour: colour("--" + name)}, look));
    views.place(frustum, answer[name].T_map_sensor);
    group.add(frustum, views.robot(answer[name], colour("--" + name)));
  }
  return group;
};

/** Tells the answer in the table of the panel. */
views.tell = answer => {
  const table = page.element("answer");
  table.replaceChildren();
  const row = (cells, tag = "td") => {
    const line = table.insertRow();
    for (const [text, style] of cells) {
      const cell = document.createElement(tag);
      cell.textContent = text;
      cell.className = style || "";
      line.append(cell);
    }
  };
  const {current, chosen} = answer;
  row([[""], ["now", "current"], ["chosen", "chosen"]], "th");
  const values = (name, of) => row([[name], [of(current), "current"], [of(chosen), "chosen"]]);
  values("gain", view => page.shown(view.gain, 1));
  values("pan", view => page.shown(view.joints.pan_rad, 3, " rad"));
  values("tilt", view => page.shown(view.joints.tilt_rad, 3, " rad"));
  values("height", view => page.shown(view.joints.height_m, 3, " m"));
  row([["move"], [""], [page.shown(answer.move_time_s, 2, " s") +
    (answer.motion_time_s > 0 ? " of " + page.shown(answer.motion_time_s, 2, " s") : "")]]);
  page.element("why").textContent = answer.why;
};

// What views gain: of the chosen one by voxel, of others over pan and tilt.
"use strict";

const gains = {};

const kStates = ["the unknown", "free space", "a surface"];  // as VoxelState numbers them

/** The voxels that a view's gain comes from as coloured cubes, and what the pointer tells of them. */
gains.voxels = bytes => {
  const numbers = new Float32Array(bytes);
  const {resolution_m, key_of_origin} = page.data.map;
  const kNumbers = 5;  // x, y, z, gain, state
  const count = numbers.length / kNumbers;
  let greatest = 0;
  for (let i = 0; i < count; ++i) greatest = Math.max(greatest, numbers[kNumbers * i + 3]);
  const cube = new THREE.BoxBufferGeometry(1, 1, 1).toNonIndexed().getAttribute("position").array;
  const corners = cube.length / 3;
  const position = new Float32Array(count * cube.length);
  const colour = new Float32Array(count * cube.length);
  for (let i = 0; i < count; ++i) {
    const shares = page.rampColour("viridis", numbers[kNumbers * i + 3] / greatest).map(c => c / 255);
    for (let k = 0; k < cube.length; ++k) {
      // A little larger than the voxel, so that its faces lie before those of the map.
      const key = numbers[kNumbers * i + k % 3] + 0.5 + 1.04 * cube[k];
      position[i * cube.length + k] = (key - key_of_origin) * resolution_m;
      colour[i * cube.length + k] = shares[k % 3];
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colour, 3));
  const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({vertexColors: THREE.VertexColors}));
  const tell = hit => {
    const i = Math.floor(3 * hit.faceIndex / corners);
    return `gain ${numbers[kNumbers * i + 3].toFixed(2)} of at most ${greatest.toFixed(2)}\n`
      + `from ${kStates[numbers[kNumbers * i + 4]]}`;
  };
  return {mesh, tell};
};

/** Tells of which gain the voxels are, or why none has a part in it. */
gains.tellVoxels = ({gain, why_none: whyNone}) => {
  page.element("show-gains").disabled = !!whyNone;
  page.element("voxel-gains-facts").textContent = whyNone || `by the gain ${gain}`;
};

/** T_map_sensor of joints on the base of a view, column by column, where the camera has no offset. */
const cameraMatrix = (view, pan_rad, tilt_rad, height_m) => {
  const optical = new THREE.Matrix4().set(0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1);
  return views.mastOn(view.T_map_base)
    .multiply(new THREE.Matrix4().makeTranslation(0, 0, height_m))
    .multiply(new THREE.Matrix4().makeRotationZ(pan_rad))
    .multiply(new THREE.Matrix4().makeRotationY(-tilt_rad))
    .multiply(optical).elements;
};

/** Whether two matrices are the same to a tenth of a millimetre. */
const isSame = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < 1e-4);

/** What is drawn: see gains.showLandscape. */
let landscape = null;

/** The gains as a picture, tilt upwards. */
const pictureOf = ({pan_rad, tilt_rad, gain, least, greatest}) => {
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [pan_rad.length, tilt_rad.length];
  const image = new ImageData(picture.width, picture.height);
  gain.forEach((g, i) => {
    const column = i % picture.width;
    const row = picture.height - 1 - Math.floor(i / picture.width);
    const share = greatest > least ? (g - least) / (greatest - least) : 0;
    image.data.set([...page.rampColour("viridis", share), 255], 4 * (row * picture.width + column));
  });
  picture.getContext("2d").putImageData(image, 0, 0);
  return picture;
};

/** Draws the picture, and the answer's views on it. */
const drawLandscape = () => {
  if (!landscape) return;
  const {pan_rad, tilt_rad, answer} = landscape;
  const canvas = page.element("landscape-map");
  const scale = Math.min(devicePixelRatio, 2);
  canvas.width = canvas.clientWidth * scale;
  canvas.height = canvas.clientHeight * scale;
  const brush = canvas.getContext("2d");
  brush.imageSmoothingEnabled = false;
  brush.drawImage(landscape.picture, 0, 0, canvas.width, canvas.height);
  const place = (axis, at) => axis.length < 2 ? 0.5
    : (0.5 + (at - axis[0]) / (axis[axis.length - 1] - axis[0]) * (axis.length - 1)) / axis.length;
  for (const [view, colour] of [[answer.current, "#e4e7eb"], [answer.chosen, "#ffffff"]]) {
    const x = place(pan_rad, view.joints.pan_rad) * canvas.width;
    const y = (1 - place(tilt_rad, view.joints.tilt_rad)) * canvas.height;
    const isChosen = view === answer.chosen;
    for (const [width, stroke] of [[4, "#1f2933"], [1.8, colour]]) {
      brush.lineWidth = width * scale;
      brush.strokeStyle = stroke;
      brush.setLineDash(isChosen ? [] : [3 * scale, 2 * scale]);
      brush.beginPath();
      brush.arc(x, y, 6 * scale, 0, 2 * Math.PI);
      brush.stroke();
    }
  }
};

const tellLandscape = text => { page.element("landscape-value").textContent = text; };

/** Tells the range of the gains; nothing is pointed at. */
const rest = () => {
  if (!landscape) return;
  tellLandscape(`gain ${page.shown(landscape.least, 1)} (dark) to `
    + `${page.shown(landscape.greatest, 1)}; dashed: now, ring: chosen`);
  landscape.tried.visible = false;
  page.redraw();
};

/** Tells the gain of a view, and outlines it in the map where the camera has no offset. */
const point = (column, row) => {
  const {pan_rad, tilt_rad, height_m, gain, answer, tried, isUsualMast} = landscape;
  tellLandscape(`pan ${page.shown(pan_rad[column], 2)}, tilt ${page.shown(tilt_rad[row], 2)} rad: `
    + `gain ${page.shown(gain[row * pan_rad.length + column], 1)}`);
  if (!isUsualMast) return;
  views.place(tried, cameraMatrix(answer.chosen, pan_rad[column], tilt_rad[row], height_m));
  tried.visible = true;
  page.redraw();
};

/** Lets people point at the landscape. */
gains.watchLandscape = () => {
  const canvas = page.element("landscape-map");
  const cell = (share, count) => Math.min(count - 1, Math.max(0, Math.floor(share * count)));
  canvas.addEventListener("pointermove", event => {
    if (!landscape) return;
    const frame = canvas.getBoundingClientRect();
    point(cell((event.clientX - frame.left) / frame.width, landscape.pan_rad.length),
      cell((frame.bottom - event.clientY) / frame.height, landscape.tilt_rad.length));
  });
  canvas.addEventListener("pointerleave", rest);
  addEventListener("resize", drawLandscape);
};

/**
 * Draws a landscape in place of the one before. `axes`: {pan_rad, tilt_rad, height_m}, none for no
 * landscape; `bytes` its gains; `tried` is an object in the scene that is placed where a view that is pointed at looks.
 */
gains.showLandscape = (axes, bytes, answer, tried) => {
  landscape = null;
  tried.visible = false;
  if (!axes) return;
  const gain = new Float32Array(bytes);
  const {pan_rad, height_m} = axes;
  const {current, chosen} = answer;
  landscape = {...axes, gain, answer, tried,
    greatest: gain.reduce((a, b) => Math.max(a, b), 0),
    least: gain.reduce((a, b) => Math.min(a, b), 0),
    isUsualMast: [current, chosen].every(view => isSame(view.T_map_sensor, cameraMatrix(view,
      view.joints.pan_rad, view.joints.tilt_rad, view.joints.height_m)))};
  landscape.picture = pictureOf(landscape);
  page.element("landscape-height").textContent = page.shown(height_m, 3, " m");
  page.element("pan-min").textContent = page.shown(pan_rad[0], 2, " rad");
  page.element("pan-max").textContent = page.shown(pan_rad[pan_rad.length - 1], 2, " rad");
  drawLandscape();
  rest();
};

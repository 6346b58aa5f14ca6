// An episode: where the camera was when, how the map grew.
"use strict";

const episode = {};

/** Unpacks the captures: {time_s, information, predicted, realised, joints, T_map_base, T_map_sensor}. */
episode.unpack = async () => {
  const numbers = new Float32Array(await page.bytes("captures"));
  const kNumbers = 37;
  const captures = [];
  for (let i = 0; i + kNumbers <= numbers.length; i += kNumbers) {
    const [time_s, information, predicted, realised, height_m] = numbers.subarray(i, i + 5);
    captures.push({time_s, information, predicted, realised, joints: {height_m},
      T_map_base: [...numbers.subarray(i + 5, i + 21)],
      T_map_sensor: [...numbers.subarray(i + 21, i + 37)]});
  }
  return captures;
};

/** The way of the camera, and what stands at the capture that is shown. */
episode.objects = (captures, camera) => {
  const group = new THREE.Group();
  const colour = new THREE.Color(page.styleColour("--tried"));
  const way = captures.map(c => new THREE.Vector3().fromArray(c.T_map_sensor, 12));
  group.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(way),
    new THREE.LineBasicMaterial({color: colour})));
  group.frustum = views.frustum(camera, {colour, fill: 0.08});
  group.robot = new THREE.Group();
  group.add(group.frustum, group.robot);
  group.showCapture = capture => {
    views.place(group.frustum, capture.T_map_sensor);
    for (const part of group.robot.children.slice()) group.robot.remove(part);
    group.robot.add(views.robot(capture, colour));
  };
  if (captures.length > 0) group.showCapture(captures[captures.length - 1]);
  return group;
};

/** Lets people choose the capture: `shared` are the settings of the map's faces. */
episode.play = (captures, objects, shared) => {
  const slider = page.element("capture");
  const button = page.element("play");
  const growth = page.element("growth");
  const last = captures.length - 1;
  if (last < 0) return;
  page.element("episode").classList.toggle("beside", !!page.data.landscape);
  slider.max = last;
  slider.value = last;

  const most = Math.max(...captures.map(c => c.information), 1e-9);
  const duration_s = Math.max(captures[last].time_s - captures[0].time_s, 1e-9);
  const drawGrowth = () => {
    const scale = Math.min(devicePixelRatio, 2);
    growth.width = growth.clientWidth * scale;
    growth.height = growth.clientHeight * scale;
    const brush = growth.getContext("2d");
    const x = c => (c.time_s - captures[0].time_s) / duration_s * (growth.width - 8 * scale) + 4 * scale;
    const y = c => growth.height - 2 * scale - c.information / most * (growth.height - 8 * scale);
    brush.beginPath();
    captures.forEach(c => brush.lineTo(x(c), y(c)));
    brush.lineWidth = 1.5 * scale;
    brush.strokeStyle = page.styleColour("--ink");
    brush.stroke();
    const now = captures[slider.value];
    brush.fillStyle = page.styleColour("--tried");
    brush.fillRect(x(now) - 0.5 * scale, 0, scale, growth.height);
    brush.beginPath();
    brush.arc(x(now), y(now), 4 * scale, 0, 2 * Math.PI);
    brush.fill();
  };

  const show = () => {
    const number = +slider.value;
    const capture = captures[number];
    objects.showCapture(capture);
    // What no capture is known to have seen comes with the last.
    shared.lastCapture.value = number === last ? -1 : number;
    const gain = Number.isFinite(capture.predicted)
      ? `; gain predicted ${page.shown(capture.predicted, 1)}, realised ${page.shown(capture.realised, 1)}` : "";
    page.element("capture-facts").textContent = `capture ${number + 1} of ${last + 1}, `
      + `${page.shown(capture.time_s, 1, " s")}: information ${page.shown(capture.information, 0)}${gain}`;
    drawGrowth();
    page.redraw();
  };
  slider.addEventListener("input", show);
  addEventListener("resize", drawGrowth);

  // The whole drive takes 20 s at most, and at least a second.
  let timer = 0;
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    button.textContent = "\u25b6";
  };
  button.addEventListener("click", () => {
    if (timer) return stop();
    if (+slider.value === last) slider.value = 0;
    const step = Math.max(1, Math.round(captures.length / 200));
    timer = setInterval(() => {
      slider.value = Math.min(last, +slider.value + step);
      show();
      if (+slider.value === last) stop();
    }, 100);
    button.textContent = "\u25a0";
  });
  show();
};

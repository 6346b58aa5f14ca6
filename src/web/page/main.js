// The page itself: scene, camera, switches.
"use strict";

(async () => {
  const canvas = page.element("scene");
  const notice = page.element("notice");
  page.showParts = () => {
    for (const part of document.querySelectorAll("[data-of]")) {
      part.hidden = !page.data[part.dataset.of];
    }
  };
  page.showParts();
  const context = canvas.getContext("webgl2", {antialias: true});
  if (!context || typeof DecompressionStream === "undefined") {
    notice.textContent = "This page needs WebGL 2 and DecompressionStream: open it in a browser of "
      + "2023 or newer with graphics switched on.";
    return;
  }
  const renderer = new THREE.WebGLRenderer({canvas, context});
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  const scene = new THREE.Scene();
  const eye = new THREE.PerspectiveCamera(50, 1, 0.05, 1000);
  eye.up.set(0, 0, 1);
  const controls = new THREE.OrbitControls(eye, canvas);
  controls.screenSpacePanning = true;

  // Nothing moves by itself: a picture is drawn when something changed.
  page.pictures = 0;
  page.drawNow = () => {
    renderer.render(scene, eye);
    ++page.pictures;
  };
  let isAskedFor = false;
  page.redraw = () => {
    if (isAskedFor) return;
    isAskedFor = true;
    requestAnimationFrame(() => {
      isAskedFor = false;
      page.drawNow();
    });
  };
  controls.addEventListener("change", page.redraw);

  // What is shown: objects of the scene by the name of their switch, as far as there are any.
  const shown = {};
  const shared = faces.sharedUniforms();
  const follow = name => {
    const isOn = page.element("show-" + name).checked && !!shown[name];
    if (shown[name]) shown[name].visible = isOn;
    if (name === "gains") shared.fade.value = isOn ? 0.7 : 0;  // colours tell one thing
    page.redraw();
  };
  const hide = name => {
    if (!shown[name]) return;
    scene.remove(shown[name]);
    faces.forget(shown[name]);
    delete shown[name];
    follow(name);
  };
  const show = (name, object) => {
    hide(name);
    shown[name] = object;
    scene.add(object);
    follow(name);
  };
  const all = surface.create(shared);
  for (const [name, group] of Object.entries(all.groups)) show(name, group);
  for (const box of document.querySelectorAll("[id^=show-]")) {
    box.addEventListener("change", () => follow(box.id.slice("show-".length)));
  }

  // The map, and a grid on the ground, for scale.
  let box = new THREE.Box3();
  let ground = null;
  const showGround = mesh_m => {
    const size_m = box.getSize(new THREE.Vector3());
    const squares = Math.min(200, 2 * Math.ceil(0.6 * Math.max(size_m.x, size_m.y) / mesh_m));
    if (ground) {
      scene.remove(ground);
      faces.forget(ground);
    }
    ground = new THREE.GridHelper(squares * mesh_m, squares, "#9aa5b1", "#9aa5b1");
    ground.material.transparent = true;
    ground.material.opacity = 0.35;
    ground.rotation.x = Math.PI / 2;
    const onGrid = c => Math.round(c / mesh_m) * mesh_m;
    ground.position.set(onGrid((box.min.x + box.max.x) / 2), onGrid((box.min.y + box.max.y) / 2),
      box.min.z - 0.01);
    scene.add(ground);
  };
  const tellMap = () => {
    const {map} = page.data;
    faces.setLattice(shared, map);
    const isEmpty = ["seen", "backs", "frontier"].every(name => surface.count(all, name) === 0);
    box = surface.usualBox(all);
    notice.textContent = "The map is empty: nothing is known.";
    notice.hidden = !isEmpty;
    const size_m = box.getSize(new THREE.Vector3());
    const mesh_m = Math.max(size_m.x, size_m.y) > 100 ? 10 : 1;
    showGround(mesh_m);
    page.element("facts").textContent =
      `${map.occupied_voxels.toLocaleString("en")} voxels of ${map.resolution_m} m, `
      + `${size_m.toArray().map(s => s.toFixed(1)).join(" x ")} m; information `
      + `${Math.round(map.information).toLocaleString("en")}`
      + (map.carries_uncertainty ? "" : "; the map carries no uncertainty")
      + `; the grid's squares are ${mesh_m} m wide`;
  };
  const showAnswer = () => {
    const {answer, camera} = page.data;
    if (!answer) return hide("views");
    show("views", views.answer(answer, camera));
    views.tell(answer);
  };
  const following = !!page.data.live;
  if (following) {
    await live.first((bricks, isWhole) => surface.putBricks(all, bricks, isWhole));
  } else {
    surface.put(all, "all", {seen: await faces.unpack("seen"), backs: await faces.unpack("backs"),
      frontier: await faces.unpack("frontier")});
  }
  tellMap();
  showAnswer();
  // A map without free space, or all of whose surfaces look outward, has backs alone.
  if (!following && surface.count(all, "seen") < surface.count(all, "backs") / 20) page.element("show-backs").click();
  let voxels = null;
  let tried = null;
  /** Shows what page.data has of gains around an answer; `bytes(id)` gives the blocks. */
  const showGains = async (answer, bytes) => {
    const {landscape, voxel_gains: told, camera} = page.data;
    if (told) gains.tellVoxels(told);
    voxels = told && !told.why_none ? gains.voxels(await bytes("voxel-gains")) : null;
    if (voxels) show("gains", voxels.mesh);
    else hide("gains");
    if (!tried) {
      tried = views.frustum(camera, {colour: new THREE.Color(page.styleColour("--tried"))});
      scene.add(tried);
      gains.watchLandscape();
    }
    gains.showLandscape(landscape, await bytes("landscape-gains"), answer, tried);
  };
  const drive = page.data.episode && await episode.unpack();
  if (drive) show("drive", episode.objects(drive, page.data.camera));

  // Colours.
  const legend = page.element("ramp").getContext("2d");
  const colourBy = name => {
    shared.heights.value.set(box.min.z, box.max.z);
    const byHeight = name === "height";
    const ramp = page.rampBytes(byHeight ? "viridis" : "cividis");
    if (shared.ramp.value) shared.ramp.value.dispose();
    shared.ramp.value = faces.texture(ramp, 256, 1, THREE.RGBAFormat);
    legend.putImageData(new ImageData(new Uint8ClampedArray(ramp.buffer), 256, 1), 0, 0);
    shared.byHeight.value = byHeight ? 1 : 0;
    page.element("ramp-min").textContent = byHeight ? page.shown(box.min.z, 1, " m") : "0: well seen";
    page.element("ramp-name").textContent = byHeight ? "height z" : "uncertainty u";
    page.element("ramp-max").textContent = byHeight ? page.shown(box.max.z, 1, " m") : "1: never seen";
    page.redraw();
  };
  for (const choice of document.querySelectorAll("input[name=colour]")) {
    choice.addEventListener("change", () => colourBy(choice.value));
    const tellsUncertainty = following || page.data.map.carries_uncertainty;
    choice.checked = choice.value === (tellsUncertainty ? "uncertainty" : "height");
    if (choice.checked) colourBy(choice.value);
  }

  // The cut.
  const cut = page.element("cut");
  const cutAbove = () => {
    const share = cut.value / cut.max;
    const height_m = box.min.z + share * (box.max.z - box.min.z);
    shared.cutHeight.value = share < 1 ? height_m : 1e9;
    page.element("cut-height").textContent = share < 1 ? page.shown(height_m, 2, " m") : "(all is shown)";
    page.redraw();
  };
  cut.addEventListener("input", cutAbove);
  cutAbove();

  // Where the eye is.
  let centre, reach_m;
  const look = (from, at) => {
    eye.position.copy(from);
    controls.target.copy(at);
    controls.update();
    page.redraw();
  };
  const measure = () => {
    const scope = box.clone();
    for (const object of [shown.views, shown.drive]) if (object) scope.expandByObject(object);
    centre = scope.getCenter(new THREE.Vector3());
    const {resolution_m} = page.data.map;
    reach_m = Math.max(0.5 * scope.getSize(new THREE.Vector3()).length(), 5 * resolution_m);
    eye.far = 100 * reach_m;
    eye.near = Math.max(1e-3 * reach_m, 0.2 * resolution_m);
    eye.updateProjectionMatrix();
  };
  /** Looks at all from a direction, from farther away where the window is narrow. */
  const lookFrom = (x, y, z) => {
    measure();
    const distance_m = reach_m * Math.max(1, 1 / eye.aspect);
    look(centre.clone().add(new THREE.Vector3(x, y, z).multiplyScalar(distance_m)), centre);
  };
  const first = () => lookFrom(-0.79, -1.16, 1.31);
  const above = () => lookFrom(0, -1e-3, 2.2);
  const throughCamera = () => {
    if (!page.data.answer) return;
    const T_map_sensor = new THREE.Matrix4().fromArray(page.data.answer.chosen.T_map_sensor);
    look(new THREE.Vector3().setFromMatrixPosition(T_map_sensor),
      new THREE.Vector3(0, 0, 1).applyMatrix4(T_map_sensor));
  };
  const resize = () => {
    renderer.setSize(innerWidth, innerHeight, false);
    eye.aspect = innerWidth / innerHeight;
    // What matters stands in the middle of what the panels leave free.
    const covered = innerWidth > 700 ? page.element("panel").getBoundingClientRect().right + 12 : 0;
    const coveredBelow = drive ? 140 : 0;
    eye.setViewOffset(innerWidth, innerHeight, -covered / 2, coveredBelow / 2, innerWidth, innerHeight);
    eye.updateProjectionMatrix();
    page.redraw();
  };
  addEventListener("resize", resize);
  resize();
  first();

  page.element("fold").addEventListener("click", () =>
    page.element("panel").classList.toggle("folded"));
  addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === " " && drive && event.target.tagName !== "INPUT" && event.target.tagName !== "BUTTON") {
      page.element("play").click();
    }
    const box = document.querySelector(`[data-key="${CSS.escape(event.key)}"]`);
    if (box && !box.closest("[hidden]")) box.click();
    const moves = {r: first, t: above, c: throughCamera};
    const move = moves[event.key.toLowerCase()];
    if (move) move();
  });

  // The voxel under the pointer.
  const caster = new THREE.Raycaster();
  let pointer = null;
  const point = () => {
    if (!pointer) return;
    const {clientX, clientY} = pointer;
    pointer = null;
    caster.setFromCamera({x: 2 * clientX / innerWidth - 1, y: 1 - 2 * clientY / innerHeight}, eye);
    const best = surface.pick(all, caster.ray);
    const [cube] = voxels && voxels.mesh.visible ? caster.intersectObject(voxels.mesh) : [];
    if (cube && !(best && best.distance < cube.distance)) {
      return page.showTip(voxels.tell(cube), clientX, clientY);
    }
    if (!best) return page.showTip("");
    const u = best.value === 255 ? "1" : (best.value / 255).toFixed(2);
    page.showTip(`voxel at ${best.centre_m.map(c => c.toFixed(2)).join(", ")} m`
      + (page.data.map.carries_uncertainty ? `\nuncertainty ${u}` : ""), clientX, clientY);
  };
  canvas.addEventListener("pointermove", event => {
    if (!pointer) requestAnimationFrame(point);
    pointer = event.buttons === 0 ? event : null;
    if (event.buttons !== 0) page.showTip("");
  });
  canvas.addEventListener("pointerleave", () => page.showTip(""));

  if (drive) episode.play(drive, shown.drive, shared);
  if (page.data.answer) await showGains(page.data.answer, page.bytes);
  if (following) {
    let hasBeenMoved = false;  // by a person: the view is then theirs
    controls.addEventListener("start", () => { hasBeenMoved = true; });
    canvas.addEventListener("wheel", () => { hasBeenMoved = true; });
    const keepInView = () => {
      const [centreBefore, reachBefore_m] = [centre, reach_m];
      measure();
      const moved_m = centre.distanceTo(centreBefore) + Math.abs(reach_m - reachBefore_m);
      if (!hasBeenMoved && moved_m > 0.1 * reachBefore_m) first();
    };
    live.follow({
      putBricks: async (bricks, isWhole) => {
        await surface.putBricks(all, bricks, isWhole);
        tellMap();
        colourBy(document.querySelector("input[name=colour]:checked").value);
        cutAbove();
        keepInView();
      },
      showGains,
      showAnswer: () => {
        showAnswer();
        keepInView();
      },
    });
  }

  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", page.redraw);
  page.renderer = renderer;
  page.turn = angle_rad => {
    eye.position.sub(controls.target).applyAxisAngle(eye.up, angle_rad).add(controls.target);
    eye.lookAt(controls.target);
  };
  page.isReady = true;
})().catch(error => {
  page.element("notice").hidden = false;
  page.element("notice").textContent = "The page cannot be shown: " + error.message;
  console.error(error);
});

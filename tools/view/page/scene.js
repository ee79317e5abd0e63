// SPDX-License-Identifier: Apache-2.0
// The scene: vehicle, an instrument for each station and camera, the targets that they measure.
/* global THREE */
import * as shapes from "./shapes.js";
import { Target } from "./targets.js";
import { colourOf, kindOf, lengthText, range, rowId } from "./words.js";

const ELLIPSOIDS = [100, 1, 30, 0]; // times 3 sigma; 0: none
const MAX_LABELS = 40;
const MAX_LABEL_STEPS = 4;
const SPACING = 0.3; // between instruments, m
const GROUNDS = { dark: 0x10141a, light: 0xeef1f5 };

const instrumentOf = (row) => [row.source, row.by || row.station, row.frames?.[0]].join("|");

// Without a graphics processor smooth edges cost more than everything else.
function rendersInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class Scene {
  constructor(canvas, labels, note, targets) {
    this.canvas = canvas;
    this.labels = labels;
    this.note = note;
    this.placements = targets;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !rendersInSoftware() });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.world = new THREE.Scene();
    this.eye = new THREE.PerspectiveCamera(45, 1, 0.02, 2000);
    this.controls = new THREE.OrbitControls(this.eye, canvas);
    this.controls.addEventListener("change", () => (this.stale = true));
    this.instruments = new Map();
    this.targets = new Map();
    this.spans = new Map();
    this.options = { ellipsoid: ELLIPSOIDS[0], trails: true, sweeps: true };
    this.follow = false;
    this.stale = true;
    this.viewed = false;
    this.drawn = 0;
    this.cost_ms = 0;
    this.furnish();
    this.view("behind");
  }

  furnish() {
    this.world.add(new THREE.HemisphereLight(0xffffff, 0x445566, 0.9));
    const sun = new THREE.DirectionalLight(0xffffff, 0.6);
    sun.position.set(3, 6, 4);
    this.world.add(sun, shapes.vehicle());
    this.grid = new THREE.GridHelper(20, 20);
    this.grid.position.y = -1.2;
    this.grid.material.transparent = true;
    this.grid.material.opacity = 0.25;
    this.world.add(this.grid);
  }

  setTheme(theme) {
    this.world.background = new THREE.Color(GROUNDS[theme]);
    this.stale = true;
  }

  instrument(row) {
    const id = instrumentOf(row);
    if (this.instruments.has(id)) return this.instruments.get(id);
    const colour = colourOf(rowId(row));
    const made = { id, row, group: new THREE.Group(), planes: [], isStation: row.frames?.[0] === "lighthouse" };
    // x right, y down, z ahead -> x right, y up, z backwards. A room's frame has its z up.
    made.group.rotation.x = row.frames?.[0] === "world" ? -Math.PI / 2 : Math.PI;
    if (made.isStation) {
      made.planes = [shapes.sweepPlane(0, 0xff5a4d), shapes.sweepPlane(1, 0x4da3ff)];
      made.group.add(shapes.station(colour), ...made.planes);
    } else if (["world", "vehicle"].includes(row.frames?.[0])) {
      made.group.add(shapes.axes(0.4));
    } else {
      made.frustum = shapes.frustum(colour, 2);
      made.frustumDistance = 2;
      made.group.add(shapes.camera(colour), made.frustum);
    }
    this.world.add(made.group);
    this.instruments.set(id, made);
    this.arrange();
    return made;
  }

  // Side by side on the vehicle's front: messages do not tell where they are mounted. A fused state is in the vehicle's frame.
  arrange() {
    const mounted = [...this.instruments.values()].filter((one) => !["world", "vehicle"].includes(one.row.frames?.[0]));
    mounted.forEach((one, at) => one.group.position.set((at - (mounted.length - 1) / 2) * SPACING, 0, 0));
  }

  // The newest state; it is put into the scene when it is drawn.
  take(state) {
    this.pending = state;
    this.stale = true;
  }

  apply(state) {
    if (state.replay) this.noticeJump(state.replay.position_s);
    for (const row of state.rows) {
      if (row.axis) this.takeAxis(row);
      if (row.frames) this.takePose(row);
      else if (this.targets.has(rowId(row))) this.targets.get(rowId(row)).take(row, this.options);
      if (!row.current) this.darken(row);
    }
    for (const row of state.rows) if (row.spin) this.takeSpin(row, state.rows);
    this.rows = state.rows;
    if (!this.viewed && this.targets.size > 0) this.view("behind");
  }

  noticeJump(position_s) {
    if (this.position_s !== undefined && (position_s < this.position_s || position_s > this.position_s + 20)) {
      for (const target of this.targets.values()) target.forgetTrail();
    }
    this.position_s = position_s;
  }

  takePose(row) {
    const instrument = this.instrument(row);
    const id = rowId(row);
    let target = this.targets.get(id);
    if (!target) {
      target = new Target(row, colourOf(id), this.placements[row.target]);
      this.targets.set(id, target);
      instrument.group.add(target.group);
      target.instrument = instrument;
    }
    target.take(row, this.options);
    const distance = range(row.p);
    if (instrument.frustum) this.stretchFrustum(instrument, distance);
    this.takeSweeps(instrument, row, distance);
  }

  stretchFrustum(instrument, distance) {
    instrument.frustum.visible = this.options.sweeps;
    instrument.frustum.scale.setScalar(distance / instrument.frustumDistance);
  }

  takeSweeps(instrument, row, distance) {
    instrument.planes.forEach((plane, axis) => {
      const hits = (row.sensors ?? []).map((entry) => entry[2 + axis]).filter((ratio) => ratio !== null);
      plane.visible = this.options.sweeps && hits.length > 0;
      if (plane.visible) plane.place(hits.reduce((a, b) => a + b) / hits.length, distance);
    });
  }

  darken(row) {
    const target = this.targets.get(rowId(row));
    target?.instrument.planes.forEach((plane) => (plane.visible = false));
  }

  // A panel's axis in east, north, up: drawn 2 m ahead of its telescope.
  takeAxis(row) {
    const instrument = this.instrument(row);
    if (!instrument.axis) {
      instrument.axis = shapes.lines([[0, 0, -1], [0, 0, 1]], colourOf(rowId(row)));
      instrument.axis.position.set(0, 0, 2);
      instrument.group.add(instrument.axis);
    }
    const [east, north, up] = row.axis;
    const direction = new THREE.Vector3(east, -up, north).normalize();
    instrument.axis.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), direction);
  }

  takeSpin(row, rows) {
    const pose = rows.find((other) => other.source === row.source && other.target === row.target && other.p && this.targets.has(rowId(other)));
    if (!pose) return;
    const target = this.targets.get(rowId(pose));
    const rate = new THREE.Vector3(...row.spin);
    if (!target.spin) target.group.add((target.spin = shapes.arrow(0xffd24d)));
    target.spin.visible = row.current && rate.length() > 0;
    if (!target.spin.visible) return;
    target.spin.position.fromArray(pose.p);
    target.spin.setDirection(rate.clone().normalize());
    target.spin.setLength(0.6, 0.12, 0.07);
  }

  // Of a target's centre in the scene; null where it is not seen.
  place(id) {
    const target = this.targets.get(id);
    if (!target || !target.shape.visible) return null;
    return target.shape.getWorldPosition(new THREE.Vector3());
  }

  view(name) {
    this.world.updateMatrixWorld(true);
    const places = [...this.targets.keys()].map((id) => this.place(id)).filter(Boolean);
    this.viewed = places.length > 0;
    const box = new THREE.Box3().setFromPoints([new THREE.Vector3(-0.8, -0.4, 0.3), new THREE.Vector3(0.8, 0.4, 0), ...places]);
    const centre = box.getCenter(new THREE.Vector3());
    const size = Math.max(1.6, box.getSize(new THREE.Vector3()).length());
    const from = { behind: [0.55, 0.5, 0.85], side: [1, 0.12, 0], above: [0.001, 1, 0.001], fit: [-0.7, 0.45, 0.6] }[name];
    this.controls.target.copy(centre);
    this.eye.position.copy(new THREE.Vector3(...from).normalize().multiplyScalar(size * 1.1).add(centre));
    this.controls.update();
    this.stale = true;
  }

  toggleFollow() {
    this.follow = !this.follow;
  }

  nextEllipsoid() {
    this.options.ellipsoid = ELLIPSOIDS[(ELLIPSOIDS.indexOf(this.options.ellipsoid) + 1) % ELLIPSOIDS.length];
  }

  toggleTrails() {
    this.options.trails = !this.options.trails;
  }

  toggleSweeps() {
    this.options.sweeps = !this.options.sweeps;
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === this.width && clientHeight === this.height) return;
    [this.width, this.height] = [clientWidth, clientHeight];
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.eye.aspect = clientWidth / Math.max(clientHeight, 1);
    this.eye.updateProjectionMatrix();
    this.stale = true;
  }

  draw(selected) {
    this.resize();
    if (this.follow) {
      const place = this.place(selected);
      if (place) {
        this.eye.position.add(place.clone().sub(this.controls.target));
        this.controls.target.copy(place);
        this.controls.update();
      }
    }
    const now = performance.now();
    // Where drawing is slow (many targets, software rendering) the rest of the page has half of the time.
    if (!this.stale || now - this.drawn < 2 * this.cost_ms) return;
    this.stale = false;
    if (this.pending) this.apply(this.pending);
    this.pending = null;
    this.renderer.render(this.world, this.eye);
    this.drawn = performance.now();
    this.cost_ms = 0.8 * this.cost_ms + 0.2 * (this.drawn - now);
    this.drawLabels(selected);
    const scale = this.options.ellipsoid;
    this.note.textContent = `instruments side by side, nominal sizes; ${scale ? `ellipsoids 3 sigma × ${scale}` : "no ellipsoids"}`;
  }

  // One label for a target that several stations measure; then the instruments'.
  drawLabels(selected) {
    const wanted = new Map();
    const rows = [...(this.rows ?? [])].sort((a, b) => Number(rowId(b) === selected) - Number(rowId(a) === selected));
    for (const row of rows) {
      const id = rowId(row);
      const name = `${row.source}|${row.target}`;
      const place = row.p && !wanted.has(name) ? this.place(id) : null;
      if (place) wanted.set(name, { place, text: `${row.target} · ${kindOf(row)} ${lengthText(range(row.p))}`, colour: colourOf(id) });
    }
    for (const one of this.instruments.values()) {
      const place = one.group.getWorldPosition(new THREE.Vector3());
      wanted.set(one.id, { place, text: one.row.by || `${kindOf(one.row)} ${one.row.station}`, colour: colourOf(rowId(one.row)) });
    }
    const taken = [];
    for (const [id, label] of wanted) {
      const at = label.place.project(this.eye);
      const seen = Math.abs(at.x) < 1 && Math.abs(at.y) < 1 && at.z < 1 && taken.length < MAX_LABELS;
      this.showLabel(id, label, seen ? this.freePlace(at, label.text, taken) : null);
    }
    for (const [id, span] of this.spans) {
      if (wanted.has(id)) continue;
      span.remove();
      this.spans.delete(id);
    }
  }

  // Beside a point, or a little below it where another label is; null where there is no room.
  freePlace(at, text, taken) {
    const box = { x: ((at.x + 1) / 2) * this.width + 12, y: ((1 - at.y) / 2) * this.height - 22, width: 7 * text.length + 14 };
    box.x = Math.min(box.x, this.width - box.width);
    const hits = (other) => Math.abs(other.y - box.y) < 20 && box.x < other.x + other.width && other.x < box.x + box.width;
    for (let tries = 0; tries < MAX_LABEL_STEPS && taken.some(hits); tries += 1) box.y += 20;
    if (taken.some(hits)) return null;
    taken.push(box);
    return box;
  }

  showLabel(id, label, box) {
    let span = this.spans.get(id);
    if (!span) {
      if (!box) return;
      this.spans.set(id, (span = document.createElement("span")));
      span.style.borderLeftColor = label.colour;
      this.labels.append(span);
    }
    span.hidden = !box;
    if (!box) return;
    if (span.textContent !== label.text) span.textContent = label.text;
    span.style.transform = `translate(${box.x.toFixed(0)}px, ${box.y.toFixed(0)}px)`;
  }
}

// SPDX-License-Identifier: Apache-2.0
// One source's measured target in the frame of its instrument: body, second solution, sensors, ellipsoid, trail.
/* global THREE */
import * as shapes from "./shapes.js";
import { kindOf } from "./words.js";

const TRAIL = 600;
const USED = new THREE.Color("#35c46f");
const REJECTED = new THREE.Color("#f0b92c");
const DARK = new THREE.Color("#6c7683");

function shapeOf(row, colour) {
  if (row.camera) return shapes.ring(colour);
  return kindOf(row) === "slam" ? shapes.rock(colour) : shapes.body(colour);
}

export class Target {
  constructor(row, colour, placements) {
    this.group = new THREE.Group();
    this.colour = colour;
    this.placements = placements; // [[number, [x, y, z]], ...] in the body's frame, or nothing
    this.shape = shapeOf(row, colour);
    this.second = shapes.ghost(this.shape);
    this.ellipsoid = shapes.ellipsoid(colour);
    this.trail = shapes.trail(colour, TRAIL);
    this.points = [];
    this.sensors = new Map();
    this.known = new Set();
    this.group.add(this.shape, this.second, this.ellipsoid, this.trail);
    for (const [number, position] of placements ?? []) {
      const sensor = this.sensor(number);
      this.shape.add(sensor);
      sensor.position.fromArray(position);
      sensor.scale.setScalar(0.012);
      this.known.add(number);
    }
  }

  sensor(number) {
    if (!this.sensors.has(number)) this.sensors.set(number, shapes.sensor());
    return this.sensors.get(number);
  }

  take(row, options) {
    const current = row.current && row.p !== undefined;
    this.shape.visible = current;
    this.second.visible = current && row.p2 !== undefined;
    this.ellipsoid.visible = current && options.ellipsoid > 0;
    this.trail.visible = options.trails;
    this.takeSensors(row);
    if (!current) return;
    this.place(this.shape, row.p, row.q);
    if (row.p2) this.place(this.second, row.p2, row.q2);
    if (this.shape.connector) this.shape.connector.visible = row.turn;
    this.ellipsoid.matrix.copy(shapes.ellipsoidMatrix(row.covariance, 3 * options.ellipsoid)).setPosition(...row.p);
    this.extend(row.p);
  }

  place(object, p, q) {
    object.position.fromArray(p);
    object.quaternion.set(q[1], q[2], q[3], q[0]);
  }

  extend(p) {
    const last = this.points[this.points.length - 1];
    if (last && Math.hypot(last[0] - p[0], last[1] - p[1], last[2] - p[2]) < 1e-3) return;
    this.points.push(p);
    if (this.points.length > TRAIL) this.points.shift();
    const position = this.trail.geometry.attributes.position;
    position.array.set(this.points.flat());
    position.needsUpdate = true;
    this.trail.geometry.setDrawRange(0, this.points.length);
  }

  forgetTrail() {
    this.points = [];
    this.trail.geometry.setDrawRange(0, 0);
  }

  // Sensors whose place on the body is not known are drawn along their ray, at the target's distance.
  takeSensors(row) {
    const lit = new Map((row.sensors ?? []).map((entry) => [entry[0], entry]));
    for (const [number, sensor] of this.sensors) {
      const entry = lit.get(number);
      sensor.material.color = entry ? (entry[1] ? USED : REJECTED) : DARK;
      if (!this.known.has(number)) sensor.visible = false;
    }
    const depth = row.p ? row.p[2] : null;
    for (const [number, entry] of lit) {
      const sensor = this.sensor(number);
      sensor.material.color = entry[1] ? USED : REJECTED;
      if (this.known.has(number)) continue;
      sensor.visible = depth !== null && entry[2] !== null && entry[3] !== null;
      if (!sensor.visible) continue;
      if (sensor.parent !== this.group) this.group.add(sensor);
      sensor.position.set(entry[2] * depth, entry[3] * depth, depth);
      sensor.scale.setScalar(0.01);
    }
  }
}

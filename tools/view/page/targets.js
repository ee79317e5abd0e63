// SPDX-License-Identifier: Apache-2.0
// One source's measured target in the frame of its instrument: body, second solution, sensors, ellipsoid, trail.
/* global THREE */
import * as shapes from "./shapes.js";
import { kindOf } from "./words.js";

const TRAIL = 600;
const SENSORS = 32;
const USED = new THREE.Color("#35c46f").toArray();
const REJECTED = new THREE.Color("#f0b92c").toArray();
const DARK = new THREE.Color("#6c7683").toArray();

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
    this.protection = shapes.protection(colour); // of a fused state: the centre is within
    this.points = [];
    this.sensors = shapes.sensors(SENSORS);
    this.group.add(this.shape, this.second, this.ellipsoid, this.protection, this.trail);
    (placements ? this.shape : this.group).add(this.sensors);
  }

  take(row, options) {
    const current = row.current && row.p !== undefined;
    this.shape.visible = current;
    this.second.visible = current && row.p2 !== undefined;
    this.ellipsoid.visible = current && options.ellipsoid > 0;
    this.protection.visible = current && options.ellipsoid > 0 && (row.fused?.protection_m ?? null) !== null;
    this.trail.visible = options.trails;
    this.takeSensors(row);
    if (!current) return;
    this.place(this.shape, row.p, row.q);
    if (row.p2) this.place(this.second, row.p2, row.q2);
    if (this.shape.connector) this.shape.connector.visible = row.turn;
    this.ellipsoid.matrix.copy(shapes.ellipsoidMatrix(row.covariance, 3 * options.ellipsoid)).setPosition(...row.p);
    if (this.protection.visible) {
      this.protection.position.fromArray(row.p);
      this.protection.scale.setScalar(row.fused.protection_m);
    }
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

  // Sensors whose places on the body are not known are drawn along their rays, at the target's distance.
  takeSensors(row) {
    const lit = new Map((row.sensors ?? []).map((entry) => [entry[0], entry]));
    const colour = (entry) => (entry ? (entry[1] ? USED : REJECTED) : DARK);
    if (this.placements) return this.sensors.show(this.placements.map(([number, position]) => [position, colour(lit.get(number))]));
    const depth = row.p ? row.p[2] : null;
    const seen = depth === null ? [] : [...lit.values()].filter((entry) => entry[2] !== null && entry[3] !== null);
    return this.sensors.show(seen.map((entry) => [[entry[2] * depth, entry[3] * depth, depth], colour(entry)]));
  }
}

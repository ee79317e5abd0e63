// SPDX-License-Identifier: Apache-2.0
// What the scene is made of. Everything is in metres; instruments look along +z of their own frame (x right, y down).
// Sizes of vehicle, bodies, rings and frustums are nominal: messages do not tell them.
/* global THREE */

const SWEEP_LENGTH = 1.15; // of the target's distance
const FRUSTUM_LENGTH = 0.9;

const lineMaterial = (colour, opacity = 1) => new THREE.LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity });

export function lines(points, colour, opacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
  return new THREE.LineSegments(geometry, lineMaterial(colour, opacity));
}

// x red, y green, z blue.
export function axes(length) {
  const made = lines([[0, 0, 0], [length, 0, 0], [0, 0, 0], [0, length, 0], [0, 0, 0], [0, 0, length]], 0xffffff);
  const colours = ["#f0524b", "#35c46f", "#4c8ff0"].map((name) => new THREE.Color(name).toArray());
  const ends = colours.flatMap((colour) => [...colour, ...colour]);
  made.geometry.setAttribute("color", new THREE.Float32BufferAttribute(ends, 3));
  made.material.vertexColors = THREE.VertexColors;
  return made;
}

function solid(geometry, colour, opacity = 1) {
  return new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: colour, transparent: opacity < 1, opacity, depthWrite: opacity === 1 }));
}

function edged(geometry, colour, opacity = 1) {
  const group = new THREE.Group();
  group.add(solid(geometry, colour, opacity));
  group.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 20), lineMaterial(0x000000, 0.35)));
  return group;
}

// The chase vehicle, behind its instruments (in the world of the scene: looking along -z, y up), and its frame V.
export function vehicle() {
  const group = new THREE.Group();
  const bus = edged(new THREE.BoxBufferGeometry(0.7, 0.4, 0.6), 0x8d99a8);
  const left = edged(new THREE.BoxBufferGeometry(0.9, 0.02, 0.4), 0x2c4f86);
  const right = left.clone();
  left.position.set(-0.85, 0, 0);
  right.position.set(0.85, 0, 0);
  group.add(bus, left, right, axes(0.45));
  group.position.set(0, -0.32, 0.3);
  return group;
}

// A base station: a box with its two rotors' windows.
export function station(colour) {
  const group = edged(new THREE.BoxBufferGeometry(0.12, 0.12, 0.08), colour);
  const window = solid(new THREE.BoxBufferGeometry(0.09, 0.09, 0.01), 0x111111);
  window.position.z = 0.04;
  group.add(window);
  return group;
}

export function camera(colour) {
  const group = edged(new THREE.BoxBufferGeometry(0.1, 0.1, 0.12), colour);
  const lens = solid(new THREE.CylinderBufferGeometry(0.035, 0.035, 0.06, 20), 0x222222);
  lens.rotation.x = Math.PI / 2;
  lens.position.z = 0.08;
  group.add(lens);
  return group;
}

// A nominal field of view, half angles 30 and 23 degrees.
export function frustum(colour, distance) {
  const z = FRUSTUM_LENGTH * distance;
  const x = z * 0.57;
  const y = z * 0.43;
  const corners = [[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]];
  const points = [];
  corners.forEach((corner, at) => points.push([0, 0, 0], corner, corner, corners[(at + 1) % 4]));
  return lines(points, colour, 0.45);
}

// A laser plane that holds the direction at which it hit the sensors: axis 0 sweeps x, 1 sweeps y.
export function sweepPlane(axis, colour) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(9), 3));
  const material = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.13, side: THREE.DoubleSide, depthWrite: false });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.place = (ratio, distance) => {
    const z = SWEEP_LENGTH * distance;
    const half = 0.45 * z;
    const far = axis === 0 ? [[ratio * z, -half, z], [ratio * z, half, z]] : [[-half, ratio * z, z], [half, ratio * z, z]];
    geometry.attributes.position.array.set([0, 0, 0, ...far[0], ...far[1]]);
    geometry.attributes.position.needsUpdate = true;
  };
  return mesh;
}

// A cooperative target with photodiodes: its body and axes.
export function body(colour) {
  const group = new THREE.Group();
  group.add(edged(new THREE.BoxBufferGeometry(0.22, 0.22, 0.22), colour, 0.55), axes(0.3));
  return group;
}

// A docking ring in the plane z = 0 of its frame, and its connector.
export function ring(colour) {
  const group = new THREE.Group();
  group.add(solid(new THREE.TorusBufferGeometry(0.3, 0.028, 12, 56), colour));
  const back = edged(new THREE.CylinderBufferGeometry(0.55, 0.55, 0.5, 8), 0x9aa5b1, 0.3);
  back.rotation.x = Math.PI / 2;
  back.position.z = 0.28;
  group.connector = solid(new THREE.BoxBufferGeometry(0.09, 0.05, 0.03), 0xd0493f);
  group.connector.position.set(0.36, 0, 0);
  group.add(back, group.connector, axes(0.4));
  return group;
}

// A target without a model.
export function rock(colour) {
  const group = new THREE.Group();
  group.add(edged(new THREE.OctahedronBufferGeometry(0.25), colour, 0.6), axes(0.4));
  return group;
}

export function ghost(object) {
  const copy = object.clone();
  copy.traverse((part) => {
    if (!part.material) return;
    part.material = part.material.clone();
    part.material.transparent = true;
    part.material.opacity = 0.18;
    part.material.depthWrite = false;
  });
  return copy;
}

export function ellipsoid(colour) {
  const material = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.28, depthWrite: false });
  const mesh = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 16, 10), material);
  mesh.matrixAutoUpdate = false;
  return mesh;
}

// A wire sphere of radius 1: the protection level, to scale.
export function protection(colour) {
  const sphere = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 16, 12), new THREE.MeshBasicMaterial({ color: colour, wireframe: true, transparent: true, opacity: 0.35 }));
  sphere.visible = false;
  return sphere;
}

export function trail(colour, length) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(3 * length), 3));
  geometry.setDrawRange(0, 0);
  const line = new THREE.Line(geometry, lineMaterial(colour, 0.8));
  line.frustumCulled = false;
  return line;
}

// Up to `count` sensors as points of one object, each with its own colour.
export function sensors(count) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(3 * count), 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(3 * count), 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 0.035, vertexColors: THREE.VertexColors }));
  points.frustumCulled = false;
  points.show = (list) => {
    list.slice(0, count).forEach(([position, colour], at) => {
      geometry.attributes.position.array.set(position, 3 * at);
      geometry.attributes.color.array.set(colour, 3 * at);
    });
    geometry.attributes.position.needsUpdate = true;
    geometry.attributes.color.needsUpdate = true;
    geometry.setDrawRange(0, Math.min(list.length, count));
  };
  return points;
}

export function arrow(colour) {
  const made = new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 1, colour, 0.12, 0.07);
  return made;
}

// The eigenvectors of a symmetric 3x3 matrix (xx, xy, xz, yy, yz, zz), each as long as `scale` times its sigma, as the
// columns of a Matrix4: the unit sphere becomes the ellipsoid. By Jacobi rotations.
export function ellipsoidMatrix([xx, xy, xz, yy, yz, zz], scale) {
  const a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let turn = 0; turn < 12; turn += 1) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (a[p][q] === 0) continue;
      const theta = 0.5 * Math.atan2(2 * a[p][q], a[p][p] - a[q][q]);
      const c = Math.cos(theta);
      const s = Math.sin(theta);
      for (let k = 0; k < 3; k += 1) [a[k][p], a[k][q]] = [c * a[k][p] + s * a[k][q], c * a[k][q] - s * a[k][p]];
      for (let k = 0; k < 3; k += 1) [a[p][k], a[q][k]] = [c * a[p][k] + s * a[q][k], c * a[q][k] - s * a[p][k]];
      for (let k = 0; k < 3; k += 1) [v[k][p], v[k][q]] = [c * v[k][p] + s * v[k][q], c * v[k][q] - s * v[k][p]];
    }
  }
  const length = [0, 1, 2].map((k) => Math.max(scale * Math.sqrt(Math.max(a[k][k], 0)), 1e-6));
  const m = new THREE.Matrix4();
  m.set(
    v[0][0] * length[0], v[0][1] * length[1], v[0][2] * length[2], 0,
    v[1][0] * length[0], v[1][1] * length[1], v[1][2] * length[2], 0,
    v[2][0] * length[0], v[2][1] * length[1], v[2][2] * length[2], 0,
    0, 0, 0, 1,
  );
  return m;
}

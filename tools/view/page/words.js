// SPDX-License-Identifier: Apache-2.0
// Numbers as an operator reads them, and the names of rows.

export const DEG = 180 / Math.PI;

export const rowId = (row) => [row.channel, row.source, row.target, row.station].join("|");

export const kindOf = (row) => row.source.split("/")[0];

export function ageText(seconds) {
  if (seconds === null) return "–";
  return seconds < 1 ? `${Math.round(seconds * 1e3)} ms` : `${seconds.toFixed(1)} s`;
}

export function lengthText(metres) {
  const size = Math.abs(metres);
  if (size < 0.01) return `${(metres * 1e3).toFixed(2)} mm`;
  return size < 10 ? `${metres.toFixed(3)} m` : `${metres.toFixed(1)} m`;
}

export const degreeText = (radians, digits = 3) => `${(radians * DEG).toFixed(digits)}°`;

export const range = (p) => Math.hypot(p[0], p[1], p[2]);

// Quaternion w, x, y, z to rotation vector, rad.
export function rotationVector(q) {
  const s = Math.hypot(q[1], q[2], q[3]);
  if (s < 1e-12) return [0, 0, 0];
  const angle = 2 * Math.atan2(s, q[0]);
  return [q[1], q[2], q[3]].map((c) => (c / s) * angle);
}

const LEVELS = { bad: 3, degraded: 2, unknown: 1, good: 0 };
export const LIGHT_NAMES = ["sees light", "calibrated", "geometry known", "estimate good"];
export const LAMP_SIGNS = { good: "✓", degraded: "!", bad: "✕", unknown: "?" };

// The worst light of a row: [level, reason].
export function worstLight(row) {
  return row.lights.reduce((worst, light) => (LEVELS[light[0]] > LEVELS[worst[0]] ? light : worst));
}

export function spanText(seconds) {
  const whole = Math.floor(seconds);
  const two = (n) => String(n).padStart(2, "0");
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}.${Math.floor((seconds % 1) * 10)}`;
}

// Colours that differ for people with any colour vision (Okabe and Ito), on dark and on light ground.
const COLOURS = ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#0072b2", "#b8a800", "#9467bd"];
const given = new Map();
export function colourOf(id) {
  if (!given.has(id)) given.set(id, COLOURS[given.size % COLOURS.length]);
  return given.get(id);
}

// SPDX-License-Identifier: Apache-2.0
// The last minute of the selected source on canvases: position, attitude, sigma, residual, rate, age.
import { DEG, rotationVector, rowId } from "./words.js";

const SPAN_S = 60;
const MAX_SAMPLES = SPAN_S * 30;
const MAX_SOURCES = 128;
const LINES = ["#e4605c", "#3fae6a", "#4c8ff0"];

// From a row to the plot's lines; a line's null is a gap.
const PLOTS = [
  { name: "position", unit: "mm", lines: ["x", "y", "z"], of: (row) => row.p?.map((c) => c * 1e3) },
  { name: "attitude", unit: "°", lines: ["rx", "ry", "rz"], wraps: true, of: (row) => (row.q ? rotationVector(row.q).map((c) => c * DEG) : row.axis ? [row.pitch_rad * DEG, row.yaw_rad * DEG] : undefined) },
  { name: "sigma", unit: "mm, °/100", lines: ["pos.", "rot."], zero: true, of: (row) => (row.current ? [row.sigma_m !== undefined ? row.sigma_m * 1e3 : null, row.sigma_rad !== undefined ? row.sigma_rad * DEG * 100 : null] : undefined) },
  { name: "residual", unit: "arcsec", lines: ["RMS"], zero: true, of: (row) => (row.residual_rad !== undefined ? [row.residual_rad * DEG * 3600] : undefined) },
  { name: "rate", unit: "1/s", lines: ["valid"], zero: true, of: (row) => [row.rate] },
  { name: "age", unit: "ms", lines: ["since measured"], zero: true, of: (row) => (row.current ? [row.age_s * 1e3] : undefined) },
];

function tidyStep(span) {
  const rough = span / 3;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= rough);
}

export class Plots {
  constructor(root) {
    this.history = new Map();
    this.canvases = PLOTS.map((plot) => {
      const figure = document.createElement("figure");
      const canvas = document.createElement("canvas");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `${plot.name} over the last minute`);
      figure.append(canvas);
      root.append(figure);
      return canvas;
    });
  }

  add(state) {
    const time = state.utc_ms / 1e3;
    for (const row of state.rows) {
      const id = rowId(row);
      let samples = this.history.get(id);
      if (!samples) {
        if (this.history.size >= MAX_SOURCES) continue;
        this.history.set(id, (samples = []));
      }
      const last = samples.length ? samples[samples.length - 1].time : -Infinity;
      if (time < last || time > last + SPAN_S) samples.length = 0; // a jump in a replay
      samples.push({ time, values: PLOTS.map((plot) => plot.of(row)) });
      if (samples.length > MAX_SAMPLES * 1.2) samples.splice(0, samples.length - MAX_SAMPLES);
    }
  }

  draw(id) {
    const samples = this.history.get(id) ?? [];
    const style = getComputedStyle(document.documentElement);
    const colours = { text: style.getPropertyValue("--dim"), line: style.getPropertyValue("--line") };
    PLOTS.forEach((plot, at) => this.drawOne(this.canvases[at], plot, at, samples, colours));
  }

  drawOne(canvas, plot, at, samples, colours) {
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "11px system-ui, sans-serif";
    this.title(pen, plot, width, colours);
    const end = samples.length ? samples[samples.length - 1].time : 0;
    const seen = samples.filter((sample) => sample.time >= end - SPAN_S && sample.values[at]);
    const values = seen.flatMap((sample) => sample.values[at].filter((value) => value !== null));
    if (values.length === 0) return;
    let low = plot.zero ? 0 : Math.min(...values);
    let high = Math.max(...values);
    const margin = Math.max((high - low) * 0.08, Math.abs(high) * 1e-4, 1e-3);
    high += margin;
    if (!plot.zero) low -= margin;
    const box = { left: 46, right: width - 6, top: 20, bottom: height - 6 };
    const x = (time) => box.right - ((end - time) / SPAN_S) * (box.right - box.left);
    const y = (value) => box.bottom - ((value - low) / (high - low)) * (box.bottom - box.top);
    this.grid(pen, low, high, y, box, colours);
    plot.lines.forEach((_, line) => this.line(pen, seen, at, line, x, y));
  }

  title(pen, plot, width, colours) {
    pen.fillStyle = colours.text;
    pen.textAlign = "left";
    pen.fillText(`${plot.name}, ${plot.unit}`, 2, 11);
    if (plot.lines.length < 2) return;
    let right = width - 4;
    pen.textAlign = "right";
    [...plot.lines].reverse().forEach((name, at) => {
      pen.fillStyle = LINES[plot.lines.length - 1 - at];
      pen.fillText(name, right, 11);
      right -= pen.measureText(name).width + 8;
    });
  }

  grid(pen, low, high, y, box, colours) {
    const step = tidyStep(high - low);
    const digits = Math.max(0, -Math.floor(Math.log10(step)));
    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.text;
    pen.textAlign = "right";
    pen.lineWidth = 1;
    for (let value = Math.ceil(low / step) * step; value <= high; value += step) {
      pen.beginPath();
      pen.moveTo(box.left, Math.round(y(value)) + 0.5);
      pen.lineTo(box.right, Math.round(y(value)) + 0.5);
      pen.stroke();
      pen.fillText(value.toFixed(Math.min(digits, 6)), box.left - 4, y(value) + 4);
    }
  }

  line(pen, samples, at, line, x, y) {
    pen.strokeStyle = LINES[line];
    pen.lineWidth = 1.5;
    pen.beginPath();
    let last = -Infinity;
    let before = 0;
    for (const sample of samples) {
      const value = sample.values[at][line];
      if (value === null || value === undefined) continue;
      // Half a second without a value is a gap, not a line; nor is an angle's jump from 180 to -180 degrees.
      const jumps = PLOTS[at].wraps && Math.abs(value - before) > 180;
      if (sample.time - last > 0.5 || jumps) pen.moveTo(x(sample.time), y(value));
      else pen.lineTo(x(sample.time), y(value));
      last = sample.time;
      before = value;
    }
    pen.stroke();
  }
}

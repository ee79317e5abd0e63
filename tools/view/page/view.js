// SPDX-License-Identifier: Apache-2.0
// Receives states and hands the newest one to every part of the page; keys, theme.
import { Scene } from "./scene.js";
import { Table } from "./table.js";
import { Plots } from "./plots.js";
import { Cameras } from "./cameras.js";
import { Replay } from "./replay.js";

const TABLE_MS = 200; // the eye reads no faster
const PLOT_MS = 100;
const SILENT_MS = 3000;

const element = (id) => document.getElementById(id);
const figures = { states: 0, frames: 0 }; // read by tests
window.pharosFigures = figures;

const table = new Table(() => redraw());
const plots = new Plots(element("plots"));
const cameras = new Cameras(element("cameras"), element("picture"));
const replay = new Replay();
let scene = null;
let newest = null;
let fresh = false;
let frozen = false;
let lastState = performance.now();
let lastTable = 0;
let lastPlot = 0;
let targets = {};

function redraw() {
  fresh = true;
  lastTable = lastPlot = 0;
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  try {
    localStorage.setItem("pharos-theme", theme);
  } catch { /* private window */ }
  if (scene) scene.setTheme(theme);
  redraw();
}

function startTheme() {
  let theme = null;
  try {
    theme = localStorage.getItem("pharos-theme");
  } catch { /* private window */ }
  if (theme !== "light" && theme !== "dark") theme = matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
  setTheme(theme);
}

function startScene() {
  try {
    scene = new Scene(element("canvas"), element("labels"), element("scene-note"), targets);
    scene.setTheme(document.documentElement.dataset.theme);
  } catch (error) {
    element("no-scene").hidden = false;
    element("no-scene").textContent = `No scene: this browser gives no WebGL (${error.message}). Everything else is shown.`;
  }
}

function setLink(text, level) {
  const link = element("link");
  link.textContent = text;
  link.className = `pill ${level}`;
}

function take(state) {
  lastState = performance.now();
  figures.states += 1;
  if (frozen && !state.replay) return;
  newest = state;
  fresh = true;
  plots.add(state);
  if (scene) scene.take(state);
}

function connect() {
  const stream = new EventSource("/states");
  stream.onmessage = (event) => take(JSON.parse(event.data));
  // The browser connects again by itself, unless the server refused.
  stream.onerror = () => {
    if (stream.readyState === EventSource.CLOSED) setTimeout(connect, 2000);
  };
}

function showLink() {
  const silent = performance.now() - lastState;
  if (silent > SILENT_MS) setLink(`no news from pharos view for ${(silent / 1e3).toFixed(0)} s`, "bad");
  else if (!newest) setLink("connecting", "unknown");
  else if (frozen) setLink("frozen", "degraded");
  else setLink(newest.replay ? "replay" : "live", "good");
}

function frame(now) {
  requestAnimationFrame(frame);
  figures.frames += 1;
  if (now - lastTable >= TABLE_MS) {
    lastTable = now;
    showLink();
    if (newest && fresh) {
      table.show(newest);
      cameras.show(newest.previews);
      replay.show(newest.replay);
      fresh = false;
    }
  }
  if (newest && now - lastPlot >= PLOT_MS) {
    lastPlot = now;
    plots.draw(table.selected());
  }
  if (scene) scene.draw(table.selected());
}

const keys = {
  ArrowUp: () => table.move(-1),
  ArrowDown: () => table.move(1),
  ArrowLeft: () => replay.step(-5),
  ArrowRight: () => replay.step(5),
  1: () => scene?.view("behind"),
  2: () => scene?.view("side"),
  3: () => scene?.view("above"),
  f: () => scene?.view("fit"),
  c: () => scene?.toggleFollow(),
  e: () => scene?.nextEllipsoid(),
  r: () => scene?.toggleTrails(),
  s: () => scene?.toggleSweeps(),
  t: () => setTheme(document.documentElement.dataset.theme === "light" ? "dark" : "light"),
  "?": () => (element("help").open ? element("help").close() : element("help").showModal()),
  " ": () => {
    if (newest?.replay) replay.toggle();
    else frozen = !frozen;
  },
};

function press(key) {
  const action = keys[key] ?? keys[key.toLowerCase()];
  if (action) action();
  return Boolean(action);
}

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (["INPUT", "SELECT"].includes(event.target.tagName) && event.key.startsWith("Arrow")) return;
  if (event.target.tagName === "BUTTON" && event.key === " ") return;
  if (press(event.key)) event.preventDefault();
});
for (const button of document.querySelectorAll("[data-key]")) button.addEventListener("click", () => press(button.dataset.key));
element("help-button").addEventListener("click", () => press("?"));
element("theme-button").addEventListener("click", () => press("t"));

startTheme();
targets = await fetch("/targets").then((answer) => answer.json()).catch(() => ({}));
startScene();
window.pharosScene = scene; // read by tests
connect();
requestAnimationFrame(frame);

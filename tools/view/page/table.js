// SPDX-License-Identifier: Apache-2.0
// The rows of all sources with their lights, the selected one in detail, daemons, events, counters.
import { ageText, colourOf, degreeText, LAMP_SIGNS, lengthText, LIGHT_NAMES, range, rotationVector, rowId, worstLight } from "./words.js";

const element = (id) => document.getElementById(id);

function make(tag, className = "", text = "") {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  return made;
}

function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

function setLamp(lamp, light, name) {
  const className = `lamp ${light[0]}`;
  if (lamp.className !== className) lamp.className = className;
  setText(lamp, LAMP_SIGNS[light[0]]);
  const title = `${name}: ${light[1]}`;
  if (lamp.title !== title) lamp.title = title;
}

// What a fused state tells: rates, protection level, and each source with what is done with it.
function fusedLines(row) {
  const { fused } = row;
  const level = (value, text) => (value === null || !row.p ? "not available" : text(value));
  const lines = [["mode", fused.mode], ["protection level", `${level(fused.protection_m, lengthText)}, ${level(fused.protection_rad, degreeText)}`]];
  if (row.p) lines.push(["velocity, rate", `${(range(fused.velocity) * 1e3).toFixed(1)} mm/s, ${degreeText(range(fused.rate), 3)}/s`]);
  for (const source of fused.sources) {
    const reason = source.reason ? ` (${source.reason.replaceAll("_", " ")})` : "";
    lines.push([source.name, `${source.state}${reason}, ${source.age_s === null ? "never heard" : `${ageText(source.age_s)} old`}, NIS ${source.nis.toFixed(2)}`]);
  }
  return lines;
}

class Row {
  constructor(id, onSelect) {
    this.main = make("tr");
    this.main.dataset.id = id;
    this.cells = {};
    for (const name of ["source", "target", "by", "lights", "rate", "age", "range", "sigma"]) {
      const number = ["rate", "age", "range", "sigma"].includes(name);
      this.cells[name] = make("td", number ? "number value" : name);
      this.main.append(this.cells[name]);
    }
    this.main.style.setProperty("--mark", colourOf(id));
    const lights = make("span", "lights");
    this.lamps = LIGHT_NAMES.map(() => make("span", "lamp unknown", "?"));
    lights.append(...this.lamps);
    this.cells.lights.append(lights);
    this.reason = make("tr", "reason");
    this.reasonCell = make("td");
    this.reasonCell.colSpan = 8;
    this.reason.append(this.reasonCell);
    for (const part of [this.main, this.reason]) part.addEventListener("click", () => onSelect(id));
  }

  show(row, selected) {
    setText(this.cells.source, row.fused ? `fused: ${row.fused.mode}` : row.channel.endsWith("_SPIN") ? `${row.source} spin` : row.source);
    setText(this.cells.target, row.target);
    setText(this.cells.by, row.by || `station ${row.station}`);
    row.lights.forEach((light, at) => setLamp(this.lamps[at], light, LIGHT_NAMES[at]));
    setText(this.cells.rate, String(row.rate));
    setText(this.cells.age, ageText(row.age_s));
    setText(this.cells.range, row.p ? lengthText(range(row.p)) : "–");
    setText(this.cells.sigma, row.sigma_m !== undefined ? lengthText(row.sigma_m) : row.sigma_rad !== undefined ? degreeText(row.sigma_rad) : "–");
    this.main.className = `${selected ? "selected" : ""} ${row.current ? "" : "lost"}`;
    const [level, reason] = worstLight(row);
    this.reason.hidden = level === "good";
    const className = level === "good" ? "" : level;
    if (this.reasonCell.className !== className) this.reasonCell.className = className;
    setText(this.reasonCell, level === "good" ? "" : reason);
  }
}

export class Table {
  constructor(onSelect) {
    this.rows = new Map();
    this.selectedId = null;
    this.onSelect = onSelect;
    this.lastEvent = 0;
  }

  selected() {
    return this.selectedId;
  }

  select(id) {
    this.selectedId = id;
    this.onSelect();
  }

  move(step) {
    const ids = [...this.rows.keys()];
    if (ids.length === 0) return;
    const at = Math.max(0, ids.indexOf(this.selectedId) + step);
    this.select(ids[Math.min(at, ids.length - 1)]);
    this.rows.get(this.selectedId).main.scrollIntoView({ block: "nearest" });
  }

  show(state) {
    const seen = new Set();
    for (const row of state.rows) {
      const id = rowId(row);
      seen.add(id);
      if (!this.rows.has(id)) {
        const shown = new Row(id, (chosen) => this.select(chosen));
        this.rows.set(id, shown);
        element(row.fused ? "fused" : "rows").append(shown.main, shown.reason);
      }
      if (this.selectedId === null) this.selectedId = id;
      this.rows.get(id).show(row, id === this.selectedId);
    }
    for (const [id, row] of this.rows) {
      if (seen.has(id)) continue;
      row.main.remove();
      row.reason.remove();
      this.rows.delete(id);
    }
    if (!seen.has(this.selectedId)) this.selectedId = this.rows.keys().next().value ?? null;
    element("nothing").hidden = seen.size > 0;
    element("no-fused").hidden = state.rows.some((row) => row.fused);
    this.showDetail(state.rows.find((row) => rowId(row) === this.selectedId));
    this.showDaemons(state.daemons);
    this.showEvents(state.events);
    this.showCounters(state);
    setText(element("clock"), `${new Date(state.utc_ms).toISOString().replace("T", " ").slice(0, 21)} UTC`);
  }

  showDetail(row) {
    const detail = element("detail");
    if (!row) return detail.replaceChildren();
    const lines = [["status", row.status || "–"], ["flags", row.flags || "none"]];
    if (row.p) {
      lines.push(["position", `${row.p.map((c) => (c * 1e3).toFixed(2)).join("  ")} mm`]);
      lines.push([row.turn ? "attitude" : "attitude (turn unknown)", `${rotationVector(row.q).map((c) => degreeText(c, 2)).join("  ")}`]);
      lines.push(["sigma", `${(row.sigma_m * 1e3).toFixed(2)} mm, ${degreeText(row.sigma_rad)}`]);
      lines.push(["residual", row.residual_rad ? `${(row.residual_rad * 206264.8).toFixed(1)} arcsec RMS of ${row.observations}` : "–"]);
      lines.push(["frames", `T_${row.frames.join("_")}`]);
    }
    if (row.fused) lines.push(...fusedLines(row));
    if (row.axis) lines.push(["axis", `pitch ${degreeText(row.pitch_rad, 4)}, yaw ${degreeText(row.yaw_rad, 4)}, sigma ${degreeText(row.sigma_rad, 4)}`]);
    if (row.spin) lines.push(["spin", `${degreeText(range(row.spin), 4)}/s, sigma ${degreeText(row.sigma_rad_s, 4)}/s`]);
    lines.push(["refused, lost", `${row.refused}, ${row.lost}`]);
    const list = make("dl");
    for (const [name, value] of lines) list.append(make("dt", "", name), make("dd", "", value));
    const lights = row.lights.map((light, at) => {
      const line = make("div", "reason");
      const lamp = make("span");
      setLamp(lamp, light, LIGHT_NAMES[at]);
      line.append(lamp, make("span", "", `${LIGHT_NAMES[at]}: ${light[1]}`));
      return line;
    });
    detail.replaceChildren(make("h2", "", `${row.source} → ${row.target}`), ...lights, list);
  }

  showDaemons(daemons) {
    const text = daemons.map((daemon) => {
      if (daemon.silent) return `pharosd on ${daemon.host}: SILENT`;
      const bad = daemon.sources.filter((source) => source.state !== "ok").map((source) => `${source.source} ${source.target} ${source.state}: ${source.message}`);
      return [`pharosd on ${daemon.host}: ${daemon.state}`, ...bad].join("; ");
    });
    setText(element("daemons"), text.join(" | ") || "no pharosd has told its state");
    const worst = daemons.some((d) => d.silent || d.state === "error") ? "bad" : daemons.some((d) => d.state !== "ok") ? "degraded" : daemons.length ? "good" : "unknown";
    element("daemons").className = worst;
  }

  showEvents(events) {
    const newest = events.length ? events[events.length - 1][0] : 0;
    if (newest === this.lastEvent) return;
    this.lastEvent = newest;
    const items = [...events].reverse().map(([, text]) => {
      const kind = text.includes(" LOST ") ? "lost" : text.includes(" FOUND ") ? "found" : "";
      return make("li", kind, text);
    });
    element("event-list").replaceChildren(...items);
  }

  showCounters(state) {
    const c = state.counters;
    const parts = [`${c.received} messages`];
    if (c.foreign) parts.push(`${c.foreign} of other types skipped`);
    if (c.impossible) parts.push(`${c.impossible} with impossible values skipped`);
    if (c.too_many) parts.push(`${c.too_many} of more sources than fit skipped`);
    if (state.replay?.skipped) parts.push(`${state.replay.skipped} broken pieces of the log skipped`);
    if (c.refused_requests) parts.push(`${c.refused_requests} requests refused`);
    parts.push(`${c.viewers} viewer${c.viewers === 1 ? "" : "s"}`);
    setText(element("counters"), parts.join(", "));
  }
}

// SPDX-License-Identifier: Apache-2.0
// The time slider of a replayed log. All pages show the same moment: the server plays it.
import { spanText } from "./words.js";

export class Replay {
  constructor() {
    this.form = document.getElementById("replay");
    this.slider = document.getElementById("slider");
    this.play = document.getElementById("play");
    this.speed = document.getElementById("speed");
    this.time = document.getElementById("replay-time");
    this.state = null;
    this.dragging = false;
    this.play.addEventListener("click", () => this.toggle());
    this.speed.addEventListener("change", () => this.ask({ speed: this.speed.value }));
    this.slider.addEventListener("input", () => {
      this.dragging = true;
      this.time.textContent = spanText(Number(this.slider.value));
    });
    this.slider.addEventListener("change", () => {
      this.dragging = false;
      this.ask({ seek: this.slider.value });
    });
    this.form.addEventListener("submit", (event) => event.preventDefault());
  }

  ask(values) {
    return fetch(`/control?${new URLSearchParams(values)}`, { method: "POST" });
  }

  toggle() {
    if (this.state) this.ask({ playing: this.state.playing ? 0 : 1 });
  }

  step(seconds) {
    if (!this.state) return;
    this.ask({ seek: Math.min(Math.max(this.state.position_s + seconds, 0), this.state.duration_s) });
  }

  show(state) {
    this.state = state ?? null;
    this.form.hidden = !state;
    if (!state) return;
    this.play.textContent = state.playing ? "pause" : "play";
    this.slider.max = state.duration_s;
    if (this.dragging) return;
    this.slider.value = state.position_s;
    this.time.textContent = `${spanText(state.position_s)} / ${spanText(state.duration_s)}`;
  }
}

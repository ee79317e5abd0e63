// SPDX-License-Identifier: Apache-2.0
// The cameras' pictures with what was found drawn in: a pane for each, large in a dialog.
import { ageText } from "./words.js";

class Pane {
  constructor(figure) {
    this.figure = figure;
    this.image = figure.querySelector("img");
    this.caption = figure.querySelector("figcaption");
    this.shown = "";
  }

  // One request at a time: a slow line gets the newest picture next.
  show(preview, number) {
    const address = `/preview/${number}?v=${preview.utime}`;
    if (address !== this.shown && (this.shown === "" || this.image.complete)) {
      this.shown = address;
      this.image.src = address;
    }
    const name = `${preview.source}${preview.view ? ` ${preview.view}` : ""}`;
    this.image.alt = `picture of ${name}`;
    this.figure.classList.toggle("stale", !preview.current);
    this.caption.textContent = `${name}: ${preview.current ? preview.status : "old"}, ${ageText(preview.age_s)}`;
  }
}

function makeFigure() {
  const figure = document.createElement("figure");
  figure.className = "camera";
  figure.append(document.createElement("img"), document.createElement("figcaption"));
  return figure;
}

export class Cameras {
  constructor(section, dialog) {
    this.section = section;
    this.dialog = dialog;
    this.panes = [];
    this.large = new Pane(dialog.querySelector("figure"));
    this.opened = 0;
  }

  add() {
    const number = this.panes.length;
    const pane = new Pane(makeFigure());
    pane.figure.addEventListener("click", () => {
      this.opened = number;
      this.large.shown = "";
      this.dialog.showModal();
    });
    this.section.append(pane.figure);
    this.panes.push(pane);
  }

  // A replay that jumps may have fewer.
  show(previews) {
    while (this.panes.length < previews.length) this.add();
    while (this.panes.length > previews.length) this.panes.pop().figure.remove();
    this.section.hidden = previews.length === 0;
    previews.forEach((preview, number) => this.panes[number].show(preview, number));
    if (this.dialog.open && previews[this.opened]) this.large.show(previews[this.opened], this.opened);
  }
}

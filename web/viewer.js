// Frames of one job: scrub, step, play. Pictures are fetched a little ahead and shown only when decoded.

import {frameUrl} from "./api.js";
import {h, setText} from "./dom.js";

const kept = 64;   // pictures held decoded
const ahead = 6;   // pictures fetched before they are due

export class Viewer {
  /** `moved(index or null)` is told which frame the user chose; null: follows the newest. */
  constructor(id, name, moved) {
    this.id = id;
    this.name = name;
    this.moved = moved;
    this.count = 0;
    this.index = 0;
    this.following = true;
    this.playing = false;
    this.rate = 30;
    this.pictures = new Map();

    this.stage = h("div", {class: "stage"}, h("p", {class: "quiet"}, "No frame yet."));
    this.scrubber = h("input", {
      type: "range", min: 0, max: 0, value: 0, "aria-label": "Frame",
      oninput: () => this.choose(Number(this.scrubber.value)),
    });
    this.toggle = h("button", {class: "button", onclick: () => this.play(!this.playing)}, "Play");
    this.label = h("output", {class: "counter"});
    this.element = h(
      "section", {class: "viewer", "aria-label": "Frames"}, this.stage,
      h("div", {class: "controls"}, this.toggle, this.scrubber, this.label));
  }

  /** The job has `count` pictures by now, `rate` of them a second. */
  update(count, rate) {
    this.rate = rate;
    if (count === this.count) return;
    this.count = count;
    this.scrubber.max = Math.max(0, count - 1);
    if (count > 0) this.show(this.following && !this.playing ? count - 1 : Math.min(this.index, count - 1));
  }

  seek(index) {
    this.following = index === null;
    if (this.following) this.show(Math.max(0, this.count - 1));
    else this.show(index);
  }

  choose(index) {
    if (this.count === 0) return;
    const chosen = Math.min(this.count - 1, Math.max(0, index));
    this.following = false;
    this.moved(chosen);
    this.show(chosen);
  }

  picture(index) {
    let picture = this.pictures.get(index);
    if (!picture) {
      picture = new Image();
      picture.alt = `${this.name}, frame ${index}`;
      picture.src = frameUrl(this.id, index);
    }
    this.pictures.delete(index);
    this.pictures.set(index, picture);
    if (this.pictures.size > kept) this.pictures.delete(this.pictures.keys().next().value);
    return picture;
  }

  async show(index) {
    this.index = index;
    if (index >= this.count) return;
    this.scrubber.value = index;
    setText(this.label, `${index} / ${this.count - 1}`);
    const picture = this.picture(index);
    try {
      await picture.decode();
      if (this.index === index) this.stage.replaceChildren(picture);
    } catch {
      this.pictures.delete(index);
      if (this.index === index)
        this.stage.replaceChildren(h("p", {class: "quiet"}, `Frame ${index} could not be loaded.`));
    }
  }

  async play(on) {
    this.playing = on;
    setText(this.toggle, on ? "Pause" : "Play");
    if (!on) return;
    if (this.index >= this.count - 1) this.choose(0);
    let due = performance.now();
    while (this.playing) {
      due = Math.max(due + 1000 / this.rate, performance.now());
      await new Promise((resume) => setTimeout(resume, due - performance.now()));
      if (!this.playing) return;
      if (this.index >= this.count - 1) return this.play(false);
      for (let i = 2; i <= ahead; ++i) if (this.index + i < this.count) this.picture(this.index + i);
      const next = this.index + 1;
      await this.picture(next).decode().catch(() => {});
      if (this.playing) this.choose(next);
    }
  }

  close() {
    this.playing = false;
  }

  /** Arrow keys step (with Shift by ten), Home and End jump, Space plays. */
  key(event) {
    const target = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || target.matches("textarea, select, input:not([type=range])")) return;
    const stride = event.shiftKey ? 10 : 1;
    const moves = {ArrowLeft: this.index - stride, ArrowRight: this.index + stride, Home: 0, End: this.count - 1};
    if (event.key in moves) this.choose(moves[event.key]);
    else if (event.key === " " && !target.closest("button, a, summary")) this.play(!this.playing);
    else return;
    event.preventDefault();
  }
}

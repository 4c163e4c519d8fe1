// Which frame is looked at, and how it moves on: shared by the player, the 3D view and the charts of a job, and by all pictures of
// a comparison.

import {computed, signal} from "@preact/signals";
import {useEffect} from "preact/hooks";
import type {KeyBinding} from "./keys";

export const speeds = [0.125, 0.25, 0.5, 1, 2, 4, 8];
const fastestPictures = 30;  // shown a second; beyond that some are left out

export class Playback {
  /** Frames that are there, and that there will be. */
  readonly count = signal(0);
  readonly total = signal(0);
  /** Frames a simulated second. */
  readonly rate = signal(30);
  /** The chosen frame; where none is chosen, the newest one. */
  readonly chosen = signal<number | null>(null);
  readonly playing = signal(false);
  readonly speed = signal(1);
  readonly loop = signal(false);
  readonly index = computed(() => {
    const last = this.count.value - 1;
    return Math.max(0, this.chosen.value === null ? last : Math.min(this.chosen.value, last));
  });
  readonly following = computed(() => this.chosen.value === null);
  private runs = 0;
  /** Resolves when the frame can be shown at once. */
  ready: (index: number) => Promise<unknown> = () => Promise.resolve();

  update(count: number, total: number, rate: number) {
    this.count.value = count;
    this.total.value = Math.max(total, count);
    this.rate.value = rate > 0 ? rate : 30;
  }

  choose(index: number) {
    if (this.count.value > 0) this.chosen.value = Math.min(this.count.value - 1, Math.max(0, Math.round(index)));
  }
  step(by: number) {
    this.playing.value = false;
    this.choose(this.index.value + by);
  }
  follow() {
    this.playing.value = false;
    this.chosen.value = null;
  }
  changeSpeed(by: number) {
    const at = speeds.indexOf(this.speed.value) + by;
    this.speed.value = speeds[Math.min(speeds.length - 1, Math.max(0, at))];
  }
  toggle() {
    if (this.playing.value) this.playing.value = false;
    else void this.play();
  }

  /** Real time where a scene's frames are meant for it; else thirty pictures a second. */
  private picturesPerSecond() {
    const rate = this.rate.value;
    return (rate <= 60 ? rate : fastestPictures) * this.speed.value;
  }

  private async play() {
    if (this.count.value < 2) return;
    // One that was stopped while it waited must not go on beside this one.
    const run = ++this.runs;
    const on = () => this.playing.value && run === this.runs;
    if (this.index.value >= this.count.value - 1) this.choose(0);
    else this.choose(this.index.value);
    this.playing.value = true;
    let due = performance.now();
    while (on()) {
      const perSecond = this.picturesPerSecond();
      const stride = Math.max(1, Math.round(perSecond / fastestPictures));
      due = Math.max(due + (1000 * stride) / perSecond, performance.now());
      await new Promise((resume) => setTimeout(resume, due - performance.now()));
      if (!on()) return;
      let next = this.index.value + stride;
      if (next > this.count.value - 1) {
        if (this.loop.value) {
          next = 0;
        } else {
          this.playing.value = false;
          this.choose(this.count.value - 1);
          return;
        }
      }
      await this.ready(next).catch(() => {});
      if (on()) this.choose(next);
    }
  }

  keys(): KeyBinding[] {
    const stride = (event: KeyboardEvent) => (event.shiftKey ? 10 : 1);
    return [
      {keys: [" "], shown: "Space", words: "Play or pause", run: () => this.toggle()},
      {keys: ["ArrowLeft"], shown: "←", words: "One frame back (with Shift ten)", run: (event) => this.step(-stride(event))},
      {keys: ["ArrowRight"], shown: "→", words: "One frame on (with Shift ten)", run: (event) => this.step(stride(event))},
      {keys: ["Home"], words: "First frame", run: () => this.step(-Infinity)},
      {keys: ["End"], words: "Newest frame, and those that follow", run: () => this.follow()},
      {keys: ["["], words: "Play slower", run: () => this.changeSpeed(-1)},
      {keys: ["]"], words: "Play faster", run: () => this.changeSpeed(1)},
      {keys: ["l"], words: "Play in a loop", run: () => { this.loop.value = !this.loop.value; }},
    ];
  }
}

/** A playback that stops when the component goes. */
export function useStopping(playback: Playback) {
  useEffect(() => () => {
    playback.playing.value = false;
  }, [playback]);
}

// The scrubber and the buttons beside it.

import {useSignalEffect} from "@preact/signals";
import type {ComponentChildren} from "preact";
import {useRef} from "preact/hooks";
import {number} from "../format";
import {type Playback, speeds} from "../playback";
import {IconButton} from "../ui/parts";

export function Controls({playback, live, children}: {playback: Playback; live: boolean; children?: ComponentChildren}) {
  const range = useRef<HTMLInputElement>(null);
  const there = useRef<HTMLSpanElement>(null);
  const index = playback.index.value;
  const count = playback.count.value;
  const total = playback.total.value;
  const time = index / playback.rate.value;
  useSignalEffect(() => {
    const last = Math.max(1, playback.total.value - 1);
    if (there.current) there.current.style.width = `${(100 * Math.max(0, playback.count.value - 1)) / last}%`;
    if (range.current) range.current.style.setProperty("--at", `${(100 * playback.index.value) / last}%`);
  });
  return (
    <div class="controls">
      <IconButton icon={playback.playing.value ? "pause" : "play"} label={playback.playing.value ? "Pause" : "Play"} disabled={count < 2}
        run={() => playback.toggle()} />
      <IconButton icon="previous" label="One frame back" disabled={count === 0 || index === 0} run={() => playback.step(-1)} />
      <IconButton icon="next" label="One frame on" disabled={count === 0 || index >= count - 1} run={() => playback.step(1)} />
      <span class="scrubber">
        <span class="track" aria-hidden="true"><span class="there" ref={there} /></span>
        <input ref={range} type="range" min={0} max={Math.max(1, total - 1)} value={index} disabled={count === 0} aria-label="Frame"
          aria-valuetext={`frame ${index} of ${Math.max(0, total - 1)}, ${number(time)} seconds`}
          onInput={(event) => {
            playback.playing.value = false;
            playback.choose(Number(event.currentTarget.value));
            // Frames that are not there yet cannot be chosen.
            event.currentTarget.value = String(playback.index.value);
          }} />
      </span>
      <output class="counter" aria-hidden="true">
        <span>{count === 0 ? "–" : index}<span class="of"> / {Math.max(0, total - 1)}</span></span>
        <span class="time">{count === 0 ? "" : `${number(time)} s`}</span>
      </output>
      {live && (
        <button type="button" class="chip live" aria-pressed={playback.following.value} title="Show each new frame (End)"
          onClick={() => (playback.following.value ? playback.choose(index) : playback.follow())}>Live</button>
      )}
      <label class="speed">
        <span class="visually-hidden">Speed</span>
        <select value={playback.speed.value} title="Speed ([ and ])" onChange={(event) => { playback.speed.value = Number(event.currentTarget.value); }}>
          {speeds.map((speed) => <option key={speed} value={speed}>{speed < 1 ? `1/${1 / speed}` : speed}×</option>)}
        </select>
      </label>
      <IconButton icon="loop" label="Loop" pressed={playback.loop.value} run={() => { playback.loop.value = !playback.loop.value; }} />
      {children}
    </div>
  );
}

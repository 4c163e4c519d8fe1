// A frame's particles to look at from all sides. Its library is loaded when it is first shown.

import {useEffect, useRef, useState} from "preact/hooks";
import {ApiError, isAbort, particlesUrl, words} from "../api";
import {number, spaced} from "../format";
import {type Cloud, PlyReader} from "../media/ply";
import {loadOrbit} from "../lazy";
import type {OrbitScene} from "../orbit3d";
import type {Playback} from "../playback";
import {href} from "../router";

const mostPoints = 400000;  // drawn; of more, every n-th

async function fetchCloud(address: string, signal: AbortSignal): Promise<Cloud> {
  const response = await fetch(address, {signal});
  if (!response.ok) {
    const problem = await response.json().catch(() => ({}));
    throw new ApiError(response.status, problem);
  }
  const reader = response.body!.getReader();
  const points = new PlyReader(mostPoints);
  try {
    for (let piece = await reader.read(); !piece.done; piece = await reader.read()) points.push(piece.value);
  } finally {
    void reader.cancel().catch(() => {});
  }
  return points.finish();
}

export function Orbit({id, playback, kept}: {id: string; playback: Playback; kept: boolean}) {
  const place = useRef<HTMLDivElement>(null);
  const scene = useRef<OrbitScene | null>(null);
  const [cloud, setCloud] = useState<Cloud | null>(null);
  const [problem, setProblem] = useState("");
  const [ready, setReady] = useState(false);
  const [color, setColor] = useState("");
  const [size, setSize] = useState(1);
  const there = playback.count.value > 0;
  const index = playback.index.value;

  useEffect(() => {
    if (!kept || !there) return;
    let gone = false;
    loadOrbit().then(({OrbitScene: Scene}) => {
      if (gone || !place.current) return;
      scene.current = new Scene(place.current);
      setReady(true);
    }).catch((error) => {
      if (!gone) setProblem(`The 3D view cannot be shown: ${words(error)}`);
    });
    return () => {
      gone = true;
      scene.current?.dispose();
      scene.current = null;
      setReady(false);
    };
  }, [kept, there, id]);

  // While the frame moves on, only the last one asked for is fetched.
  useEffect(() => {
    if (!kept || !there) return;
    const stop = new AbortController();
    const timer = setTimeout(() => {
      fetchCloud(particlesUrl(id, index), stop.signal).then((points) => {
        if (stop.signal.aborted) return;
        setCloud(points);
        setProblem("");
      }, (error) => {
        if (!stop.signal.aborted && !isAbort(error)) setProblem(words(error));
      });
    }, 120);
    return () => {
      clearTimeout(timer);
      stop.abort();
    };
  }, [kept, there, id, index]);

  const colors = cloud ? [...cloud.scalars.map((scalar) => scalar.name), ...(cloud.materials.length > 1 ? ["material"] : [])] : [];
  const chosen = colors.includes(color) ? color : (colors[0] ?? "material");
  const range = cloud && ready ? scene.current?.show(cloud, chosen, size) ?? null : null;

  if (!kept)
    return (
      <div class="note">
        <p>This job keeps no particles. A scene whose output has <code>"particles": ["ply"]</code> does.</p>
        <p><a class="button small" href={href("new", "edit", {job: id, particles: "ply"})}>New job that keeps them</a></p>
      </div>
    );
  if (!there) return <p class="note">There is no frame yet.</p>;
  const unit = cloud?.scalars.find((scalar) => scalar.name === chosen)?.unit ?? "";
  return (
    <div class="orbit">
      <div class="orbit-place" ref={place} tabIndex={0} role="application"
        aria-label="Particles in 3D: arrows turn, plus and minus zoom, 0 resets" onKeyDown={(event) => {
          if (scene.current?.key(event.key)) {
            event.preventDefault();
            event.stopPropagation();
          }
        }} />
      <div class="orbit-bar">
        <label>Colour <select value={chosen} onChange={(event) => setColor(event.currentTarget.value)}>
          {colors.map((name) => <option key={name} value={name}>{spaced(name)}</option>)}
        </select></label>
        {range && <span class="legend"><span>{number(range[0])}</span><span class="ramp" aria-hidden="true" /><span>{number(range[1])} {unit}</span></span>}
        <label>Size <input type="range" min={0.3} max={3} step={0.1} value={size} onInput={(event) => setSize(Number(event.currentTarget.value))} /></label>
        <span class="spacer" />
        <span class="quiet" role="status">
          {problem || (cloud ? `Frame ${index}: ${number(cloud.kept)} ${cloud.kept < cloud.count ? `of ${number(cloud.count)} ` : ""}points` : "Loading …")}
        </span>
      </div>
    </div>
  );
}

// Where a new job starts: example scenes, a file that is dropped, or the draft that was left.

import {useEffect, useRef, useState} from "preact/hooks";
import {isAbort, listScenes, url, words} from "../api";
import {draft, readSceneFile, setDraft, startDraft} from "../draft";
import {useKeys} from "../keys";
import {notify} from "../live";
import {go, href} from "../router";
import type {SceneEntry} from "../types";
import {Icon} from "../ui/icon";

const blankScene = `{
  "lather": 1,
  "name": "",
  "domain": {"min": [-0.1, 0, -0.1], "max": [0.1, 0.2, 0.1]},
  "duration": 1,
  "spacing": 0.005,
  "materials": [{"name": "foam", "preset": "shaving-cream"}],
  "bodies": [
    {"name": "ball", "material": "foam", "shape": {"type": "sphere", "radius": 0.03, "translate": [0, 0.1, 0]}}
  ]
}
`;

export async function takeFile(file: File | undefined) {
  if (!file) return;
  try {
    startDraft(await readSceneFile(file), `file:${file.name}`);
    go(href("new", "edit"));
  } catch (error) {
    notify(words(error), true);
  }
}

function Card({scene}: {scene: SceneEntry}) {
  const [failed, setFailed] = useState(false);
  const name = scene.title || scene.name;
  // A link with this name in its address would show the draft again that was made from it.
  const open = () => {
    if (draft.value?.source === `scene:${scene.name}`) setDraft(null);
  };
  return (
    <li>
      <a class="card" href={href("new", "edit", {scene: scene.name})} onClick={open}>
        <span class="card-picture">
          {scene.picture && !failed
            ? <img src={url(scene.picture.replace(/^\/api\/v1\//, ""))} alt="" loading="lazy" width={400} height={250} onError={() => setFailed(true)} />
            : <span class="card-blank" aria-hidden="true">{name.slice(0, 1)}</span>}
        </span>
        <span class="card-name">{name}</span>
        <span class="card-words">
{scene.title === undefined ? scene.name : `${scene.dimension === 2 ? "2D" : "3D"} · ${scene.solver === "mlsrk" ? "particles" : "grid"}`}
        </span>
      </a>
    </li>
  );
}

export function Gallery() {
  const [scenes, setScenes] = useState<SceneEntry[] | null>(null);
  const [problem, setProblem] = useState("");
  const [text, setText] = useState("");
  const file = useRef<HTMLInputElement>(null);
  const search = useRef<HTMLInputElement>(null);
  useEffect(() => {
    document.title = "New job · Lather";
    const stop = new AbortController();
    listScenes(stop.signal).then(setScenes, (error) => {
      if (!isAbort(error)) setProblem(words(error));
    });
    return () => stop.abort();
  }, []);
  useKeys("Examples", [
    {keys: ["/"], words: "Search", run: () => search.current?.focus()},
    {keys: ["o"], words: "Open a file", run: () => file.current?.click()},
  ]);
  const left = draft.value && draft.value.text !== draft.value.original ? draft.value : null;
  const shown = (scenes ?? []).filter((scene) => `${scene.name} ${scene.title ?? ""}`.toLowerCase().includes(text.toLowerCase()));
  return (
    <main id="main" class="gallery" tabIndex={-1}>
      <header class="title">
        <h1>New job</h1>
        <span class="title-actions">
          {left && <a class="button small" href={href("new", "edit")}><Icon name="edit" /> Back to the draft</a>}
          <a class="button small" href={href("new", "edit")} onClick={() => startDraft(blankScene, "blank")}><Icon name="plus" /> Small scene</a>
          <button type="button" class="button small" onClick={() => file.current!.click()}><Icon name="upload" /> Open a file</button>
          <input ref={file} type="file" class="visually-hidden" tabIndex={-1} aria-label="Scene file, or a PNG made by Lather" accept=".json,.png,application/json,image/png"
            onChange={(event) => {
              void takeFile(event.currentTarget.files?.[0]);
              event.currentTarget.value = "";
            }} />
        </span>
      </header>
      <div class="gallery-lead">
        <p>Choose an example, or drop a scene file here. A PNG that Lather drew opens the scene that it shows.</p>
        {scenes && scenes.length > 6 && (
          <label class="search">
            <Icon name="search" />
            <span class="visually-hidden">Search the examples</span>
            <input ref={search} type="search" placeholder="Search" value={text} onInput={(event) => setText(event.currentTarget.value)} />
          </label>
        )}
      </div>
      {problem && <p class="note">{problem}</p>}
      <ul class="cards" aria-busy={scenes === null && !problem}>{shown.map((scene) => <Card key={scene.name} scene={scene} />)}</ul>
      {scenes && scenes.length === 0 && <p class="note">This server has no example scenes.</p>}
    </main>
  );
}

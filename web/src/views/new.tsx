// A scene as a form and as JSON, side by side, with what it would cost. The text is what counts: the form edits it in place.

import {useEffect, useMemo, useRef, useState} from "preact/hooks";
import {ApiError, getPlan, getSceneText, getSchema, isAbort, postJob, postPlan, type Submission, Unreachable, words} from "../api";
import {type Draft, draft, setDraft, startDraft} from "../draft";
import type {Editor, Mark} from "../editor";
import {edit, JsonError, lineOf, locate, type Node, parse, write} from "../json/text";
import {useKeys} from "../keys";
import {loadEditor} from "../lazy";
import {announce, away, notify, online, trouble} from "../live";
import {go, href, route} from "../router";
import {isObject, type Json, type JsonObject, type Plan, type Problem, type Schema} from "../types";
import {Facts, useMedia} from "../ui/parts";
import {revealed, SceneForm} from "./form";
import {Gallery} from "./gallery";
import {planFacts, Warnings} from "./plan";

const planDelayMs = 350;

/** Enough that no two posts share it; crypto.randomUUID is missing where a page comes over plain HTTP. */
const newKey = () => Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");

/** Fills the draft from what the address names, unless it is there already: a reload keeps what has been written. */
function useSource(query: URLSearchParams): string {
  const [problem, setProblem] = useState("");
  const scene = query.get("scene");
  const job = query.get("job");
  const particles = query.get("particles");
  const source = scene !== null ? `scene:${scene}` : job !== null ? `job:${job}${particles ? `+${particles}` : ""}` : null;
  useEffect(() => {
    if (source === null || draft.value?.source === source) return;
    setDraft(null);
    const stop = new AbortController();
    const load = async () => {
      if (scene !== null) {
        const text = await getSceneText(scene, stop.signal);
        const sizes = (JSON.parse(text) as JsonObject).sizes;
        return {text, size: isObject(sizes) && "preview" in sizes ? "preview" : ""};
      }
      const full = (await getPlan(job!, stop.signal)).scene;
      if (particles && isObject(full.output)) full.output.particles = [particles];
      return {text: `${write(full)}\n`, size: ""};
    };
    load().then(({text, size}) => {
      if (!stop.signal.aborted) startDraft(text, source, size);
    }, (error) => {
      if (!isAbort(error)) setProblem(error instanceof ApiError && error.status === 404 ? "There is no such scene." : words(error));
    });
    return () => stop.abort();
  }, [source]);
  return source === null ? "Nothing is being written." : problem;
}

function useSchema(): Schema | null {
  const [schema, setSchema] = useState<Schema | null>(null);
  useEffect(() => {
    const stop = new AbortController();
    getSchema(stop.signal).then(setSchema, () => {});
    return () => stop.abort();
  }, []);
  return schema;
}

interface Read {
  node: Node | null;
  scene: JsonObject | null;
  error: JsonError | null;
}

function read(text: string): Read {
  try {
    const node = parse(text);
    if (isObject(node.value)) return {node, scene: node.value, error: null};
    return {node, scene: null, error: new JsonError("A scene is an object: {…}.", node.start)};
  } catch (error) {
    if (error instanceof JsonError) return {node: null, scene: null, error};
    throw error;
  }
}

interface Outcome {
  plan: Plan | null;
  problems: Problem[];
  words: string;
}

const submissionOf = (scene: JsonObject, {size, priority}: Draft): Submission =>
  ({scene, ...(size ? {size} : {}), ...(priority ? {priority} : {})});

/** Asks for the plan of what stands there, a moment after the last change; what comes too late is left. */
function usePlanned(scene: JsonObject | null, current: Draft | null): {outcome: Outcome | null; busy: boolean} {
  const [outcome, setOutcome] = useState<Outcome | null>(null);
  const [busy, setBusy] = useState(false);
  const request = scene && current ? JSON.stringify(submissionOf(scene, current)) : null;
  const connected = online.value;
  useEffect(() => {
    if (request === null) {
      setBusy(false);
      return;
    }
    const stop = new AbortController();
    setBusy(true);
    const timer = setTimeout(() => {
      postPlan(JSON.parse(request), stop.signal).then((plan) => ({plan, problems: [], words: ""}), (error) => {
        if (isAbort(error)) throw error;
        if (error instanceof Unreachable) trouble.value = away;
        return {plan: null, problems: error instanceof ApiError ? error.errors : [], words: words(error)};
      }).then((answer) => {
        if (stop.signal.aborted) return;
        setOutcome(answer);
        setBusy(false);
      }, () => {});
    }, planDelayMs);
    return () => {
      clearTimeout(timer);
      stop.abort();
    };
  }, [request, connected]);
  return {outcome: request === null ? null : outcome, busy};
}

/** A problem's pointer leads into the request; this leads into the scene, or is null. */
function scenePointer(problem: Problem): string | null {
  const match = /^\/scene(\/.*)?$/s.exec(problem.pointer ?? "");
  return match ? (match[1] ?? "") : null;
}

function Problems({problems, text, node, show}: {problems: Problem[]; text: string; node: Node | null; show: (pointer: string) => void}) {
  return (
    <ol class="problems">
      {problems.map((problem, i) => {
        const pointer = scenePointer(problem);
        const place = pointer !== null && node ? locate(node, pointer) : null;
        const about = (
          <>
            <span class="problem-place">
              <code>{pointer ?? problem.pointer ?? ""}</code>
              {place && <span class="quiet">line {lineOf(text, place.start)}</span>}
            </span>
            <span>{problem.message ?? problem.detail}</span>
            {problem.allowed && <span class="quiet">Allowed: {problem.allowed}</span>}
          </>
        );
        return (
          <li key={`${problem.pointer} ${i}`}>
            {place ? <button type="button" onClick={() => show(pointer!)}>{about}</button> : <div>{about}</div>}
          </li>
        );
      })}
    </ol>
  );
}

function EditorPane({text, marks, changed, use}: {text: string; marks: Mark[]; changed: (text: string) => void; use: (editor: Editor | null) => void}) {
  const host = useRef<HTMLDivElement>(null);
  const editor = useRef<Editor | null>(null);
  const latest = useRef({text, changed, marks});
  latest.current = {text, changed, marks};
  const [failed, setFailed] = useState(false);
  useEffect(() => {
    let gone = false;
    loadEditor().then(({Editor: Made}) => {
      if (gone || !host.current) return;
      editor.current = new Made(host.current, latest.current.text, "Scene as JSON", (typed) => latest.current.changed(typed));
      editor.current.mark(latest.current.marks);
      use(editor.current);
    }, () => !gone && setFailed(true));
    return () => {
      gone = true;
      editor.current?.destroy();
      editor.current = null;
      use(null);
    };
  }, []);
  useEffect(() => editor.current?.setText(text), [text]);
  useEffect(() => editor.current?.mark(marks), [marks]);
  // What cannot load the editor can still be edited.
  if (failed) return <textarea class="plain-editor" aria-label="Scene as JSON" value={text} onInput={(event) => changed(event.currentTarget.value)} />;
  return <div class="editor" ref={host} />;
}

function Sizes({scene, current}: {scene: JsonObject | null; current: Draft}) {
  const sizes = isObject(scene?.sizes) ? Object.keys(scene!.sizes as JsonObject) : [];
  const all = current.size && !sizes.includes(current.size) ? [...sizes, current.size] : sizes;
  if (all.length === 0) return null;
  return (
    <div class="segmented" role="group" aria-label="Size">
      {["", ...all].map((size) => (
        <button key={size} type="button" aria-pressed={current.size === size} onClick={() => setDraft({...current, size})}>
          {size || "as written"}
        </button>
      ))}
    </div>
  );
}

/** A server that knows qualities lists them in the schema, from fast to exact. */
function Quality({schema, scene, change}: {schema: Schema | null; scene: JsonObject; change: (pointer: string, value: Json | undefined) => void}) {
  const levels = (schema?.properties?.quality?.enum ?? []).filter((level): level is string => typeof level === "string");
  if (levels.length < 2) return null;
  const byDefault = levels.indexOf(String(schema!.properties!.quality.default ?? "standard"));
  const at = levels.indexOf(String(scene.quality ?? ""));
  const value = at < 0 ? Math.max(0, byDefault) : at;
  return (
    <label class="quality">
      <span class="quality-name">Quality <strong>{at < 0 ? "not chosen" : levels[value]}</strong></span>
      <input type="range" min={0} max={levels.length - 1} step={1} value={value} aria-valuetext={at < 0 ? "not chosen" : levels[value]}
        onInput={(event) => change("/quality", levels[Number(event.currentTarget.value)])} />
      <span class="quality-ends" aria-hidden="true"><span>faster</span><span>more exact</span></span>
    </label>
  );
}

function EditPage() {
  const {query} = route.value;
  const sourceProblem = useSource(query);
  const schema = useSchema();
  const current = draft.value;
  const text = current?.text ?? "";
  const {node, scene, error} = useMemo(() => read(text), [text]);
  const lastScene = useRef<JsonObject | null>(null);
  if (scene) lastScene.current = scene;
  const {outcome, busy} = usePlanned(scene, current);
  const [posting, setPosting] = useState(false);
  const editor = useRef<Editor | null>(null);
  const postKey = useRef({request: "", key: ""});
  const narrow = useMedia("(max-width: 860px)");
  const [pane, setPane] = useState<"form" | "json">("form");

  useEffect(() => {
    document.title = "New job · Lather";
    return () => {
      revealed.value = null;
    };
  }, []);
  const change = (next: string) => {
    if (draft.value) setDraft({...draft.value, text: next});
  };
  const changeValue = (pointer: string, value: Json | undefined) => {
    if (!node || !current) return;
    const made = edit(text, node, pointer, value);
    if (!made) return;
    editor.current?.apply(made, text);
    change(text.slice(0, made.from) + made.insert + text.slice(made.to));
  };

  const problems = error ? [] : (outcome?.problems ?? []);
  const byPointer = useMemo(() => {
    const all = new Map<string, Problem[]>();
    for (const problem of problems) {
      const pointer = scenePointer(problem);
      if (pointer !== null) all.set(pointer, [...(all.get(pointer) ?? []), problem]);
    }
    return all;
  }, [outcome, error]);
  const marks = useMemo((): Mark[] => {
    if (error) return [{from: error.at, to: Math.min(text.length, error.at + 1), message: error.message, severity: "error"}];
    if (!node) return [];
    return [...byPointer].flatMap(([pointer, list]) => {
      const {start, end, exact} = locate(node, pointer);
      // All of what lacks a member would be underlined: its beginning has to do.
      return list.map((problem): Mark => ({
        from: start, to: exact ? end : Math.min(end, start + 1), severity: "error",
        message: `${problem.message ?? ""}${problem.allowed ? `\nAllowed: ${problem.allowed}` : ""}`,
      }));
    });
  }, [byPointer, error, node]);

  const show = (pointer: string) => {
    if (!node) return;
    const {start, end, exact} = locate(node, pointer);
    revealed.value = {pointer};
    editor.current?.reveal(start, exact ? end : start, narrow ? pane === "json" : false);
  };

  const post = async () => {
    if (!scene || !current || posting) return;
    const request = submissionOf(scene, current);
    // A post that may or may not have arrived is repeated with its own key, so that it gives one job.
    const fingerprint = JSON.stringify(request);
    if (postKey.current.request !== fingerprint) postKey.current = {request: fingerprint, key: newKey()};
    setPosting(true);
    try {
      const job = await postJob(request, postKey.current.key);
      postKey.current = {request: "", key: ""};
      // Unless the user has gone on to something else meanwhile.
      if (draft.value === current) setDraft({...current, original: current.text});
      announce("The job has been posted.");
      if (route.value.view === "new") go(href("job", job.id));
      else setPosting(false);
    } catch (failure) {
      notify(failure instanceof Unreachable ? "The server does not answer. Post again when it is back: no job is made twice." : words(failure), true);
      setPosting(false);
    }
  };
  useKeys("New job", [{keys: ["p"], words: "Post the job", run: () => void post()}]);

  if (!current)
    return (
      <main id="main" class="edit" tabIndex={-1}>
        <div class="empty"><p>{sourceProblem || "Loading …"}</p><a class="button" href={href("new")}>To the examples</a></div>
      </main>
    );
  const shownScene = scene ?? lastScene.current ?? {};
  const name = typeof shownScene.name === "string" && shownScene.name ? shownScene.name : "New job";
  const refused = outcome?.words ?? "";
  return (
    <main id="main" class="edit" tabIndex={-1}>
      <header class="title">
        <h1>{name}</h1>
        <span class="title-actions"><a class="button small" href={href("new")}>All examples</a></span>
      </header>
      {narrow && (
        <div class="segmented wide" role="group" aria-label="Show">
          <button type="button" aria-pressed={pane === "form"} onClick={() => setPane("form")}>Form</button>
          <button type="button" aria-pressed={pane === "json"} onClick={() => setPane("json")}>JSON</button>
        </div>
      )}
      <div class="edit-columns">
        {(!narrow || pane === "form") && (
          <section class="pane form-pane" aria-label="Form">
            {error && <p class="callout warn small">The JSON cannot be read: the form shows how it was before.</p>}
            {schema ? (
              <fieldset disabled={error !== null}>
                <SceneForm schema={schema} size={current.size} scene={shownScene} problems={byPointer} change={changeValue} />
              </fieldset>
            ) : <p class="note">Loading the form …</p>}
          </section>
        )}
        {(!narrow || pane === "json") && (
          <section class="pane json-pane" aria-label="JSON">
            <EditorPane key={current.source} text={text} marks={marks} changed={change} use={(made) => { editor.current = made; }} />
          </section>
        )}
        <section class="plan-pane" aria-label="Plan">
          <div class="plan-head">
            <Sizes scene={scene} current={current} />
            {scene && <Quality schema={schema} scene={scene} change={changeValue} />}
          </div>
          <div class={`plan-body ${busy ? "busy" : ""}`} role="status" aria-busy={busy}>
            {error ? (
              <div class="callout bad">
                <strong>This is not JSON yet.</strong>
                <button type="button" class="link" onClick={() => editor.current?.reveal(error.at, error.at + 1, true)}>Line {lineOf(text, error.at)}: {error.message}</button>
              </div>
            ) : outcome?.plan ? (
              <>
                <Facts entries={planFacts(outcome.plan)} />
                <Warnings plan={outcome.plan} />
              </>
            ) : outcome ? (
              <>
                <p class="refused"><strong>{problems.length > 0 ? `${problems.length} ${problems.length === 1 ? "problem" : "problems"}` : "It cannot be planned"}</strong>
                  {problems.length === 0 && <span> {refused}</span>}</p>
                <Problems problems={problems} text={text} node={node} show={show} />
              </>
            ) : <p class="note">Planning …</p>}
          </div>
          <div class="plan-foot">
            <label class="priority">Priority <input type="number" min={-100} max={100} step={1} value={current.priority} onChange={(event) => {
              const priority = Math.round(Number(event.currentTarget.value));
              setDraft({...current, priority: Number.isFinite(priority) ? Math.max(-100, Math.min(100, priority)) : 0});
            }} /></label>
            <button type="button" class="button primary" disabled={posting || !scene || (!busy && !outcome?.plan)} onClick={() => void post()}>
              {posting ? "Posting …" : "Post job"}
            </button>
          </div>
        </section>
      </div>
    </main>
  );
}

export function NewJob() {
  return route.value.id === "edit" ? <EditPage /> : <Gallery />;
}

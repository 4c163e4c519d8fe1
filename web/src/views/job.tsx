// One job: its frames, its state, what can be downloaded, and what was planned and measured.

import {useEffect, useMemo, useRef, useState} from "preact/hooks";
import {actOnJob, ApiError, getJob, getLog, getPlan, isAbort, jobUrl, linkUrl, words} from "../api";
import {duration, localTime, number, plural, secondsBetween} from "../format";
import {
  act, type Action, actionIcons, actions, actionWords, confirmation, framesInAll, hasEnded, losesWork, timeLeft, title,
} from "../jobs";
import {write} from "../json/text";
import {useKeys} from "../keys";
import {announce, notify, useEvents, usePolling} from "../live";
import {Playback} from "../playback";
import {go, href, route, setQuery} from "../router";
import {isObject, type Job, type Json, type JsonObject, type Plan} from "../types";
import {Icon} from "../ui/icon";
import {AskNumber, Bar, Confirm, Facts, State, Tabs} from "../ui/parts";
import {Orbit} from "./orbit";
import {PlanView} from "./plan";
import {Player} from "./player";
import {ReportView} from "./report";

const tabs: [string, string][] = [["report", "Report"], ["plan", "Plan"], ["scene", "Scene"], ["log", "Log"], ["3d", "3D"]];

function useJob(id: string) {
  const [job, setJob] = useState<Job | null>(null);
  const [problem, setProblem] = useState("");
  const streamed = useRef(false);
  const poke = usePolling(async (signal) => {
    try {
      setJob(await getJob(id, signal));
      setProblem("");
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      if (error.status === 404) setJob(null);
      setProblem(error.status === 404 ? "There is no such job (any more)." : error.message);
    }
  }, streamed.current || (job && hasEnded(job.state)) ? 5000 : 1000, id);
  const stream = job && !hasEnded(job.state) && "events" in job.links ? linkUrl(job.links.events) : null;
  streamed.current = useEvents(stream, poke);
  return {job, problem, poke};
}

/** The plan; `version` changes when the job is made another one. */
function usePlan(id: string, version: unknown) {
  const [plan, setPlan] = useState<Plan | null>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    const stop = new AbortController();
    getPlan(id, stop.signal).then(setPlan, (error) => {
      if (!isAbort(error)) setProblem(words(error));
    });
    return () => stop.abort();
  }, [id, version]);
  return {plan, problem};
}

function Log({job}: {job: Job}) {
  const [text, setText] = useState<string | null>(null);
  const element = useRef<HTMLPreElement>(null);
  usePolling(async (signal) => {
    try {
      setText(await getLog(job.id, signal));
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      setText("");
    }
  }, hasEnded(job.state) ? null : 2000, `${job.id} ${job.state}`);
  // Stays at the end while it is looked at.
  useEffect(() => {
    const pre = element.current;
    if (pre && pre.scrollHeight - pre.scrollTop - pre.clientHeight < 80) pre.scrollTop = pre.scrollHeight;
  }, [text]);
  if (!text) return <p class="note">{text === null ? "Loading the log …" : "Nothing has been logged."}</p>;
  return <pre class="text" ref={element} tabIndex={0} aria-label="Log">{text}</pre>;
}

function Scene({id, plan}: {id: string; plan: Plan}) {
  const text = useMemo(() => write(plan.scene), [plan]);
  const copy = () => {
    navigator.clipboard?.writeText(text).then(() => notify("The scene has been copied."), () => notify("The browser does not allow copying.", true));
  };
  return (
    <div class="scene">
      <p class="note-row">
        <span class="quiet">In full: with its size applied and all defaults.</span>
        <span class="spacer" />
        {navigator.clipboard && <button type="button" class="button small" onClick={copy}><Icon name="copy" /> Copy</button>}
        <a class="button small" href={href("new", "edit", {job: id})}><Icon name="edit" /> Edit as a new job</a>
      </p>
      <pre class="text" tabIndex={0} aria-label="Scene">{text}</pre>
    </div>
  );
}

const asked = (plan: Plan | null, kind: string): string[] => {
  const output = plan?.scene.output;
  const list = isObject(output) ? output[kind] : null;
  return Array.isArray(list) ? list.filter((item): item is string => typeof item === "string") : [];
};

function Downloads({job, plan, frame}: {job: Job; plan: Plan | null; frame: number}) {
  const link = (address: string, name: string, file: string) => (
    <a key={name} class="download" href={address} download={file}><Icon name="download" /> {name}</a>
  );
  const stem = title(job).replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "").slice(0, 60) || job.id;
  const padded = String(frame).padStart(5, "0");
  const probes = plan?.scene.probes as Json[] | undefined;
  return (
    <section class="downloads" aria-label="Downloads">
      <h3>Downloads</h3>
      {job.frames > 0 && <>
        {"film" in job.links && link(linkUrl(job.links.film), "Film", `${stem}.mp4`)}
        {link(jobUrl(job.id, "/frames.zip"), "All frames", `${stem}.zip`)}
        {link(jobUrl(job.id, `/frames/${frame}.png`), `Frame ${frame}`, `${stem}-${padded}.png`)}
        {asked(plan, "particles").map((kind) =>
          link(jobUrl(job.id, `/particles/${frame}.${kind}`), `Particles ${frame} (${kind})`, `${stem}-${padded}.${kind}`))}
        {asked(plan, "skin").map((kind) =>
          link(jobUrl(job.id, `/skin/${frame}.${kind}`), `Skin ${frame} (${kind})`, `${stem}-${padded}-skin.${kind}`))}
      </>}
      {hasEnded(job.state) && probes && probes.length > 0 && link(jobUrl(job.id, "/probes.csv"), "Probes", `${stem}-probes.csv`)}
      {hasEnded(job.state) && job.frames > 0 && link(jobUrl(job.id, "/report"), "Report", `${stem}-report.json`)}
      {link(jobUrl(job.id, "/plan"), "Plan and scene", `${stem}-plan.json`)}
    </section>
  );
}

function Status({job}: {job: Job}) {
  const progress = job.progress ?? {};
  const running = job.state === "running";
  const left = timeLeft(job);
  return (
    <section class="status" aria-label="State">
      <p class="status-line">
        <State job={job} />
        <span class="spacer" />
        {running && <span class="strong">{Math.floor(100 * progress.fraction)} %</span>}
        {left && <span class="quiet">{left} left</span>}
      </p>
      <Bar job={job} />
      <Facts entries={[
        ["Frames", job.state === "succeeded" ? number(job.frames) : `${number(job.frames)} of ${number(framesInAll(job))}`],
        ["Simulated", hasEnded(job.state) && job.state === "succeeded" ? "" : progress.time > 0 ? `${number(progress.time)} s` : ""],
        ["Step", running && progress.step > 0 ? number(progress.step) : ""],
        ["A frame takes", running && progress.seconds_per_frame > 0 ? duration(progress.seconds_per_frame) : ""],
        ["Points", number(job.points)],
        ["Took", job.started && job.ended ? duration(secondsBetween(job.started, job.ended)) : ""],
        ["Priority", job.priority !== 0 ? number(job.priority) : ""],
        ["Attempt", job.attempt > 1 ? number(job.attempt) : ""],
        ["Posted", localTime(job.created)],
      ]} />
    </section>
  );
}

export function JobPage({id}: {id: string}) {
  const {job, problem, poke} = useJob(id);
  const {plan, problem: planProblem} = usePlan(id, job && framesInAll(job));
  const playback = useMemo(() => new Playback(), [id]);
  const [asking, setAsking] = useState<"extend" | "priority" | null>(null);
  const [confirming, setConfirming] = useState<Action | null>(null);
  const {query} = route.value;
  const tab = tabs.some(([name]) => name === query.get("tab")) ? query.get("tab")! : "report";

  // The address chooses the frame, and the frame that is chosen goes into the address once it stays.
  const frameOfAddress = query.get("frame");
  const written = useRef<string | null>(null);
  useEffect(() => {
    // What was written here is old news by now.
    if (frameOfAddress === null || frameOfAddress === written.current || playback.playing.peek()) return;
    const frame = Number(frameOfAddress);
    if (Number.isInteger(frame) && frame >= 0) playback.chosen.value = frame;
  }, [playback, frameOfAddress]);
  const chosen = playback.chosen.value;
  const playing = playback.playing.value;
  useEffect(() => {
    if (playing) return;
    const timer = setTimeout(() => {
      written.current = chosen === null ? null : String(chosen);
      if (route.value.id === id) setQuery({frame: chosen});
    }, 250);
    return () => clearTimeout(timer);
  }, [chosen, playing]);

  const before = useRef<Job | null>(null);
  useEffect(() => {
    if (!job) return;
    document.title = `${title(job)} · Lather`;
    playback.update(job.frames, framesInAll(job), job.frame_rate);
    if (before.current && before.current.state !== job.state) announce(`${title(job)}: ${job.state}.`);
    before.current = job;
  }, [job]);

  const carryOut = async (action: Action) => {
    if (!job) return;
    const succeeded = await act(action, [job]);
    if (action === "delete" && succeeded) go(href("jobs"));
    else poke();
  };
  const change = async (action: "extend" | "priority", body: JsonObject, done: string) => {
    try {
      await actOnJob(job!, action, body);
      announce(done);
    } catch (error) {
      notify(words(error), true);
    }
    poke();
  };
  const run = (action: Action) => {
    if (job && losesWork(action, [job], Date.now())) setConfirming(action);
    else void carryOut(action);
  };
  useKeys("Job", [
    ...tabs.map(([name, words], i) => ({keys: [String(i + 1)], words: `Show ${words}`, run: () => setQuery({tab: name})})),
    {keys: ["e"], words: "Edit as a new job", run: () => go(href("new", "edit", {job: id}))},
  ]);

  if (!job)
    return (
      <main id="main" class="job" tabIndex={-1}>
        <div class="empty" aria-busy={problem === ""}>
          <p>{problem || "Loading …"}</p>
          {problem && <a class="button" href={href("jobs")}>To the queue</a>}
        </div>
      </main>
    );
  const frame = playback.index.value;
  return (
    <main id="main" class="job" tabIndex={-1}>
      <header class="title">
        <h1>{title(job)}</h1>
        <span class="title-actions">
          <a class="button small" href={href("new", "edit", {job: id})}><Icon name="edit" /> Edit as new</a>
          {job.state === "succeeded" && "extend" in job.links && plan && (
            <button type="button" class="button small" onClick={() => setAsking("extend")}><Icon name="longer" /> Extend</button>
          )}
          {job.state === "queued" && "priority" in job.links && (
            <button type="button" class="button small" onClick={() => setAsking("priority")}>Priority {number(job.priority)}</button>
          )}
          {actions(job).map((action) => (
            <button key={action} type="button" class="button small" onClick={() => run(action)}>
              <Icon name={actionIcons[action]} /> {actionWords[action]}
            </button>
          ))}
        </span>
      </header>
      {job.error && (
        <div class="callout bad" role="alert">
          <strong>{job.state === "failed" ? "This job failed." : "It could not go on."}</strong>
          <p class="prose">{job.error}</p>
          {job.frames > 0 && <p class="quiet">{plural(job.frames, "frame")} made before that {job.frames === 1 ? "is" : "are"} kept.</p>}
        </div>
      )}
      <div class="job-columns">
        <Player id={id} name={title(job)} playback={playback} live={!hasEnded(job.state)} />
        <aside>
          <Status job={job} />
          <Downloads job={job} plan={plan} frame={frame} />
        </aside>
      </div>
      <Tabs label="About this job" tabs={tabs} chosen={tab} choose={(name) => setQuery({tab: name})}>
        {tab === "report" && <ReportView job={job} playback={playback} />}
        {tab === "plan" && (plan ? <PlanView plan={plan} /> : <p class="note">{planProblem || "Loading the plan …"}</p>)}
        {tab === "scene" && (plan ? <Scene id={id} plan={plan} /> : <p class="note">{planProblem || "Loading the scene …"}</p>)}
        {tab === "log" && <Log job={job} />}
        {tab === "3d" && (plan ? <Orbit id={id} playback={playback} kept={asked(plan, "particles").includes("ply")} /> :
          <p class="note">{planProblem || "Loading …"}</p>)}
      </Tabs>
      {asking === "extend" && plan && (
        <AskNumber title="Make it longer" words="The job goes on from its end; its frames stay as they are." label="Duration" unit="s" action="Extend"
          value={Number(plan.scene.duration) * 2} least={Number(plan.scene.duration)} close={() => setAsking(null)}
          run={(duration) => void change("extend", {duration}, "The job goes on.")} />
      )}
      {asking === "priority" && (
        <AskNumber title="Priority" words="From −100 to 100; higher ones go first." label="Priority" action="Set" value={job.priority} least={-100} most={100}
          close={() => setAsking(null)} run={(priority) => void change("priority", {priority: Math.round(priority)}, "The priority has been changed.")} />
      )}
      {confirming && <Confirm {...confirmation(confirming, [job])} run={() => void carryOut(confirming)} close={() => setConfirming(null)} />}
    </main>
  );
}

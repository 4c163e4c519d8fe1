// The queue: every job in one dense row, newest first; filters and what is selected stand in the address.

import {useEffect, useMemo, useRef, useState} from "preact/hooks";
import {frameUrl, listJobs, words} from "../api";
import {ago, duration, localTime, number, plural, secondsBetween} from "../format";
import {
  act, type Action, actionIcons, actions, actionWords, confirmation, hasEnded, losesWork, positions, progressText, timeLeft, title,
} from "../jobs";
import {useKeys} from "../keys";
import {announce, notify, usePolling} from "../live";
import {go, href, route, setQuery} from "../router";
import type {Job} from "../types";
import {Icon} from "../ui/icon";
import {Bar, Confirm, IconButton, State} from "../ui/parts";

const pageSize = 100;
const filters: [string, string, (job: Job) => boolean][] = [
  ["", "All", () => true],
  ["active", "Active", (job) => !hasEnded(job.state)],
  ["done", "Done", (job) => job.state === "succeeded"],
  ["failed", "Failed", (job) => job.state === "failed"],
  ["cancelled", "Cancelled", (job) => job.state === "cancelled"],
];

/** The newest jobs, and the older ones that were asked for. */
function useJobs() {
  const [newest, setNewest] = useState<Job[] | null>(null);
  const [older, setOlder] = useState<Job[]>([]);
  const cursor = useRef<string | null>(null);
  const olderShown = useRef(false);
  const active = (newest ?? []).some((job) => !hasEnded(job.state));
  const poke = usePolling(async (signal) => {
    const page = await listJobs(pageSize, null, signal);
    if (!olderShown.current) cursor.current = page.next_cursor;
    setNewest(page.jobs);
  }, active ? 1000 : 3000, "queue");
  const loadOlder = async () => {
    try {
      const page = await listJobs(pageSize, cursor.current);
      olderShown.current = true;
      cursor.current = page.next_cursor;
      setOlder((before) => [...before, ...page.jobs]);
    } catch (error) {
      notify(words(error), true);
    }
  };
  const jobs = useMemo(() => {
    const known = new Set((newest ?? []).map((job) => job.id));
    return [...(newest ?? []), ...older.filter((job) => !known.has(job.id))];
  }, [newest, older]);
  const forget = (ids: Set<string>) => {
    setNewest((before) => before && before.filter((job) => !ids.has(job.id)));
    setOlder((before) => before.filter((job) => !ids.has(job.id)));
  };
  return {jobs, loaded: newest !== null, complete: cursor.current === null, loadOlder, poke, forget};
}

const thumbnailPeriodMs = 4000;

/** The last picture; while a job runs, a new one every few seconds, for pictures are large. */
function Thumbnail({job}: {job: Job}) {
  const latest = job.frames - 1;
  const [shown, setShown] = useState(latest);
  const since = useRef(Date.now());
  useEffect(() => {
    if (latest === shown) return;
    const wait = hasEnded(job.state) || shown < 0 ? 0 : Math.max(0, since.current + thumbnailPeriodMs - Date.now());
    const timer = setTimeout(() => {
      since.current = Date.now();
      setShown(latest);
    }, wait);
    return () => clearTimeout(timer);
  }, [latest, job.state]);
  return (
    <span class="thumbnail" aria-hidden="true">
      {shown >= 0 && <img src={frameUrl(job.id, shown)} alt="" loading="lazy" decoding="async" width={72} height={42} />}
    </span>
  );
}

function Row(props: {
  job: Job; position: number | undefined; now: number; selected: boolean; current: boolean;
  select: (id: string, on: boolean, range: boolean) => void; reached: (id: string) => void; run: (action: Action, jobs: Job[]) => void;
}) {
  const {job, position, now, selected, current, select, reached, run} = props;
  const took = hasEnded(job.state) && job.started ? duration(secondsBetween(job.started, job.ended)) : "";
  const left = timeLeft(job);
  const last = job.state === "queued" && position ? `#${position} in line` : left ? `${left} left` : took;
  return (
    <li class={`row ${selected ? "selected" : ""} ${current ? "current" : ""}`} data-id={job.id} onFocusIn={() => reached(job.id)}>
      <label class="check">
        <input type="checkbox" checked={selected} aria-label={`Select ${title(job)}`}
          onClick={(event) => select(job.id, event.currentTarget.checked, event.shiftKey)} />
      </label>
      <a class="row-link" href={href("job", job.id)} title={`${job.id}, posted ${localTime(job.created)}`}>
        <Thumbnail job={job} />
        <span class="row-name">
          <span class="name">{title(job)}</span>
          <span class="sub">
            {plural(job.points, "point")}
            {job.priority !== 0 && ` · priority ${number(job.priority)}`}
            {job.attempt > 1 && ` · attempt ${job.attempt}`}
            {job.error && <span class="row-error"> · {job.error}</span>}
          </span>
        </span>
        <State job={job} />
        <span class="row-progress"><Bar job={job} /><span class="sub">{progressText(job)}</span></span>
        <span class="row-left">{last}</span>
        <span class="row-when">{ago(job.created, now)}</span>
      </a>
      <span class="row-actions">
        {actions(job).map((action) => (
          <IconButton key={action} icon={actionIcons[action]} label={`${actionWords[action]} ${title(job)}`} run={() => run(action, [job])} />
        ))}
      </span>
    </li>
  );
}

function Empty({filtered}: {filtered: boolean}) {
  if (filtered)
    return (
      <div class="empty">
        <p>No job fits these filters.</p>
        <button type="button" class="button" onClick={() => setQuery({q: "", state: ""})}>Show all</button>
      </div>
    );
  return (
    <div class="empty">
      <p class="empty-title">No jobs yet</p>
      <p>Start from an example scene, or drop a scene file or a picture that Lather made.</p>
      <a class="button primary" href={href("new")}>New job</a>
    </div>
  );
}

export function Queue() {
  const {query} = route.value;
  const {jobs, loaded, complete, loadOlder, poke, forget} = useJobs();
  const [now, setNow] = useState(Date.now());
  const [current, setCurrent] = useState<string | null>(null);
  const [asked, setAsked] = useState<{action: Action; jobs: Job[]} | null>(null);
  const anchor = useRef<string | null>(null);
  const search = useRef<HTMLInputElement>(null);
  const before = useRef(new Map<string, string>());

  useEffect(() => {
    document.title = "Queue · Lather";
    const timer = setInterval(() => setNow(Date.now()), 15000);
    return () => clearInterval(timer);
  }, []);

  // Ends of jobs are said aloud.
  useEffect(() => {
    for (const job of jobs) {
      const state = before.current.get(job.id);
      if (state && state !== job.state && hasEnded(job.state)) announce(`${title(job)}: ${job.state}.`);
    }
    before.current = new Map(jobs.map((job) => [job.id, job.state]));
  }, [jobs]);

  const text = query.get("q") ?? "";
  const chosenFilter = filters.find(([id]) => id === (query.get("state") ?? "")) ?? filters[0];
  const matching = jobs.filter((job) => `${job.name}\n${job.id}`.toLowerCase().includes(text.toLowerCase()));
  const shown = matching.filter(chosenFilter[2]);
  const place = complete ? positions(jobs) : new Map<string, number>();
  const ids = new Set((query.get("select") ?? "").split(",").filter(Boolean));
  const selected = jobs.filter((job) => ids.has(job.id));
  const setSelected = (chosen: Iterable<string>) => setQuery({select: [...chosen].join(",")});

  const select = (id: string, on: boolean, range: boolean) => {
    const next = new Set(ids);
    const order = shown.map((job) => job.id);
    const from = range && anchor.current !== null ? order.indexOf(anchor.current) : -1;
    const to = order.indexOf(id);
    const several = from >= 0 ? order.slice(Math.min(from, to), Math.max(from, to) + 1) : [id];
    for (const one of several) on ? next.add(one) : next.delete(one);
    anchor.current = id;
    setSelected(next);
  };

  const carryOut = async (action: Action, which: Job[]) => {
    const succeeded = await act(action, which);
    if (action === "delete" && succeeded) {
      const gone = new Set(which.map((job) => job.id));
      setSelected([...ids].filter((id) => !gone.has(id)));
      forget(gone);
    }
    poke();
  };
  const run = (action: Action, which: Job[]) =>
    losesWork(action, which, Date.now()) ? setAsked({action, jobs: which}) : void carryOut(action, which);

  const move = (by: number) => {
    const index = shown.findIndex((job) => job.id === current);
    const next = shown[Math.min(shown.length - 1, Math.max(0, index < 0 ? 0 : index + by))];
    if (!next) return;
    setCurrent(next.id);
    document.querySelector<HTMLElement>(`.row[data-id="${CSS.escape(next.id)}"] .row-link`)?.focus();
  };
  const compare = () => {
    if (selected.length >= 2 && selected.length <= 4) go(href("compare", "", {jobs: selected.map((job) => job.id).join(",")}));
  };
  useKeys("Queue", [
    {keys: ["ArrowDown", "j"], shown: "↓ j", words: "Next job", run: () => move(1)},
    {keys: ["ArrowUp", "k"], shown: "↑ k", words: "Previous job", run: () => move(-1)},
    {keys: ["Enter", "o"], shown: "Enter", words: "Open it", run: () => current && go(href("job", current))},
    {keys: ["x"], words: "Select it", run: () => current && select(current, !ids.has(current), false)},
    {keys: ["X"], shown: "Shift x", words: "Select up to it", run: () => current && select(current, true, true)},
    {keys: ["a"], words: "Select all shown, or none", run: () => setSelected(ids.size > 0 ? [] : shown.map((job) => job.id))},
    {keys: ["c"], words: "Compare the selected", run: compare},
    {keys: ["/"], words: "Filter", run: () => search.current?.focus()},
    {keys: ["Escape"], shown: "Esc", words: "Select none", run: () => setSelected([])},
  ]);

  const possible = (["pause", "resume", "retry", "cancel", "delete"] as Action[])
    .map((action) => [action, selected.filter((job) => actions(job).includes(action))] as const)
    .filter(([, which]) => which.length > 0);

  return (
    <main id="main" class="queue" tabIndex={-1}>
      <h1 class="visually-hidden">Queue</h1>
      <div class="toolbar">
        <label class="search">
          <Icon name="search" />
          <span class="visually-hidden">Filter by name</span>
          <input ref={search} type="search" placeholder="Filter by name" value={text} onInput={(event) => setQuery({q: event.currentTarget.value})}
            onKeyDown={(event) => event.key === "Escape" && event.currentTarget.blur()} />
        </label>
        <div class="chips" role="group" aria-label="State">
          {filters.map(([id, name, fits]) => (
            <button key={id} type="button" class="chip" aria-pressed={chosenFilter[0] === id} onClick={() => setQuery({state: id})}>
              {name} <span class="count">{matching.filter(fits).length}</span>
            </button>
          ))}
        </div>
      </div>
      {selected.length > 0 && (
        <div class="selection" role="region" aria-label="Selected jobs">
          <strong>{selected.length} selected</strong>
          <button type="button" class="button small" disabled={selected.length < 2 || selected.length > 4} onClick={compare}
            title={selected.length > 4 ? "At most four" : undefined}><Icon name="compare" /> Compare</button>
          {possible.map(([action, which]) => (
            <button key={action} type="button" class="button small" onClick={() => run(action, [...which])}>
              <Icon name={actionIcons[action]} /> {actionWords[action]}{which.length < selected.length ? ` ${which.length}` : ""}
            </button>
          ))}
          <span class="spacer" />
          <button type="button" class="button small plain" onClick={() => setSelected([])}>Select none</button>
        </div>
      )}
      {loaded && shown.length > 0 && (
        <div class="row head" aria-hidden="true">
          <span class="check" /><span class="row-link"><span class="thumbnail" /><span>Job</span><span>State</span><span>Progress</span>
            <span class="row-left">Time</span><span class="row-when">Posted</span></span><span class="row-actions" />
        </div>
      )}
      <ul class="rows" role="list" aria-label="Jobs" aria-busy={!loaded}>
        {shown.map((job) => (
          <Row key={job.id} job={job} position={place.get(job.id)} now={now} selected={ids.has(job.id)} current={job.id === current}
            select={select} reached={setCurrent} run={run} />
        ))}
      </ul>
      {loaded && shown.length === 0 && <Empty filtered={jobs.length > 0} />}
      {!complete && <button type="button" class="button older" onClick={() => void loadOlder()}>Older jobs</button>}
      {asked && <Confirm {...confirmation(asked.action, asked.jobs)} run={() => void carryOut(asked.action, asked.jobs)} close={() => setAsked(null)} />}
    </main>
  );
}

// Two to four jobs side by side: one scrubber for all, what differs in their scenes, and where two pictures differ.

import {useSignalEffect} from "@preact/signals";
import {useEffect, useMemo, useRef, useState} from "preact/hooks";
import {ApiError, frameUrl, getJob, getPlan, getReport, isAbort, words} from "../api";
import {duration, number, secondsBetween} from "../format";
import {framesInAll, hasEnded, title} from "../jobs";
import {flatten} from "../json/text";
import {useKeys} from "../keys";
import {usePolling} from "../live";
import {Pictures} from "../media/pictures";
import {Playback, useStopping} from "../playback";
import {href, route, setQuery} from "../router";
import type {Job, Plan, Report} from "../types";
import {Chart, type Line} from "../ui/chart";
import {State, Tabs} from "../ui/parts";
import {Controls} from "./controls";

const letters = ["A", "B", "C", "D"];

/** The job's frame that shows the moment of the playback's frame. */
function frameAt(job: Job, playback: Playback, index: number): number {
  return Math.min(job.frames - 1, Math.round((index * job.frame_rate) / playback.rate.peek()));
}

function Picture({job, letter, playback, pictures}: {job: Job; letter: string; playback: Playback; pictures: Pictures}) {
  const stage = useRef<HTMLDivElement>(null);
  const [words, setWords] = useState("");
  const latest = useRef(job);
  latest.current = job;
  useSignalEffect(() => {
    const index = playback.index.value;
    void playback.count.value;
    const frame = frameAt(latest.current, playback, index);
    if (frame < 0) {
      setWords("No frame yet.");
      return;
    }
    if (playback.playing.value) pictures.prepare(frame, latest.current.frames);
    pictures.get(frame).then((picture) => {
      if (playback.index.peek() !== index || !stage.current) return;
      picture.alt = `${letter}: ${title(latest.current)}, frame ${frame}`;
      stage.current.replaceChildren(picture);
      setWords("");
    }, () => playback.index.peek() === index && setWords(`Frame ${frame} could not be loaded.`));
  });
  return (
    <figure class="compared">
      <figcaption><span class="letter">{letter}</span><a href={href("job", job.id)}>{title(job)}</a><State job={job} /></figcaption>
      <div class="stage"><div class="picture" ref={stage} />{words && <p class="stage-words">{words}</p>}</div>
    </figure>
  );
}

const gains = [1, 4, 16];

/** |A − B| of two pictures, pixel by pixel, brightened by a gain. */
function Difference({jobs, pictures, playback}: {jobs: [Job, Job]; pictures: [Pictures, Pictures]; playback: Playback}) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [gain, setGain] = useState(4);
  const [outcome, setOutcome] = useState("");
  const latest = useRef(jobs);
  latest.current = jobs;
  const draw = async (index: number, by: number) => {
    const frames = latest.current.map((job) => frameAt(job, playback, index));
    if (frames.some((frame) => frame < 0)) return setOutcome("Not both have a frame yet.");
    try {
      const both = await Promise.all(frames.map((frame, i) => pictures[i].get(frame)));
      const target = canvas.current;
      if (!target || playback.index.peek() !== index) return;
      const {naturalWidth: width, naturalHeight: height} = both[0];
      const data = both.map((picture) => {
        const work = document.createElement("canvas");
        work.width = width;
        work.height = height;
        const context = work.getContext("2d", {willReadFrequently: true})!;
        context.drawImage(picture, 0, 0, width, height);
        return context.getImageData(0, 0, width, height);
      });
      const [a, b] = data.map((one) => one.data);
      const drawn = new ImageData(width, height);
      let sum = 0;
      let differ = 0;
      for (let i = 0; i < a.length; i += 4) {
        let most = 0;
        for (let c = 0; c < 3; ++c) {
          const difference = Math.abs(a[i + c] - b[i + c]);
          sum += difference;
          most = Math.max(most, difference);
          drawn.data[i + c] = Math.min(255, by * difference);
        }
        drawn.data[i + 3] = 255;
        if (most > 8) ++differ;
      }
      target.width = width;
      target.height = height;
      target.getContext("2d")!.putImageData(drawn, 0, 0);
      const pixels = width * height;
      const scaled = both[0].naturalWidth !== both[1].naturalWidth || both[0].naturalHeight !== both[1].naturalHeight;
      setOutcome(`${number((100 * differ) / pixels)} % of the pixels differ, by ${number(sum / (3 * pixels))} of 255 in the mean of all` +
        (scaled ? "; the second is scaled to the first’s size" : ""));
    } catch {
      if (playback.index.peek() === index) setOutcome("A picture could not be loaded.");
    }
  };
  useSignalEffect(() => {
    void playback.count.value;
    void draw(playback.index.value, gain);
  });
  useEffect(() => void draw(playback.index.peek(), gain), [gain]);
  return (
    <figure class="compared">
      <figcaption>
        <span class="letter">{letters[0]} − {letters[1]}</span>
        <label class="gain">Gain <select value={gain} onChange={(event) => setGain(Number(event.currentTarget.value))}>
          {gains.map((one) => <option key={one} value={one}>{one}×</option>)}
        </select></label>
      </figcaption>
      <div class="stage dark"><canvas ref={canvas} role="img" aria-label="Difference of the first two pictures" /></div>
      <p class="compared-words" role="status">{outcome}</p>
    </figure>
  );
}

function SceneDifference({jobs, plans}: {jobs: Job[]; plans: Map<string, Plan>}) {
  const rows = useMemo(() => {
    const flat = jobs.map((job) => (plans.has(job.id) ? flatten(plans.get(job.id)!.scene) : null));
    if (flat.some((one) => one === null)) return null;
    const pointers = new Set(flat.flatMap((one) => [...one!.keys()]));
    return [...pointers].map((pointer) => ({pointer, values: flat.map((one) => one!.get(pointer))}))
      .filter(({values}) => values.some((value) => value !== values[0]));
  }, [jobs.map((job) => job.id).join(), plans]);
  if (!rows) return <p class="note">Loading the scenes …</p>;
  if (rows.length === 0) return <p class="note">The scenes are the same.</p>;
  return (
    <div class="scrolling" tabIndex={0} role="region" aria-label="What differs in the scenes">
      <table class="grid difference">
        <thead><tr><th scope="col">Field</th>{jobs.map((job, i) => <th key={job.id} scope="col"><span class="letter">{letters[i]}</span></th>)}</tr></thead>
        <tbody>
          {rows.map(({pointer, values}) => (
            <tr key={pointer}><th scope="row"><code>{pointer}</code></th>{values.map((value, i) => <td key={i}>{value === undefined ? <span class="quiet">–</span> : <code>{value}</code>}</td>)}</tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Numbers({jobs, plans, reports}: {jobs: Job[]; plans: Map<string, Plan>; reports: Map<string, Report>}) {
  const rows: [string, (job: Job, plan?: Plan, report?: Report) => string][] = [
    ["Points", (job) => number(job.points)],
    ["Steps", (_, plan, report) => number(report?.steps ?? plan?.steps)],
    ["Time step (s)", (_, plan, report) => number(report?.time_step?.largest ?? plan?.time_step)],
    ["Took", (job) => (job.started && job.ended ? duration(secondsBetween(job.started, job.ended)) : "–")],
    ["Time in steps", (_, __, report) => duration(report?.wall_seconds) || "–"],
    ["Time in pictures", (_, __, report) => duration(report?.render_seconds) || "–"],
    ["Point-steps a second", (_, __, report) => number(report?.point_steps_per_second)],
  ];
  return (
    <div class="scrolling" tabIndex={0} role="region" aria-label="Numbers of the jobs">
      <table class="grid">
        <thead><tr><th scope="col" />{jobs.map((job, i) => <th key={job.id} scope="col" class="number"><span class="letter">{letters[i]}</span></th>)}</tr></thead>
        <tbody>
          {rows.map(([name, value]) => (
            <tr key={name}><th scope="row">{name}</th>{jobs.map((job) => <td key={job.id} class="number">{value(job, plans.get(job.id), reports.get(job.id))}</td>)}</tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** One quantity of all jobs in a chart, over the moments of all. */
function Measured({jobs, reports, playback}: {jobs: Job[]; reports: Map<string, Report>; playback: Playback}) {
  const charts = useMemo(() => {
    const all = jobs.flatMap((job, i) => (reports.has(job.id) ? [{letter: letters[i], frames: reports.get(job.id)!.frames ?? []}] : []));
    const x = [...new Set(all.flatMap(({frames}) => frames.map((frame) => frame.time)))].sort((a, b) => a - b);
    const at = new Map(x.map((time, i) => [time, i]));
    const chart = (name: string, unit: string, pick: (frame: Report["frames"][0]) => number | undefined) => {
      const lines: Line[] = all.map(({letter, frames}) => {
        const values: (number | null)[] = x.map(() => null);
        for (const frame of frames) values[at.get(frame.time)!] = pick(frame) ?? null;
        return {name: letter, values};
      });
      return {title: name, unit, lines};
    };
    if (x.length < 2) return [];
    return [
      chart("Largest speed", "m/s", (frame) => frame.max_speed),
      chart("Kinetic energy", "J", (frame) => frame.energy?.kinetic),
      chart("Points", "", (frame) => frame.points),
    ].map((one) => ({...one, x}));
  }, [jobs.map((job) => job.id).join(), reports]);
  if (charts.length === 0) return <p class="note">Reports are written when jobs end.</p>;
  return <div class="charts">{charts.map((one) => <Chart key={one.title} {...one} pick={(time) => playback.choose(time * playback.rate.value)} />)}</div>;
}

export function Compare() {
  const {query} = route.value;
  const wanted = [...new Set((query.get("jobs") ?? "").split(",").filter(Boolean))].slice(0, 4);
  const key = wanted.join();
  const [jobs, setJobs] = useState<Job[]>([]);
  const [problem, setProblem] = useState("");
  const [plans, setPlans] = useState(new Map<string, Plan>());
  const [reports, setReports] = useState(new Map<string, Report>());
  const playback = useMemo(() => new Playback(), [key]);
  const pictures = useMemo(() => wanted.map((id) => new Pictures((index) => frameUrl(id, index))), [key]);
  const tab = query.get("tab") ?? "scene";
  const difference = query.get("mode") === "difference";
  useStopping(playback);

  const allEnded = jobs.length > 0 && jobs.every((job) => hasEnded(job.state));
  usePolling(async (signal) => {
    const answers = await Promise.all(wanted.map((id) => getJob(id, signal).catch((error) => {
      if (error instanceof ApiError) return null;
      throw error;
    })));
    const found = answers.filter((job): job is Job => job !== null);
    setJobs(found);
    setProblem(found.length < wanted.length ? "A job of this comparison is not there (any more)." : "");
  }, allEnded ? 5000 : 1000, key);

  const known = jobs.map((job) => job.id).join();
  const endedOnes = jobs.filter((job) => hasEnded(job.state)).map((job) => job.id).join();
  useEffect(() => {
    const stop = new AbortController();
    const all = async <T,>(ids: string, get: (id: string, signal: AbortSignal) => Promise<T>, set: (found: Map<string, T>) => void) => {
      const found = new Map<string, T>();
      await Promise.all(ids.split(",").filter(Boolean).map(async (id) => {
        try {
          found.set(id, await get(id, stop.signal));
        } catch (error) {
          if (!isAbort(error) && !(error instanceof ApiError)) console.error(words(error));
        }
      }));
      if (!stop.signal.aborted) set(found);
    };
    void all(known, getPlan, setPlans);
    void all(endedOnes, getReport, setReports);
    return () => stop.abort();
  }, [known, endedOnes]);

  // Moments are those of the job with most frames a second; there are as many as the longest has.
  useEffect(() => {
    if (jobs.length === 0) return;
    const rate = Math.max(...jobs.map((job) => job.frame_rate));
    const frames = (count: (job: Job) => number) => Math.max(...jobs.map((job) => (count(job) > 0 ? Math.round(((count(job) - 1) * rate) / job.frame_rate) + 1 : 0)));
    playback.update(frames((job) => job.frames), frames(framesInAll), rate);
  }, [jobs, playback]);
  useEffect(() => {
    playback.ready = (index) => Promise.all(jobs.map((job) => {
      const frame = frameAt(job, playback, index);
      return frame < 0 ? null : pictures[wanted.indexOf(job.id)].get(frame);
    }));
  }, [jobs, playback]);
  useEffect(() => {
    const frame = Number(query.get("frame") ?? NaN);
    if (Number.isInteger(frame) && frame >= 0) playback.chosen.value = frame;
    document.title = "Compare · Lather";
  }, [playback]);
  const chosen = playback.chosen.value;
  const playing = playback.playing.value;
  useEffect(() => {
    if (playing) return;
    const timer = setTimeout(() => {
      if (route.value.view === "compare") setQuery({frame: chosen});
    }, 250);
    return () => clearTimeout(timer);
  }, [chosen, playing]);

  useKeys("Compare", [
    ...playback.keys(),
    {keys: ["d"], words: "Difference of the pictures, or side by side", run: () => setQuery({mode: difference ? "" : "difference"})},
  ]);

  if (wanted.length < 2)
    return (
      <main id="main" class="compare" tabIndex={-1}>
        <h1 class="visually-hidden">Compare</h1>
        <div class="empty"><p class="empty-title">Nothing to compare yet</p><p>Select two to four jobs in the queue, then choose Compare.</p>
          <a class="button" href={href("jobs")}>To the queue</a></div>
      </main>
    );
  return (
    <main id="main" class="compare" tabIndex={-1}>
      <header class="title">
        <h1>Compare</h1>
        <span class="title-actions">
          <span class="segmented" role="group" aria-label="Show">
            <button type="button" aria-pressed={!difference} onClick={() => setQuery({mode: ""})}>Side by side</button>
            <button type="button" aria-pressed={difference} onClick={() => setQuery({mode: "difference"})}>Difference</button>
          </span>
        </span>
      </header>
      {problem && <p class="callout warn">{problem}</p>}
      <div class={`compared-all of-${jobs.length + (difference ? 1 : 0)}`}>
        {jobs.map((job, i) => <Picture key={job.id} job={job} letter={letters[i]} playback={playback} pictures={pictures[wanted.indexOf(job.id)]} />)}
        {difference && jobs.length >= 2 && (
          <Difference key={known} jobs={[jobs[0], jobs[1]]} playback={playback} pictures={[pictures[wanted.indexOf(jobs[0].id)], pictures[wanted.indexOf(jobs[1].id)]]} />
        )}
      </div>
      <Controls playback={playback} live={!allEnded} />
      <Tabs label="About these jobs" chosen={tab} choose={(name) => setQuery({tab: name})}
        tabs={[["scene", "Differences of the scenes"], ["numbers", "Numbers"], ["charts", "Charts"]]}>
        {tab === "scene" && <SceneDifference jobs={jobs} plans={plans} />}
        {tab === "numbers" && <Numbers jobs={jobs} plans={plans} reports={reports} />}
        {tab === "charts" && <Measured jobs={jobs} reports={reports} playback={playback} />}
      </Tabs>
    </main>
  );
}

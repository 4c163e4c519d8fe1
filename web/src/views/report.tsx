// What a run measured, as charts over the scene's time and a few numbers.

import {computed} from "@preact/signals";
import {useEffect, useMemo, useState} from "preact/hooks";
import {ApiError, getReport, isAbort, words} from "../api";
import {duration, number, spaced} from "../format";
import {hasEnded} from "../jobs";
import type {Playback} from "../playback";
import {isObject, type Job, type Report} from "../types";
import {Chart, type Line} from "../ui/chart";
import {Facts} from "../ui/parts";

function Stages({report}: {report: Report}) {
  const stages = [...(report.stages ?? [])].sort((a, b) => b.seconds - a.seconds);
  const all = stages.reduce((sum, stage) => sum + stage.seconds, 0);
  if (!(all > 0)) return null;
  return (
    <figure class="chart stages">
      <figcaption>Step time by stage <span class="unit">{duration(all)} in all</span></figcaption>
      <table>
        <tbody>
          {stages.map((stage) => (
            <tr key={stage.name}>
              <th scope="row">{spaced(stage.name)}</th>
              <td class="meter-cell"><meter min={0} max={1} value={stage.seconds / stages[0].seconds} aria-hidden="true" /></td>
              <td class="number">{number(stage.seconds)} s</td>
              <td class="number quiet">{Math.round((100 * stage.seconds) / all)} %</td>
            </tr>
          ))}
        </tbody>
      </table>
    </figure>
  );
}

const energyNames: Record<string, string> = {elastic_volume: "elastic, volume", elastic_shear: "elastic, shear"};

interface ChartData {
  title: string;
  unit: string;
  lines: Line[];
}

/** The charts that the report has numbers for; constant ones are left out, but for those that should be constant. */
function chartsOf(report: Report): ChartData[] {
  const {frames} = report;
  const column = (pick: (frame: Report["frames"][0]) => unknown) =>
    frames.map((frame) => {
      const value = pick(frame);
      return typeof value === "number" && Number.isFinite(value) ? value : null;
    });
  const varies = (values: (number | null)[]) => values.some((value) => value !== null && value !== values[0]);
  const charts: ChartData[] = [];
  const add = (title: string, unit: string, lines: Line[], always = false) => {
    const good = lines.filter((line) => line.values.some((value) => value !== null));
    if (good.length > 0 && (always || good.some((line) => varies(line.values)))) charts.push({title, unit, lines: good});
  };
  const parts = Object.keys(frames[0].energy ?? {});
  const total = column((frame) => Object.values(frame.energy ?? {}).reduce((sum, part) => sum + part, 0));
  add("Energy", "J", [
    {name: "total", values: total},
    ...parts.map((part) => ({name: energyNames[part] ?? spaced(part), values: column((frame) => frame.energy[part])})),
  ]);
  add("Largest speed", "m/s", [{name: "largest speed", values: column((frame) => frame.max_speed)}]);
  // What came in or left is no error.
  const mass = (frame: Report["frames"][0]) => frame.mass - (frame.mass_emitted ?? 0) + (frame.mass_left ?? 0) +
    Number((isObject(frame.subgrid_removal) && frame.subgrid_removal.mass_removed) || 0);
  const first = mass(frames[0]);
  if (first > 0) add("Mass error", "relative", [{name: "mass error", values: column((frame) => (mass(frame) - first) / first)}], true);
  add("Volume ratio J", "", [
    {name: "least", values: column((frame) => frame.volume_ratio?.min)},
    {name: "greatest", values: column((frame) => frame.volume_ratio?.max)},
  ]);
  add("Density inside the material", "of that at rest", [
    {name: "mean", values: column((frame) => frame.density?.interior_nodes && frame.density.mean)},
    {name: "least", values: column((frame) => frame.density?.interior_nodes && frame.density.min)},
    {name: "greatest", values: column((frame) => frame.density?.interior_nodes && frame.density.max)},
  ]);
  add("Points", "", [{name: "points", values: column((frame) => frame.points)}]);
  add("Torn", "share of points", [{name: "torn", values: column((frame) => frame.weak_fraction)}]);
  add("Steps to the frame", "", [{name: "steps", values: column((frame) =>
    typeof frame.step === "number" && frame.frame > 0 ? frame.step - Number(frames[frame.frame - 1]?.step ?? NaN) : null)}]);
  return charts;
}

interface Probe {
  name: string;
  x: number[];
  charts: ChartData[];
}

interface ReportedProbe {
  name: string;
  columns: {quantity: string; unit: string}[];  // the first is time
  samples: number[][];
}

/** A chart for each unit that a probe has. */
function probesOf(report: Report): Probe[] {
  return ((report.probes ?? []) as ReportedProbe[]).filter((probe) => probe.samples?.length > 1).map((probe) => {
    const byUnit = new Map<string, Line[]>();
    probe.columns.forEach(({quantity, unit}, i) => {
      if (i === 0) return;
      const lines = byUnit.get(unit) ?? [];
      byUnit.set(unit, lines);
      lines.push({name: spaced(quantity), values: probe.samples.map((row) => (Number.isFinite(row[i]) ? row[i] : null))});
    });
    const charts = [...byUnit].map(([unit, lines]) => ({title: `${probe.name}: ${lines.map((line) => line.name).join(", ")}`, unit, lines}));
    return {name: probe.name, x: probe.samples.map((row) => row[0]), charts};
  });
}

export function ReportView({job, playback}: {job: Job; playback: Playback}) {
  const [report, setReport] = useState<Report | null>(null);
  const [problem, setProblem] = useState("");
  const ended = hasEnded(job.state);
  useEffect(() => {
    if (!ended) return;
    const stop = new AbortController();
    getReport(job.id, stop.signal).then((answer) => {
      setReport(answer);
      setProblem("");
    }, (error) => {
      if (isAbort(error)) return;
      setProblem(error instanceof ApiError && error.status === 404 ? "This job ended before it could measure anything." : words(error));
    });
    return () => stop.abort();
  }, [job.id, job.state, job.attempt]);

  const charts = useMemo(() => (report && (report.frames ?? []).length > 1 ? chartsOf(report) : []), [report]);
  const probes = useMemo(() => (report ? probesOf(report) : []), [report]);
  const x = useMemo(() => (report?.frames ?? []).map((frame) => frame.time), [report]);
  const at = useMemo(() => computed(() => playback.index.value / playback.rate.value), [playback]);
  const pick = (time: number) => {
    playback.playing.value = false;
    playback.choose(time * playback.rate.value);
  };

  if (!ended) return <p class="note">The report is written when the job ends.</p>;
  if (problem) return <p class="note">{problem}</p>;
  if (!report) return <p class="note" aria-busy="true">Loading the report …</p>;
  const {smallest, largest} = report.time_step ?? {};
  const same = number(smallest) === number(largest);
  return (
    <div class="report">
      {(report.warnings ?? []).length > 0 && (
        <div class="callout warn"><ul>{report.warnings!.map((text) => <li key={text}>{text}</li>)}</ul></div>
      )}
      <Facts entries={[
        ["Steps", number(report.steps)],
        ["Time step", report.steps ? (same ? `${number(largest)} s` : `${number(smallest)} to ${number(largest)} s`) : ""],
        ["Largest CFL number", number(report.largest_cfl)],
        ["Simulated", `${number(report.simulated_time)} s`],
        ["Time in steps", duration(report.wall_seconds)],
        ["Time in pictures", duration(report.render_seconds)],
        ["Point-steps a second", number(report.point_steps_per_second)],
        ["Threads, kernels", `${report.threads}, ${report.kernel_level}`],
        ["Drawn with", report.render_backend?.replace(/ \(.*/, "") ?? ""],
      ]} />
      <div class="charts">
        <Stages report={report} />
        {charts.map((chart) => <Chart key={chart.title} {...chart} x={x} at={at} pick={pick} />)}
        {probes.flatMap((probe) => probe.charts.map((chart) => (
          <Chart key={chart.title} {...chart} x={probe.x} at={at} pick={pick} />
        )))}
      </div>
      {charts.length > 0 && <p class="hint">A click on a chart shows the frame of that moment.</p>}
    </div>
  );
}

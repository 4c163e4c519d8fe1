// What a finished (or failed) run measured, in one screen.

import {duration, h, number} from "./dom.js";

const facts = (entries) =>
  h("dl", {class: "facts-list"}, entries.filter(([, text]) => text !== "").map(([name, text]) =>
    h("div", {}, h("dt", {}, name), h("dd", {}, text))));

function measured(report) {
  const frames = report.frames ?? [];
  if (frames.length < 2) return null;
  const first = frames[0];
  const last = frames[frames.length - 1];
  const energy = (frame) => Object.values(frame.energy).reduce((sum, part) => sum + part, 0);
  return h("section", {}, h("h3", {}, "Measured"), facts([
    ["mass", `${number(last.mass)} kg (change ${number(last.mass - first.mass)})`],
    ["energy, first to last frame", `${number(energy(first))} to ${number(energy(last))} J`],
    ["largest speed", `${number(Math.max(...frames.map((frame) => frame.max_speed)))} m/s`],
    ["volume ratio J, last frame", `${number(last.volume_ratio.min)} to ${number(last.volume_ratio.max)}`],
    ["torn, last frame", last.weak_fraction ? `${number(100 * last.weak_fraction)} % of points` : ""],
    ["density within 5 %, last frame",
      last.density.interior_nodes ? `${number(100 * last.density.within_5_percent)} % of interior nodes` : "–"],
    ["points emitted", last.points_emitted ? number(last.points_emitted) : ""],
    ["points that left", last.points_left ? number(last.points_left) : ""],
  ]));
}

function stages(report) {
  const list = report.stages ?? [];
  const total = list.reduce((sum, stage) => sum + stage.seconds, 0);
  if (!(total > 0)) return null;
  return h(
    "section", {}, h("h3", {}, "Time by stage"),
    h("table", {class: "stages"}, h("tbody", {}, list.map((stage) => h(
      "tr", {}, h("th", {scope: "row"}, stage.name.replaceAll("_", " ")),
      h("td", {}, h("meter", {min: 0, max: 1, value: stage.seconds / total, "aria-hidden": "true"})),
      h("td", {class: "number"}, `${number(stage.seconds)} s`),
      h("td", {class: "number quiet"}, `${Math.round((100 * stage.seconds) / total)} %`))))));
}

/** The report as an element. */
export function reportElement(report) {
  const {smallest, largest} = report.time_step ?? {};
  const steps = number(smallest) === number(largest) ? `${number(largest)} s` : `${number(smallest)} to ${number(largest)} s`;
  const run = h("section", {}, h("h3", {}, "Run"), facts([
    ["steps", number(report.steps)],
    ["time step", report.steps ? steps : ""],
    ["largest CFL number", number(report.largest_cfl)],
    ["simulated", `${number(report.simulated_time)} s`],
    ["time in steps", duration(report.wall_seconds)],
    ["time in pictures", duration(report.render_seconds)],
    ["point-steps per second", number(report.point_steps_per_second)],
    ["threads, kernels", `${report.threads}, ${report.kernel_level}`],
    ["drawn with", report.render_backend ?? ""],
  ]));
  const warnings = (report.warnings ?? []).length
    ? h("section", {}, h("h3", {}, "Warnings"), h("ul", {}, report.warnings.map((text) => h("li", {}, text))))
    : null;
  return h("div", {class: "report"}, ...[run, measured(report), stages(report), warnings].filter(Boolean));
}

// The queue: every job in one line, newest first, kept in place while numbers change.

import {frameUrl, listJobs} from "./api.js";
import {duration, h, localTime, setText} from "./dom.js";

/** "frame 12 of 41 · 1 min 3 s left", for any state. */
export function progressText(job) {
  const progress = job.progress ?? {};
  if (job.state === "running") {
    const left = duration(progress.eta_seconds ?? NaN);
    return `frame ${job.frames ?? 0} of ${progress.frames ?? "?"}${left ? ` · ${left} left` : ""}`;
  }
  if (job.state === "queued") return "waiting for a runner";
  return `${job.frames ?? 0} of ${progress.frames ?? "?"} frames`;
}

export function fraction(job) {
  return job.state === "succeeded" ? 1 : Math.min(1, Math.max(0, job.progress?.fraction ?? 0));
}

class Row {
  constructor(job) {
    this.shown = -1;
    this.thumbnail = h("img", {alt: "", loading: "lazy", decoding: "async", hidden: true});
    this.name = h("span", {class: "name"});
    this.state = h("span", {});
    this.bar = h("progress", {max: 1, "aria-label": "progress"});
    this.text = h("span", {class: "quiet"});
    this.link = h(
      "a", {href: `#job=${encodeURIComponent(job.id)}`, title: job.id},
      h("span", {class: "thumbnail"}, this.thumbnail),
      h("span", {class: "facts"}, h("span", {class: "line"}, this.name, this.state), this.bar, this.text));
    this.element = h("li", {}, this.link);
    this.update(job);
  }

  update(job) {
    this.job = job;
    setText(this.name, job.name || job.id);
    setText(this.state, job.state);
    this.state.className = `state ${job.state}`;
    this.bar.value = fraction(job);
    this.bar.className = job.state;
    setText(this.text, progressText(job));
    const when = localTime(job.created ?? job.created_at ?? "");
    this.link.title = when ? `${job.id}, posted ${when}` : job.id;
    const latest = (job.frames ?? 0) - 1;
    if (latest >= 0 && latest !== this.shown) {
      this.thumbnail.src = frameUrl(job.id, latest);
      this.thumbnail.hidden = false;
      this.shown = latest;
    }
  }

  select(selected) {
    if (selected) this.link.setAttribute("aria-current", "page");
    else this.link.removeAttribute("aria-current");
  }
}

export class QueueView {
  constructor(element) {
    this.rows = new Map();
    this.older = [];
    this.selected = null;
    this.list = h("ol", {});
    this.empty = h("p", {class: "quiet pad", hidden: true}, "No jobs yet. Post a scene to begin.");
    this.more = h("button", {class: "button", hidden: true, onclick: () => this.loadOlder()}, "Older jobs");
    element.replaceChildren(this.list, this.empty, this.more);
  }

  newest() {
    return this.rows.keys().next().value ?? null;
  }

  async refresh() {
    const page = await listJobs();
    if (this.older.length === 0) this.cursor = page.next_cursor ?? null;
    this.show(page.jobs);
  }

  async loadOlder() {
    const page = await listJobs(this.cursor);
    this.older.push(...page.jobs);
    this.cursor = page.next_cursor ?? null;
    await this.refresh();
  }

  show(newest) {
    const known = new Set(newest.map((job) => job.id));
    const jobs = [...newest, ...this.older.filter((job) => !known.has(job.id))];
    const rows = new Map();
    for (const job of jobs) {
      const row = this.rows.get(job.id) ?? new Row(job);
      row.update(job);
      rows.set(job.id, row);
    }
    const order = [...rows.values()].map((row) => row.element);
    if (order.length !== this.list.children.length || order.some((item, i) => item !== this.list.children[i]))
      this.list.replaceChildren(...order);
    this.rows = rows;
    this.empty.hidden = rows.size > 0;
    this.more.hidden = !this.cursor;
    this.select(this.selected);
  }

  select(id) {
    this.selected = id;
    for (const [key, row] of this.rows) row.select(key === id);
  }
}

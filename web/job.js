// One job: its state and progress, its frames, its report and what can be downloaded.

import {cancelJob, deleteJob, getJob, getReport, jobUrl} from "./api.js";
import {duration, h, localTime, number, setText} from "./dom.js";
import {fraction, progressText} from "./queue.js";
import {reportElement} from "./report.js";
import {Viewer} from "./viewer.js";

const ended = (state) => ["succeeded", "failed", "cancelled"].includes(state);

export class JobView {
  constructor(id, frame) {
    this.id = id;
    this.title = "";
    this.viewer = new Viewer(id, "", (index) => this.remember(index));
    if (frame !== null) this.viewer.seek(frame);

    this.heading = h("h2", {}, id);
    this.state = h("span", {class: "state", role: "status"});
    this.cancel = h("button", {class: "button", hidden: true, onclick: () => this.act(() => this.cancelNow())}, "Cancel");
    this.remove = h("button", {class: "button", hidden: true, onclick: () => this.act(() => this.removeNow())}, "Delete");
    this.bar = h("progress", {max: 1, "aria-label": "progress"});
    this.text = h("p", {class: "quiet"});
    this.error = h("p", {class: "failure", role: "alert", hidden: true});
    const download = (path, text) => h("a", {class: "button", href: jobUrl(id, path), download: true}, text);
    this.zip = download("/frames.zip", "frames.zip");
    this.reportLink = h("a", {class: "button", href: jobUrl(id, "/report"), download: "report.json"}, "report.json");
    this.log = h("a", {class: "button", href: jobUrl(id, "/log"), target: "_blank"}, "log");
    this.report = h("div", {});

    this.element = h(
      "article", {class: "job"},
      h("header", {class: "title"}, this.heading, this.state, h("span", {class: "spacer"}), this.cancel, this.remove),
      this.bar, this.text, this.error, this.viewer.element,
      h("p", {class: "downloads"}, this.zip, this.reportLink, this.log), this.report);
  }

  /** Brings everything up to date; an ended job whose report is shown is asked no more. */
  async refresh() {
    if (this.complete) return;
    let job;
    try {
      job = await getJob(this.id);
    } catch (error) {
      if (error.status !== 404) throw error;
      this.fail("There is no such job (any more).");
      this.complete = true;
      return;
    }
    this.show(job);
    if (!ended(job.state)) return;
    try {
      this.report.replaceChildren(reportElement(await getReport(this.id)));
    } catch (error) {
      if (!error.status) throw error;
    }
    this.complete = true;
  }

  show(job) {
    this.title = job.name;
    this.viewer.name = job.name;
    setText(this.heading, job.name || job.id);
    setText(this.state, job.state);
    this.state.className = `state ${job.state}`;
    this.bar.value = fraction(job);
    this.bar.className = job.state;
    setText(this.text, this.details(job));
    this.cancel.hidden = !["queued", "running"].includes(job.state);
    this.remove.hidden = !ended(job.state);
    this.zip.hidden = !job.frames;
    this.reportLink.hidden = !ended(job.state);
    this.fail(job.error ?? "");
    this.viewer.update(job.frames ?? 0, job.frame_rate ?? 30);
  }

  details(job) {
    const progress = job.progress ?? {};
    const parts = [progressText(job)];
    if (progress.time > 0 && job.state !== "succeeded") parts.push(`${number(progress.time)} s simulated`);
    if (progress.step > 0 && job.state !== "succeeded") parts.push(`step ${number(progress.step)}`);
    if (job.state === "running" && progress.seconds_per_frame > 0)
      parts.push(`${number(progress.seconds_per_frame)} s per frame`);
    if (job.points) parts.push(`${number(job.points)} points`);
    if (job.started && job.ended) parts.push(`took ${duration((new Date(job.ended) - new Date(job.started)) / 1000)}`);
    else if (job.created) parts.push(`posted ${localTime(job.created)}`);
    return parts.join(" · ");
  }

  fail(text) {
    setText(this.error, text);
    this.error.hidden = text === "";
  }

  remember(frame) {
    history.replaceState(null, "", `#job=${encodeURIComponent(this.id)}&frame=${frame}`);
  }

  async act(action) {
    try {
      await action();
    } catch (error) {
      this.fail(error.message);
    }
  }

  async cancelNow() {
    await cancelJob(this.id);
    await this.refresh();
  }

  async removeNow() {
    if (!window.confirm(`Delete “${this.title}” with all its frames?`)) return;
    await deleteJob(this.id);
    location.hash = "";
  }

  seek(frame) {
    this.viewer.seek(frame);
  }

  key(event) {
    this.viewer.key(event);
  }

  close() {
    this.viewer.close();
  }
}

// What can be said of jobs and done with them, from what the API says of each.

import {actOnJob, deleteJob, words} from "./api";
import {duration, number, plural} from "./format";
import {announce, notify} from "./live";
import type {Job, JobState} from "./types";

export const hasEnded = (state: JobState) => ["succeeded", "failed", "cancelled"].includes(state);

export const stateWords: Record<string, string> = {
  queued: "Queued", running: "Running", pausing: "Pausing", paused: "Paused", cancelling: "Cancelling",
  cancelled: "Cancelled", succeeded: "Done", failed: "Failed",
};

export const title = (job: Pick<Job, "id" | "name">) => job.name || job.id;

export const fraction = (job: Job) =>
  job.state === "succeeded" ? 1 : Math.min(1, Math.max(0, job.progress?.fraction ?? 0));

/** Frames that there will be. */
export const framesInAll = (job: Job) => Math.max(job.frames, job.progress?.frames ?? 0);

/** "frame 12 of 41", for any state. */
export function progressText(job: Job): string {
  const all = job.progress?.frames || "?";
  if (job.state === "queued" && job.frames === 0) return "waiting";
  if (job.state === "succeeded") return plural(job.frames, "frame");
  return `${job.frames} of ${typeof all === "number" ? number(all) : all} frames`;
}

export const timeLeft = (job: Job) => (job.state === "running" && job.progress?.eta_seconds != null ? duration(Math.ceil(job.progress.eta_seconds)) : "");

/** Place in the queue from 1, by priority and age, of each queued job; only where all of them are known. */
export function positions(jobs: Job[]): Map<string, number> {
  const waiting = jobs.filter((job) => job.state === "queued");
  waiting.sort((a, b) => b.priority - a.priority || Date.parse(a.created ?? "") - Date.parse(b.created ?? ""));
  return new Map(waiting.map((job, i) => [job.id, i + 1]));
}

export type Action = "cancel" | "pause" | "resume" | "retry" | "delete";
export const actionWords: Record<Action, string> = {
  cancel: "Cancel", pause: "Pause", resume: "Resume", retry: "Retry", delete: "Delete",
};
export const actionIcons: Record<Action, string> = {
  cancel: "cancel", pause: "pause", resume: "play", retry: "retry", delete: "remove",
};
const done: Record<Action, string> = {
  cancel: "cancelled", pause: "paused", resume: "resumed", retry: "queued again", delete: "deleted",
};

/** What can be done with the job now. A server that cannot pause has no such link. */
export function actions(job: Job): Action[] {
  const offered = (action: Action, ...states: JobState[]) => states.includes(job.state) && action in job.links;
  const list: Action[] = [];
  if (offered("pause", "queued", "running")) list.push("pause");
  if (offered("resume", "paused")) list.push("resume");
  if (offered("retry", "failed", "cancelled")) list.push("retry");
  if (offered("cancel", "queued", "running", "pausing", "paused")) list.push("cancel");
  if (hasEnded(job.state)) list.push("delete");
  return list;
}

/** Tries it with each job and says how it went; whether it went well with all. */
export async function act(action: Action, jobs: Job[]): Promise<boolean> {
  const outcomes = await Promise.all(jobs.map(async (job) => {
    try {
      await (action === "delete" ? deleteJob(job.id) : actOnJob(job, action));
      return null;
    } catch (error) {
      return `${title(job)}: ${words(error)}`;
    }
  }));
  const failures = outcomes.filter((outcome) => outcome !== null);
  for (const failure of failures.slice(0, 3)) notify(failure!, true);
  if (failures.length > 3) notify(`${failures.length - 3} more could not be ${done[action]}.`, true);
  const succeeded = jobs.length - failures.length;
  if (succeeded > 0) announce(succeeded === 1 ? `Job ${done[action]}.` : `${succeeded} jobs ${done[action]}.`);
  return failures.length === 0;
}

/** Whether a slip of the hand would lose work: then the user is asked first. */
export function losesWork(action: Action, jobs: Job[], now: number): boolean {
  if (action === "delete") return true;
  if (action !== "cancel") return false;
  return jobs.length > 1 || jobs.some((job) => job.started && now - Date.parse(job.started) > 60000);
}

export function confirmation(action: Action, jobs: Job[]) {
  const which = jobs.length === 1 ? `“${title(jobs[0])}”` : `${jobs.length} jobs`;
  return action === "delete"
    ? {title: `Delete ${which}?`, words: "Frames, report and log are removed from the server and cannot be brought back.", action: "Delete"}
    : {title: `Cancel ${which}?`, words: "The simulation stops. Frames made so far stay.", action: "Cancel it"};
}

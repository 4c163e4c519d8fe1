// The server's API. All addresses are relative to the page's own, so the page works behind any path prefix.

import type {Job, Json, JsonObject, Plan, Problem, Report, SceneEntry, Schema} from "./types";

const base = new URL("api/v1/", document.baseURI);
const patienceMs = 20000;

/** What the server answered when it refused, from its problem document (RFC 9457). */
export class ApiError extends Error {
  readonly errors: Problem[];
  readonly plan: Partial<Plan> | null;
  constructor(readonly status: number, problem: Record<string, unknown>) {
    super(String(problem.detail || problem.title || `The server answered ${status}.`));
    this.errors = Array.isArray(problem.errors) ? (problem.errors as Problem[]) : [];
    this.plan = (problem.plan as Partial<Plan>) ?? null;
  }
}

/** The server could not be reached, or did not answer in time. */
export class Unreachable extends Error {
  constructor() {
    super("The server does not answer.");
  }
}

export const isAbort = (error: unknown) => error instanceof DOMException && error.name === "AbortError";
export const words = (error: unknown) => (error instanceof Error ? error.message : String(error));

export const url = (path: string) => new URL(path, base).href;
/** An address from one of the server's `links`, which name paths from the server's own root. */
export const linkUrl = (link: string) => url(link.replace(/^\/api\/v1\//, ""));
const jobPath = (id: string, rest = "") => `jobs/${encodeURIComponent(id)}${rest}`;
export const jobUrl = (id: string, rest: string) => url(jobPath(id, rest));
export const frameUrl = (id: string, index: number) => jobUrl(id, `/frames/${index}.png`);
export const particlesUrl = (id: string, index: number) => jobUrl(id, `/particles/${index}.ply`);

interface Options {
  method?: string;
  body?: Json;
  signal?: AbortSignal;
  headers?: Record<string, string>;
}

async function fetchOr(address: string, {method = "GET", body, signal, headers = {}}: Options): Promise<[Response, string]> {
  const stop = new AbortController();
  const timer = setTimeout(() => stop.abort(), patienceMs);
  const forward = () => stop.abort();
  signal?.addEventListener("abort", forward);
  try {
    const response = await fetch(address, {
      method,
      signal: stop.signal,
      headers: body === undefined ? headers : {"Content-Type": "application/json", ...headers},
      body: body === undefined ? undefined : JSON.stringify(body),
    });
    return [response, await response.text()];
  } catch {
    if (signal?.aborted) throw new DOMException("aborted", "AbortError");
    throw new Unreachable();
  } finally {
    clearTimeout(timer);
    signal?.removeEventListener("abort", forward);
  }
}

/** The answer's text; throws ApiError unless it is a success. */
async function callText(address: string, options: Options = {}): Promise<string> {
  const [response, text] = await fetchOr(address, options);
  if (response.ok) return text;
  let problem: Record<string, unknown> = {};
  try {
    problem = JSON.parse(text);
  } catch {
    // A proxy's page, not the server's document: its status has to do.
  }
  // What a proxy says while the server behind it is away.
  if ([502, 504].includes(response.status)) throw new Unreachable();
  throw new ApiError(response.status, problem);
}

async function call<T>(path: string, options: Options = {}): Promise<T> {
  const text = await callText(url(path), options);
  return (text ? JSON.parse(text) : {}) as T;
}

export interface JobsPage {
  jobs: Job[];
  next_cursor: string | null;
}

export const listJobs = (limit: number, cursor: string | null, signal?: AbortSignal) =>
  call<JobsPage>(`jobs?limit=${limit}${cursor ? `&cursor=${encodeURIComponent(cursor)}` : ""}`, {signal});
export const getJob = (id: string, signal?: AbortSignal) => call<Job>(jobPath(id), {signal});
export const getReport = (id: string, signal?: AbortSignal) => call<Report>(jobPath(id, "/report"), {signal});
export const getPlan = (id: string, signal?: AbortSignal) => call<Plan>(jobPath(id, "/plan"), {signal});
export const getLog = (id: string, signal?: AbortSignal) => callText(jobUrl(id, "/log"), {signal});
export const deleteJob = (id: string) => call<void>(jobPath(id), {method: "DELETE"});
/** cancel, pause, resume, retry, extend, priority: what the job's links offer. */
export const actOnJob = async (job: Job, action: string, body?: JsonObject) => {
  await callText(linkUrl(job.links[action]), {method: "POST", body});
};

export interface Submission {
  scene: JsonObject;
  size?: string;
  priority?: number;
  [more: string]: Json | undefined;
}
/** The same key gives the same job, however often a post is repeated. */
export const postJob = (request: Submission, key: string) =>
  call<Job>("jobs", {method: "POST", body: request as JsonObject, headers: {"Idempotency-Key": key}});
export const postPlan = (request: Submission, signal?: AbortSignal) =>
  call<Plan>("plan", {method: "POST", body: request as JsonObject, signal});
export const listScenes = async (signal?: AbortSignal) =>
  (await call<{scenes: SceneEntry[]}>("scenes", {signal})).scenes ?? [];
export const getSceneText = (name: string, signal?: AbortSignal) =>
  callText(url(`scenes/${encodeURIComponent(name)}`), {signal});
export const getSchema = (signal?: AbortSignal) => call<Schema>("schema", {signal});
export const getHealth = (signal?: AbortSignal) =>
  callText(new URL("healthz", document.baseURI).href, {signal}).then((text) => JSON.parse(text) as {version: string});

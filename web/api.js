// The server's API. All addresses are relative to the page's own, so the page works behind any path prefix.

const base = new URL("api/v1/", document.baseURI);
const patienceMs = 15000;

/** What the server answered when it refused, from its problem document (RFC 9457). */
export class ApiError extends Error {
  constructor(status, problem) {
    super(problem.detail || problem.title || `The server answered ${status}`);
    this.status = status;
    this.errors = Array.isArray(problem.errors) ? problem.errors : [];
  }
}

export const url = (path) => new URL(path, base).href;
const jobPath = (id, rest = "") => `jobs/${encodeURIComponent(id)}${rest}`;
export const jobUrl = (id, rest) => url(jobPath(id, rest));
export const frameUrl = (id, index) => jobUrl(id, `/frames/${index}.png`);

async function call(path, options = {}) {
  const response = await fetch(url(path), {signal: AbortSignal.timeout(patienceMs), ...options});
  const text = await response.text();
  let body = {};
  try {
    body = text ? JSON.parse(text) : {};
  } catch {
    body = {detail: text.slice(0, 200)};
  }
  if (!response.ok) throw new ApiError(response.status, body);
  return body;
}

const post = (path, body) =>
  call(path, {
    method: "POST",
    headers: body ? {"Content-Type": "application/json"} : {},
    body: body ? JSON.stringify(body) : undefined,
  });

export const listJobs = (cursor) => call(cursor ? `jobs?cursor=${encodeURIComponent(cursor)}` : "jobs");
export const getJob = (id) => call(jobPath(id));
export const getReport = (id) => call(jobPath(id, "/report"));
export const cancelJob = (id) => post(jobPath(id, "/cancel"));
export const deleteJob = (id) => call(jobPath(id), {method: "DELETE"});
export const postJob = (request) => post("jobs", request);
export const postPlan = (request) => post("plan", request);
export const listScenes = () => call("scenes");
export const getScene = (name) => call(`scenes/${encodeURIComponent(name)}`);

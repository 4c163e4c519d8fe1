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

/** The answer's text; throws ApiError unless it is a success. */
async function callText(path, options = {}) {
  const response = await fetch(url(path), {signal: AbortSignal.timeout(patienceMs), ...options});
  const text = await response.text();
  if (response.ok) return text;
  let problem = {detail: text.slice(0, 200)};
  try {
    problem = JSON.parse(text);
  } catch {
    // A proxy's page, not the server's document: its beginning has to do.
  }
  throw new ApiError(response.status, problem);
}

async function call(path, options = {}) {
  const text = await callText(path, options);
  return text ? JSON.parse(text) : {};
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
export const getSceneText = (name) => callText(`scenes/${encodeURIComponent(name)}`);

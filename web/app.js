// The page: what the address's hash names is shown in the main column, beside the queue. Polls while it is visible.
//   #             the queue and the newest job
//   #new          a box to post a scene
//   #job=ID&frame=N

import {setText} from "./dom.js";
import {JobView} from "./job.js";
import {QueueView} from "./queue.js";
import {SubmitView} from "./submit.js";

const pollMs = 1000;
const main = document.getElementById("main");
const connection = document.getElementById("connection");

const queue = new QueueView(document.getElementById("queue"));
const submit = new SubmitView((job) => {
  location.hash = `job=${job.id}`;
});
let view = null;

/** Shows what the hash names; without a name, the newest job, or the box when there is none. */
function route() {
  const hash = location.hash.slice(1);
  const parameters = new URLSearchParams(hash);
  const id = parameters.get("job") ?? (hash === "" ? queue.newest() : null);
  const frame = parameters.has("frame") ? Number(parameters.get("frame")) : null;

  if (id === null || id === undefined) {
    if (view !== submit) show(submit);
  } else if (view instanceof JobView && view.id === id) {
    view.seek(frame);
  } else {
    show(new JobView(id, frame));
  }
  queue.select(id);
}

function show(next) {
  view?.close?.();
  view = next;
  main.replaceChildren(view.element);
  document.title = view.title ? `${view.title} · Lather` : "Lather";
}

async function poll() {
  try {
    await queue.refresh();
    if (view === null || (location.hash.length <= 1 && view !== submit)) route();
    await view.refresh?.();
    document.title = view.title ? `${view.title} · Lather` : "Lather";
    setText(connection, "");
  } catch (error) {
    setText(connection, error.status ? error.message : "The server does not answer; trying again each second.");
    if (view === null) route();
  }
}

let timer = null;
let polling = false;
async function tick() {
  clearTimeout(timer);
  if (document.visibilityState !== "visible" || polling) return;
  polling = true;
  await poll();
  polling = false;
  timer = setTimeout(tick, pollMs);
}

window.addEventListener("hashchange", () => {
  route();
  tick();
});
document.addEventListener("visibilitychange", tick);
document.addEventListener("keydown", (event) => view?.key?.(event));
tick();

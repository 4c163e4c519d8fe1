// Where the page is: the address's hash, "#/job/ID?frame=3", so that any address of the page can be kept and shared, under any
// path prefix.

import {signal} from "@preact/signals";

export interface Route {
  view: string;
  id: string;
  query: URLSearchParams;
}

function read(): Route {
  const [path, query = ""] = location.hash.replace(/^#\/?/, "").split("?", 2);
  const [view = "", id = ""] = path.split("/");
  let name = "";
  try {
    name = decodeURIComponent(id);
  } catch {
    // A broken escape names nothing.
  }
  return {view: view || "jobs", id: name, query: new URLSearchParams(query)};
}

export const route = signal<Route>(read());
window.addEventListener("hashchange", () => {
  route.value = read();
});

type Query = Record<string, string | number | null | undefined>;

export function href(view: string, id = "", query: Query = {}): string {
  const parameters = new URLSearchParams();
  for (const [key, value] of Object.entries(query))
    if (value !== null && value !== undefined && value !== "") parameters.set(key, String(value));
  const text = parameters.toString();
  return `#/${view}${id ? `/${encodeURIComponent(id)}` : ""}${text ? `?${text}` : ""}`;
}

export function go(target: string) {
  location.hash = target;
}

/** Changes the query of the address in place; an empty value takes its key away. */
export function setQuery(change: Query) {
  const {view, id, query} = route.value;
  const all: Query = Object.fromEntries(query);
  const target = href(view, id, {...all, ...change});
  if (target === location.hash) return;
  history.replaceState(null, "", target);
  route.value = read();
}

// Keys of the page and of the view that is shown; `?` lists them.

import {signal} from "@preact/signals";
import {useEffect, useRef} from "preact/hooks";

export interface KeyBinding {
  keys: string[];  // as in KeyboardEvent.key
  shown?: string;  // how the list names them; by default the keys themselves
  words: string;
  run: (event: KeyboardEvent) => void;
}

interface Group {
  title: string;
  bindings: KeyBinding[];
}

export const keyGroups = signal<Group[]>([]);

const typed = "textarea, select, input:not([type=range]):not([type=checkbox]), [contenteditable=true]";
const pressed = "button, a[href], summary, input:not([type=range]), select, label, [role=tab], [role=menuitem]";

function onKey(event: KeyboardEvent) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || event.isComposing) return;
  const target = event.composedPath()[0];
  if (target instanceof Element) {
    if (target.closest(typed)) return;
    if ((event.key === " " || event.key === "Enter") && target.closest(pressed)) return;
    if (target.closest("[role=tablist]") && event.key.startsWith("Arrow")) return;
  }
  if (document.querySelector("dialog[open]")) return;
  for (const group of [...keyGroups.value].reverse())
    for (const binding of group.bindings)
      if (binding.keys.includes(event.key)) {
        event.preventDefault();
        binding.run(event);
        return;
      }
}
document.addEventListener("keydown", onKey);

/** Binds keys while the component is shown. Later groups go before earlier ones. */
export function useKeys(title: string, bindings: KeyBinding[]) {
  const latest = useRef(bindings);
  latest.current = bindings;
  useEffect(() => {
    const group: Group = {
      title,
      bindings: bindings.map((binding, i) => ({...binding, run: (event) => latest.current[i]?.run(event)})),
    };
    keyGroups.value = [...keyGroups.value, group];
    return () => {
      keyGroups.value = keyGroups.value.filter((other) => other !== group);
    };
  }, [title, bindings.length]);
}

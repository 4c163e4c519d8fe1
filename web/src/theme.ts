// Light, dark, or as the system has it; kept in the browser.

import {signal} from "@preact/signals";

export type Theme = "auto" | "light" | "dark";
const storageKey = "lather.theme";

function load(): Theme {
  try {
    const kept = localStorage.getItem(storageKey);
    return kept === "light" || kept === "dark" ? kept : "auto";
  } catch {
    return "auto";
  }
}

function put(value: Theme) {
  if (value === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = value;
}

export const theme = signal<Theme>(load());
put(theme.value);

export function setTheme(value: Theme) {
  put(value);
  theme.value = value;
  try {
    localStorage.setItem(storageKey, value);
  } catch {
    // Without storage it holds for this visit.
  }
}

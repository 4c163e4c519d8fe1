// The scene that is being written. Kept in the tab, so that a reload loses nothing.

import {signal} from "@preact/signals";

export interface Draft {
  text: string;
  /** What it was made from: "scene:NAME", "job:ID", "file:NAME", "blank". */
  source: string;
  original: string;
  size: string;
  priority: number;
}

const storageKey = "lather.draft";

function load(): Draft | null {
  try {
    const draft = JSON.parse(sessionStorage.getItem(storageKey) ?? "null");
    return draft && typeof draft.text === "string" ? draft : null;
  } catch {
    return null;
  }
}

export const draft = signal<Draft | null>(load());

export function setDraft(next: Draft | null) {
  draft.value = next;
  try {
    if (next) sessionStorage.setItem(storageKey, JSON.stringify(next));
    else sessionStorage.removeItem(storageKey);
  } catch {
    // Without storage, or with a full one, a reload starts over.
  }
}

export const startDraft = (text: string, source: string, size = "") =>
  setDraft({text, source, original: text, size, priority: 0});

/** The scene of a dropped file: JSON as it stands, or what a PNG says that it was drawn from. Throws Error with words for the user. */
export async function readSceneFile(file: File): Promise<string> {
  const {isPng, pngTexts} = await import("./media/png");
  if (file.size > 64 << 20) throw new Error(`${file.name} is too large to be a scene.`);
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (!isPng(bytes)) {
    const text = new TextDecoder().decode(bytes);
    if (!text.trimStart().startsWith("{")) throw new Error(`${file.name} is neither a scene in JSON nor a PNG.`);
    return text;
  }
  const scene = (await pngTexts(bytes)).get("lather:scene-json");
  if (scene === undefined) throw new Error(`${file.name} holds no scene: it was not drawn by Lather, or by an earlier version.`);
  const {parse, write} = await import("./json/text");
  return `${write(parse(scene).value)}\n`;
}

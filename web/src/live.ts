// What keeps the page up to date: polling, which loses nothing, while the page can be seen; and whether the server answers.

import {computed, signal} from "@preact/signals";
import {useCallback, useEffect, useRef, useState} from "preact/hooks";
import {isAbort, Unreachable, words} from "./api";

/** Why nothing is up to date; "" while all is well. */
export const trouble = signal("");
export const away = "Server does not answer, trying again";
/** False while the server does not answer. */
export const online = computed(() => trouble.value !== away);

/** What was said last to those who listen instead of looking, and what everyone is shown for a while. */
export const announcement = signal("");
export interface Notice {
  id: number;
  text: string;
  bad: boolean;
}
export const notices = signal<Notice[]>([]);
let lastNotice = 0;

export function announce(text: string) {
  announcement.value = text;
}

export function dismiss(id: number) {
  notices.value = notices.value.filter((notice) => notice.id !== id);
}

export function notify(text: string, bad = false) {
  const id = ++lastNotice;
  notices.value = [...notices.value.slice(-3), {id, text, bad}];
  setTimeout(() => dismiss(id), bad ? 12000 : 5000);
}

const leastBetweenEventsMs = 250;

/** Calls `heard` soon after each event of a job's stream, while the page is visible; whether the stream is open. Streams are a
 * comfort: without one, polling tells the same. */
export function useEvents(address: string | null, heard: () => void): boolean {
  const [open, setOpen] = useState(false);
  useEffect(() => {
    if (address === null) return;
    let source: EventSource | null = null;
    let timer = 0;
    const soon = () => {
      if (timer === 0) timer = window.setTimeout(() => {
        timer = 0;
        heard();
      }, leastBetweenEventsMs);
    };
    const close = () => {
      source?.close();
      source = null;
      setOpen(false);
    };
    const seen = () => {
      close();
      if (document.visibilityState !== "visible") return;
      source = new EventSource(address);
      source.onopen = () => setOpen(true);
      // It tries again by itself, unless the server has refused it.
      source.onerror = () => setOpen(false);
      source.addEventListener("job", soon);
      source.addEventListener("frame", soon);
      source.addEventListener("end", () => {
        close();
        soon();
      });
    };
    document.addEventListener("visibilitychange", seen);
    seen();
    return () => {
      document.removeEventListener("visibilitychange", seen);
      clearTimeout(timer);
      close();
    };
  }, [address]);
  return open;
}

/** Calls `refresh` now and then every `periodMs` after it has ended, while the page is visible; never twice at a time. A failure
 * to reach the server shows in `online` and is tried again. Returns a function that asks for one more at once. */
export function usePolling(refresh: (signal: AbortSignal) => Promise<void>, periodMs: number | null, key: unknown): () => void {
  const latest = useRef(refresh);
  latest.current = refresh;
  const period = useRef(periodMs);
  period.current = periodMs;
  const poke = useRef(() => {});

  useEffect(() => {
    const stop = new AbortController();
    let timer = 0;
    let busy = false;
    let again = false;

    async function run() {
      clearTimeout(timer);
      if (busy) {
        again = true;
        return;
      }
      busy = true;
      again = false;
      let retry = false;
      try {
        await latest.current(stop.signal);
        trouble.value = "";
      } catch (error) {
        if (isAbort(error)) return;
        trouble.value = error instanceof Unreachable ? away : words(error);
        retry = error instanceof Unreachable;
      }
      busy = false;
      if (stop.signal.aborted) return;
      if (again) void run();
      else schedule(retry ? 1000 : period.current);
    }
    function schedule(wait: number | null) {
      clearTimeout(timer);
      if (wait !== null && document.visibilityState === "visible") timer = window.setTimeout(run, wait);
    }
    const seen = () => {
      if (document.visibilityState === "visible") void run();
    };
    poke.current = () => void run();
    document.addEventListener("visibilitychange", seen);
    void run();
    return () => {
      stop.abort();
      clearTimeout(timer);
      document.removeEventListener("visibilitychange", seen);
      poke.current = () => {};
    };
  }, [key]);

  return useCallback(() => poke.current(), []);
}

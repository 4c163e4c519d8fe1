// Numbers and times as text.

/** Seconds in words: "8 s", "3 min 20 s", "2 h 5 min"; "" for none. */
export function duration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds) || seconds < 0) return "";
  if (seconds < 10 && seconds > 0) return `${Number(seconds.toPrecision(2))} s`;
  const s = Math.round(seconds);
  if (s < 60) return `${s} s`;
  if (s < 3600) return `${Math.floor(s / 60)} min ${s % 60} s`;
  if (s < 86400) return `${Math.floor(s / 3600)} h ${Math.floor((s % 3600) / 60)} min`;
  return `${Math.floor(s / 86400)} d ${Math.floor((s % 86400) / 3600)} h`;
}

/** Three or four digits that fit the size of the number. */
export function number(value: unknown): string {
  if (typeof value !== "number" || !Number.isFinite(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e7) return value.toLocaleString("en");
  const size = Math.abs(value);
  if (size >= 1e5 || (size < 1e-3 && size > 0)) return minus(value.toExponential(2).replace("e+", "e"));
  return minus(String(Number(value.toPrecision(4))));
}

const minus = (text: string) => text.replace(/-/g, "−");

export function bytes(value: unknown): string {
  if (typeof value !== "number" || !Number.isFinite(value)) return "–";
  const units = ["B", "KiB", "MiB", "GiB", "TiB"];
  let unit = 0;
  while (value >= 1024 && unit < units.length - 1) {
    value /= 1024;
    ++unit;
  }
  return `${(value as number) < 10 && unit > 0 ? (value as number).toFixed(1) : Math.round(value as number)} ${units[unit]}`;
}

export function localTime(text: string | null): string {
  const time = new Date(text ?? "");
  return Number.isNaN(time.valueOf()) ? "" : time.toLocaleString();
}

/** "just now", "5 min ago", "3 h ago", or the date. */
export function ago(text: string | null, now: number): string {
  const time = Date.parse(text ?? "");
  if (Number.isNaN(time)) return "";
  const s = (now - time) / 1000;
  if (s < 60) return "just now";
  if (s < 3600) return `${Math.floor(s / 60)} min ago`;
  if (s < 86400) return `${Math.floor(s / 3600)} h ago`;
  return new Date(time).toLocaleDateString(undefined, {month: "short", day: "numeric"});
}

export const secondsBetween = (from: string | null, to: string | null) =>
  (Date.parse(to ?? "") - Date.parse(from ?? "")) / 1000;

/** "grid_velocities" -> "grid velocities". */
export const spaced = (name: string) => name.replaceAll("_", " ");
export const plural = (count: number, one: string, many = `${one}s`) => `${number(count)} ${count === 1 ? one : many}`;

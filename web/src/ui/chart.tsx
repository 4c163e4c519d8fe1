// A line chart over time. A click on it asks for the frame of that moment.

import uPlot from "uplot";
import {effect, type ReadonlySignal} from "@preact/signals";
import {useEffect, useRef} from "preact/hooks";
import {number} from "../format";
import {theme} from "../theme";
import {useMedia} from "./parts";

export interface Line {
  name: string;
  values: (number | null)[];
  dashed?: boolean;
}

interface Props {
  title: string;
  unit: string;
  x: number[];
  xName?: string;
  lines: Line[];
  at?: ReadonlySignal<number>;  // the moment that is looked at
  pick?: (x: number) => void;
}

const height = 170;
export const lineColors = ["--line-1", "--line-2", "--line-3", "--line-4", "--line-5", "--line-6"];

/** What a colour of the style sheet is now, for a canvas, which knows no variables. */
function colorOf(name: string): string {
  const probe = document.createElement("span");
  probe.style.color = `var(${name})`;
  document.body.append(probe);
  const {color} = getComputedStyle(probe);
  probe.remove();
  return color;
}

/** What is constant stands in the middle of a range of its own size. */
function padded(_: uPlot, least: number | null, most: number | null): uPlot.Range.MinMax {
  if (least === null || most === null) return [0, 1];
  if (least < most) return uPlot.rangeNum(least, most, 0.1, true);
  const around = 0.1 * Math.abs(least) || 1e-6;
  return [least - around, least + around];
}

function range(values: (number | null)[]): string {
  let least = Infinity;
  let most = -Infinity;
  for (const value of values)
    if (value !== null && Number.isFinite(value)) {
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
  return least > most ? "no values" : `${number(least)} to ${number(most)}`;
}

export function Chart({title, unit, x, xName = "time (s)", lines, at, pick}: Props) {
  const place = useRef<HTMLDivElement>(null);
  const dark = useMedia("(prefers-color-scheme: dark)");
  const colors = `${theme.value} ${dark}`;
  const asked = useRef(pick);
  asked.current = pick;

  useEffect(() => {
    const element = place.current!;
    const axis = (): uPlot.Axis => ({
      stroke: colorOf("--quiet"),
      font: `11px ${getComputedStyle(document.documentElement).fontFamily}`,
      grid: {stroke: colorOf("--hairline"), width: 1},
      ticks: {show: false},
    });
    const moment = (plot: uPlot) => {
      if (!at) return;
      const left = Math.round(plot.valToPos(at.value, "x", true)) + 0.5;
      if (!(left >= plot.bbox.left && left <= plot.bbox.left + plot.bbox.width)) return;
      const {ctx} = plot;
      ctx.save();
      ctx.strokeStyle = colorOf("--accent");
      ctx.lineWidth = devicePixelRatio;
      ctx.beginPath();
      ctx.moveTo(left, plot.bbox.top);
      ctx.lineTo(left, plot.bbox.top + plot.bbox.height);
      ctx.stroke();
      ctx.restore();
    };
    const plot = new uPlot({
      width: Math.max(200, element.clientWidth),
      height,
      legend: {show: lines.length > 1, live: true},
      cursor: {y: false, points: {size: 6}, drag: {x: false, y: false}},
      scales: {x: {time: false}, y: {range: padded}},
      axes: [
        {...axis(), size: 26, space: 60},
        {...axis(), size: 58, space: 30, values: (_, splits) => splits.map((value) => (value === null ? "" : number(value)))},
      ],
      series: [
        {label: xName, value: (_, value) => (value === null ? "" : number(value))},
        ...lines.map((line, i): uPlot.Series => ({
          label: line.name,
          stroke: colorOf(lineColors[i % lineColors.length]),
          width: 1.5,
          dash: line.dashed ? [4, 3] : undefined,
          points: {show: x.length < 3},
          value: (_, value) => (value === null ? "" : number(value)),
        })),
      ],
      hooks: {draw: [moment]},
    }, [x, ...lines.map((line) => line.values)] as uPlot.AlignedData, element);

    plot.over.addEventListener("click", () => {
      const {left} = plot.cursor;
      if (left !== undefined && left >= 0) asked.current?.(plot.posToVal(left, "x"));
    });
    const sized = new ResizeObserver(() => {
      if (element.clientWidth > 0) plot.setSize({width: element.clientWidth, height});
    });
    sized.observe(element);
    const stop = at && effect(() => {
      const now = at.value;
      const idx = x.reduce((best, time, i) => (Math.abs(time - now) < Math.abs(x[best] - now) ? i : best), 0);
      plot.setLegend({idx});
      plot.redraw(false, false);
    });
    return () => {
      stop?.();
      sized.disconnect();
      plot.destroy();
    };
  }, [x, lines, colors]);

  const summary = lines.map((line) => `${line.name} ${range(line.values)}`).join("; ");
  return (
    <figure class="chart">
      <figcaption>{title} {unit && <span class="unit">{unit}</span>}</figcaption>
      <div ref={place} role="img" aria-label={`${title}: ${summary} ${unit}`} class={pick ? "pickable" : ""} />
    </figure>
  );
}

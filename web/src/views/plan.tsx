// A plan: what a job costs, before or after it has run.

import type {ComponentChildren} from "preact";
import {bytes, duration, number, plural, spaced} from "../format";
import {isObject, type Plan} from "../types";
import {Facts} from "../ui/parts";

export function planFacts(plan: Plan): [string, ComponentChildren][] {
  // A server that knows qualities and budgets says what it chose.
  const quality = isObject(plan.quality) && typeof plan.quality.name === "string" ? plan.quality.name : "";
  const budget = isObject(plan.choices?.budget) ? plan.choices.budget : {};
  return [
    ["Quality", quality],
    ["Expected time", typeof budget.seconds === "number" ? duration(budget.seconds) : ""],
    ["Expected error", typeof budget.error === "number" ? `${number(100 * budget.error)} %` : ""],
    ["Points", number(plan.points)],
    ["Emitted later", plan.points_emitted > 0 ? number(plan.points_emitted) : ""],
    ["Frames", number(plan.frames)],
    ["Steps", number(plan.steps)],
    ["Time step", `${number(plan.time_step)} s`],
    ["Points × steps", number(plan.points * plan.steps)],
    ["Memory", bytes(plan.memory_bytes)],
  ];
}

export function Warnings({plan}: {plan: Plan}) {
  if (!plan.warnings || plan.warnings.length === 0) return null;
  return <div class="callout warn"><ul>{plan.warnings.map((text) => <li key={text}>{text}</li>)}</ul></div>;
}

export function PlanView({plan}: {plan: Plan}) {
  return (
    <div class="plan">
      <Warnings plan={plan} />
      <div class="columns-2">
        <section>
          <h3>Size</h3>
          <Facts entries={[
            ...planFacts(plan),
            ["Stable up to", plan.step_bound ? `${number(plan.step_bound)} s` : ""],
            ...Object.entries(plan.choices ?? {}).filter(([, value]) => typeof value !== "object").map(([name, value]): [string, string] =>
              [spaced(name).replace(/^./, (c) => c.toUpperCase()), String(value)]),
          ]} />
        </section>
        <section>
          <h3>Stages of a step</h3>
          <ol class="stage-list">{plan.stages.map((stage) => <li key={stage}>{stage}</li>)}</ol>
        </section>
      </div>
      <section>
        <h3>Materials</h3>
        <div class="scrolling">
          <table class="grid">
            <thead>
              <tr><th scope="col">Material</th><th scope="col" class="number">Points</th><th scope="col" class="number">Wave speed</th>
                <th scope="col" class="number">A point holds</th><th scope="col">Fields</th></tr>
            </thead>
            <tbody>
              {plan.materials.map((material) => (
                <tr key={material.name}>
                  <th scope="row">{material.name}</th>
                  <td class="number">{number(material.points)}</td>
                  <td class="number">{material.wave_speed ? `${number(material.wave_speed)} m/s` : "–"}</td>
                  <td class="number">{plural(material.bytes_per_point, "byte")}</td>
                  <td class="quiet">{(material.fields ?? []).map((field) => `${field.name} (${field.bytes})`).join(", ")}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      </section>
    </div>
  );
}

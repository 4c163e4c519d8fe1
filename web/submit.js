// A box to post a scene: what would be posted can be planned first, and what is wrong is shown where it stands.

import {getSceneText, listScenes, postJob, postPlan} from "./api.js";
import {bytes, h, number} from "./dom.js";
import {locate} from "./pointer.js";

export class SubmitView {
  /** `posted(job)` is called when the server took the job. */
  constructor(posted) {
    this.title = "New job";
    this.posted = posted;
    this.text = h("textarea", {
      id: "scene", rows: 28, spellcheck: "false", autocapitalize: "off", "aria-describedby": "problems",
      placeholder: '{"lather": 1, "name": "…", …}', oninput: () => this.edited(),
    });
    this.examples = h("select", {id: "example", onchange: () => this.load(this.examples.value)});
    this.exampleField = h("span", {class: "field", hidden: true}, h("label", {for: "example"}, "Example"), this.examples);
    this.size = h("select", {id: "size"}, h("option", {value: ""}, "as written"));
    this.planButton = h("button", {class: "button", type: "button", onclick: () => this.send(postPlan)}, "Plan");
    this.postButton = h("button", {class: "button primary", type: "submit"}, "Post");
    this.outcome = h("div", {id: "problems", role: "status"});
    this.element = h(
      "form", {class: "submit", onsubmit: (event) => {
        event.preventDefault();
        this.send(postJob);
      }},
      h("h2", {}, "New job"),
      h("p", {class: "controls"}, this.exampleField,
        h("span", {class: "field"}, h("label", {for: "size"}, "Size"), this.size),
        h("span", {class: "spacer"}), this.planButton, this.postButton),
      h("label", {for: "scene", class: "quiet"}, "Scene (JSON, SI units, y up)"), this.text, this.outcome);
    this.findExamples();
  }

  /** Servers without examples offer none. */
  async findExamples() {
    let scenes = [];
    try {
      scenes = (await listScenes()).scenes ?? [];
    } catch {
      return;
    }
    const names = scenes.map((scene) => (typeof scene === "string" ? scene : scene.name));
    this.examples.replaceChildren(
      h("option", {value: ""}, "choose…"), ...names.map((name) => h("option", {value: name}, name)));
    this.exampleField.hidden = names.length === 0;
    if (this.text.value === "" && names.length > 0) {
      this.examples.value = names[0];
      this.load(names[0]);
    }
  }

  async load(name) {
    if (name === "") return;
    try {
      this.text.value = await getSceneText(name);
      this.edited();
      if ([...this.size.options].some((option) => option.value === "preview")) this.size.value = "preview";
    } catch (error) {
      this.showMessage(error.message);
    }
  }

  /** Offers the sizes that the scene names. */
  edited() {
    this.outcome.replaceChildren();
    let sizes = [];
    try {
      sizes = Object.keys(JSON.parse(this.text.value).sizes ?? {});
    } catch {
      return;
    }
    const chosen = this.size.value;
    this.size.replaceChildren(
      h("option", {value: ""}, "as written"), ...sizes.map((size) => h("option", {value: size}, size)));
    if (sizes.includes(chosen)) this.size.value = chosen;
  }

  async send(action) {
    let scene;
    try {
      scene = JSON.parse(this.text.value);
    } catch (error) {
      this.showMessage(`This is not JSON: ${error.message}`);
      return;
    }
    const request = this.size.value ? {scene, size: this.size.value} : {scene};
    this.busy(true);
    try {
      const answer = await action(request);
      this.outcome.replaceChildren();
      if (action === postPlan) this.showPlan(answer);
      else this.posted(answer);
    } catch (error) {
      this.showProblems(error);
    } finally {
      this.busy(false);
    }
  }

  busy(on) {
    this.planButton.disabled = on;
    this.postButton.disabled = on;
  }

  showMessage(text) {
    this.outcome.replaceChildren(h("p", {class: "failure"}, text));
  }

  showProblems(error) {
    const items = (error.errors ?? []).map((problem) => this.problem(problem));
    this.outcome.replaceChildren(h("p", {class: "failure"}, error.message), h("ol", {class: "problems"}, items));
  }

  /** A problem's words beside the lines that it is about; a click selects them in the box. */
  problem(problem) {
    const words = [
      h("p", {}, problem.message ?? problem.detail ?? ""),
      problem.allowed ? h("p", {class: "quiet"}, `Allowed: ${problem.allowed}`) : null,
    ];
    const inScene = /^\/scene(\/.*)?$/.exec(problem.pointer ?? "");
    if (!inScene) return h("li", {}, h("code", {}, problem.pointer ?? ""), ...words);
    const pointer = inScene[1] ?? "";
    const text = this.text.value;
    const place = locate(text, pointer);
    const excerpt = text.slice(place.start, place.end).split("\n")[0].slice(0, 100);
    const select = () => {
      this.text.focus();
      this.text.setSelectionRange(place.start, place.exact ? place.end : place.start + excerpt.length);
      const lines = text.split("\n").length;
      this.text.scrollTop = (this.text.scrollHeight * Math.max(0, place.line - 4)) / lines;
    };
    const button = h(
      "button", {class: "place", type: "button", onclick: select, title: "Show it in the scene"},
      h("span", {class: "line-number"}, `line ${place.line}`), h("code", {}, pointer || "/"),
      h("code", {class: "excerpt"}, excerpt));
    return h("li", {}, button, ...words);
  }

  showPlan(plan) {
    const rows = [
      ["points", number(plan.points)], ["frames", number(plan.frames)], ["steps", number(plan.steps)],
      ["time step", `${number(plan.time_step)} s`], ["memory", bytes(plan.memory_bytes)],
      ["points × steps", number(plan.points * plan.steps)],
    ];
    const facts = h("dl", {class: "facts-list"}, rows.map(([name, text]) => h("div", {}, h("dt", {}, name), h("dd", {}, text))));
    const warnings = (plan.warnings ?? []).map((text) => h("p", {class: "quiet"}, text));
    this.outcome.replaceChildren(h("h3", {}, "Plan"), facts, ...warnings);
  }
}

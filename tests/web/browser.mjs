// The page in a real browser against the real program: browser.mjs LATHER CHROMIUM [NAME...], names of tests to run only these.

import assert from "node:assert/strict";
import {mkdtempSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {eventually, fromWeb, root, Server, sleep, startProxy} from "./support.mjs";

const [program, chromium, ...only] = process.argv.slice(2);
const data = mkdtempSync(join(tmpdir(), "lather-page."));
const server = new Server(program, data);
const axe = readFileSync(fromWeb.resolve("axe-core/axe.min.js"), "utf8");

const scene = (name, change = {}) => ({...JSON.parse(readFileSync(join(root, "scenes", `${name}.json`), "utf8")), ...change});
const small = {"/output/width": 160, "/output/height": 120, "/output/supersampling": 1};
/** Done in about a second. */
const short = (name, set = {}) => ({
  scene: scene("falling-blob-2d", {name}), size: "preview", set: {...small, "/duration": 0.2, "/output/particles": ["ply"], ...set},
});
/** Not done before the tests are. */
const long = (name) => ({scene: scene("falling-blob-2d", {name}), size: "preview", set: {...small, "/duration": 300}});
const post = (request) => server.api("jobs", request);
const ended = (id) => eventually(`job ${id} ends`, async () => {
  const job = await server.api(`jobs/${id}`);
  return ["succeeded", "failed", "cancelled"].includes(job.state) && job;
}, 60);

let browser;
/** What the page must not do, on any page of any test. */
const faults = [];
let serverIsAway = false;

async function open(hash = "", options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, acceptDownloads: true, ...options});
  const page = await context.newPage();
  page.setDefaultTimeout(30000);
  page.on("pageerror", (error) => faults.push(`exception: ${error.message}`));
  page.on("dialog", (dialog) => {
    faults.push(`dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  page.on("console", (message) => {
    const text = message.text();
    // The browser itself notes each answer that is no success; the page asks for plans of scenes with mistakes, and for servers that are away.
    const expected = text.startsWith("Failed to load resource") && (serverIsAway || /status of (404|409|422|502)/.test(text));
    if (message.type() === "error" && !expected) faults.push(`console: ${text}`);
  });
  const origin = new URL(options.address ?? server.address).origin;
  page.on("request", (request) => {
    if (!/^(data|blob):/.test(request.url()) && new URL(request.url()).origin !== origin) faults.push(`a request to ${request.url()}`);
  });
  await page.goto(`${options.address ?? server.address}/${hash}`.replace(/([^:])\/\//, "$1/"));
  return page;
}

const text = (page, selector) => page.locator(selector).first().innerText();
const query = (page, key) => new URLSearchParams(new URL(page.url()).hash.split("?")[1] ?? "").get(key);
const until = (what, question, seconds) => eventually(what, question, seconds ?? 30);

/** Types a text in place of the editor's. */
async function rewrite(page, typed) {
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+a");
  // By itself: over a selection the browser would keep its style, which the security policy forbids and the console reports.
  await page.keyboard.press("Delete");
  await page.keyboard.insertText(typed);
}

/** Fails on what axe-core calls serious or critical; by all its rules, or one. */
async function accessible(page, what, rule) {
  await page.evaluate(`if (!globalThis.axe) {${axe}}`);
  const found = await page.evaluate(async (only) => {
    const {violations} = await globalThis.axe.run(document, {resultTypes: ["violations"], ...(only ? {runOnly: [only]} : {})});
    return violations.filter(({impact}) => impact === "serious" || impact === "critical")
      .map(({id, nodes}) => `${id}: ${nodes.slice(0, 3).map((node) => `${node.target} ${node.any[0]?.message ?? ""}`).join(" | ")}`);
  }, rule);
  assert.deepEqual(found, [], what);
}

/** Nothing is wider than the window. */
async function fits(page, what) {
  const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(content <= window, `${what}: ${content} px in a window of ${window} px`);
}

const tests = {
  async "a job is posted from the gallery, watched, scrubbed and downloaded"() {
    const page = await open();
    await page.getByText("No jobs yet").waitFor();
    await page.keyboard.press("n");
    await page.getByLabel("Search the examples").fill("blob of foam falls");
    const card = page.getByRole("link", {name: /A blob of foam falls onto a peg/});
    await until("its picture", () => card.locator("img").evaluate((img) => img.naturalWidth > 0));
    await card.click();
    await page.getByRole("group", {name: "Size"}).getByRole("button", {name: "preview", pressed: true}).waitFor();
    const duration = page.getByRole("textbox", {name: "duration"});
    await duration.fill("0.5");
    await duration.press("Enter");
    // The form changes the text, and the text the plan.
    await until("the plan", async () => (await text(page, ".plan-body")).includes("Frames\n16"));
    await page.getByRole("button", {name: "Post job"}).click();
    await page.getByRole("heading", {name: "A blob of foam falls onto a peg"}).waitFor();

    // It follows the newest frame while the job runs.
    const shown = () => page.locator(".picture img").getAttribute("alt");
    await until("a frame is shown", async () => (await page.locator(".picture img").count()) > 0);
    await page.getByRole("button", {name: "Live"}).waitFor();
    assert.match(await shown(), /A blob of foam falls onto a peg, frame \d+/);
    await until("it is done", async () => (await text(page, ".status .state")) === "Done", 30);
    await until("the newest frame", async () => (await shown()).endsWith("frame 15"));

    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("Shift+ArrowLeft");
    await until("frame 4", async () => (await shown()).endsWith("frame 4"));
    await until("the address", () => query(page, "frame") === "4");
    await page.getByRole("slider", {name: "Frame"}).fill("9");
    await until("frame 9", async () => (await shown()).endsWith("frame 9"));
    await page.keyboard.press("Home");
    await until("frame 0", async () => (await shown()).endsWith("frame 0"));
    await page.keyboard.press("]");
    await page.keyboard.press("]");
    assert.equal(await page.getByRole("combobox", {name: "Speed"}).inputValue(), "4");
    await page.keyboard.press("Space");
    await until("it has played to the end", async () => (await shown()).endsWith("frame 15"));
    await page.getByRole("button", {name: "Play", exact: true}).waitFor();
    await page.keyboard.press("End");

    const download = async (name) => {
      const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", {name, exact: true}).click()]);
      return [file.suggestedFilename(), readFileSync(await file.path())];
    };
    const [pngName, png] = await download("Frame 15");
    assert.equal(pngName, "A-blob-of-foam-falls-onto-a-peg-00015.png");
    assert.equal(png.subarray(1, 4).toString(), "PNG");
    const [, zip] = await download("All frames");
    assert.equal(zip.subarray(0, 2).toString(), "PK");
    const [, report] = await download("Report");
    assert.equal(JSON.parse(report).frames.length, 16);

    // The report's charts.
    await page.locator(".chart .uplot").first().waitFor();
    assert.match(await page.locator(".chart [role=img]").first().getAttribute("aria-label"), /^Energy: total .* J$/);
    await page.getByRole("tab", {name: "Plan"}).click();
    await page.getByRole("cell", {name: /velocity/}).waitFor();
    await page.getByRole("tab", {name: "Log"}).click();
    await until("the log", async () => (await text(page, "pre.text")).includes("drawing with"));

    // A picture opens the scene that it shows.
    await page.goto(`${server.address}/#/new`);
    await page.locator("input[type=file]").setInputFiles({name: pngName, mimeType: "image/png", buffer: png});
    await page.locator(".cm-content").waitFor();
    await until("the plan of the picture's scene", async () => (await text(page, ".plan-body")).includes("Frames\n16"));
    const id = (await server.api("jobs")).jobs[0].id;
    const kept = JSON.parse((await page.evaluate(() => sessionStorage.getItem("lather.draft"))));
    assert.deepEqual(JSON.parse(kept.text), (await server.api(`jobs/${id}/plan`)).scene);
    await page.context().close();
  },

  async "mistakes are shown at their place, in the form and in the JSON"() {
    const page = await open("#/new/edit?scene=falling-blob-2d");
    await page.getByRole("button", {name: "as written"}).click();
    const spacing = page.getByRole("textbox", {name: "spacing"});
    await spacing.fill("-1");
    await spacing.press("Enter");
    const problem = page.locator(".problems button", {hasText: "/spacing"});
    await problem.getByText("Allowed: from 1e-06 to 1000 m").waitFor();
    assert.equal(await spacing.getAttribute("aria-invalid"), "true");
    await page.locator(".cm-lintRange-error").first().waitFor();
    assert.equal(await page.getByRole("button", {name: "Post job"}).isDisabled(), true);
    await problem.click();
    await until("its field has the focus", () => spacing.evaluate((input) => input === document.activeElement));
    await spacing.fill("0.005");
    await spacing.press("Enter");
    await until("no problem", async () => (await page.locator(".problems").count()) === 0);

    // A member deep inside: its groups open.
    const draft = JSON.parse(await page.evaluate(() => sessionStorage.getItem("lather.draft"))).text;
    await rewrite(page, draft.replace('"radius": 0.025', '"radius": -0.025'));
    await page.locator(".problems button", {hasText: "/obstacles/0/shape/radius"}).click();
    await until("the deep field", () => page.evaluate(() => document.activeElement.value === "-0.025"));

    // No JSON at all: said with its line; the form waits.
    await rewrite(page, '{\n  "lather": 1,\n  "name" 2\n}');
    await page.getByText("Line 3: A colon should stand here").waitFor();
    assert.equal(await page.locator(".form-pane fieldset").evaluate((fieldset) => fieldset.disabled), true);

    // What is written survives a reload.
    await rewrite(page, draft.replace("onto a peg", "once more"));
    await page.getByRole("heading", {name: "once more"}).waitFor();
    await page.reload();
    await page.getByRole("heading", {name: "once more"}).waitFor();
    await page.context().close();
  },

  async "jobs are filtered, selected and cancelled; both views live in the address"() {
    const {id} = await post(long("a long one"));
    await post(short("a short one"));
    const page = await open();
    const row = page.locator(".row", {hasText: "a long one"});
    await row.waitFor();
    await page.getByRole("button", {name: /^Active/}).click();
    assert.equal(query(page, "state"), "active");
    await page.keyboard.press("/");
    await page.keyboard.type("long");
    await until("one row", async () => (await page.locator(".rows .row").count()) === 1);
    await page.keyboard.press("Escape");
    await page.keyboard.press("j");
    await page.keyboard.press("x");
    await page.getByText("1 selected").waitFor();
    await page.reload();
    await page.getByText("1 selected").waitFor();
    assert.equal(await page.getByLabel("Filter by name").inputValue(), "long");

    // Its page, reloaded in the middle, shows the same frame.
    await page.keyboard.press("j");
    await page.keyboard.press("Enter");
    await until("two frames", async () => (await server.api(`jobs/${id}`)).frames > 2, 30);
    await until("a frame is shown", async () => (await page.locator(".picture img").count()) > 0);
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await until("the address", () => query(page, "frame") === "1");
    await page.reload();
    await until("frame 1", async () => (await page.locator(".picture img").getAttribute("alt")).endsWith("frame 1"));
    await page.getByRole("button", {name: "Cancel"}).click();
    await until("it is cancelled", async () => (await text(page, ".status .state")) === "Cancelled");
    await page.getByRole("button", {name: "Delete"}).click();
    const dialog = page.getByRole("dialog");
    await dialog.getByText("cannot be brought back").waitFor();
    await page.keyboard.press("Escape");
    await dialog.waitFor({state: "detached"});
    await page.getByRole("button", {name: "Delete"}).click();
    await dialog.getByRole("button", {name: "Delete"}).click();
    await page.locator(".rows .row", {hasText: "a short one"}).waitFor();
    assert.equal(await page.locator(".row", {hasText: "a long one"}).count(), 0);
    await page.context().close();
  },

  async "jobs are paused, resumed, retried and made longer where the server can, and only there"() {
    const able = "pause" in (await post(short("made longer"))).links;
    await post(long("at rest"));
    const page = await open();
    const row = page.locator(".row", {hasText: "at rest"});
    await row.getByText("Running").waitFor();
    assert.equal(await row.getByRole("button", {name: "Pause at rest"}).count(), able ? 1 : 0);
    if (able) {
      await row.getByRole("button", {name: "Pause at rest"}).click();
      await row.getByText("Paused").waitFor();
      await row.getByRole("button", {name: "Resume at rest"}).click();
      await row.getByText(/Running|Queued/).waitFor();
    }
    await row.getByRole("button", {name: "Cancel at rest"}).click();
    await row.getByText("Cancelled").waitFor();
    assert.equal(await row.getByRole("button", {name: "Retry at rest"}).count(), able ? 1 : 0);
    const other = page.locator(".row", {hasText: "made longer"});
    await other.getByText("Done").waitFor();
    await other.getByRole("link").click();
    await page.getByRole("heading", {name: "made longer"}).waitFor();
    await page.getByRole("button", {name: "Delete"}).waitFor();
    await page.locator(".facts").nth(1).waitFor();
    assert.equal(await page.getByRole("button", {name: "Extend"}).count(), able ? 1 : 0);
    if (able) {
      await page.getByRole("button", {name: "Extend"}).click();
      await page.getByRole("dialog").getByLabel("Duration").fill("0.3");
      await page.keyboard.press("Enter");
      await until("it has ten frames", async () => /^Done[^]*Frames\n10\n/.test(await text(page, ".status")), 30);
    }
    await page.context().close();
  },

  async "a server that restarts in the middle is waited for"() {
    const page = await open();
    const {id} = await post(short("through a restart", {"/duration": 1}));
    await page.goto(`${server.address}/#/job/${id}`);
    await until("it runs", async () => (await server.api(`jobs/${id}`)).frames > 1, 30);
    serverIsAway = true;
    await server.stop();
    await page.getByText("Server does not answer").waitFor();
    await server.start();
    await until("it is back", async () => (await page.getByText("Server does not answer").count()) === 0);
    serverIsAway = false;
    await until("it is done", async () => (await text(page, ".status .state")) === "Done", 40);
    await until("the last frame", async () => (await page.locator(".picture img").getAttribute("alt")).endsWith("frame 30"));
    await page.context().close();
  },

  async "names with HTML in them are names"() {
    const name = '<img src=x onerror="window.broken=1">&amp;<script>window.broken=1</script>';
    const {id} = await post(short(name, {"/duration": 0.07}));
    const page = await open();
    await page.locator(".row .name", {hasText: name}).waitFor();
    await ended(id);
    await page.goto(`${server.address}/#/job/${id}`);
    await page.getByRole("heading", {name}).waitFor();
    await page.goto(`${server.address}/#/job/${id}?tab=scene`);
    await page.locator("pre.text", {hasText: "onerror"}).waitFor();
    await page.goto(`${server.address}/#/new/edit?job=${id}`);
    await page.getByRole("heading", {name}).waitFor();
    await page.goto(`${server.address}/#/job/${encodeURIComponent(name)}?q=${encodeURIComponent(name)}`);
    await page.getByText("There is no such job").waitFor();
    assert.equal(await page.evaluate(() => window.broken), undefined);
    await page.context().close();
  },

  async "jobs are compared: one scrubber, scenes, pictures"() {
    const [a, b] = await Promise.all([post(short("friction 0.3")), post(short("friction 0.9", {"/obstacles/0/friction": 0.9}))]);
    await ended(a.id);
    await ended(b.id);
    const page = await open("#/jobs?q=friction");
    for (const name of ["friction 0.3", "friction 0.9"]) await page.getByLabel(`Select ${name}`).check();
    await page.getByRole("button", {name: "Compare"}).click();
    await until("two pictures", async () => (await page.locator(".compared .picture img").count()) === 2);
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await until("frame 1 of both", async () => {
      const alts = await page.locator(".compared .picture img").evaluateAll((images) => images.map((img) => img.alt));
      return alts.length === 2 && alts.every((alt) => alt.endsWith("frame 1"));
    });
    const row = page.getByRole("row", {name: /\/obstacles\/0\/friction/});
    assert.deepEqual((await row.getByRole("cell").allInnerTexts()).sort(), ["0.3", "0.9"]);
    // Both are the same before they touch the peg, and differ afterwards.
    await page.keyboard.press("d");
    await page.getByText(/^0 % of the pixels differ/).waitFor();
    await page.keyboard.press("End");
    await page.getByText(/^[1-9][\d.]* % of the pixels differ|^0\.\d+ % of the pixels differ/).waitFor();
    await page.getByRole("tab", {name: "Charts"}).click();
    await page.locator(".chart .uplot").first().waitFor();
    await page.context().close();
  },

  async "particles are shown in 3D and turn by keys"() {
    const {id} = await post(short("in 3D", {"/duration": 0.07}));
    await ended(id);
    const page = await open(`#/job/${id}?tab=3d&frame=1`);
    await page.getByText("Frame 1: 288 points").waitFor();
    const place = page.locator(".orbit-place");
    /** Colours of what is drawn, coarsely. */
    const colors = async () => {
      const shot = (await place.screenshot()).toString("base64");
      return page.evaluate(async (encoded) => {
        const image = new Image();
        image.src = `data:image/png;base64,${encoded}`;
        await image.decode();
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [64, 48];
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0, 64, 48);
        const {data} = context.getImageData(0, 0, 64, 48);
        const found = [];
        for (let i = 0; i < data.length; i += 4) {
          const strong = Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]);
          found.push(strong > 40 ? 1 : 0);
        }
        return found.join("");
      }, shot);
    };
    const before = await until("coloured points", async () => {
      const drawn = await colors();
      return drawn.split("1").length > 30 && drawn;
    });
    await place.focus();
    for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowRight");
    await until("they have turned", async () => (await colors()) !== before);
    assert.equal(query(page, "frame"), "1");
    await page.context().close();
  },

  async "all of it works below a proxy's prefix"() {
    const proxy = await startProxy("/deep/below/", server.port);
    const {id} = await post(short("behind a proxy", {"/duration": 0.1}));
    await ended(id);
    const page = await open("", {address: proxy.address});
    await page.locator(".row", {hasText: "behind a proxy"}).locator("img").waitFor();
    await page.locator(".row-link", {hasText: "behind a proxy"}).click();
    await until("a picture", () => page.locator(".picture img").evaluate((img) => img.naturalWidth > 0).catch(() => false));
    await page.getByRole("tab", {name: "3D"}).click();
    await page.getByText(/Frame \d+: 288 points/).waitFor();
    await page.goto(`${proxy.address}#/new`);
    await until("a scene's picture", () => page.locator(".card img").first().evaluate((img) => img.naturalWidth > 0));
    await page.goto(`${proxy.address}#/new/edit?job=${id}`);
    await until("the plan", async () => (await text(page, ".plan-body")).includes("Points"));
    await page.locator(".cm-content").waitFor();
    await page.getByRole("button", {name: "Post job"}).click();
    await until("it is done", async () => (await text(page, ".status .state")) === "Done", 30);
    await page.getByRole("button", {name: "Delete"}).click();
    await page.getByRole("dialog").getByRole("button", {name: "Delete"}).click();
    await page.locator(".rows").waitFor();
    await page.context().close();
    proxy.stop();
  },

  async "keys are listed, and reach everything; focus comes back"() {
    const page = await open();
    await page.locator(".rows .row").first().waitFor();
    await page.getByRole("button", {name: "Keys (?)"}).focus();
    await page.keyboard.press("?");
    const dialog = page.getByRole("dialog", {name: "Keys"});
    await dialog.getByText("Compare the selected").waitFor();
    await page.keyboard.press("n");  // not while a dialog is open
    await page.keyboard.press("Escape");
    await dialog.waitFor({state: "detached"});
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Keys (?)");
    // Tab goes through the editor and out of it again.
    await page.goto(`${server.address}/#/new/edit?scene=jelly-drop-2d`);
    await page.locator(".cm-content").click();
    const inEditor = () => page.evaluate(() => document.activeElement.classList.contains("editor"));
    assert.equal(await inEditor(), true);
    await page.keyboard.press("Tab");
    assert.equal(await inEditor(), false);
    await page.context().close();
  },

  async "nothing that axe-core calls serious, light and dark; nothing wider than a phone; no motion where none is wanted"() {
    const {id} = await post(short("looked at", {"/duration": 0.1}));
    const other = await post(short("looked at, too", {"/duration": 0.1}));
    await ended(id);
    await ended(other.id);
    const views = {
      queue: ["#/jobs", ".rows .row"], selection: [`#/jobs?select=${id}`, ".selection"], gallery: ["#/new", ".card"],
      edit: ["#/new/edit?scene=shaving-cream-shake", ".plan-body .facts"], job: [`#/job/${id}`, ".chart .uplot"], plan: [`#/job/${id}?tab=plan`, ".grid"],
      log: [`#/job/${id}?tab=log`, "pre.text"], "3D": [`#/job/${id}?tab=3d`, ".orbit canvas"],
      compare: [`#/compare?jobs=${id},${other.id}&mode=difference`, ".compared canvas"],
    };
    const light = await open();
    const dark = await open("", {colorScheme: "dark"});
    const phone = await open("", {viewport: {width: 360, height: 740}, reducedMotion: "reduce", hasTouch: true, isMobile: true});
    for (const [name, [hash, ready]] of Object.entries(views)) {
      await Promise.all([light, dark, phone].map(async (page) => {
        await page.goto(`${server.address}/${hash}`);
        await page.locator(ready).first().waitFor();
      }));
      await accessible(light, `${name}, light`);
      await accessible(dark, `${name}, dark`, "color-contrast");
      await fits(phone, name);
    }
    const running = await post(long("still running"));
    await phone.goto(`${server.address}/#/jobs`);
    await phone.locator(".state.running").first().waitFor();
    assert.equal(await phone.locator(".state.running").first().evaluate((state) => getComputedStyle(state, "::before").animationName), "none");
    await fetch(`${server.address}/api/v1/jobs/${running.id}/cancel`, {method: "POST"});
    await light.goto(`${server.address}/#/jobs`);
    await light.keyboard.press("?");
    await light.getByRole("dialog").waitFor();
    await accessible(light, "keys");
    for (const page of [light, dark, phone]) await page.context().close();
  },
};

let failures = 0;
let count = 0;
try {
  await server.start();
  browser = await fromWeb("playwright-core").chromium.launch({
    executablePath: chromium,
    args: [...(process.getuid() === 0 ? ["--no-sandbox"] : []), "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"],
  });
  for (const [name, test] of Object.entries(tests)) {
    if (only.length > 0 && !only.some((part) => name.includes(part))) continue;
    const start = Date.now();
    ++count;
    try {
      await test();
      assert.deepEqual(faults, []);
      console.log(`ok      ${((Date.now() - start) / 1000).toFixed(1).padStart(5)} s  ${name}`);
    } catch (error) {
      ++failures;
      console.log(`FAILED  ${name}\n${error.stack}\n${faults.join("\n")}`);
      const pages = browser.contexts().flatMap((context) => context.pages());
      for (const page of pages) console.log(`at ${page.url()}:\n${(await page.locator("body").innerText().catch(() => "")).slice(0, 1500)}`);
      for (const context of browser.contexts()) await context.close();
      faults.length = 0;
      serverIsAway = false;
      if (server.process.exitCode !== null) await server.start();
    }
  }
} finally {
  await browser?.close();
  await server.stop();
  await sleep(100);
  rmSync(data, {recursive: true, force: true});
}
console.log(`${count - failures} of ${count} passed`);
process.exit(failures === 0 && count > 0 ? 0 : 1);

// What the page's tests share: packages, the program as a process, and a proxy.

import {spawn} from "node:child_process";
import http from "node:http";
import {createRequire} from "node:module";
import net from "node:net";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
/** Requires a package of web/, where they are installed. */
export const fromWeb = createRequire(join(root, "web/package.json"));

export const sleep = (ms) => new Promise((resume) => setTimeout(resume, ms));

/** Asks `question` until it gives something; throws after `seconds`. */
export async function eventually(what, question, seconds = 20) {
  const end = Date.now() + 1000 * seconds;
  while (Date.now() < end) {
    const answer = await question();
    if (answer) return answer;
    await sleep(50);
  }
  throw new Error(`${what}: not within ${seconds} s`);
}

async function freePort() {
  const listener = net.createServer().listen(0, "127.0.0.1");
  await new Promise((resume) => listener.once("listening", resume));
  const {port} = listener.address();
  await new Promise((resume) => listener.close(resume));
  return port;
}

export class Server {
  constructor(program, data) {
    this.program = program;
    this.data = data;
    this.said = "";
  }

  /** On the same port each time, as a restarted service is. */
  async start() {
    this.port ??= await freePort();
    this.address = `http://127.0.0.1:${this.port}`;
    this.process = spawn(this.program, ["serve", "--port", String(this.port), "--data", this.data, "--scenes", join(root, "scenes"),
      "--workers", "2", "--threads", "1"], {stdio: ["ignore", "pipe", "pipe"]});
    for (const stream of [this.process.stdout, this.process.stderr]) stream.on("data", (bytes) => { this.said += bytes; });
    await eventually("the server answers", async () => {
      if (this.process.exitCode !== null) throw new Error(`the server ended: ${this.said}`);
      return fetch(`${this.address}/healthz`).then((answer) => answer.ok, () => false);
    });
  }

  async stop() {
    if (!this.process || this.process.exitCode !== null) return;
    const ended = new Promise((resume) => this.process.once("exit", resume));
    this.process.kill("SIGTERM");
    await ended;
  }

  async api(path, body) {
    const answer = await fetch(`${this.address}/api/v1/${path}`, body === undefined ? {} :
      {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)});
    if (!answer.ok) throw new Error(`${path}: ${answer.status} ${await answer.text()}`);
    return answer.json();
  }
}

/** Serves what is below `prefix` as the server at `port` does at its root, and nothing else. */
export async function startProxy(prefix, port) {
  const proxy = http.createServer((request, response) => {
    if (!request.url.startsWith(prefix)) {
      response.writeHead(404).end();
      return;
    }
    const onward = http.request({host: "127.0.0.1", port, path: request.url.slice(prefix.length - 1), method: request.method, headers: request.headers},
      (answer) => {
        response.writeHead(answer.statusCode, answer.headers);
        answer.pipe(response);
      });
    onward.on("error", () => response.writeHead(502).end());
    request.pipe(onward);
  }).listen(0, "127.0.0.1");
  await new Promise((resume) => proxy.once("listening", resume));
  return {
    address: `http://127.0.0.1:${proxy.address().port}${prefix}`,
    stop: () => {
      proxy.closeAllConnections();
      proxy.close();
    },
  };
}

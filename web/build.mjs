// Builds the page from src/ into dist/, which is committed and embedded in the program.
//   node build.mjs           writes dist/
//   node build.mjs --check   writes nothing; fails unless dist/ is what src/ gives, and small enough
//   node build.mjs --watch   builds anew at each change
import {readFileSync, readdirSync, mkdirSync, writeFileSync, rmSync, existsSync} from "node:fs";
import {dirname, join, relative} from "node:path";
import {fileURLToPath} from "node:url";
import {gzipSync} from "node:zlib";
import esbuild from "esbuild";

const root = dirname(fileURLToPath(import.meta.url));
const dist = join(root, "dist");

// Without the 3D view, whose library is as large as all the rest.
const largestBundle = 250 * 1024;  // bytes, gzipped
const notCounted = new Set(["orbit3d.js", "licenses.txt"]);

// Each is loaded on its own; names are fixed, for CMake lists them. What only some visits need is loaded by import().
const options = {
  absWorkingDir: root,
  entryPoints: ["src/app.tsx", "src/editor.ts", "src/orbit3d.ts", "src/app.css"],
  external: ["./editor.js", "./orbit3d.js"],
  outdir: dist,
  bundle: true,
  format: "esm",
  minify: true,
  target: "es2021",
  jsx: "automatic",
  jsxImportSource: "preact",
  charset: "utf8",
  legalComments: "none",  // licenses.txt has them all, in full
  metafile: true,
  write: false,
  logLevel: "warning",
};

/** The licence of every package that a bundle has code of. */
function licenses(metafile) {
  const packages = new Set();
  for (const input of Object.keys(metafile.inputs)) {
    const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (match) packages.add(match[1]);
  }
  return [...packages].sort().map((name) => {
    const folder = join(root, "node_modules", name);
    const {version, license} = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    return `${name} ${version} (${license})\n\n${file ? readFileSync(join(folder, file), "utf8").trim() : ""}\n`;
  }).join(`\n${"-".repeat(80)}\n\n`);
}

/** File name -> bytes of dist/. */
async function build() {
  const result = await esbuild.build(options);
  const files = new Map();
  for (const output of result.outputFiles) files.set(relative(dist, output.path), Buffer.from(output.contents));
  for (const name of ["index.html", "icon.svg"]) files.set(name, readFileSync(join(root, "src", name)));
  files.set("licenses.txt", Buffer.from(licenses(result.metafile)));
  return files;
}

function write(files) {
  rmSync(dist, {recursive: true, force: true});
  mkdirSync(dist);
  for (const [name, bytes] of files) writeFileSync(join(dist, name), bytes);
}

function report(files) {
  let counted = 0;
  for (const [name, bytes] of [...files].sort()) {
    const zipped = gzipSync(bytes, {level: 9}).length;
    if (!notCounted.has(name)) counted += zipped;
    console.log(`${name.padEnd(14)} ${String(bytes.length).padStart(8)} bytes ${String(zipped).padStart(8)} gzipped`);
  }
  console.log(`without the 3D view ${counted} of at most ${largestBundle} bytes gzipped`);
  return counted <= largestBundle;
}

/** The names of files that differ between dist/ and `files`. */
function differences(files) {
  const there = existsSync(dist) ? readdirSync(dist) : [];
  const names = new Set([...there, ...files.keys()]);
  return [...names].filter((name) => {
    if (!there.includes(name) || !files.has(name)) return true;
    return !readFileSync(join(dist, name)).equals(files.get(name));
  });
}

if (process.argv.includes("--watch")) {
  const context = await esbuild.context({...options, plugins: [{
    name: "write",
    setup(build_) {
      build_.onEnd(async () => write(await build()));
    },
  }]});
  await context.watch();
} else {
  const files = await build();
  const small = report(files);
  if (process.argv.includes("--check")) {
    const differ = differences(files);
    if (differ.length > 0) console.error(`dist/ is not what src/ gives: ${differ.join(", ")}. Run: npm run build`);
    if (!small) console.error("The bundle is too large.");
    process.exitCode = differ.length > 0 || !small ? 1 : 0;
  } else {
    write(files);
    if (!small) process.exitCode = 1;
  }
}

// The page's parts that need no browser: JSON with places, PNG and PLY readers, numbers as text.

import assert from "node:assert/strict";
import {mkdtempSync, readFileSync, readdirSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import test from "node:test";
import {pathToFileURL} from "node:url";
import {deflateSync} from "node:zlib";
import {fromWeb, root} from "./support.mjs";

const built = mkdtempSync(join(tmpdir(), "lather-parts."));
process.on("exit", () => rmSync(built, {recursive: true, force: true}));
await fromWeb("esbuild").build({
  absWorkingDir: join(root, "web"), bundle: true, format: "esm", outdir: built, outExtension: {".js": ".mjs"}, logLevel: "warning",
  entryPoints: {text: "src/json/text.ts", png: "src/media/png.ts", ply: "src/media/ply.ts", format: "src/format.ts"},
});
const part = (name) => import(pathToFileURL(join(built, `${name}.mjs`)));
const {parse, locate, edit, apply, write, valueAt, flatten, JsonError} = await part("text");
const {pngTexts} = await part("png");
const {PlyReader} = await part("ply");
const format = await part("format");

const scenes = readdirSync(join(root, "scenes")).filter((name) => name.endsWith(".json"))
  .map((name) => readFileSync(join(root, "scenes", name), "utf8"));

test("reads what JSON.parse reads, of every example scene", () => {
  assert.ok(scenes.length > 20);
  for (const text of scenes) {
    assert.deepEqual(parse(text).value, JSON.parse(text));
    assert.deepEqual(JSON.parse(write(JSON.parse(text))), JSON.parse(text));
  }
});

test("refuses what JSON.parse refuses, and says where", () => {
  const broken = ["", "{", "[1,]", '{"a" 1}', '{"a": 01}', "{'a': 1}", '"a\nb"', '"\\x"', "[1] 2", "nul", "+1", "{,}", '{"a":1,}', "-", "1."];
  for (const text of broken) {
    assert.throws(() => JSON.parse(text), text);
    assert.throws(() => parse(text), (error) => error instanceof JsonError && error.at >= 0 && error.at <= text.length, text);
  }
  assert.throws(() => parse('{"a": 1,\n "b" 2}'), (error) => error.at === 14);
  assert.throws(() => parse("[".repeat(100000)), JsonError);
});

test("a key __proto__ is a key like others", () => {
  const value = parse('{"__proto__": {"a": 1}}').value;
  assert.ok(Object.hasOwn(value, "__proto__"));
  assert.equal(({}).a, undefined);
});

test("finds the place of every value of every scene, and of the nearest ancestor of others", () => {
  for (const text of scenes) {
    const tree = parse(text);
    for (const [pointer, words] of flatten(tree.value)) {
      const {start, end, exact} = locate(tree, pointer);
      assert.ok(exact);
      const member = text.slice(start, end);
      const [, parent, key] = /^(.*)\/([^/]*)$/.exec(pointer);
      const there = Array.isArray(valueAt(tree.value, parent)) ? JSON.parse(member) : JSON.parse(`{${member}}`)[key];
      assert.deepEqual(there, JSON.parse(words), pointer);
      assert.deepEqual(valueAt(tree.value, pointer), JSON.parse(words));
    }
  }
  const text = '{"a": {"b~c/d": [1, {"e": 2}]}}';
  assert.equal(text.slice(...range(locate(parse(text), "/a/b~0c~1d/1/e"))), '"e": 2');
  const near = locate(parse(text), "/a/none/x");
  assert.equal(near.exact, false);
  assert.equal(text.slice(...range(near)), '"a": {"b~c/d": [1, {"e": 2}]}');
});
const range = ({start, end}) => [start, end];

test("an edit changes one value and leaves all other text", () => {
  for (const text of scenes) {
    const before = JSON.parse(text);
    const changed = apply(text, edit(text, parse(text), "/spacing", 0.125));
    assert.deepEqual(JSON.parse(changed), {...before, spacing: 0.125});
    assert.equal(changed.length - text.length, "0.125".length - /"spacing": ([^,]*)/.exec(text)[1].length);
    const added = apply(text, edit(text, parse(text), "/numerics_x/deep/er", true));
    assert.deepEqual(JSON.parse(added), {...before, numerics_x: {deep: {er: true}}});
    assert.deepEqual(JSON.parse(apply(added, edit(added, parse(added), "/numerics_x", undefined))), before);
    for (const key of Object.keys(before)) {
      const {[key]: _, ...rest} = before;
      assert.deepEqual(JSON.parse(apply(text, edit(text, parse(text), `/${key}`, undefined))), rest, key);
    }
  }
});

test("edits of lists: at the end, inside, into an empty one; none where they cannot be", () => {
  const one = (text, pointer, value) => {
    const made = edit(text, parse(text), pointer, value);
    return made && apply(text, made);
  };
  assert.equal(one("[1, 2]", "/2", 3), "[1, 2, 3]");
  assert.equal(one("[]", "/0", {a: 1}), '[{"a": 1}]');
  assert.equal(one("[1, 2, 3]", "/1", undefined), "[1, 3]");
  assert.equal(one("[1]", "/0", undefined), "[]");
  assert.equal(one('{\n  "a": 1\n}', "/b", 2), '{\n  "a": 1,\n  "b": 2\n}');
  assert.equal(one("[1]", "/5", 3), null);
  assert.equal(one('{"a": 1}', "/a/b", 3), null);
  assert.equal(one('{"a": 1}', "/b", undefined), null);
});

function chunk(type, content) {
  const bytes = Buffer.alloc(12 + content.length);  // the reader does not check sums
  bytes.writeUInt32BE(content.length);
  bytes.write(type, 4, "latin1");
  content.copy(bytes, 8);
  return bytes;
}
const png = (...chunks) => new Uint8Array(Buffer.concat([Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]), ...chunks]));
const end = chunk("IEND", Buffer.alloc(0));

test("reads the texts of a PNG, plain and compressed", async () => {
  const texts = await pngTexts(png(
    chunk("tEXt", Buffer.from("plain\0text", "latin1")),
    chunk("iTXt", Buffer.from("raw\0\0\0\0\0ä", "utf8")),
    chunk("iTXt", Buffer.concat([Buffer.from("packed\0\x01\0\0\0", "latin1"), deflateSync('{"ö": 1}')])), end));
  assert.deepEqual([...texts], [["plain", "text"], ["raw", "ä"], ["packed", '{"ö": 1}']]);
});

test("refuses what is no PNG, one that is cut off, and a text that unpacks without end", async () => {
  await assert.rejects(pngTexts(new Uint8Array([1, 2, 3])), /no PNG|not a PNG/);
  const whole = png(chunk("tEXt", Buffer.from("a\0b")), end);
  for (let size = 8; size < whole.length; ++size) await assert.rejects(pngTexts(whole.slice(0, size)), /cut off/);
  const bomb = Buffer.concat([Buffer.from("bomb\0\x01\0\0\0", "latin1"), deflateSync(Buffer.alloc(64 << 20))]);
  await assert.rejects(pngTexts(png(chunk("iTXt", bomb), end)), /too large/);
});

function ply(count) {
  const head = "ply\nformat binary_little_endian 1.0\ncomment lather material 0 foam\ncomment lather material 1 a b\n" +
    `comment lather scalar speed m/s\nelement vertex ${count}\nproperty float x\nproperty float y\nproperty float z\n` +
    "property uint id\nproperty uchar material\nproperty float speed\nend_header\n";
  const body = Buffer.alloc(21 * count);
  for (let i = 0; i < count; ++i) {
    [i, 2 * i, 3 * i].forEach((value, axis) => body.writeFloatLE(value, 21 * i + 4 * axis));
    body.writeUInt32LE(i, 21 * i + 12);
    body.writeUInt8(i % 2, 21 * i + 16);
    body.writeFloatLE(0.5 * i, 21 * i + 17);
  }
  const all = Buffer.concat([Buffer.from(head), body]);
  return all.buffer.slice(all.byteOffset, all.byteOffset + all.length);
}

/** In pieces of `size` bytes. */
function readPly(buffer, most, size = 1 << 20) {
  const reader = new PlyReader(most);
  for (let at = 0; at < buffer.byteLength; at += size) reader.push(new Uint8Array(buffer.slice(at, at + size)));
  return reader.finish();
}

test("reads the points of a PLY, and every n-th of many", () => {
  const all = readPly(ply(10), 100);
  assert.equal(all.kept, 10);
  assert.deepEqual([...all.positions.slice(27)], [9, 18, 27]);
  assert.deepEqual([...all.material], [0, 1, 0, 1, 0, 1, 0, 1, 0, 1]);
  assert.deepEqual(all.materials, ["foam", "a b"]);
  assert.deepEqual(all.scalars.map(({name, unit}) => [name, unit]), [["speed", "m/s"]]);
  const some = readPly(ply(10), 4);
  assert.equal(some.count, 10);
  assert.deepEqual([...some.scalars[0].values], [0, 1.5, 3, 4.5]);
  assert.equal(readPly(ply(0), 4).kept, 0);
  for (const size of [1, 7, 21, 22, 300]) assert.deepEqual(readPly(ply(10), 4, size), some, `in pieces of ${size}`);
});

test("refuses a PLY that is cut off, or of another kind", () => {
  assert.throws(() => readPly(ply(10).slice(0, -1), 100), /cut off/);
  assert.throws(() => readPly(new TextEncoder().encode("ply\nformat ascii 1.0\nend_header\n").buffer, 100), /cannot|can read/);
});

test("numbers and times as text", () => {
  assert.equal(format.number(1234567), "1,234,567");
  assert.equal(format.number(0.00012345), "1.23e−4");
  assert.equal(format.number(-3.14159), "−3.142");
  assert.equal(format.number(NaN), "–");
  assert.equal(format.duration(3725), "1 h 2 min");
  assert.equal(format.duration(59.4), "59 s");
  assert.equal(format.duration(59.6), "1 min 0 s");
  assert.equal(format.duration(-1), "");
  assert.equal(format.bytes(1536), "1.5 KiB");
});

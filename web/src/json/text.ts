// JSON as text with places: where a JSON pointer (RFC 6901) leads, and edits that leave all other text as it is.

import type {Json} from "../types";

export interface Node {
  start: number;
  end: number;
  value: Json;
  /** Of an object or array; `start` is where the member's key, or the item, begins. */
  members?: {key: string; start: number; node: Node}[];
}

export class JsonError extends Error {
  constructor(message: string, readonly at: number) {
    super(message);
  }
}

export const splitPointer = (pointer: string) =>
  pointer.split("/").slice(1).map((token) => token.replaceAll("~1", "/").replaceAll("~0", "~"));
export const joinPointer = (parent: string, token: string | number) =>
  `${parent}/${String(token).replaceAll("~", "~0").replaceAll("/", "~1")}`;

const deepest = 64;
const numberPattern = /-?(0|[1-9]\d*)(\.\d+)?([eE][+-]?\d+)?/y;

/** Reads JSON; throws JsonError, which says where. */
export function parse(text: string): Node {
  let at = 0;

  const fail = (message: string, where = at): never => {
    throw new JsonError(message, where);
  };
  const shown = () => (at < text.length ? `“${text[at]}”` : "the end");
  const space = () => {
    while (at < text.length && " \t\n\r".includes(text[at])) ++at;
  };

  function string(): string {
    const start = at++;
    while (at < text.length && text[at] !== '"') {
      if (text[at] < " ") fail("A text cannot go over the end of a line.", start);
      at += text[at] === "\\" ? 2 : 1;
    }
    if (at >= text.length) fail("This text has no end.", start);
    ++at;
    try {
      return JSON.parse(text.slice(start, at)) as string;
    } catch {
      return fail("This text has a broken escape.", start);
    }
  }

  function word(): Json {
    for (const [name, value] of [["true", true], ["false", false], ["null", null]] as const)
      if (text.startsWith(name, at)) {
        at += name.length;
        return value;
      }
    numberPattern.lastIndex = at;
    const match = numberPattern.exec(text);
    if (!match) return fail(`A value should stand here, not ${shown()}.`);
    at += match[0].length;
    return Number(match[0]);
  }

  function members(close: string, depth: number): NonNullable<Node["members"]> {
    const all: NonNullable<Node["members"]> = [];
    ++at;
    space();
    if (text[at] === close) {
      ++at;
      return all;
    }
    while (true) {
      const start = at;
      let key = String(all.length);
      if (close === "}") {
        if (text[at] !== '"') fail(`A key in quotes should stand here, not ${shown()}.`);
        key = string();
        space();
        if (text[at] !== ":") fail(`A colon should stand here, not ${shown()}.`);
        ++at;
        space();
      }
      all.push({key, start, node: value(depth + 1)});
      space();
      if (text[at] === close) {
        ++at;
        return all;
      }
      if (text[at] !== ",") fail(`A comma or ${close} should stand here, not ${shown()}.`);
      ++at;
      space();
    }
  }

  function value(depth: number): Node {
    if (depth > deepest) fail("This is nested too deeply.");
    const start = at;
    if (text[at] === '"') {
      const content = string();
      return {start, end: at, value: content};
    }
    if (text[at] === "{") {
      const all = members("}", depth);
      // Not by assignment: a key "__proto__" is a key like others.
      return {start, end: at, value: Object.fromEntries(all.map((m) => [m.key, m.node.value])), members: all};
    }
    if (text[at] === "[") {
      const all = members("]", depth);
      return {start, end: at, value: all.map((m) => m.node.value), members: all};
    }
    const content = word();
    return {start, end: at, value: content};
  }

  space();
  const root = value(0);
  space();
  if (at < text.length) fail(`Nothing should follow, but here is ${shown()}.`);
  return root;
}

export interface Place {
  start: number;  // of the member's key, or of the item
  end: number;
  exact: boolean;
}

/** The place of the value that `pointer` names, or of its nearest ancestor that exists. */
export function locate(root: Node, pointer: string): Place {
  let place: Place = {start: root.start, end: root.end, exact: true};
  let node = root;
  for (const token of splitPointer(pointer)) {
    const member = node.members?.find((candidate) => candidate.key === token);
    if (!member) return {...place, exact: false};
    node = member.node;
    place = {start: member.start, end: node.end, exact: true};
  }
  return place;
}

export function valueAt(root: Json | undefined, pointer: string): Json | undefined {
  let value = root;
  for (const token of splitPointer(pointer)) {
    if (typeof value !== "object" || value === null || !Object.hasOwn(value, token)) return undefined;
    value = (value as Record<string, Json>)[token];
  }
  return value;
}

export interface Edit {
  from: number;
  to: number;
  insert: string;
}

/** Lists of numbers and short values on one line, as the example scenes have them. */
export function write(value: Json, indent = ""): string {
  const flat = writeFlat(value);
  if (typeof value !== "object" || value === null || flat.length + indent.length <= 100) return flat;
  const inner = `${indent}  `;
  if (Array.isArray(value)) return `[\n${value.map((item) => inner + write(item, inner)).join(",\n")}\n${indent}]`;
  const lines = Object.entries(value).map(([key, item]) => `${inner}${JSON.stringify(key)}: ${write(item, inner)}`);
  return `{\n${lines.join(",\n")}\n${indent}}`;
}

function writeFlat(value: Json): string {
  if (typeof value !== "object" || value === null) return JSON.stringify(value);
  if (Array.isArray(value)) return `[${value.map(writeFlat).join(", ")}]`;
  return `{${Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${writeFlat(item)}`).join(", ")}}`;
}

const indentOf = (text: string, at: number) => /^[ \t]*/.exec(text.slice(text.lastIndexOf("\n", at - 1) + 1))![0];

/** The edit that sets the value at `pointer`, makes objects on the way, or takes the member away for undefined; null where there
 * is nothing to do, or the pointer leads through something that has no such members. */
export function edit(text: string, root: Node, pointer: string, value: Json | undefined): Edit | null {
  const tokens = splitPointer(pointer);
  let node = root;
  for (let depth = 0; depth < tokens.length; ++depth) {
    const index = node.members?.findIndex((candidate) => candidate.key === tokens[depth]) ?? -1;
    if (index < 0) {
      if (value === undefined || !node.members) return null;
      if (Array.isArray(node.value) && Number(tokens[depth]) !== node.members.length) return null;
      let made = value;
      for (const token of tokens.slice(depth + 1).reverse()) made = {[token]: made};
      return append(text, node, tokens[depth], made);
    }
    if (depth === tokens.length - 1 && value === undefined) return removal(node, index);
    node = node.members![index].node;
  }
  if (value === undefined) return null;
  return {from: node.start, to: node.end, insert: write(value, indentOf(text, node.start))};
}

function append(text: string, parent: Node, key: string, value: Json): Edit {
  const outer = indentOf(text, parent.start);
  const many = text.slice(parent.start, parent.end).includes("\n");
  const named = Array.isArray(parent.value) ? "" : `${JSON.stringify(key)}: `;
  const last = parent.members!.at(-1);
  if (!many) {
    const member = named + write(value, outer);
    if (last) return {from: last.node.end, to: last.node.end, insert: `, ${member}`};
    return {from: parent.start + 1, to: parent.end - 1, insert: member};
  }
  const inner = last ? indentOf(text, last.start) : `${outer}  `;
  const member = `\n${inner}${named}${write(value, inner)}`;
  if (last) return {from: last.node.end, to: last.node.end, insert: `,${member}`};
  return {from: parent.start + 1, to: parent.end - 1, insert: `${member}\n${outer}`};
}

function removal(parent: Node, index: number): Edit {
  const members = parent.members!;
  const {start, node} = members[index];
  if (members.length === 1) return {from: parent.start + 1, to: parent.end - 1, insert: ""};
  if (index === members.length - 1) return {from: members[index - 1].node.end, to: node.end, insert: ""};
  return {from: start, to: members[index + 1].start, insert: ""};
}

export const apply = (text: string, change: Edit) => text.slice(0, change.from) + change.insert + text.slice(change.to);
export const lineOf = (text: string, at: number) => text.slice(0, at).split("\n").length;

/** Values as pointer -> text, leaves only. */
export function flatten(value: Json, pointer = "", into = new Map<string, string>()): Map<string, string> {
  const numbers = Array.isArray(value) && value.every((item) => typeof item !== "object" || item === null);
  if (typeof value === "object" && value !== null && !numbers) {
    for (const [key, item] of Object.entries(value)) flatten(item as Json, joinPointer(pointer, key), into);
  } else {
    into.set(pointer, writeFlat(value));
  }
  return into;
}

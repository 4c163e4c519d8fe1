// Where in a JSON text a JSON pointer (RFC 6901) leads.

const unescape = (token) => token.replaceAll("~1", "/").replaceAll("~0", "~");

/**
 * The place of the value that `pointer` names, or of its nearest ancestor that exists, as {start, end, line, exact}
 * (offsets in `text`; lines from 1). `text` must be valid JSON.
 */
export function locate(text, pointer) {
  const path = pointer.split("/").slice(1).map(unescape);
  let at = 0;
  let best = {depth: -1, start: 0, end: 0};

  const space = () => {
    while (at < text.length && /\s/.test(text[at])) ++at;
  };
  const string = () => {
    const start = at++;
    while (text[at] !== '"') at += text[at] === "\\" ? 2 : 1;
    ++at;
    return JSON.parse(text.slice(start, at));
  };
  const below = (depth, token) => (depth >= 0 && depth < path.length && path[depth] === token ? depth + 1 : -1);

  // `depth` tokens of the path led here; -1 off the path. `start` includes a member's key.
  function value(depth, start) {
    const close = {"{": "}", "[": "]"}[text[at]];
    if (text[at] === '"') string();
    else if (close) members(depth, close);
    else while (at < text.length && !/[\s,\]}]/.test(text[at])) ++at;
    if (depth > best.depth) best = {depth, start, end: at};
  }

  function members(depth, close) {
    ++at;
    space();
    for (let index = 0; text[at] !== close; ++index) {
      const start = at;
      let token = String(index);
      if (close === "}") {
        token = string();
        space();
        ++at;
        space();
      }
      value(below(depth, token), start);
      space();
      if (text[at] === ",") ++at;
      space();
    }
    ++at;
  }

  space();
  value(0, at);
  const line = text.slice(0, best.start).split("\n").length;
  return {start: best.start, end: best.end, line, exact: best.depth === path.length};
}

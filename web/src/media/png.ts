// The texts that Lather writes into its PNGs, as "lather:scene-json".

const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const largestText = 8 << 20;  // bytes, decompressed

export const isPng = (bytes: Uint8Array) => signature.every((byte, i) => bytes[i] === byte);

/** Keyword -> text of the tEXt and iTXt chunks. Throws Error where the file is no PNG, or cut off. */
export async function pngTexts(bytes: Uint8Array): Promise<Map<string, string>> {
  if (!isPng(bytes)) throw new Error("This is not a PNG.");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const texts = new Map<string, string>();
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at);
    const type = latin1(bytes.subarray(at + 4, at + 8));
    const content = bytes.subarray(at + 8, at + 8 + length);
    if (content.length < length) break;
    if (type === "IEND") return texts;
    if (type === "tEXt") readPlain(content, texts);
    if (type === "iTXt") await readInternational(content, texts);
    at += 12 + length;
  }
  throw new Error("This PNG is cut off.");
}

const latin1 = (bytes: Uint8Array) => Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
const utf8 = (bytes: Uint8Array) => new TextDecoder().decode(bytes);

function readPlain(content: Uint8Array, texts: Map<string, string>) {
  const zero = content.indexOf(0);
  if (zero > 0) texts.set(latin1(content.subarray(0, zero)), latin1(content.subarray(zero + 1)));
}

/** keyword 0, compressed?, method, language 0, translated keyword 0, text */
async function readInternational(content: Uint8Array, texts: Map<string, string>) {
  const keyword = content.indexOf(0);
  const language = content.indexOf(0, keyword + 3);
  const translated = content.indexOf(0, language + 1);
  if (keyword < 1 || language < 0 || translated < 0) return;
  const text = content.subarray(translated + 1);
  const name = latin1(content.subarray(0, keyword));
  texts.set(name, utf8(content[keyword + 1] === 1 ? await inflate(text) : text));
}

async function inflate(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
  const reader = stream.getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  while (true) {
    const {done, value} = await reader.read();
    if (done) break;
    size += value.length;
    if (size > largestText) {
      void reader.cancel();
      throw new Error("A text of this PNG is too large.");
    }
    parts.push(value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

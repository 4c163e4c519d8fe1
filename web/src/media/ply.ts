// Points of a binary PLY, as Lather writes them (docs/outputs.md), thinned where there are many.

export interface Cloud {
  count: number;  // in the file
  kept: number;
  positions: Float32Array;  // 3 a point
  material: Uint8Array;     // by point
  materials: string[];
  scalars: {name: string; unit: string; values: Float32Array}[];
}

const sizes: Record<string, number> = {
  char: 1, uchar: 1, int8: 1, uint8: 1, short: 2, ushort: 2, int16: 2, uint16: 2,
  int: 4, uint: 4, int32: 4, uint32: 4, float: 4, float32: 4, double: 8, float64: 8,
};

type Read = (view: DataView, at: number) => number;
const reads: Record<string, Read> = {
  char: (v, at) => v.getInt8(at), uchar: (v, at) => v.getUint8(at),
  short: (v, at) => v.getInt16(at, true), ushort: (v, at) => v.getUint16(at, true),
  int: (v, at) => v.getInt32(at, true), uint: (v, at) => v.getUint32(at, true),
  float: (v, at) => v.getFloat32(at, true), double: (v, at) => v.getFloat64(at, true),
};
const other: Record<string, string> = {
  int8: "char", uint8: "uchar", int16: "short", uint16: "ushort", int32: "int", uint32: "uint", float32: "float", float64: "double",
};

const notScalars = new Set(["x", "y", "z", "vx", "vy", "vz", "id", "material"]);

interface Head {
  count: number;
  stride: number;  // bytes a point
  properties: {name: string; type: string; at: number}[];
  units: Map<string, string>;
  materials: string[];
}

const unreadable = () => new Error("These are no points that the page can read.");

function readHead(text: string): Head {
  const head: Head = {count: NaN, stride: 0, properties: [], units: new Map(), materials: []};
  let inVertices = false;
  for (const line of text.split("\n")) {
    const part = line.split(" ");
    if (part[0] === "element") {
      inVertices = part[1] === "vertex";
      if (inVertices) head.count = Number(part[2]);
    } else if (part[0] === "property" && inVertices) {
      const type = other[part[1]] ?? part[1];
      if (!(type in sizes)) throw unreadable();
      head.properties.push({name: part[2], type, at: head.stride});
      head.stride += sizes[type];
    } else if (line.startsWith("comment lather material ")) {
      head.materials[Number(part[3])] = part.slice(4).join(" ");
    } else if (line.startsWith("comment lather scalar ")) {
      head.units.set(part[3], part.slice(4).join(" "));
    }
  }
  if (!Number.isInteger(head.count) || head.count < 0 || head.stride === 0) throw unreadable();
  return head;
}

/** Reads a file piece by piece and keeps every n-th point, so that at most `most` are ever held. */
export class PlyReader {
  private begun = new Uint8Array(0);  // the head, until it is whole; then what has come of the next point
  private head: Head | null = null;
  private rows = new Uint8Array(0);
  private kept = 0;
  private step = 1;
  private seen = 0;  // whole points

  constructor(private readonly most: number) {}

  /** Throws Error where the file is none of Lather's. */
  push(piece: Uint8Array) {
    const bytes = this.begun.length > 0 ? joined(this.begun, piece) : piece;
    const rest = this.head ? bytes : this.takeHead(bytes);
    if (!this.head) return;
    const {count, stride} = this.head;
    let at = 0;
    for (; rest.length - at >= stride && this.seen < count; at += stride, ++this.seen) {
      if (this.seen % this.step !== 0) continue;
      this.rows.set(rest.subarray(at, at + stride), this.kept * stride);
      ++this.kept;
    }
    this.begun = rest.slice(at);
  }

  /** The points, when all has come. Throws Error where the file is cut off. */
  finish(): Cloud {
    if (!this.head) throw unreadable();
    if (this.seen < this.head.count) throw new Error("The file of points is cut off.");
    return columns(this.head, this.rows, this.kept);
  }

  private takeHead(bytes: Uint8Array): Uint8Array {
    const text = new TextDecoder("latin1").decode(bytes.subarray(0, 65536));
    const end = text.indexOf("end_header\n");
    if (end < 0 && bytes.length < 65536) {
      this.begun = bytes.slice();
      return bytes;
    }
    if (end < 0 || !text.startsWith("ply\n") || !text.includes("format binary_little_endian")) throw unreadable();
    this.head = readHead(text.slice(0, end));
    this.step = Math.max(1, Math.ceil(this.head.count / this.most));
    this.rows = new Uint8Array(Math.ceil(this.head.count / this.step) * this.head.stride);
    return bytes.subarray(end + "end_header\n".length);
  }
}

function joined(a: Uint8Array, b: Uint8Array): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(a.length + b.length);
  all.set(a);
  all.set(b, a.length);
  return all;
}

function columns({count, stride, properties, units, materials}: Head, rows: Uint8Array, kept: number): Cloud {
  const view = new DataView(rows.buffer, rows.byteOffset, rows.byteLength);
  const find = (name: string) => properties.find((property) => property.name === name);
  const column = (name: string, to: Float32Array | Uint8Array, width: number, offset: number) => {
    const property = find(name);
    if (!property) return;
    const read = reads[property.type];
    for (let i = 0; i < kept; ++i) to[i * width + offset] = read(view, i * stride + property.at);
  };
  const positions = new Float32Array(3 * kept);
  ["x", "y", "z"].forEach((name, axis) => column(name, positions, 3, axis));
  const material = new Uint8Array(kept);
  column("material", material, 1, 0);
  const scalars = properties.filter(({name}) => !notScalars.has(name)).map(({name}) => {
    const values = new Float32Array(kept);
    column(name, values, 1, 0);
    return {name, unit: units.get(name) ?? "", values};
  });
  if (!scalars.some(({name}) => name === "speed") && find("vx")) {
    const velocity = new Float32Array(3 * kept);
    ["vx", "vy", "vz"].forEach((name, axis) => column(name, velocity, 3, axis));
    const values = new Float32Array(kept);
    for (let i = 0; i < kept; ++i) values[i] = Math.hypot(velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]);
    scalars.push({name: "speed", unit: "m/s", values});
  }
  return {count, kept, positions, material, materials, scalars};
}

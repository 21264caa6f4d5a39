// The binary answers of the server (docs/live.md, "HTTP").
const HEAD = 8, FRAME_HEAD = 96, PART = 32, MOVED = 32, LARGEST = 1 << 30;

const name = (bytes, at) => String.fromCharCode(...bytes.subarray(at, at + 4));

// Collects the records of GET /frames from pieces of any length. Two buffers are used in turns: a frame stays valid
// until the one after the next is complete.
export class RecordReader {
  constructor(onFrame) {
    this.onFrame = onFrame;
    this.head = new Uint8Array(HEAD);
    this.buffers = [new Uint8Array(0), new Uint8Array(0)];
    this.restart();
  }

  restart() {
    this.filled = 0; // bytes of the record so far
    this.size = 0; // of the record; 0: not known
  }

  // Throws for bytes that are not records.
  add(piece) {
    let at = 0;
    while (at < piece.length) {
      if (this.filled < HEAD) {
        const count = Math.min(HEAD - this.filled, piece.length - at);
        this.head.set(piece.subarray(at, at + count), this.filled);
        this.filled += count;
        at += count;
        if (this.filled === HEAD) this.begin();
        continue;
      }
      const count = Math.min(this.size - this.filled, piece.length - at);
      this.buffers[0].set(piece.subarray(at, at + count), this.filled);
      this.filled += count;
      at += count;
      if (this.filled === this.size) this.finish();
    }
  }

  begin() {
    this.size = new DataView(this.head.buffer).getUint32(4, true);
    if (this.size < 16 || this.size > LARGEST) throw new Error('not a stream of frames');
    if (this.buffers[0].length < this.size) this.buffers[0] = new Uint8Array(Math.ceil(1.2 * this.size));
    this.buffers[0].set(this.head, 0);
  }

  finish() {
    const bytes = this.buffers[0].subarray(0, this.size);
    this.restart();
    if (name(bytes, 0) !== 'SBF1') return;
    this.buffers.reverse();
    this.onFrame(readFrame(bytes));
  }
}

function readFrame(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const u32 = (at) => view.getUint32(at, true), f64 = (at) => view.getFloat64(at, true);
  const frame = {
    time: f64(8), step: f64(16), number: f64(24), run: f64(32), spacing: f64(40), quantum: f64(48),
    speedMax: f64(56), pressureMax: f64(64), count: u32(72), decimation: u32(76), parts: [], moved: [],
  };
  const parts = u32(80), moved = u32(84), points = FRAME_HEAD + PART * parts + MOVED * moved;
  if (points + 8 * frame.count !== bytes.length) throw new Error('a frame has a wrong size');
  for (let p = 0, at = FRAME_HEAD; p < parts; p++, at += PART) {
    const part = { first: u32(at), count: u32(at + 4), corner: [f64(at + 8), f64(at + 16), f64(at + 24)] };
    const last = frame.parts[frame.parts.length - 1];
    // Parts with the same corner are drawn at once.
    if (last && last.corner.every((value, k) => value === part.corner[k])) last.count += part.count;
    else frame.parts.push(part);
  }
  for (let m = 0, at = FRAME_HEAD + PART * parts; m < moved; m++, at += MOVED)
    frame.moved.push({ body: u32(at), by: [f64(at + 8), f64(at + 16), f64(at + 24)] });
  frame.points = bytes.subarray(points);
  return frame;
}

export function readScene(buffer) {
  const bytes = new Uint8Array(buffer);
  if (bytes.length < HEAD || name(bytes, 0) !== 'SBS1') throw new Error('not a scene');
  const length = new DataView(buffer).getUint32(4, true);
  const scene = JSON.parse(new TextDecoder().decode(bytes.subarray(HEAD, HEAD + length)));
  let at = HEAD + length;
  for (const body of scene.bodies) {
    body.mesh = new Float32Array(buffer, at, 3 * body.vertices);
    at += 12 * body.vertices;
    body.corners = new Uint32Array(buffer, at, 3 * body.triangles);
    at += 12 * body.triangles;
  }
  return scene;
}

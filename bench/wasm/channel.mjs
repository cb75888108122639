// The common part of the drivers of engines in WebAssembly. roam-bench runs this script with one driver appended:
//   node --input-type=module --eval TEXT DIR        DIR holds node_modules
// Little endian. Input, descriptor 3: u32 vertices, u32 triangles, f32 x y z of each vertex, u32 a b c of each
// triangle. Then, until the end, u32 n and n questions of 8 f64; those of a sweep are radius, half height, from,
// motion. Output, descriptor 4: u32 length and a JSON text of that length. Then for each question its reply and
// nanoseconds, f64; the reply to a sweep is the time of impact, 2 if free.
import { readFileSync, readSync, writeSync } from 'node:fs';
import { performance as clock } from 'node:perf_hooks';
import { pathToFileURL } from 'node:url';

const modules = process.argv[1] + '/node_modules/';

function read(bytes) {
  const buffer = new ArrayBuffer(bytes);
  const view = new Uint8Array(buffer);
  for (let done = 0; done < bytes;) {
    const got = readSync(3, view, done, Math.min(bytes - done, 1 << 30));
    if (got === 0) process.exit(0);
    done += got;
  }
  return buffer;
}

function write(view) {
  for (let done = 0; done < view.byteLength;) done += writeSync(4, view, done);
}

function median(values) {
  return values.sort((a, b) => a - b)[values.length >> 1];
}

// The cost of an empty pair of readings, milliseconds.
function emptyPair() {
  const empty = [];
  for (let i = 0; i < 1001; ++i) {
    const before = clock.now();
    empty.push(clock.now() - before);
  }
  return median(empty);
}

// Reads the scene, builds it, and sends the result of make(vertices, indices), which has {name, used, bytes}.
async function begin(start, make) {
  const [vertexCount, triangleCount] = new Uint32Array(read(8));
  const vertices = new Float32Array(read(12 * vertexCount));
  const indices = new Uint32Array(read(12 * triangleCount));
  await start();
  const before = clock.now();
  const made = make(vertices, indices);
  const { name, used, bytes } = made;
  const about = new TextEncoder().encode(JSON.stringify({ name, used, bytes, build_s: 1e-3 * (clock.now() - before) }));
  write(new Uint8Array(Uint32Array.of(about.length).buffer));
  write(about);
  return made;
}

// Replies to questions until the end of input. answer(numbers, at, answers, to) takes eight numbers and gives `width`;
// their nanoseconds follow.
function serve(width, answer) {
  for (;;) {
    const [count] = new Uint32Array(read(4));
    const questions = new Float64Array(read(64 * count));
    const answers = new Float64Array((width + 1) * count);
    const empty = emptyPair();
    for (let i = 0; i < count; ++i) {
      const before = clock.now();
      answer(questions, 8 * i, answers, (width + 1) * i);
      const after = clock.now();
      answers[(width + 1) * i + width] = Math.max(0, 1e6 * (after - before - empty));
    }
    write(new Uint8Array(answers.buffer));
  }
}

// What session.c does, with the module in Node: session.mjs MODULE.js INPUT OUTPUT
import fs from 'node:fs';
import {createRequire} from 'node:module';

const [module, input, output] = process.argv.slice(2);
const create = createRequire(import.meta.url)(fs.realpathSync(module));
const library = await create({wasmBinary: fs.readFileSync(module.replace(/js$/, 'wasm'))});
const scene = library._scene_create_vessel();
const count = library._malloc(4);
const states = [];

/** The bytes of what get(scene, &count) gives, and how many things these are. */
function read(get, size) {
  const pointer = get(scene, count);
  const things = library.HEAPU32[count >> 2];
  return {things, bytes: library.HEAPU8.slice(pointer, pointer + size * things)};
}

let steps = 0;
const start = performance.now();
for (const line of fs.readFileSync(input, 'utf8').trim().split('\n')) {
  const [times, push, turn, beat, cut] = line.split(' ').map(Number);
  if (cut && !library._scene_cut(scene)) {
    console.log(`step ${steps}: no cut: ${library.UTF8ToString(library._scene_message())}`);
  }
  for (let step = 0; step < times; ++step, ++steps) {
    if (!library._scene_step(scene, push, turn, beat)) {
      throw new Error(library.UTF8ToString(library._scene_message()));
    }
    const wire = read(library._scene_get_wire, 24);
    const contacts = read(library._scene_get_contacts, 72);
    states.push(new Uint8Array(Uint32Array.of(wire.things, contacts.things).buffer), wire.bytes, contacts.bytes);
  }
}
console.log(`${steps} steps of ${((performance.now() - start) / steps).toFixed(2)} ms, ${library.HEAPU8.length / 1e6} MB of memory`);
library._scene_destroy(scene);
fs.writeFileSync(output, Buffer.concat(states));

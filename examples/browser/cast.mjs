// The C API from JavaScript: a cube, a segment, and where it leaves the cube. cast.mjs MODULE.js
import fs from 'node:fs';
import {createRequire} from 'node:module';

const path = fs.realpathSync(process.argv[2]);
const create = createRequire(import.meta.url)(path);
const dsw = await create({wasmBinary: fs.readFileSync(path.replace(/js$/, 'wasm'))});

/** Copies numbers into the memory of the module. The caller frees them. */
function place(numbers) {
  const at = dsw._malloc(numbers.byteLength);
  dsw.HEAPU8.set(new Uint8Array(numbers.buffer), at);
  return at;
}

function check(status) {
  if (status !== 0) { // DSW_STATUS_OK
    throw new Error(`${dsw.UTF8ToString(dsw._dsw_status_string(status))}: ${dsw.UTF8ToString(dsw._dsw_last_error_message())}`);
  }
}

// Pointers and size_t have 4 bytes, so a struct's offsets are those of a 32-bit machine.
const DESC = {size: 76, index_bytes: 12, points: 16, point_count: 20, volume_count: 32, connectivity: 40, connectivity_count: 44};
const FLIGHT = {size: 128, position: 0, time: 24, normal: 32, outcome: 120};
const OUTCOMES = ['none', 'reached', 'contact', 'work limit', 'outside', 'impassable'];

const points = place(Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1));
const corners = place(Int32Array.of(0, 1, 2, 3, 4, 5, 6, 7));
const desc = dsw._malloc(DESC.size);
dsw._dsw_environment_desc_init(desc, DESC.size);
for (const [member, value] of Object.entries(
    {index_bytes: 4, points, point_count: 8, volume_count: 1, connectivity: corners, connectivity_count: 8})) {
  dsw.HEAPU32[desc + DESC[member] >> 2] = value;
}
const handle = dsw._malloc(4);
check(dsw._dsw_environment_create(0, desc, handle, 0));
const environment = dsw.HEAPU32[handle >> 2];

// A struct that is passed by value is passed as an address: here the null id of a volume.
const start = place(Uint32Array.of(0, 0));
const from = place(Float64Array.of(0.5, 0.5, 0.5));
const to = place(Float64Array.of(0.5, 0.5, 2.5));
const flight = dsw._malloc(FLIGHT.size);
check(dsw._dsw_environment_cast(environment, start, from, to, 0, flight));
const numbers = (member, count) => Array.from(dsw.HEAPF64.slice(flight + member >> 3, (flight + member >> 3) + count));
const answer = {
  outcome: OUTCOMES[dsw.HEAPU32[flight + FLIGHT.outcome >> 2]],
  position: numbers(FLIGHT.position, 3),
  time: numbers(FLIGHT.time, 1)[0],
  normal: numbers(FLIGHT.normal, 3),
};
console.log(JSON.stringify(answer));

check(dsw._dsw_environment_destroy(environment));
[points, corners, desc, handle, start, from, to, flight].forEach(at => dsw._free(at));
if (JSON.stringify(answer) !== '{"outcome":"contact","position":[0.5,0.5,1],"time":0.25,"normal":[0,0,-1]}') {
  throw new Error('the segment should leave the cube after a quarter of its way');
}

// What the package must leave to its host, by the addon or by the module of WebAssembly: globals, memory that grows, and the end of the
// process.
'use strict';
const assert = require('node:assert/strict');
const globals = Object.getOwnPropertyNames(globalThis);
const dsw = require('dartsweep');

assert.deepEqual(Object.getOwnPropertyNames(globalThis), globals);
assert.equal(typeof fetch, 'function');

const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
const environment = new dsw.Environment(points, [0, 1, 2, 3, 4, 5, 6, 7], { type: dsw.CellType.Hexahedron });
// The arrays that are read are 2.2 GB in all, more than a module of WebAssembly can hold at once.
const many = new Float64Array(120000).fill(0.5);
let { volumes } = environment.locatePoints(many);
for (let i = 0; i < 1700; ++i) volumes = environment.locatePoints(many.slice(), volumes).volumes;
assert.equal(volumes.length, 40000);

const growing = new ArrayBuffer(24, { maxByteLength: 1 << 20 });
if (growing.resizable) {
  environment.locatePoints(new Float64Array(growing).fill(0.5));
  growing.resize(480000);
  assert.equal(environment.locatePoints(new Float64Array(growing).fill(0.5)).volumes.length, 20000);
}

process.on('exit', () => {
  environment.close();
  assert.throws(() => environment.cast([0, 0, 0], [1, 1, 1]), dsw.ClosedError);
  console.log('a host is left as it was');
});

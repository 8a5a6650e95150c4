'use strict';
const assert = require('node:assert/strict');
const { test } = require('node:test');
const dsw = require('dartsweep');

const { VertexFace, EdgeEdge, VertexEdge } = dsw.PairKind;
const triangle = [0, 0, 0, 1, 0, 0, 0, 1, 0];
const kinds = [VertexFace, EdgeEdge, VertexFace];

// Points of three pairs whose first features are at these heights.
const at = (first, second, third) => [
  ...[0.25, 0.25, first, ...triangle],
  ...[-1, 0.25, second, 1, 0.25, second, 0, -1, 0, 0, 1, 0],
  ...[0.5, 0.25, third, ...triangle],
];
const from = at(1, 1, 1);

test('times and ranks of pairs are exact', () => {
  const touches = dsw.sweepPairs(3, kinds, from, at(-2, -2, -1), { flags: dsw.PAIRS_RANK });
  assert.deepEqual(touches.toArray(), [
    { time: 1 / 3, touches: 1, rank: 0 },
    { time: 1 / 3, touches: 1, rank: 0 },
    { time: 0.5, touches: 1, rank: 2 },
  ]);
  const context = new dsw.Context({ threads: 2 });
  const later = new Float64Array(at(-2 + 2 ** -52, -2, 2));
  const given = { flags: dsw.PAIRS_RANK, touches, context };
  assert.equal(dsw.sweepPairs(3, Uint8Array.from(kinds), new Float64Array(from), later, given), touches);
  assert.deepEqual(touches.toArray(), [
    { time: 1 / 3, touches: 1, rank: 1 },
    { time: 1 / 3, touches: 1, rank: 0 },
    { time: 0, touches: 0, rank: 2 },
  ]);
});

test('pairs of the plane touch', () => {
  const [touch] = dsw.sweepPairs(2, [VertexEdge], [0.5, 1, 0, 0, 1, 0], [0.5, -1, 0, 0, 1, 0]);
  assert.deepEqual(touch, { time: 0.5, touches: 1, rank: 0 });
  assert.equal(dsw.sweepPairs(3, [], [], []).length, 0);
});

test('wrong pairs are refused', () => {
  const to = at(-2, -2, -1);
  assert.throws(() => dsw.sweepPairs(3, [VertexFace, VertexEdge, EdgeEdge], from, to), dsw.UnsupportedError);
  assert.throws(() => dsw.sweepPairs(4, kinds, from, to), dsw.OutOfRangeError);
  assert.throws(() => dsw.sweepPairs(2, kinds, from, to), dsw.WrongSizeError);
  assert.throws(() => dsw.sweepPairs(3, kinds, from, to.slice(12)), dsw.WrongSizeError);
  assert.throws(() => dsw.sweepPairs(3, kinds, from, to, { touches: new dsw.PairTouchArray(2) }), dsw.WrongSizeError);
  assert.throws(() => dsw.sweepPairs(3, kinds, from, at(NaN, 0, 0)), dsw.NonFiniteError);
  assert.throws(() => dsw.sweepPairs(3, [256, 0, 0], from, to), RangeError);
});

test('features turn', () => {
  const motion = [0, 0, 0, 1, 0, 0, 1, 0, ...Array(9).fill(0)]; // half a turn about z, from -y over x to y
  const touchOf = (far, second) => dsw.sweepRigidPairs(2, [VertexEdge], [0, -5, far, -9, far, 9], [], motion, [0, second]).toArray()[0];
  assert.deepEqual(touchOf(3, 0xffffffff), { time: 0.25, touches: 1, rank: 0 });
  assert.equal(touchOf(5.5, 0xffffffff).touches, 0);
  assert.equal(touchOf(3, 0).touches, 0);
  assert.throws(() => touchOf(1, 1), dsw.OutOfRangeError);
  assert.throws(() => dsw.sweepRigidPairs(2, [VertexEdge], [0, -1, 1, -3, 1, 3], [], motion.slice(1), [0, 0]), dsw.WrongSizeError);
});

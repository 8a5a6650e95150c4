'use strict';
const assert = require('node:assert/strict');
const fs = require('node:fs');
const { test } = require('node:test');
const { Worker, isMainThread, parentPort } = require('node:worker_threads');
const { play } = require('./scenario.js');

if (isMainThread) {
  const expected = fs.readFileSync(process.env.DSW_SCENARIO, 'utf8');

  test('all bits are those of C', () => assert.equal(play(), expected));

  test('workers play it at the same time, with the same bits', async () => {
    const results = await Promise.all(
      Array.from({ length: 4 }, () =>
        new Promise((resolve, reject) => new Worker(__filename).once('message', resolve).once('error', reject))),
    );
    assert.deepEqual(results, Array(4).fill(expected));
  });
} else {
  parentPort.postMessage(play());
}

'use strict';
const assert = require('node:assert/strict');
const fs = require('node:fs');
const path = require('node:path');
const { test } = require('node:test');
const dsw = require('dartsweep');

const folder = path.dirname(require.resolve('dartsweep'));

test('import gives the same names as require', async () => {
  const { default: all, ...named } = await import('dartsweep');
  assert.equal(all, dsw);
  assert.deepEqual({ ...named }, dsw);
});

test('every method has its type, and every type its method', () => {
  const types = fs.readFileSync(path.join(folder, 'index.d.ts'), 'utf8');
  const structs = fs.readFileSync(path.join(folder, 'structs.d.ts'), 'utf8');
  const numbers = [.../^export interface ChangeNumbers \{\n(.*?)^\}/ms.exec(structs)[1].matchAll(/^  (\w+):/gm)].map((match) => match[1]);
  for (const name of ['Environment', 'Change', 'Scene', 'Body', 'Trace']) {
    const text = new RegExp(`^export class ${name} \\{\n(.*?)^\\}`, 'ms').exec(types)[1];
    const declared = new Set([...text.matchAll(/^  (?:static )?(\w+)\(/gm)].map((match) => match[1]));
    if (name === 'Change') for (const number of numbers) declared.add(number);
    const present = new Set(['constructor']);
    for (let type = dsw[name]; type.name !== 'SwigObject'; type = Object.getPrototypeOf(type))
      for (const key of [...Object.keys(Object.getOwnPropertyDescriptors(type.prototype)), ...Object.getOwnPropertyNames(type)]) present.add(key);
    for (const key of ['arguments', 'caller', 'createBodyId', 'length', 'name', 'prototype', 'toString']) present.delete(key);
    assert.deepEqual([...present].sort(), [...declared.add('constructor')].sort(), name);
  }
});

test('the version is that of the headers', () => {
  assert.equal(dsw.version(), 1000000 * dsw.VERSION_MAJOR + 1000 * dsw.VERSION_MINOR + dsw.VERSION_PATCH);
  assert.equal(require(path.join(folder, '../package.json')).version, [dsw.VERSION_MAJOR, dsw.VERSION_MINOR, dsw.VERSION_PATCH].join('.'));
});

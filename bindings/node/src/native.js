// The addon, told how structs and errors look: convert.h calls these functions.
'use strict';
const { hooks, native } = require('./addon.js');
const { errorOf } = require('./errors.js');
const { StructArray, arrays, write } = require('./memory.js');
const { structs } = require('./structs.js');

const kinds = Object.values(structs);

function listOf(struct, value) {
  if (value.constructor.struct !== struct) throw new TypeError(`${struct.name}Array is needed, not ${value.constructor.name}`);
  return new Uint8Array(value.buffer);
}

native.setHooks({
  ...hooks,
  error: errorOf,
  encode(kind, value, memory) {
    write(kinds[kind], new DataView(memory), 0, value);
  },
  readable(kind, value) {
    const struct = kinds[kind];
    if (value instanceof StructArray) return listOf(struct, value);
    if (!Array.isArray(value)) throw new TypeError(`${struct.name}Array, or an array of them, is needed`);
    return new Uint8Array(new arrays[`${struct.name}Array`](value).buffer);
  },
  writable(kind, value) {
    const struct = kinds[kind];
    if (!(value instanceof StructArray)) throw new TypeError(`${struct.name}Array is needed`);
    return listOf(struct, value);
  },
  decode: (kind, memory) => kinds[kind].read(new DataView(memory), 0),
  list: (kind, memory) => new arrays[`${kinds[kind].name}Array`](memory),
});

module.exports = native;

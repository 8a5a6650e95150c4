// Structs of C in memory of JavaScript: written from plain objects, and in lists that calls read and fill in place.
'use strict';
const { Id } = require('./ids.js');
const { structs, lists } = require('./structs.js');

const LIMITS = { Int32: [-(2 ** 31), 2 ** 31 - 1], Uint32: [0, 2 ** 32 - 1], BigUint64: [0, Number.MAX_SAFE_INTEGER] };

function writeNumber(type, view, at, value, name) {
  if (typeof value !== 'number') throw new TypeError(`${name} must be a number`);
  if (type in LIMITS && !(Number.isInteger(value) && value >= LIMITS[type][0] && value <= LIMITS[type][1]))
    throw new RangeError(`${name} is ${value}, must be a whole number from ${LIMITS[type][0]} to ${LIMITS[type][1]}`);
  view[`set${type}`](at, type === 'BigUint64' ? BigInt(value) : value, true);
}

function sizeOf(type) {
  return type in structs ? structs[type].size : type === 'Uint32' || type === 'Int32' ? 4 : 8;
}

function writeMember(type, dims, view, at, value, name) {
  if (dims.length === 0) {
    if (type in structs) write(structs[type], view, at, value, name);
    else writeNumber(type, view, at, value, name);
    return;
  }
  const [count, ...rest] = dims;
  if (value?.length !== count) throw new TypeError(`${name} must have ${count} entries`);
  const step = rest.reduce((size, dim) => size * dim, sizeOf(type));
  for (let i = 0; i < count; ++i) writeMember(type, rest, view, at + i * step, value[i], `${name}[${i}]`);
}

// Members that `value` has not stay as they are; null is the null id.
function write(struct, view, at, value, name = struct.name) {
  if (struct.name === 'Vec3') {
    writeMember('Float64', [3], view, at, value, name);
    return;
  }
  const isId = struct.name.endsWith('Id');
  if (isId && value === null) {
    new Uint8Array(view.buffer, at, struct.size).fill(0);
    return;
  }
  if (typeof value !== 'object' || value === null || (value instanceof Id && value.constructor.name !== struct.name))
    throw new TypeError(`${name} must be of type ${struct.name}`);
  for (const key of Object.keys(value))
    if (!struct.fields.some(([field]) => field === key)) throw new TypeError(`${name} has no member '${key}'`);
  for (const [field, offset, type, dims] of struct.fields) {
    const member = value[field];
    if (member !== undefined) writeMember(type, dims, view, at + offset, member, `${name}.${field}`);
    else if (isId) throw new TypeError(`${name} must be of type ${struct.name}`);
  }
}

// The base of VolumeIdArray, FlightArray and so on.
class StructArray {
  // Makes an array of a number of entries, of the memory of another array (which may be from another thread), or of
  // values.
  constructor(source) {
    const { size } = this.constructor.struct;
    if (typeof source === 'number') {
      if (!Number.isInteger(source)) throw new RangeError(`${this.constructor.name} has a whole number of entries, not ${source}`);
      this.buffer = new ArrayBuffer(size * source);
    } else if (source instanceof ArrayBuffer || source instanceof SharedArrayBuffer) {
      if (source.byteLength % size !== 0) throw new RangeError(`memory of ${this.constructor.name} is a multiple of ${size} bytes`);
      this.buffer = source;
    } else {
      const values = [...source];
      this.buffer = new ArrayBuffer(size * values.length);
      values.forEach((value, i) => this.set(i, value));
    }
  }

  get length() {
    return this.buffer.byteLength / this.constructor.struct.size;
  }

  // undefined beyond the end, as of an array; negative ones count from the end.
  at(index) {
    const { length } = this;
    const entry = index < 0 ? length + index : index;
    if (!(entry >= 0 && entry < length)) return undefined;
    const { struct } = this.constructor;
    return struct.read(new DataView(this.buffer), struct.size * Math.trunc(entry));
  }

  set(index, value) {
    if (!(Number.isInteger(index) && index >= 0 && index < this.length)) throw new RangeError(`index ${index} beyond the array`);
    const { struct } = this.constructor;
    write(struct, new DataView(this.buffer), struct.size * index, value);
  }

  *[Symbol.iterator]() {
    const { struct } = this.constructor;
    const view = new DataView(this.buffer);
    for (let at = 0; at < view.byteLength; at += struct.size) yield struct.read(view, at);
  }

  toArray() {
    return [...this];
  }
}

const arrays = {};
for (const name of lists) {
  const type = { [`${name}Array`]: class extends StructArray {} }[`${name}Array`];
  type.struct = structs[name];
  arrays[type.name] = type;
}

module.exports = { StructArray, arrays, write };

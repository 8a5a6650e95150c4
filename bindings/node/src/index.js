// The package dartsweep: see README.md, and index.d.ts for all that is in it.
'use strict';
const { Context, Environment, Trace, sweepPairs, sweepRigidPairs } = require('./environment.js');
const { classes } = require('./errors.js');
const { StructArray, arrays } = require('./memory.js');
const native = require('./native.js');
const { Body, Scene } = require('./scene.js');
const { constants, enums, ids } = require('./structs.js');

// Makes an enum as TypeScript does: it also holds the names of its values.
function enumOf(values) {
  const names = Object.fromEntries(Object.entries(values).map(([name, value]) => [value, name]));
  return Object.freeze({ ...names, ...values });
}

function cellOf(id) {
  const kind = enums.CellKind[/^(Vertex|Edge|Face|Volume)Id$/.exec(id?.constructor.name)?.[1]];
  if (kind === undefined) throw new TypeError('an id of a vertex, an edge, a face or a volume is needed');
  return { kind, index: id.index ?? id.volume, generation: id.generation, local: id.local ?? 0 };
}

// `using`, where it is there.
if (Symbol.dispose) {
  for (const { prototype } of [Environment, Scene]) {
    Object.defineProperty(prototype, Symbol.dispose, { value: prototype.close, writable: true, configurable: true });
  }
}

module.exports = {
  Body,
  Change: native.Change,
  Context,
  Environment,
  Scene,
  StructArray,
  Trace,
  cellOf,
  statusString: native.statusString,
  sweepPairs,
  sweepRigidPairs,
  version: native.version,
  ...arrays,
  ...classes,
  ...constants,
  ...Object.fromEntries(Object.entries(enums).map(([name, values]) => [name, enumOf(values)])),
  ...ids,
};

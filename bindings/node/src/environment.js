// Environments and their context, and what needs no environment: what SWIG made, with options by name and results made rather than filled.
'use strict';
const { arrays } = require('./memory.js');
const native = require('./native.js');
const { enums } = require('./structs.js');

// Cells that are only in the plane.
const planar = [enums.CellType.Triangle, enums.CellType.Quad, enums.CellType.Polygon];

class Context extends native.Context {
  constructor({ threads = 0, log } = {}) {
    if (log !== undefined && typeof log !== 'function') throw new TypeError('log must be a function');
    super(threads, log);
  }
}

class Environment extends native.Environment {
  constructor(points, cells, { type, types, offsets, regions, tags, faces, faceLocations, context = null, ...desc } = {}) {
    if (type !== undefined) desc.uniformCellType = type;
    if (planar.includes(type)) desc.dimension = 2;
    super(points, cells, offsets, types, regions, tags, faces, faceLocations, desc, context);
  }

  static load(block, context = null) {
    return Object.setPrototypeOf(super.load(block, context), this.prototype);
  }

  coarsen(options, volumeMap) {
    return Object.setPrototypeOf(super.coarsen(options, volumeMap), Environment.prototype);
  }

  locatePoints(points, hints) {
    const volumes = new arrays.VolumeIdArray(Math.trunc(points.length / this.dimension()));
    const locations = new Int32Array(volumes.length);
    super.locatePoints(points, hints, volumes, locations);
    return { volumes, locations };
  }

  findSignedDistances(points, { distances = new Float64Array(points.length / this.dimension()), nearest } = {}) {
    super.findSignedDistances(points, distances, nearest);
    return distances;
  }

  cast(from, to, { start = null, ...options } = {}) {
    return super.cast(from, to, start, options);
  }

  castPath(from, to, { start = null, ...options } = {}) {
    return super.castPath(from, to, start, options);
  }

  // {fillers}

  markVolumes(volumes, mark, flags = 0) {
    return super.markVolumes(volumes, mark, flags);
  }

  markRegion(region, mark, flags = 0) {
    return super.markRegion(region, mark, flags);
  }

  addVolumes(points, cells, { type, types, vertices, offsets, regions, tags, sewTo, ...desc } = {}) {
    if (type !== undefined) desc.uniformCellType = type;
    return super.addVolumes(vertices, points, cells, offsets, types, regions, tags, sewTo, desc);
  }

  remesh({ volumes, next, ...desc } = {}) {
    return super.remesh(volumes, next, desc);
  }
}

function sweepPairs(dimension, kinds, from, to, { flags = 0, touches = new arrays.PairTouchArray(kinds.length), context = null } = {}) {
  native.sweepPairs(dimension, kinds, from, to, touches, flags, context);
  return touches;
}

function sweepRigidPairs(dimension, kinds, from, to, motions, indices, options = {}) {
  const { flags = 0, touches = new arrays.PairTouchArray(kinds.length), context = null } = options;
  native.sweepRigidPairs(dimension, kinds, from, to, motions, indices, touches, flags, context);
  return touches;
}

class Trace extends native.Trace {
  addVolumes(environment, volumes, label = 0) {
    super.addVolumes(environment, volumes, label);
  }

  addImpassable(environment, withBoundary = false, label = 0) {
    super.addImpassable(environment, withBoundary, label);
  }

  addWalk(environment, from, to, { normalLength = 0, label = 0, start = null, ...options } = {}) {
    super.addWalk(environment, from, to, normalLength, label, start, options);
  }

  addContact(flight, normalLength = 0, label = 0) {
    super.addContact(flight, normalLength, label);
  }
}

module.exports = { Context, Environment, Trace, sweepPairs, sweepRigidPairs };

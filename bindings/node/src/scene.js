// Scenes and their bodies, as in environment.js.
'use strict';
const { arrays } = require('./memory.js');
const native = require('./native.js');

class Body extends native.Body {
  // The positions of all vertices by index, in an array of their own unless one is given to be filled.
  getPositions(positions = new Float64Array(this.dimension() * this.getCounts().vertexSlots), volumes) {
    super.getPositions(positions, volumes);
    return positions;
  }

  move(targets, { order, ...options } = {}) {
    return super.move(targets, options, order);
  }

  moveRigid(motion, { order, ...options } = {}) {
    return super.moveRigid(motion, options, order);
  }

  findFreeFractions(centre, poses, indices, { offsets, fractions, contacts } = {}) {
    const count = offsets ? offsets.length - 1 : Math.trunc(indices.length / 2);
    const found = fractions ?? new arrays.FreeFractionArray(count);
    super.findFreeFractions(centre, poses, indices, offsets, found, contacts);
    return found;
  }
}

// Gives the ids of bodies; ids may stand among the bodies.
function idsOf(bodies) {
  return Array.isArray(bodies) ? bodies.map((body) => (body instanceof Body ? body.id() : body)) : bodies;
}

class Scene extends native.Scene {
  static load(environment, block) {
    return Object.setPrototypeOf(super.load(environment, block), this.prototype);
  }

  // {fillers}

  getParticlePositions(particles) {
    const positions = new Float64Array(this.dimension() * particles.length);
    const volumes = new arrays.VolumeIdArray(particles.length);
    super.getParticlePositions(particles, positions, volumes);
    return { positions, volumes };
  }

  cast(from, to, { starts, ...options } = {}) {
    const count = from.length / this.dimension();
    const flights = new arrays.FlightArray(count), partners = new arrays.ContactPartnerArray(count);
    super.cast(from, to, starts, options, flights, partners);
    return { flights, partners };
  }

  findNearest(points, radius = Infinity, { hints, volumes, locations } = {}) {
    const count = points.length / this.dimension();
    const nearest = new arrays.NearestArray(count), partners = new arrays.ContactPartnerArray(count);
    super.findNearest(points, radius, hints, nearest, partners, volumes, locations);
    return { nearest, partners };
  }

  moveRigid(bodies, motions, { reports = new arrays.MoveReportArray(bodies.length), ...options } = {}) {
    super.moveRigid(idsOf(bodies), motions, options, reports);
    return reports;
  }

  stepFraction(bodies, steps, { environmentSteps, ...options } = {}) {
    const places = new Float64Array(steps.length), fractions = new Float64Array(bodies.length);
    const environmentPlaces = environmentSteps && new Float64Array(environmentSteps.length);
    const fraction = super.stepFraction(idsOf(bodies), steps, options, places, fractions, environmentSteps, environmentPlaces);
    return { fraction, fractions, places, environmentPlaces };
  }

  createBody(positions, edges, { triangles, hints, ...desc } = {}) {
    const offsets = triangles && Uint32Array.from({ length: triangles.length / 3 + 1 }, (_, i) => 3 * i);
    return this.body(super.createBodyId(positions, edges, offsets, triangles, hints, desc));
  }

  body(id) {
    return new Body(this, id);
  }

  deform(positions, { bodies = [], targets = [], reports = new arrays.MoveReportArray(bodies.length), ...options } = {}) {
    return { report: super.deform(positions, idsOf(bodies), targets, options, reports), reports };
  }

  deformRigid(positions, bodies, motions, { reports = new arrays.MoveReportArray(bodies.length), ...options } = {}) {
    return { report: super.deformRigid(positions, idsOf(bodies), motions, options, reports), reports };
  }
}

module.exports = { Body, Scene };

// The scenario of bindings/tests/README.md, in JavaScript. Its result is text, as in scenario.json.
'use strict';
const {
  CellType, Environment, Mark, Location, Response, Scene, DartsweepError, FEATURE_DEFORMING, Status, VolumeId,
} = require('dartsweep');

const LINKS = 12, PARTICLES = 50, SIDE = 10, NX = 6, NY = 6, NZ = 12;
const CORNERS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
const inside = [24, 24, 48], outside = [-9, 0, 0];

const at = (i, j, k) => (k * (NY + 1) + j) * (NX + 1) + i;

function meshPoints() {
  const points = new Float64Array(3 * (NX + 1) * (NY + 1) * (NZ + 1));
  for (let k = 0; k <= NZ; ++k)
    for (let j = 0; j <= NY; ++j)
      for (let i = 0; i <= NX; ++i)
        points.set([8 * i + ((j * k) % 3), 8 * j + ((i * k) % 3), 8 * k + ((i * j) % 3)], 3 * at(i, j, k));
  return points;
}

function regionsOfCells() {
  return Int32Array.from({ length: NX * NY * NZ }, (_, cell) => {
    const i = cell % NX, j = Math.trunc(cell / NX) % NY;
    return i > 0 && i < NX - 1 && j > 0 && j < NY - 1 ? 1 : 2;
  });
}

function createEnvironment(options = {}) {
  const cells = new Int32Array(8 * NX * NY * NZ);
  for (let c = 0; c < cells.length; ++c) {
    const cell = Math.trunc(c / 8), [i, j, k] = CORNERS[c % 8];
    cells[c] = at((cell % NX) + i, (Math.trunc(cell / NX) % NY) + j, Math.trunc(cell / (NX * NY)) + k);
  }
  return new Environment(meshPoints(), cells, { type: CellType.Hexahedron, regions: regionsOfCells(), ...options });
}

function createCatheter(scene) {
  const positions = new Float64Array(3 * LINKS);
  for (let i = 0; i < LINKS; ++i) positions.set([24.5, 25.25, 8.125 + 2 * i], 3 * i);
  return scene.createBody(positions, Uint32Array.from({ length: 2 * (LINKS - 1) }, (_, i) => Math.trunc(i / 2) + (i % 2)));
}

// Squares whose corners have moved, half of them cut into two triangles.
function createPlane() {
  const points = [], cells = [], offsets = [0], types = [], regions = [];
  for (let j = 0; j <= SIDE; ++j)
    for (let i = 0; i <= SIDE; ++i) points.push(8 * i + ((i * j) % 3), 8 * j + ((i + 2 * j) % 3));
  const add = (region, type, ...corners) => {
    cells.push(...corners);
    offsets.push(cells.length);
    types.push(type);
    regions.push(region);
  };
  for (let j = 0; j < SIDE; ++j)
    for (let i = 0; i < SIDE; ++i) {
      const a = j * (SIDE + 1) + i, d = a + SIDE + 1;
      const region = i > 0 && i < SIDE - 1 && j > 0 && j < SIDE - 1 ? 1 : 2;
      if ((i + j) % 2 === 0) {
        add(region, CellType.Quad, a, a + 1, d + 1, d);
      } else {
        add(region, CellType.Triangle, a, a + 1, d + 1);
        add(region, CellType.Triangle, a, d + 1, d);
      }
    }
  return new Environment(points, cells, { dimension: 2, offsets, types, regions });
}

class Scenario {
  stages = [];
  seed = 1;

  // --- the result
  stage(name) {
    this.stages.push([name, []]);
  }

  #say(bits) {
    this.stages.at(-1)[1].push(bits.toString(16).padStart(16, '0'));
  }

  integers(...values) {
    for (const value of values) this.#say(BigInt.asUintN(64, BigInt(value)));
  }

  doubles(...values) {
    for (const bits of new BigUint64Array(Float64Array.from(values).buffer)) this.#say(bits);
  }

  text() {
    return `{\n${this.stages.map(([name, bits]) => `  "${name}": ["${bits.join('", "')}"]`).join(',\n')}\n}\n`;
  }

  // --- what it is played with
  draw(count) {
    return Float64Array.from({ length: 3 * count }, (_, i) => {
      this.seed = (this.seed * 4093 + 1021) % 65536;
      return i % 3 === 2 ? 1.5 * (this.seed / 1024) : 4 + 0.625 * (this.seed / 1024);
    });
  }

  drawInPlane(count) {
    return Float64Array.from({ length: 2 * count }, () => {
      this.seed = (this.seed * 4093 + 1021) % 65536;
      return 11 + 0.90625 * (this.seed / 1024);
    });
  }

  // --- stages, in the order of README.md
  play() {
    this.stage('vessel');
    const environment = createEnvironment();
    const info = environment.info();
    const { marked } = environment.markRegion(2, Mark.Impassable);
    this.integers(info.vertexCount, info.volumeCount, info.faceCount, info.boundaryFaceCount, marked);
    this.queries(environment);
    const scene = new Scene(environment);
    const centres = [...regionsOfCells().keys()].filter((cell) => regionsOfCells()[cell] === 1).slice(0, PARTICLES)
      .flatMap((cell) => environment.getCentre(environment.getVolumeId(cell)));
    const particles = scene.createParticles(centres);
    this.stage('particles');
    for (let i = 0; i < 4; ++i) this.move(scene, particles);
    this.push(createCatheter(scene));
    this.snapshots(environment, scene, particles);
    this.mistakes(environment, scene, particles);
    this.cut('cut', environment, [-5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25], 2, 2);
    scene.close();
    environment.close();
    this.deform();
    this.plane();
    return this.text();
  }

  flights(flights) {
    for (const { outcome, time, position, contact, volumesVisited } of flights) {
      this.integers(outcome);
      this.doubles(time, ...position, ...contact.normal);
      this.integers(contact.wall.volume, contact.wall.local, volumesVisited);
    }
  }

  sweeps(sweeps) {
    for (const { outcome, time, point, edgeParameter } of sweeps) {
      this.integers(outcome);
      this.doubles(time, ...point, edgeParameter);
    }
  }

  queries(environment) {
    this.stage('locate');
    const from = this.draw(64);
    const { volumes, locations } = environment.locatePoints(from);
    locations.forEach((location, i) => this.integers(location, volumes.at(i).index, volumes.at(i).generation));

    this.stage('cast');
    const to = this.draw(64);
    this.flights(environment.castSegments(from, to));

    this.stage('sweep');
    this.sweeps(environment.sweepEdges(from.subarray(0, 48), to.subarray(0, 48), this.draw(16)));

    this.stage('nearest');
    locations.forEach((location, i) => {
      if (location !== Location.Passable) return;
      this.nearest(environment.findNearest(from.subarray(3 * i, 3 * i + 3), 20, volumes.at(i)));
    });
  }

  nearest({ distance, cell }) {
    this.doubles(distance);
    this.integers(cell.kind, cell.index);
  }

  move(scene, particles) {
    for (const { outcome, time, position } of scene.moveParticles(particles, this.draw(PARTICLES))) {
      this.integers(outcome);
      this.doubles(time, ...position);
    }
  }

  push(body) {
    this.pushes('catheter', body, (i) => [1.75, -0.5 * (Math.trunc(i / 3) % 3), 3][i % 3]);
    this.contacts('contacts', body.getContacts());
  }

  pushes(stage, body, way) {
    this.stage(stage);
    for (let step = 0; step < 10; ++step) {
      const targets = body.getPositions().map((x, i) => x + way(i));
      const report = body.move(targets, { vertexResponse: Response.Slide, edgeResponse: Response.Slide });
      this.integers(report.verticesStopped, report.contactCount);
      this.doubles(...body.getPositions());
    }
  }

  contacts(stage, contacts) {
    this.stage(stage);
    this.integers(contacts.length);
    for (const { vertex, contact, time, point } of contacts) {
      this.integers(vertex.index, contact.kind);
      this.doubles(time, ...point, ...contact.normal);
      this.integers(contact.wall.volume);
    }
  }

  blocks(...blocks) {
    for (const block of blocks) this.integers(block.length, block.reduce((sum, byte) => sum + byte, 0));
  }

  snapshots(environment, scene, particles) {
    this.stage('snapshot');
    const block = environment.save(), sceneBlock = scene.save();
    this.blocks(block, sceneBlock);
    const other = Environment.load(block);
    const copy = Scene.load(other, sceneBlock);
    this.move(copy, particles);
    copy.close();
    other.close();

    this.stage('damaged');
    this.status(() => Environment.load(block.subarray(0, Math.trunc(block.length / 2))));
    const flipped = block.slice();
    flipped[Math.trunc(block.length / 2)] ^= 1;
    this.status(() => Environment.load(flipped));
  }

  status(call) {
    try {
      call();
      this.integers(Status.Ok);
    } catch (error) {
      if (!(error instanceof DartsweepError)) throw error;
      this.integers(error.status);
    }
  }

  mistakes(environment, scene, particles) {
    this.stage('errors');
    this.status(() => environment.cast([0, NaN, 0], inside));
    this.status(() => environment.cast(inside, outside, { start: new VolumeId(3, 7) }));
    this.status(() => environment.getVolumeId(NX * NY * NZ));
    this.status(() => scene.createParticle(outside));
    this.status(() => scene.createParticle([4, 4, 4]));
    this.status(() => scene.moveParticles([particles.at(0), particles.at(0)], [...inside, ...inside]));
    const particle = scene.createParticle(inside);
    this.status(() => environment.markVolumes([scene.getParticlePosition(particle).volume], Mark.Impassable));
    scene.destroyParticle(particle);
    this.status(() => scene.destroyParticle(particle));
    this.status(() => scene.resetStatistics());
    this.status(() => new Environment(meshPoints(), [0, 1, 7, 7], { type: CellType.Tetra }));
  }

  cut(stage, environment, blade, rows, columns) {
    this.stage(stage);
    const change = environment.cut(blade, rows, columns);
    this.doubles(change.distance);
    this.integers(change.volumesSplit, change.getFaces().length, environment.info().volumeCount);
    for (const { vertex, weights } of change.getVertices()) {
      this.integers(vertex.index);
      this.doubles(weights[0]);
    }
  }

  deform() {
    this.stage('deform');
    const environment = createEnvironment();
    environment.markRegion(2, Mark.Impassable);
    const scene = new Scene(environment, { features: FEATURE_DEFORMING });
    const body = createCatheter(scene);
    const next = environment.getPoints().map((x, i) => (i % 3 === 0 ? x + (48 - x) * 0.4375 : x));
    this.deformed(environment.deform(next), body);
    scene.close();
    environment.close();
  }

  deformed(report, body) {
    this.integers(report.outcome, report.heldCount, report.contactCount, report.pushedCount);
    this.doubles(...body.getPositions());
  }

  plane() {
    this.stage('plane');
    const environment = createPlane();
    const info = environment.info();
    const { marked } = environment.markRegion(2, Mark.Impassable);
    environment.markVertices([environment.getVertexId(5 * (SIDE + 1) + 5)], Mark.Impassable);
    this.integers(info.dimension, info.vertexCount, info.volumeCount, info.faceCount, info.boundaryFaceCount, marked);

    this.stage('plane locate');
    this.seed = 1;
    const from = this.drawInPlane(32);
    const { volumes, locations } = environment.locatePoints(from);
    locations.forEach((location, i) => {
      this.integers(location, volumes.at(i).index, volumes.at(i).generation);
      if (location === Location.Passable) this.nearest(environment.findNearest(from.subarray(2 * i, 2 * i + 2), 20, volumes.at(i)));
    });

    this.stage('plane cast');
    const to = this.drawInPlane(32).map((x, i) => (i % 4 === 0 ? x + 40 : x));
    this.flights(environment.castSegments(from, to));

    this.stage('plane sweep');
    this.sweeps(environment.sweepEdges(from.subarray(0, 32), to.subarray(0, 32), this.drawInPlane(16)));

    this.stage('plane particles');
    const scene = new Scene(environment, { features: FEATURE_DEFORMING });
    const particles = scene.createParticles(from);
    scene.moveParticles(particles, to);
    this.doubles(...scene.getParticlePositions(particles).positions);
    const positions = Float64Array.from({ length: 2 * LINKS }, (_, i) => (i % 2 === 0 ? 20.25 + 1.5 * i : 40.5));
    const rope = scene.createBody(positions, Uint32Array.from({ length: 2 * (LINKS - 1) }, (_, i) => Math.trunc(i / 2) + (i % 2)));
    this.pushes('rope', rope, (i) => [1.5, 4 - 0.75 * (Math.trunc(i / 2) % 3)][i % 2]);
    this.contacts('rope contacts', rope.getContacts());
    this.stage('plane snapshot');
    this.blocks(environment.save(), scene.save());

    this.stage('plane deform');
    const points = environment.getPoints();
    const bent = new Float64Array(points.length + 2 * 64);
    bent.set(points.map((x, i) => (i % 2 === 1 ? x + (40 - x) * 0.125 : x)));
    this.deformed(environment.deform(bent), rope);
    this.cut('plane cut', environment, [20, 20.5, 60.25, 41.25], 2, 1);
    scene.close();
    environment.close();
  }
}

module.exports = { createCatheter, createEnvironment, createPlane, inside, outside, play: () => new Scenario().play() };

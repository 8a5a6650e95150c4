'use strict';
const assert = require('node:assert/strict');
const { test } = require('node:test');
const { Worker } = require('node:worker_threads');
const dsw = require('dartsweep');
const { createCatheter, createEnvironment, inside } = require('./scenario.js');

const target = [24, 24, 50];

test('arrays that are given are filled in place', () => {
  const scene = new dsw.Scene(createEnvironment());
  const body = createCatheter(scene);
  const memory = new Float64Array(40);
  const positions = memory.subarray(2, 38);
  assert.equal(body.getPositions(positions), positions);
  assert.deepEqual(memory.subarray(2, 38), body.getPositions());
  assert.deepEqual([...memory.subarray(0, 2), ...memory.subarray(38)], [0, 0, 0, 0]);

  const particles = scene.createParticles([...inside, ...inside]);
  const flights = new dsw.FlightArray(2);
  assert.equal(scene.moveParticles(particles, [...target, ...target], { flights }), flights);
  assert.equal(flights.at(-1).outcome, dsw.Outcome.Reached);
  assert.deepEqual(flights.at(0).position, target);
});

test('what is nearest to points and segments is found', () => {
  const environment = createEnvironment();
  const from = new Float64Array([...inside, ...target]), to = new Float64Array([...target, ...inside]);
  const volumes = new dsw.VolumeIdArray(2), locations = new Int32Array(2);
  const points = environment.findNearestToPoints(from, 20, { volumes, locations });
  const segments = environment.findNearestToSegments(from, to, 20, { hints: volumes });
  for (let i = 0; i < 2; ++i) {
    assert.equal(locations[i], dsw.Location.Passable);
    assert.ok(segments.at(i).nearest.distance <= points.at(i).distance);
    assert.ok(segments.at(i).segmentParameter >= 0 && segments.at(i).segmentParameter <= 1);
  }
  const nearest = new dsw.SegmentNearestArray(2);
  assert.equal(environment.findNearestToSegments(from, to, 20, { nearest }), nearest);
});

test('rays meet bodies', () => {
  const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
  const cube = new dsw.Environment(points, [0, 1, 2, 3, 4, 5, 6, 7], { type: dsw.CellType.Hexahedron });
  const scene = new dsw.Scene(cube, { features: dsw.FEATURE_BODY_CONTACTS });
  const leaf = scene.createBody([0.25, 0.25, 0.5, 0.75, 0.25, 0.5, 0.25, 0.75, 0.5], null, { triangles: [0, 1, 2], level: dsw.Level.Faces });
  const { flights, partners } = scene.cast([0.3, 0.3, 0.75, 0.9, 0.9, 0.75], [0.3, 0.3, 0.25, 0.9, 0.9, 0.25]);
  assert.equal(flights.at(0).time, 0.5);
  assert.equal(partners.at(0).body.index, leaf.id().index);
  assert.equal(flights.at(1).outcome, dsw.Outcome.Reached);
  const near = scene.findNearest([0.3, 0.3, 0.625]);
  assert.equal(near.nearest.at(0).distance, 0.125);
  assert.equal(near.partners.at(0).face.generation, 1);
  assert.deepEqual([...cube.findSignedDistances([0.5, 0.5, 0.75, 0.5, 0.5, 3])], [-0.25, 2]);
  assert.equal(cube.cast([0, 0.5, 0.5], [1, 0.5, 0.25], { flags: dsw.CAST_OPEN_ENDS }).outcome, dsw.Outcome.Reached);
});

test('particles and vertices leave through exits', () => {
  const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
  const cube = new dsw.Environment(points, [0, 1, 2, 3, 4, 5, 6, 7], { type: dsw.CellType.Hexahedron });
  const scene = new dsw.Scene(cube);
  const top = cube.cast([0.5, 0.5, 0.5], [0.5, 0.5, 3]).contact.wall;
  cube.markExits([top], 6);
  assert.equal(cube.getExit(top), 6);
  assert.equal(cube.getExitFaces().length, 1);
  const particle = scene.createParticle([0.25, 0.25, 0.5]);
  assert.equal(scene.moveParticle(particle, [0.25, 0.25, 2.5], { flags: dsw.CAST_LEAVE }).outcome, dsw.Outcome.Exit);
  const left = scene.getExits();
  assert.deepEqual([left.length, left.at(0).patch, left.at(0).time, scene.getParticleCount()], [1, 6, 0.25, 0]);
  const rod = scene.createBody([0.25, 0.5, 0.25, 0.25, 0.5, 0.75], [0, 1]);
  rod.move([0.25, 0.5, 0.75, 0.25, 0.5, 1.25], { flags: dsw.MOVE_LEAVE });
  assert.equal(rod.getExits().at(0).vertex.index, 1);
});

test('bodies that penetrate are freed', () => {
  const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
  const scene = new dsw.Scene(new dsw.Environment(points, [0, 1, 2, 3, 4, 5, 6, 7], { type: dsw.CellType.Hexahedron }));
  const line = [0.25, 0.5, 0.5, 0.75, 0.5, 0.5, 1.25, 0.5, 0.5];
  assert.throws(() => scene.createBody(line, [0, 1, 1, 2]), dsw.OutsideError);
  const wire = scene.createBody(line, [0, 1, 1, 2], { flags: dsw.BODY_START_PENETRATING });
  const crossed = wire.findPenetrations();
  assert.deepEqual([wire.isPenetrating(), crossed.length, crossed.at(0).part.edge.index], [true, 1, 1]);
  assert.throws(() => wire.move(line), dsw.OccupiedError);
  assert.deepEqual(wire.depenetrate(new dsw.VolumeId(0, 0), 0.125), { freed: false, distance: 0 });
  const made = wire.depenetrate();
  assert.ok(made.freed && made.distance >= 0.25 && made.distance <= 0.5);
  assert.equal(wire.isPenetrating(), false);
});

test('threads are cut', () => {
  const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
  const scene = new dsw.Scene(new dsw.Environment(points, [0, 1, 2, 3, 4, 5, 6, 7], { type: dsw.CellType.Hexahedron }));
  const thread = scene.createBody([0.25, 0.5, 0.5, 0.75, 0.5, 0.5], [0, 1]);
  const blade = [0.375, 0, 0, 0.375, 0, 1, 0.375, 1, 0, 0.375, 1, 1];
  assert.equal(scene.cutBodies(blade, 2, 2), 1);
  const cuts = scene.getBodyCuts();
  assert.deepEqual([cuts.length, cuts.at(0).edgeParameter, cuts.at(0).body.index], [1, 0.25, thread.id().index]);
  assert.equal(scene.cutBodies(blade, 2, 2, [thread.id()]), 0);
  assert.equal(thread.getCounts().edgeCount, 2);
  assert.throws(() => scene.cutBodies(blade, 2, 3));
});

test('places inside are found', () => {
  const environment = createEnvironment();
  const volumes = new dsw.VolumeIdArray(2);
  const places = environment.findInside([24, 24, 900, ...inside], 0.5, { volumes });
  assert.deepEqual([...places.subarray(3)], [...inside]);
  assert.equal(environment.locate(places.subarray(0, 3)).location, dsw.Location.Passable);
});

test('memory that is shared between threads is read in place', async () => {
  const environment = createEnvironment();
  const points = new Float64Array(new SharedArrayBuffer(48));
  points.set([...inside, ...target]);
  const flights = environment.castSegments(points.subarray(0, 3), points.subarray(3), {
    flights: new dsw.FlightArray(new SharedArrayBuffer(new dsw.FlightArray(1).buffer.byteLength)),
  });
  assert.ok(flights.buffer instanceof SharedArrayBuffer);
  const worker = new Worker(
    `const { FlightArray } = require('dartsweep');
     const { parentPort, workerData } = require('node:worker_threads');
     parentPort.postMessage(new FlightArray(workerData).at(0));`,
    { eval: true, workerData: flights.buffer },
  );
  const flight = await new Promise((resolve, reject) => worker.once('message', resolve).once('error', reject));
  assert.deepEqual(flight.position, target);
  // What was sent has lost its class, and is an id all the same.
  assert.ok(environment.isValid(flight.volume));
});

test('arrays that lose their memory while arguments are read are refused', () => {
  const environment = createEnvironment();
  const lose = {
    'to another thread': (buffer) => structuredClone(buffer, { transfer: [buffer] }),
    'to nobody': (buffer) => buffer.resize?.(8),
  };
  for (const [where, take] of Object.entries(lose)) {
    const make = (size) => new ArrayBuffer(size, { maxByteLength: size });
    const from = new Float64Array(make(24));
    const starts = (buffer) => [{ generation: 0, get index() { take(buffer); return 0; } }];
    if (!from.buffer.resizable && where === 'to nobody') continue; // before Node 20
    assert.throws(() => environment.castSegments(from, target, { starts: starts(from.buffer) }), /lost its memory/);
    const cells = new Int32Array(make(32));
    const regions = Object.defineProperty([0], 0, { get() { take(cells.buffer); return 0; } });
    assert.throws(() => new dsw.Environment(new Float64Array(24), cells, { regions }), /lost its memory/);
  }
  const nothing = [];
  nothing.length = 2 ** 32 - 1;
  assert.throws(() => environment.castSegments(nothing, nothing, { flights: new dsw.FlightArray(1) }), TypeError);
});

test('lists of structs are lists', () => {
  const id = new dsw.VolumeId(3, 4);
  const list = new dsw.VolumeIdArray([id, new dsw.VolumeId(5, 6), null]);
  assert.equal(list.length, 3);
  assert.deepEqual([...list], [id, new dsw.VolumeId(5, 6), new dsw.VolumeId()]);
  assert.deepEqual(list.toArray(), [...list]);
  assert.ok(list.at(0).equals(id) && !list.at(1).equals(id) && list.at(2).isNull && list.at(3) === undefined);
  assert.ok(!id.equals(new dsw.VertexId(3, 4)));
  list.set(1, id);
  assert.deepEqual(list.at(1), id);
  assert.equal(new dsw.VolumeIdArray(0).length, 0);
  for (const wrong of [new ArrayBuffer(9), 1.5, -1, NaN]) assert.throws(() => new dsw.VolumeIdArray(wrong), RangeError);
});

test('results are plain objects, which go back in', () => {
  const environment = createEnvironment();
  environment.markRegion(2, dsw.Mark.Impassable);
  const scene = new dsw.Scene(environment, { features: dsw.FEATURE_CROSSINGS });
  const body = createCatheter(scene);
  body.move(body.getPositions().map((x, i) => (i % 3 === 0 ? x + 30 : x)));
  const contact = body.getContacts().at(0);
  assert.equal(contact.contact.kind, dsw.ContactKind.Plane);
  assert.equal(contact.fixed.length, 2);
  assert.deepEqual(structuredClone(contact).point, contact.point);
  const flight = environment.cast(inside, [90, 24, 50]);
  const trace = new dsw.Trace();
  trace.addContact(flight, 2);
  trace.addWalk(environment, inside, [90, 24, 50], { label: 7 });
  assert.ok(trace.getPoints().length > 0 && trace.getSegments() instanceof Uint32Array);

  scene.moveParticles(scene.createParticles([...inside, ...inside]), [...target, ...inside]);
  const offsets = scene.getCrossingOffsets();
  assert.equal(offsets[0], 0);
  assert.equal(offsets.at(-1), scene.getCrossings().length);

  const moved = body.moveRigid({ rotation: [0, 0, 0, 1], translation: [0, 0, 0.5] });
  assert.equal(typeof moved.fraction, 'number');
  assert.deepEqual(dsw.cellOf(flight.contact.wall), { kind: dsw.CellKind.Face, index: flight.contact.wall.volume, generation: flight.contact.wall.generation, local: flight.contact.wall.local });
});

test('points of the plane have two coordinates', () => {
  const square = [0, 0, 1, 0, 1, 1, 0, 1];
  const environment = new dsw.Environment(square, [0, 1, 2, 0, 2, 3], { type: dsw.CellType.Triangle });
  assert.equal(environment.dimension(), 2);
  assert.deepEqual([...environment.getPoints()], square);
  assert.deepEqual(environment.getVertexPosition(environment.getVertexId(2)), [1, 1, 0]);
  const { time, contact } = environment.cast([0.5, 0.25], [0.5, 2.25]);
  assert.equal(time, 0.375);
  assert.deepEqual(contact.normal, [0, -1, 0]);
  assert.equal(environment.cast([0.5, 0.25, 0], [0.5, 2.25, 0]).time, 0.375);
  const side = environment.findFaces([0, 2], [1, 2]).at(0);
  const { vertex } = environment.splitEdge(new dsw.EdgeId(side.volume, side.generation, side.local), 0.25);
  assert.deepEqual(environment.getVertexPosition(vertex), [1, 0.25, 0]);
  environment.markVertices([environment.getVertexId(2)], dsw.Mark.Impassable);
  const scene = new dsw.Scene(environment, { features: dsw.FEATURE_DEFORMING });
  const body = scene.createBody([0.5, 0.25, 0.75, 0.25], [0, 1]);
  assert.equal(body.move([0.5, 1.25, 0.75, 0.5]).verticesStopped, 1);
  assert.equal(body.getContacts().at(0).time, 0.75);
  const memory = new Float64Array(6);
  body.getPositions(memory.subarray(1, 5));
  assert.deepEqual([...memory], [0, ...body.getPositions(), 0]);
  assert.equal(environment.deform([0, 0, 1, 0, 1, 2, 0, 2, 1, 0.5]).outcome, dsw.DeformOutcome.Done);
});

test('cells of several types, of 8 bytes an index', () => {
  const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1, 0.5, 0.5, -1];
  const environment = new dsw.Environment(points, BigInt64Array.from([0, 1, 2, 3, 4, 0, 1, 3, 5].map(BigInt)), {
    types: [dsw.CellType.Pyramid, dsw.CellType.Tetra],
    offsets: BigInt64Array.from([0n, 5n, 9n]),
    tags: [8, 9],
    flags: dsw.ENVIRONMENT_REORIENT,
  });
  assert.equal(environment.info().volumeCount, 2);
  assert.equal(environment.getTag(environment.getVolumeId(1)), 9);
  assert.equal(environment.buildReport().reorientedCount, 1);
  assert.ok(!environment.findFaces([0, 4], [0, 1, 2, 3]).at(0).isNull);
  assert.throws(() => environment.findFaces(new Uint32Array([0, 4]), [0, 1, 2, 3]), /BigUint64Array/);
});

// Cubes with points of their own; each is x, y, z and a width.
function cubes(options, ...all) {
  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
  const points = all.flatMap((cube) => corners.flatMap((corner) => corner.map((at, k) => cube[k] + cube[3] * at)));
  const cells = Int32Array.from({ length: 8 * all.length }, (_, i) => i);
  return new dsw.Environment(points, cells, { type: dsw.CellType.Hexahedron, ...options });
}

test('parts that touch are counted and sewn', () => {
  const one = [0, 0, 0, 1], four = [[1, 0, 0, 0.5], [1, 0.5, 0, 0.5], [1, 0, 0.5, 0.5], [1, 0.5, 0.5, 0.5]];
  const loose = cubes({ flags: dsw.ENVIRONMENT_FIND_TOUCHING }, one, ...four).buildReport();
  assert.equal(loose.touchingFaceCount, 13);
  assert.equal(loose.touchingFace.volume, 0);
  assert.equal(loose.touchedFace.volume, 1);
  const sewn = cubes({ flags: dsw.ENVIRONMENT_CONFORM | dsw.ENVIRONMENT_FIND_TOUCHING }, one, ...four);
  assert.equal(sewn.buildReport().partCount, 1);
  assert.equal(sewn.buildReport().changedCount, 1);
  assert.equal(sewn.buildReport().touchingFaceCount, 0);
  assert.equal(sewn.cast([0.25, 0.5, 0.5], [1.375, 0.375, 0.25]).outcome, dsw.Outcome.Reached);
  const near = cubes({ flags: dsw.ENVIRONMENT_MERGE_POINTS, mergeDistance: 1e-9 }, one, [1 + 1e-10, 0, 0, 1]);
  assert.equal(near.buildReport().mergedPointCount, 4);
  assert.throws(() => cubes({ flags: dsw.ENVIRONMENT_CONFORM }, one, [1, 0.25, 0.25, 1]), /faces of cells 0 and 1 overlap/);
});

test('enumerators have names', () => {
  assert.equal(dsw.Outcome[dsw.Outcome.Reached], 'Reached');
  assert.throws(() => { dsw.Outcome.Reached = 5; }, TypeError);
});

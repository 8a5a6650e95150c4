'use strict';
const assert = require('node:assert/strict');
const { test } = require('node:test');
const dsw = require('dartsweep');
const { createCatheter, createEnvironment, inside } = require('./scenario.js');

test('a change outlasts the next', () => {
  const environment = createEnvironment();
  const first = environment.cut([-5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25], 2, 2);
  assert.ok(first instanceof dsw.Change);
  assert.deepEqual([first.volumesCrossed, first.volumesSplit, first.volumesChanged, first.isClosed], [36, 24, 36, 0]);
  assert.equal(environment.getChange().distance, first.distance);
  const volume = environment.getVolumeId(3);
  environment.removeVolumes([volume]);
  const second = environment.getChange();
  assert.deepEqual([second.volumesSplit, second.getFaces().length], [0, 0]);
  assert.deepEqual(second.getVolumes().toArray(), [{ before: volume, after: new dsw.VolumeId() }]);
  environment.close();
  const lists = [first.getVolumes(), first.getVertices(), first.getFaces(), first.getWhole()];
  assert.deepEqual(lists.map((list) => list.length), [60, 35, 24, 12]);
  for (const list of [first.getCarved(), first.getUnrepaired(), first.getDetached()]) assert.equal(list.length, 0);
  const { weights, from } = first.getVertices().at(0);
  assert.equal(weights[0] + weights[1], 1);
  assert.ok(!from[0].equals(from[1]));
});

test('a drill halves what it crosses', () => {
  const environment = createEnvironment();
  environment.markVolumes([environment.getVolumeId(237)], dsw.Mark.Impassable);
  const drill = [29.25, 29.25, 53.25, 29.25, 27.25, 51.25, 27.25, 29.25, 51.25, 27.25, 27.25, 53.25];
  const triangles = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2];
  const change = environment.carve(drill, triangles, { finest: 1, flags: dsw.CarveFlag.Cover });
  assert.deepEqual([change.volumesSplit, change.getCarved().length, change.getWhole().length], [1, 63, 0]);
  environment.close();
});

test('a piece becomes a body', () => {
  const environment = createEnvironment();
  const scene = new dsw.Scene(environment);
  const volume = environment.getVolumeId(237);
  environment.markVolumes([volume], dsw.Mark.Impassable);
  const body = scene.body(environment.detach({ volume }));
  const change = environment.getChange();
  assert.equal(body.getCounts().vertexSlots, 8);
  assert.deepEqual([change.getBodyVertices().length, change.getBodyFaces().length], [8, 12]);
  assert.deepEqual([...change.getDetached()], [volume]);
  assert.deepEqual(change.getBodyFaces().at(0).volume, volume);
  assert.ok(change.distance > 0);
  const { vertex, from, weights } = change.getBodyVertices().at(7);
  assert.ok(vertex.isNull && !from[0].isNull && from[0].equals(from[1]));
  assert.deepEqual(weights, [1, 0]);
});

test('each report says what was touched', () => {
  const environment = createEnvironment();
  environment.markRegion(2, dsw.Mark.Impassable);
  const { contact } = environment.cast(inside, [90, 24, 48]);
  assert.deepEqual([contact.kind, contact.markedKind], [dsw.ContactKind.Plane, dsw.CellKind.Volume]);
  assert.deepEqual(contact.obstacle, dsw.cellOf(contact.wall));
  assert.ok(environment.isImpassable(dsw.cellOf(contact.behind)));
  assert.equal(environment.cast(inside, [24, 24, 50]).contact.kind, dsw.ContactKind.None);
  const body = createCatheter(new dsw.Scene(environment, { features: dsw.FEATURE_DEFORMING }));
  const edge = body.getEdgeIds().at(0);
  assert.equal(body.splitEdge(edge, 0.25).edgeParameter, 0.25);
  assert.equal(body.getEdgeEnds(edge).length, 2);
  const next = environment.getPoints().map((x, i) => (i % 3 === 0 ? x + (48 - x) * 0.4375 : x));
  assert.equal(environment.deform(next).contactCount, environment.getWallContacts().length);
  const touched = environment.getWallContacts().at(0);
  assert.deepEqual(touched.body, body.id());
  assert.ok(touched.contact.normal[0] > 0.9 && touched.contact.obstacle.kind !== dsw.CellKind.None);
  assert.equal(touched.response, dsw.WallResponse.Push);
  assert.equal(environment.getHeldVertices().length, 0);
});

test('near rows say where a body is close', () => {
  const points = Float64Array.from({ length: 54 }, (_, i) => [i / 3 % 3, i / 9 % 3, i / 27].map(Math.floor)[i % 3]);
  const cells = [0, 1, 3, 4].flatMap((at) => [0, 1, 4, 3, 9, 10, 13, 12].map((corner) => at + corner));
  const environment = new dsw.Environment(points, cells, { type: dsw.CellType.Hexahedron, regions: [1, 1, 1, 2] });
  environment.markRegion(2, dsw.Mark.Impassable); // a pillar, whose edge is at x = y = 1
  const wire = new dsw.Scene(environment).createBody([0.25, 1.5, 0.375, 1.5, 0.25, 0.375], [0, 1]);
  const none = 2 ** 32 - 1;
  const close = (a, b) => assert.ok(Math.abs(a - b) < 1e-15, `${a} is not ${b}`);
  assert.equal(wire.getNearRows().length, 0);
  assert.equal(wire.findNearRows({ margin: 0.25, radius: 0.0625, flags: dsw.NEAR_JACOBIAN }), 3);
  const rows = wire.getNearRows();
  const [first, second, atEdge] = rows;
  assert.deepEqual([first.distance, first.gap, first.normal, second.vertices], [0.25, 0.1875, [1, 0, 0], [1, none, none]]);
  assert.equal(atEdge.obstacle.kind, dsw.CellKind.Edge);
  close(atEdge.distance, Math.SQRT1_2 / 4);
  close(atEdge.normal[0], -Math.SQRT1_2);
  assert.deepEqual([atEdge.weights, atEdge.obstaclePoint], [[0.5, 0.5, 0], [1, 1, 0.375]]);
  assert.ok(atEdge.body.isNull && !atEdge.wall.isNull);
  assert.deepEqual([...wire.getNearOffsets()], [0, 3, 6, 12]);
  assert.deepEqual([...wire.getNearColumns()], [0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5]);
  assert.deepEqual([...wire.getNearValues()].slice(0, 6), [1, 0, 0, 0, 1, 0]);
  wire.move([0.265625, 1.5, 0.375, 1.515625, 0.25, 0.375]);
  assert.equal(wire.findNearRows({ margin: 0.25, radius: 0.0625 }), 3);
  const next = wire.getNearRows();
  assert.deepEqual([...next].map((row) => row.previous), [0, 1, 2]);
  assert.deepEqual([...next].map((row) => row.key), [...rows].map((row) => row.key));
  assert.equal(next.at(0).distance, 0.265625);
  assert.equal(wire.getNearOffsets().length, 0);
  assert.throws(() => wire.findNearRows({ margin: -1 }), dsw.OutOfRangeError);
});

test('a thick body keeps its radius', () => {
  const environment = new dsw.Environment(
    [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1],
    [0, 1, 2, 3, 4, 5, 6, 7],
    { type: dsw.CellType.Hexahedron },
  );
  const scene = new dsw.Scene(environment);
  const create = (radius) => scene.createBody([0.25, 0.5, 0.5, 0.75, 0.5, 0.5], [0, 1], { radius });
  const close = (a, b, by) => assert.ok(Math.abs(a - b) < by, `${a} is not ${b}`);
  const wire = create(0.1);
  assert.equal(wire.getRadius(), 0.1);
  assert.throws(() => wire.setRadius(-1), dsw.OutOfRangeError);
  assert.throws(() => wire.findLeastGap(NaN), dsw.OutOfRangeError);
  wire.setRadius(0.125);
  assert.deepEqual([wire.getRadius(), wire.findLeastGap(0.0625)], [0.125, 0.0625]);
  close(wire.findLeastGap(1), 0.125, 1e-8);
  assert.throws(() => wire.setRadius(0.5), dsw.OccupiedError);
  assert.deepEqual([...scene.getOffendingEdges()], [0, 1]);
  wire.setRadius(0.1);
  close(wire.findLeastGap(1), 0.15, 1e-8);
  wire.move([0.25, 0.5, -0.5, 0.75, 0.5, -0.5]);
  close(wire.getPositions()[2], 0.1, 1e-3);
  assert.ok(wire.findLeastGap(0.1) >= -1e-9);
  assert.throws(() => create(0.3), dsw.OccupiedError);
});

'use strict';
const assert = require('node:assert/strict');
const { test } = require('node:test');
const dsw = require('dartsweep');

const corners = [0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4];
const edges = [0, 1, 1, 2];
const strand = (x, z = 1) => [x, 1, z, x, 2, z, x, 3, z];
// The room with its floor at a height.
const raised = (height) => corners.map((coordinate, i) => (i < 12 && i % 3 === 2 ? height : coordinate));

// One hexahedron, whose outer boundary is a wall.
function makeRoom(features = dsw.FEATURE_BODY_CONTACTS | dsw.FEATURE_DEFORMING) {
  const environment = new dsw.Environment(corners, [0, 1, 2, 3, 4, 5, 6, 7], { type: dsw.CellType.Hexahedron });
  return { environment, scene: new dsw.Scene(environment, { features }) };
}

test('free fractions move nothing', () => {
  const { scene } = makeRoom(0);
  const bar = scene.createBody([1, 2, 2, 3, 2, 2], [0, 1]);
  const poses = [0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 4, 0, 0];
  const [around, stopped, outside] = [...bar.findFreeFractions([2, 2, 2], poses, [0, 1, 0, 0, 2, 2], { offsets: [0, 3, 5, 6] })];
  assert.deepEqual([around.fraction, around.piece, outside.startsFree], [1, 2, 0]);
  assert.ok(stopped.fraction < 0.25 && stopped.fraction > 0.25 - 1e-12);
  const contacts = new dsw.BodyContactArray(1);
  const [found] = [...bar.findFreeFractions([2, 2, 2], poses, [0, 2], { contacts })];
  assert.ok(found.pieceFraction === stopped.fraction && [...contacts][0].time === 0.25);
  assert.deepEqual([...bar.getPositions()], [1, 2, 2, 3, 2, 2]);
  assert.throws(() => bar.findFreeFractions([2, 2, 2], [1, 2], [0, 0]), dsw.WrongSizeError);
});

test('a bar slides along a wall', () => {
  const { scene } = makeRoom(0);
  const bar = scene.createBody([1, 2, 2, 3, 2, 2], [0, 1]);
  const report = bar.moveRigid({ rotation: [0, 0, 0, 1], translation: [4, 1, 0] }, { flags: dsw.MOVE_SLIDE_WHOLE });
  assert.ok(report.fraction < 0.25 && report.fraction > 0.25 - 1e-12);
  [2, 3, 2, 4, 3, 2].forEach((x, i) => assert.ok(Math.abs(bar.getPositions()[i] - x) < 1e-9));
  assert.ok(Math.abs(bar.getMotionLeft().translation[0] - 3) < 1e-9);
});

test('rigid bodies move at once', () => {
  const { scene } = makeRoom();
  const bars = [[0.5, 2, 2, 1, 2, 2], [3, 2, 2, 3.5, 2, 2]].map((points) => scene.createBody(points, [0, 1]));
  const motions = [0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0];
  const [one, other] = [...scene.moveRigid(bars, motions)];
  assert.ok(one.fraction < 0.25 && one.fraction > 0.25 - 1e-12 && one.fraction === other.fraction);
});

test('thick rigid bodies keep their distance at once', () => {
  const { scene } = makeRoom();
  const bars = [[0.5, 2, 2, 1, 2, 2], [3, 2, 2, 3.5, 2, 2]].map((points) => scene.createBody(points, [0, 1], { radius: 0.125 }));
  const motions = [0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0];
  const [one, other] = [...scene.moveRigid(bars, motions)];
  assert.ok(Math.abs(one.fraction - 0.21875) < 1e-9 && one.fraction === other.fraction);
});

test('a bar turns while the floor rises', () => {
  const { environment, scene } = makeRoom();
  const bar = scene.createBody([1, 2, 2, 3, 2, 2], [0, 1]);
  const { report, reports } = scene.deformRigid(raised(3), [bar], [0, 0, Math.SQRT1_2, Math.SQRT1_2, 2, 2, 2, 0, 0, 0]);
  assert.equal(report.outcome, dsw.DeformOutcome.Fraction);
  assert.ok(Math.abs(report.fraction - 2 / 3) < 1e-9 && reports.at(0).fraction === report.fraction);
  assert.ok([...environment.getWallContacts()].every(({ time }) => Math.abs(time - 2 / 3) < 1e-12));
  assert.throws(() => scene.deformRigid(raised(3), [bar], [0, 0, 0, 1]), dsw.WrongSizeError);
});

test('strands that are carried together do not stop each other', () => {
  const { scene } = makeRoom();
  const strands = [1, 1.25].map((x) => scene.createBody(strand(x), edges));
  const reports = scene.moveTogether(strands, [...strand(2), ...strand(2.25)]);
  assert.deepEqual([...reports].map((report) => report.fraction), [1, 1]);
  assert.deepEqual([...strands[0].getPositions()], strand(2));
  const ids = new dsw.BodyIdArray(strands.map((each) => each.id()));
  const options = { stop: dsw.TogetherStop.Feature, maxRounds: 4, reports };
  assert.equal(scene.moveTogether(ids, [...strand(3), ...strand(5)], options), reports);
  assert.deepEqual([...reports].map((report) => report.verticesStopped), [0, 3]);
  assert.deepEqual([...strands[0].getPositions()], strand(3));
  // One vertex at a time the left strand runs into the right one.
  scene.moveTogether(strands, [...strand(1), ...strand(1.25)]);
  const stopped = scene.moveBodies(strands, [...strand(2), ...strand(2.25)]);
  assert.deepEqual([...stopped].map((report) => report.verticesStopped), [3, 0]);
});

test('how much of steps is free', () => {
  const { scene } = makeRoom();
  const body = scene.createBody(strand(1), edges);
  const { fraction, fractions, places } = scene.stepFraction([body], [4, 0, 0, 4, 0, 0, 4, 0, 0]);
  assert.ok(fraction < 0.75 && fraction > 0.7499999 && fractions[0] === fraction);
  assert.equal(places[0], 1 + 4 * fraction);
  assert.deepEqual([...body.getPositions()], strand(1));
  const walls = raised(2).map((x, i) => x - raised(0)[i]);
  const moved = scene.stepFraction([body], new Float64Array(9), { environmentSteps: walls });
  assert.ok(moved.fraction < 0.5 && moved.fraction > 0.4999999 && moved.environmentPlaces.length === walls.length);
});

test('a floor that rises stops before a strand', () => {
  const { environment, scene } = makeRoom();
  const body = scene.createBody(strand(2), edges);
  const { report, reports } = scene.deform(raised(2));
  assert.equal(report.outcome, dsw.DeformOutcome.Fraction);
  assert.ok(report.fraction < 0.5 && report.fraction > 0.4999999 && reports.length === 0);
  const contacts = [...environment.getWallContacts()];
  assert.ok(contacts.length > 0 && contacts.every(({ time }) => time === 0.5));
  assert.deepEqual(contacts[0].body, body.id());
  assert.deepEqual([...body.getPositions()], strand(2));
});

test('a strand rises with the floor', () => {
  const { environment, scene } = makeRoom();
  const body = scene.createBody(strand(2), edges);
  const { report, reports } = scene.deform(new Float64Array(raised(1.5)), { bodies: [body], targets: strand(2, 2) });
  assert.equal(report.outcome, dsw.DeformOutcome.Done);
  assert.equal(reports.at(0).fraction, 1);
  assert.deepEqual([...body.getPositions()], strand(2, 2));
  assert.deepEqual([...environment.getPoints()], raised(1.5));
});

test('only the parts that touch stop', () => {
  const { environment, scene } = makeRoom();
  const body = scene.createBody(strand(2), edges);
  const { report, reports } = scene.deform(raised(2), { bodies: [body], targets: strand(2), stop: dsw.TogetherStop.Feature });
  assert.equal(report.outcome, dsw.DeformOutcome.Held);
  assert.equal(report.heldCount, environment.getHeldVertices().length);
  assert.equal(reports.at(0).fraction, 0.5);
  const other = makeRoom();
  const pushed = other.scene.createBody(strand(2), edges);
  const options = { bodies: [pushed], targets: strand(2), stop: dsw.TogetherStop.Feature, response: dsw.TogetherResponse.Slide };
  assert.equal(other.scene.deform(raised(2), options).report.outcome, dsw.DeformOutcome.Done);
  assert.ok(Math.abs(pushed.getWaysLeft()[2] + 1) < 1e-9);
});

test('nothing moves at the work limit', () => {
  const { environment, scene } = makeRoom();
  const body = scene.createBody(strand(2), edges);
  const targets = strand(Number.MIN_VALUE); // integers are long beside it
  const limited = scene.deform(raised(2), { bodies: [body], targets, maxWork: 1 });
  assert.equal(limited.report.outcome, dsw.DeformOutcome.Limited);
  assert.equal(limited.reports.at(0).verticesLimited, 3);
  assert.deepEqual([...body.getPositions()], strand(2));
  assert.deepEqual([...environment.getPoints()], corners);
  const { report, reports } = scene.deform(raised(2), { bodies: [body], targets });
  assert.equal(report.outcome, dsw.DeformOutcome.Fraction);
  assert.equal(reports.at(0).verticesLimited, 0);
});

test('wrong moves together are refused', () => {
  const { scene } = makeRoom();
  const body = scene.createBody(strand(2), edges);
  for (const [bodies, targets, error] of [
    [[body], [2, 1, 1], dsw.WrongSizeError],
    [[body, body], [...strand(2), ...strand(2)], dsw.DuplicateIdError],
    [[new dsw.BodyId(5, 1)], strand(2), dsw.StaleIdError],
    [[body], strand(NaN), dsw.NonFiniteError],
  ]) {
    assert.throws(() => scene.moveTogether(bodies, targets), error);
    assert.throws(() => scene.deform(corners, { bodies, targets }), error);
  }
  assert.throws(() => scene.deform(corners.slice(3)), dsw.WrongSizeError);
  assert.throws(() => scene.moveTogether([body], strand(2), { stop: 3 }), dsw.UnsupportedError);
  assert.throws(() => makeRoom(0).scene.deform(corners), dsw.NotEnabledError);
});

test('back edges that are left are listed', () => {
  const { scene } = makeRoom(0);
  const tip = [1, 1, 2];
  const base = [1, 1, 1, 2, 1, 1, 1, 2, 1];
  const flags = dsw.BODY_SKIP_BACK_EDGES | dsw.BODY_LEAVE_BACK_EDGES;
  const triangles = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
  const body = scene.createBody([...base, ...tip], null, { triangles, level: dsw.Level.Edges, flags });
  assert.equal(body.getUntestedEdges().length, 0);
  body.move([...base, 1.1, 1.1, 1.7]); // the tip goes inwards
  assert.equal(body.getUntestedEdges().length, 3);
  body.move([...base, ...tip]);
  assert.equal(body.getUntestedEdges().length, 0);
});

test('a particle has a state', () => {
  const { scene } = makeRoom(0);
  const particle = scene.createParticle([2, 2, 2]);
  assert.equal(scene.getParticleCell(particle).kind, dsw.CellKind.Volume);
  assert.equal(scene.getParticleAim(particle).kind, dsw.CellKind.None);
  scene.moveParticle(particle, [2, 2, 9]);
  assert.equal(scene.getParticleAim(particle).kind, dsw.CellKind.Face);
});

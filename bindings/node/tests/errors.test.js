'use strict';
const assert = require('node:assert/strict');
const { test } = require('node:test');
const dsw = require('dartsweep');
const { raiseStatus } = require('./native.js');
const { createCatheter, createEnvironment, createPlane, inside, outside } = require('./scenario.js');

test('every status has its error', () => {
  for (const [name, status] of Object.entries(dsw.Status)) {
    if (typeof status !== 'number' || status === dsw.Status.Ok) continue;
    const type = dsw[`${name}Error`];
    assert.throws(() => raiseStatus(status), (error) => {
      assert.equal(error.constructor, type);
      assert.equal(error.name, type.name);
      assert.equal(error.status, status);
      assert.equal(error.code, `DSW_${name.replace(/(?<=.)[A-Z]/g, '_$&').toUpperCase()}`);
      assert.equal(error.message, dsw.statusString(status));
      return error instanceof dsw.DartsweepError && error instanceof Error;
    });
  }
});

test('the text is that of the library, the stack that of the caller', () => {
  const environment = createEnvironment();
  assert.throws(() => environment.cast([0, NaN, 0], inside), (error) => {
    assert.match(error.message, /dsw_environment_cast: from\[1\] is nan, must be finite/);
    assert.match(error.stack.split('\n')[1], /errors\.test\.js|environment\.js/);
    return error instanceof dsw.NonFiniteError;
  });
});

test('the failing call changes nothing', () => {
  const environment = createEnvironment();
  const scene = new dsw.Scene(environment);
  scene.createParticle(inside);
  const before = scene.save();
  assert.throws(() => scene.createParticles([...inside, ...outside]), dsw.OutsideError);
  assert.throws(() => environment.markVolumes([environment.locate(inside).volume], dsw.Mark.Impassable), dsw.OccupiedError);
  assert.deepEqual(scene.save(), before);
  assert.equal(scene.getOccupants().length, 1);
});

test('arguments of other types and shapes are refused', () => {
  const environment = createEnvironment();
  const scene = new dsw.Scene(environment, { features: dsw.FEATURE_DEFORMING });
  const body = createCatheter(scene);
  const volume = environment.locate(inside).volume;
  for (const call of [
    () => environment.castSegments(new Float32Array(3), new Float64Array(3)),
    () => environment.cast('no point', inside),
    () => environment.cast([1], inside),
    () => environment.cast(['1', 2, 3], inside),
    () => environment.cast(inside, outside, { maxCels: 3 }),
    () => environment.getCentre(new dsw.VertexId(0, 1)),
    () => environment.getCentre({ index: 0 }),
    () => environment.markVolumes(new dsw.FaceIdArray(1), dsw.Mark.Impassable),
    () => environment.markVolumes(volume, dsw.Mark.Impassable),
    () => environment.castSegments([...inside], [...outside], { flights: [] }),
    () => environment.getVolumeId('0'),
    () => environment.locate.call(scene, inside),
    () => dsw.Environment.prototype.locate.call({}, inside),
    () => body.move(body.getPositions(), { vertexResponse: 'slide' }),
    () => body.moveRigid({ rotation: [0, 0, 1] }),
    () => body.getPositions([]),
    () => new dsw.Scene(null),
    () => new dsw.Scene({}),
    () => new dsw.Context({ log: 'console' }),
    () => dsw.cellOf(new dsw.BodyId(0, 1)),
    () => dsw.Environment.load('block'),
  ]) {
    assert.throws(call, (error) => !(error instanceof dsw.DartsweepError), String(call));
  }
  for (const call of [
    () => environment.castSegments(new Float64Array(4), new Float64Array(4)),
    () => environment.cast([1, 2], inside),
    () => environment.deform(new Float64Array(4)),
  ]) {
    assert.throws(call, dsw.WrongSizeError, String(call));
  }
  for (const call of [
    () => environment.getVolumeId(-1),
    () => environment.getVolumeId(2 ** 32),
    () => environment.getVolumeId(0.5),
    () => body.move(body.getPositions(), { search: 2 ** 40 }),
    () => new dsw.FlightArray(2).set(2, {}),
  ]) {
    assert.throws(call, RangeError, String(call));
  }
  for (const call of [() => environment.castSegments(new Float64Array(3), new Float64Array(6)), () => environment.deform(null)])
    assert.throws(call, dsw.WrongSizeError);
});

test('wrong lengths in the plane are told', () => {
  const environment = createPlane();
  const scene = new dsw.Scene(environment, { features: dsw.FEATURE_DEFORMING });
  const body = scene.createBody([40, 30, 45, 30], [0, 1]);
  for (const [text, call] of [
    ['2 coordinates, or a third that is 0', () => environment.cast([40, 30, 1], [40, 30])],
    ['2 coordinates; 3 numbers are no points', () => environment.castSegments([1, 2, 3], [1, 2, 3])],
    ['2 coordinates; 5 numbers are no points', () => scene.createParticles(new Float64Array(5))],
    ['point_count is 3, the environment has 121', () => environment.deform(new Float64Array(6))],
    ['target_count is 3, there are 2', () => body.move(new Float64Array(6))],
    ['positions has 3 entries, not 2', () => body.getPositions(new Float64Array(6))],
  ]) {
    assert.throws(call, (error) => error instanceof dsw.WrongSizeError && error.message.includes(text), text);
  }
  assert.throws(() => environment.cast([40], [40, 30]), { name: 'TypeError', message: /2 in the plane/ });
});

'use strict';
const assert = require('node:assert/strict');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { test } = require('node:test');
const { setFlagsFromString } = require('node:v8');
const { runInNewContext } = require('node:vm');
const { Worker } = require('node:worker_threads');
const dsw = require('dartsweep');
const { createCatheter, createEnvironment, inside } = require('./scenario.js');

setFlagsFromString('--expose-gc');
const gc = runInNewContext('gc');

// What is collected is destroyed in a later turn of the event loop.
async function collect() {
  for (let i = 0; i < 5; ++i) {
    gc();
    await new Promise(setImmediate);
  }
}

test('closing twice is fine', () => {
  const environment = createEnvironment();
  const scene = new dsw.Scene(environment);
  scene.close();
  scene.close();
  environment.close();
  environment.close();
  assert.ok(scene.isClosed() && environment.isClosed());
});

test('use after close is an error', () => {
  const environment = createEnvironment();
  const scene = new dsw.Scene(environment);
  const body = createCatheter(scene);
  const particle = scene.createParticle(inside);
  scene.close();
  const closed = (message) => (error) =>
    error instanceof dsw.ClosedError && error.message === message && error.status === dsw.Status.NullArgument && error.code === 'DSW_CLOSED';
  for (const call of [
    () => body.getPositions(),
    () => body.move(new Float64Array(36)),
    () => scene.save(),
    () => scene.moveParticle(particle, inside),
    () => scene.createParticle(inside),
  ]) {
    assert.throws(call, closed('the scene is closed'));
  }
  environment.close();
  for (const call of [() => environment.save(), () => environment.cast(inside, inside), () => new dsw.Scene(environment)])
    assert.throws(call, closed('the environment is closed'));
});

test('a scene keeps its environment, a body its scene', async () => {
  const body = (() => {
    const environment = createEnvironment();
    const made = createCatheter(new dsw.Scene(environment));
    environment.close();
    return made;
  })();
  await collect();
  assert.equal(body.getPositions().length, 36);
  body.destroy();
  assert.throws(() => body.destroy(), dsw.StaleIdError);
  assert.throws(() => body.getPositions(), dsw.StaleIdError);
});

test('what is forgotten is given back', async () => {
  const environment = createEnvironment();
  (() => {
    const both = [new dsw.Scene(environment), new dsw.Scene(environment)];
    assert.throws(() => environment.markRegion(1, dsw.Mark.Impassable), dsw.SharedError);
    assert.ok(!both.some((scene) => scene.isClosed()));
  })();
  await collect();
  assert.equal(environment.info().sceneCount, 0);
});

test('a constructor that throws leaves nothing', async () => {
  const environment = createEnvironment();
  for (let i = 0; i < 10; ++i) assert.throws(() => new dsw.Scene(environment, { features: 1 << 30 }), dsw.UnsupportedError);
  await collect();
  assert.equal(environment.info().sceneCount, 0);
});

test('using closes', { skip: !Symbol.dispose }, () => {
  const environment = createEnvironment();
  environment[Symbol.dispose]();
  assert.ok(environment.isClosed());
});

test('classes can be derived from', () => {
  class Vessel extends dsw.Environment {}
  const environment = createEnvironment();
  const loaded = Vessel.load(environment.save());
  assert.ok(loaded instanceof Vessel);
  assert.deepEqual(loaded.info(), { ...environment.info(), memoryBytes: loaded.info().memoryBytes });
});

test('a worker that ends in the middle takes its objects along', async () => {
  const worker = new Worker(
    `const { createCatheter, createEnvironment } = require(${JSON.stringify(require.resolve('./scenario.js'))});
     const { Context, Scene } = require('dartsweep');
     const { parentPort } = require('node:worker_threads');
     const environment = createEnvironment({ context: new Context({ log() {} }) });
     globalThis.body = createCatheter(new Scene(environment));
     parentPort.postMessage('made');
     setInterval(() => environment.save(), 1);`,
    { eval: true, env: process.env },
  );
  await new Promise((resolve, reject) => worker.once('message', resolve).once('error', reject));
  assert.equal(await worker.terminate(), 1);
});

test('a bug report is one call', () => {
  const scene = new dsw.Scene(createEnvironment());
  scene.startRecording(null, dsw.RECORDING_LATEST);
  scene.createParticle(inside);
  const file = path.join(os.tmpdir(), `dartsweep-${process.pid}.dswrec`);
  const { isRight, places, text } = scene.writeBugReport(file, 'a note');
  assert.deepEqual({ isRight, places, text }, { isRight: 1, places: 1, text: '' });
  assert.ok(fs.readFileSync(file).includes('a note'));
  fs.rmSync(file);
  scene.stopRecording();
});

test('the log comes after the call that wrote it', () => {
  const lines = [];
  const log = (level, text) => lines.push([level, text, environment?.isClosed()]);
  let environment;
  environment = createEnvironment({ context: new dsw.Context({ threads: 2, log }) });
  assert.equal(lines.length, 1);
  assert.equal(lines[0][0], dsw.LogLevel.Info);
  assert.match(lines[0][1], /^dsw_environment_create: \d+ volumes/);
  createEnvironment({ context: new dsw.Context({ log: () => { throw new Error('dropped'); } }) });
  createEnvironment({ context: new dsw.Context() });
});

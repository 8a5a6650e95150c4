#!/bin/sh
# crashcat (physics in JavaScript) and scaled shapes: a ball, a cylinder and a capsule that are stretched along one axis, as an ellipsoid in its guide is.
# One would guess that contacts are where the shape is: the guide offers a scale for each axis to all shapes, and has a ball by [1, 2, 1] as an ellipsoid.
# What happens: a ball, a cylinder and a capsule are scaled by the factor of x along all three axes. A ball or a cylinder by [1, 2, 1], which should be twice as
# high, is as high as before for rays, and lies half as high on the ground as it should. By [2, 1, 1] a ray finds it at twice its height. A ball that is 0.01
# deep in a flat dome by [4, 1, 4] has the depth 1.51, and one 0.01 above has none, for there the box of bounds ends. Boxes and hulls are right. Volume and
# bounds are those of the shape that was asked for, so what is not there has weight. No warning is given.
# Who meets it: whoever makes ellipsoids, eggs or discs of balls, or longer posts of one cylinder, as models and editors with a scale for each axis do.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/scale.mjs" <<'JS'
import assert from 'node:assert';
import { readFileSync } from 'node:fs';
import * as cat from 'crashcat';

cat.registerAll();
const CORNERS = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].flatMap((z) => [x / 2, y / 2, z / 2])));
const SHAPES = {
  ball: () => cat.sphere.create({ radius: 0.5 }),
  cylinder: () => cat.cylinder.create({ halfHeight: 0.5, radius: 0.5 }),
  capsule: () => cat.capsule.create({ halfHeightOfCylinder: 0.25, radius: 0.25 }),
  box: () => cat.box.create({ halfExtents: [0.5, 0.5, 0.5] }),
  hull: () => cat.convexHull.create({ positions: CORNERS }),
};

function empty() {
  const settings = cat.createWorldSettings();
  const moving = cat.addObjectLayer(settings, cat.addBroadphaseLayer(settings));
  const still = cat.addObjectLayer(settings, cat.addBroadphaseLayer(settings));
  cat.enableCollision(settings, moving, still);
  settings.gravity = [0, -9.81, 0];
  return { world: cat.createWorld(settings), moving, still };
}

function reach(shape, axis) {
  const { world, still } = empty();
  cat.rigidBody.create(world, { motionType: cat.MotionType.STATIC, shape, objectLayer: still });
  const collector = cat.createClosestCastRayCollector();
  collector.reset();
  const [from, along] = [[0, 0, 0], [0, 0, 0]];
  from[axis] = 5;
  along[axis] = -1;
  cat.castRay(world, collector, cat.createDefaultCastRaySettings(), from, along, 10, cat.filter.create(world.settings.layers));
  return Number((5 - 10 * collector.hit.fraction).toFixed(2));
}

function rest(shape) {
  const { world, moving, still } = empty();
  const ground = cat.box.create({ halfExtents: [5, 0.5, 5] });
  cat.rigidBody.create(world, { motionType: cat.MotionType.STATIC, shape: ground, objectLayer: still, position: [0, -0.5, 0] });
  const body = cat.rigidBody.create(world, { motionType: cat.MotionType.DYNAMIC, shape, objectLayer: moving, position: [0, 1.1, 0] });
  for (let step = 0; step < 300; ++step) cat.updateWorld(world, undefined, 1 / 60);
  return Number(body.position[1].toFixed(2));
}

function overlap(shape, height) {
  const { world, still } = empty();
  cat.rigidBody.create(world, { motionType: cat.MotionType.STATIC, shape, objectLayer: still });
  const collector = cat.createAllCollideShapeCollector();
  collector.reset();
  const settings = cat.createDefaultCollideShapeSettings();
  cat.collideShape(world, collector, settings, cat.sphere.create({ radius: 0.1 }), [0, height, 0], [0, 0, 0, 1], [1, 1, 1], cat.filter.create(world.settings.layers));
  return collector.hits.map((hit) => Number(hit.penetration.toFixed(2)));
}

const found = {};
for (const [name, make] of Object.entries(SHAPES)) {
  const tall = cat.scaled.create({ shape: make(), scale: [1, 2, 1] });
  const wide = cat.scaled.create({ shape: make(), scale: [2, 1, 1] });
  assert.equal(tall.aabb[4], 1);
  assert(Math.abs(tall.volume / make().volume - 2) < 1e-9);
  found[name] = { tall: [0, 1, 2].map((axis) => reach(tall, axis)), rest: rest(tall), wide: [0, 1, 2].map((axis) => reach(wide, axis)) };
}
const dome = cat.scaled.create({ shape: SHAPES.ball(), scale: [4, 1, 4] });
const depths = [0.61, 0.59].map((height) => overlap(dome, height));
console.log('crashcat', JSON.parse(readFileSync('node_modules/crashcat/package.json')).version, 'half extents by rays, and the height at rest:', JSON.stringify(found), 'depths of a ball 0.01 above and 0.01 within a flat dome:', JSON.stringify(depths));
for (const name of ['box', 'hull']) assert.deepEqual(found[name], { tall: [0.5, 1, 0.5], rest: 1, wide: [1, 0.5, 0.5] });
for (const name of ['ball', 'cylinder']) {
  assert.deepEqual(found[name].tall, [0.5, 0.5, 0.5], 'the factor of y counts now');
  assert(Math.abs(found[name].rest - 0.5) < 0.05);
  assert.deepEqual(found[name].wide, [1, 1, 1]);
}
assert.deepEqual([found.capsule.tall, found.capsule.wide], [[0.25, 0.5, 0.25], [0.5, 1, 0.5]]);
assert(depths[0].length === 0 && depths[1][0] > 1.4, 'the depth on a flat dome is another now');
JS
cd "$folder"
npm install --silent --no-fund --no-audit crashcat@0.0.5 > "$folder/npm.txt"
node scale.mjs

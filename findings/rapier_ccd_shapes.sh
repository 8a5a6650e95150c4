#!/bin/sh
# Rapier in JavaScript (rapier3d-compat), a thin wall, and bodies with continuous collision detection (setCcdEnabled(true)).
# One would guess that a body which a wall holds at 2 m/s is held at 40 m/s with CCD: that is what it is for, and balls, cuboids and hulls are.
# What happens: bodies whose shape is a mesh or voxels are held at 2 m/s, and go through the wall at 20, 40 and 100 m/s, mostly or always. CCD on or off, as
# many of twelve go through, and nothing warns. A convex hull of the same corners is held at all speeds, with CCD as without.
# Who meets it: whoever throws, shoots or swings parts that are not convex, and turns on CCD for them.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/wall.mjs" <<'JS'
import rapier from '@dimforge/rapier3d-compat';

const warn = console.warn;
console.warn = () => {};
await rapier.init();
console.warn = warn;
const { ColliderDesc, RigidBodyDesc } = rapier;
const corners = (half) => new Float32Array([-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].flatMap((z) => [x * half, y * half, z * half]))));
const sides = new Uint32Array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]));
const bodies = {
  ball: () => ColliderDesc.ball(0.1),
  cuboid: () => ColliderDesc.cuboid(0.1, 0.1, 0.1),
  hull: () => ColliderDesc.convexHull(corners(0.1)),
  mesh: () => ColliderDesc.trimesh(corners(0.1), sides),
  voxels: () => ColliderDesc.voxels(new Int32Array([-1, 0].flatMap((x) => [-1, 0].flatMap((y) => [-1, 0].flatMap((z) => [x, y, z])))), { x: 0.1, y: 0.1, z: 0.1 }),
};
const STARTS = 12;

/** How many bodies of twelve, which start a little apart, are beyond the wall. */
function through(body, speed, ccd) {
  let count = 0;
  for (let i = 0; i < STARTS; i++) {
    const world = new rapier.World({ x: 0, y: 0, z: 0 });
    world.createCollider(ColliderDesc.cuboid(5, 0.01, 5));
    const thing = world.createRigidBody(RigidBodyDesc.dynamic().setTranslation(0.03, 1 + ((speed / 60) * i) / STARTS, 0.02).setLinvel(0, -speed, 0).setCcdEnabled(ccd));
    world.createCollider(bodies[body](), thing);
    for (let k = 0; k < 10 + 150 / speed; k++) world.step();
    if (thing.translation().y < -0.25) count++;
    world.free();
  }
  return count;
}

const speeds = [2, 20, 40, 100];
const found = Object.fromEntries(Object.keys(bodies).map((body) => [body, [false, true].map((ccd) => speeds.map((speed) => through(body, speed, ccd)))]));
console.log('rapier', rapier.version(), 'through the wall of', STARTS, 'at', speeds.join(', '), 'm/s without and with CCD:', JSON.stringify(found));
const held = ['ball', 'cuboid', 'hull'].every((body) => found[body].flat().every((count) => count === 0));
const passed = ['mesh', 'voxels'].every((body) => String(found[body][0]) === String(found[body][1]) && found[body][1][0] === 0 && found[body][1].slice(1).every((count) => count >= STARTS / 3));
if (!held || !passed) {
  console.log('this has changed');
  process.exit(1);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit @dimforge/rapier3d-compat@0.21.0 > /dev/null
node wall.mjs

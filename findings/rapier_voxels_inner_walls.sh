#!/bin/sh
# Rapier in JavaScript (rapier3d-compat) and questions to a solid block of 4 x 4 x 4 voxels, beside the same block as a cuboid.
# One would guess that both answer alike: voxels know their neighbours, so that bodies do not catch on inner borders.
# What happens: from a place in the middle, 0.7 from the nearest wall and 0.8 below the top, projectPoint and castRay (solid: false) end at the border of one
# voxel, 0.13 and 0.3 away, where there is no wall. contactShape says null for a ball that is 0.1 deep in the block, which intersectsShape and
# castShape find. No warning is given. The cuboid gives 0.7, 0.8 and -0.1.
# Who meets it: whoever asks how deep a drill, a probe or a camera is in voxels, or pushes things out of them by the nearest wall.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/ask.mjs" <<'JS'
import rapier from '@dimforge/rapier3d-compat';

const warn = console.warn;
console.warn = () => {};
await rapier.init();
console.warn = warn;
const four = [-2, -1, 0, 1], none = { x: 0, y: 0, z: 0 }, straight = { x: 0, y: 0, z: 0, w: 1 }, ball = new rapier.Ball(0.2);
const blocks = {
  cuboid: rapier.ColliderDesc.cuboid(1, 1, 1),
  voxels: rapier.ColliderDesc.voxels(new Int32Array(four.flatMap((x) => four.flatMap((y) => four.flatMap((z) => [x, y, z])))), { x: 0.5, y: 0.5, z: 0.5 }),
};
const round = (x) => (x === undefined ? null : Math.round(1000 * x) / 1000);

function ask(shape) {
  const world = new rapier.World(none);
  const block = world.createCollider(shape), place = { x: 0.13, y: 0.2, z: 0.3 }, above = { x: 0.13, y: 1.1, z: 0.3 };
  world.step();
  const { point } = block.projectPoint(place, false);
  const answers = {
    toWall: round(Math.hypot(point.x - place.x, point.y - place.y, point.z - place.z)),
    rayUp: round(block.castRay(new rapier.Ray(place, { x: 0, y: 1, z: 0 }), 10, false)),
    overlaps: block.intersectsShape(ball, above, straight),
    depth: round(block.contactShape(ball, above, straight, 0.1)?.distance),
    castDown: round(block.castShape(none, ball, { x: 0.13, y: 3, z: 0.3 }, straight, { x: 0, y: -1, z: 0 }, 0, 10, true)?.time_of_impact),
  };
  world.free();
  return answers;
}

const found = Object.fromEntries(Object.entries(blocks).map(([name, shape]) => [name, ask(shape)]));
console.log('rapier', rapier.version(), 'answers of a block of side 2:', JSON.stringify(found));
const expected = {
  cuboid: { toWall: 0.7, rayUp: 0.8, overlaps: true, depth: -0.1, castDown: 1.8 },
  voxels: { toWall: 0.13, rayUp: 0.3, overlaps: true, depth: null, castDown: 1.8 },
};
if (JSON.stringify(found) !== JSON.stringify(expected)) {
  console.log('this has changed');
  process.exit(1);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit @dimforge/rapier3d-compat@0.21.0 > /dev/null
node ask.mjs

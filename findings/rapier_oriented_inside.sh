#!/bin/sh
# Rapier in JavaScript (rapier3d-compat) and a ball within a cube of triangles that is solid by the flag ORIENTED, beside a cuboid.
# One would guess that the answers for a ball that is wholly inside agree with one another, and with those of the cuboid.
# What happens: containsPoint and intersectsShape say that the ball is inside. contactShape gives the distance +0.5, which is a gap, where the cuboid gives the
# depth -0.9. castShape from this place says that the ball can go 1.0 before it hits, where the cuboid says 0. castRay (solid: true) from inside ends at
# the wall, 0.8 away, and projectPoint (solid: true) at the wall, too, though a solid's own point is its nearest. Without the flag the cube is hollow for all.
# Who meets it: whoever makes closed meshes solid by the flag, and pushes by contactShape or moves characters and tools by castShape.
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
const none = { x: 0, y: 0, z: 0 }, straight = { x: 0, y: 0, z: 0, w: 1 }, ball = new rapier.Ball(0.2), place = { x: 0.13, y: 0.2, z: 0.3 };
const corners = new Float32Array([-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].flatMap((z) => [x, y, z]))));
const sides = new Uint32Array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]));
const cubes = {
  cuboid: rapier.ColliderDesc.cuboid(1, 1, 1),
  oriented: rapier.ColliderDesc.trimesh(corners, sides, rapier.TriMeshFlags.ORIENTED),
  mesh: rapier.ColliderDesc.trimesh(corners, sides),
};
const round = (x) => (x === undefined ? null : Math.round(100 * x) / 100);

function ask(shape) {
  const world = new rapier.World(none), cube = world.createCollider(shape);
  world.step();
  const { point } = cube.projectPoint(place, true);
  const answers = {
    contains: cube.containsPoint(place),
    overlaps: cube.intersectsShape(ball, place, straight),
    contact: round(cube.contactShape(ball, place, straight, 1)?.distance),
    cast: round(cube.castShape(none, ball, place, straight, { x: 0, y: -1, z: 0 }, 0, 10, true)?.time_of_impact),
    ray: round(cube.castRay(new rapier.Ray(place, { x: 0, y: 1, z: 0 }), 10, true)),
    toWall: round(Math.hypot(point.x - place.x, point.y - place.y, point.z - place.z)),
  };
  world.free();
  return answers;
}

const found = Object.fromEntries(Object.entries(cubes).map(([name, shape]) => [name, ask(shape)]));
console.log('rapier', rapier.version(), 'answers of a cube of side 2:', JSON.stringify(found));
const expected = {
  cuboid: { contains: true, overlaps: true, contact: -0.9, cast: 0, ray: 0, toWall: 0 },
  oriented: { contains: true, overlaps: true, contact: 0.5, cast: 1, ray: 0.8, toWall: 0.7 },
  mesh: { contains: false, overlaps: false, contact: 0.5, cast: 1, ray: 0.8, toWall: 0.7 },
};
if (JSON.stringify(found) !== JSON.stringify(expected)) {
  console.log('this has changed');
  process.exit(1);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit @dimforge/rapier3d-compat@0.21.0 > /dev/null
node ask.mjs

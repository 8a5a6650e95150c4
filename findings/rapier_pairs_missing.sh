#!/bin/sh
# Rapier in JavaScript (rapier3d-compat) and bodies of five kinds that fall slowly on grounds of four kinds.
# One would guess that each body lies on each ground, or that a pair without a contact is an error: balls, cuboids and hulls lie on all four.
# What happens: a body of voxels falls through a mesh and a height field, and a mesh of triangles falls through a height field and through voxels, as if they
# were air. The same bodies lie on cuboids, mesh on mesh and voxels on voxels. There is no warning.
# Who meets it: whoever drops parts that are not convex, as meshes or voxels, on terrain, or digs and builds in voxels with tools that are meshes.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/fall.mjs" <<'JS'
import rapier from '@dimforge/rapier3d-compat';

const warn = console.warn;
console.warn = () => {};
await rapier.init();
console.warn = warn;
const { ColliderDesc, RigidBodyDesc } = rapier, range = [...Array(50).keys()].map((i) => i - 25);
const corners = (half) => new Float32Array([-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].flatMap((z) => [x * half, y * half, z * half]))));
const sides = new Uint32Array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]));
const bodies = {
  ball: () => ColliderDesc.ball(0.1),
  cuboid: () => ColliderDesc.cuboid(0.1, 0.1, 0.1),
  hull: () => ColliderDesc.convexHull(corners(0.1)),
  mesh: () => ColliderDesc.trimesh(corners(0.1), sides),
  voxels: () => ColliderDesc.voxels(new Int32Array([-1, 0].flatMap((x) => [-1, 0].flatMap((y) => [-1, 0].flatMap((z) => [x, y, z])))), { x: 0.1, y: 0.1, z: 0.1 }),
};
const grounds = {
  cuboid: () => ColliderDesc.cuboid(5, 0.01, 5),
  mesh: () => ColliderDesc.trimesh(new Float32Array([-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5]), new Uint32Array([0, 2, 1, 0, 3, 2])),
  heightfield: () => ColliderDesc.heightfield(2, 2, new Float32Array(9), { x: 10, y: 1, z: 10 }),
  voxels: () => ColliderDesc.voxels(new Int32Array(range.flatMap((x) => range.flatMap((z) => [x, 0, z]))), { x: 0.2, y: 0.02, z: 0.2 }),
};

/** Whether a body that falls by 0.2 is below the ground after a second. */
function falls(body, ground) {
  const world = new rapier.World({ x: 0, y: -9.81, z: 0 });
  world.createCollider(grounds[ground]());
  const thing = world.createRigidBody(RigidBodyDesc.dynamic().setTranslation(0.03, 0.3, 0.02));
  world.createCollider(bodies[body](), thing);
  for (let i = 0; i < 60; i++) world.step();
  const height = thing.translation().y;
  world.free();
  return height < -1;
}

const through = Object.keys(bodies).flatMap((body) => Object.keys(grounds).filter((ground) => falls(body, ground)).map((ground) => `${body} ${ground}`));
console.log('rapier', rapier.version(), 'bodies and the grounds they fall through:', through.join(', '));
if (through.join() !== 'mesh heightfield,mesh voxels,voxels mesh,voxels heightfield') {
  console.log('this has changed');
  process.exit(1);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit @dimforge/rapier3d-compat@0.21.0 > /dev/null
node fall.mjs

#!/bin/sh
# Rapier in JavaScript (rapier3d-compat) and the mass of shapes with round borders (roundCuboid, roundCylinder, roundCone, roundConvexHull).
# One would guess that a cube of side 0.8 with a border of 0.1 weighs nearly what the cube of side 1 does that it fills but for its edges.
# What happens: it weighs 0.512, as if the border had no weight, and collider.volume() says 0.512, too, while it lies on the ground half a unit high, as the
# cube of side 1 does. Its moments of inertia are a third of those. The same is true of cylinders, cones and hulls. A capsule, which is a segment
# with a border, is weighed rightly. No warning is given, and the density that was set is not the one of what is seen.
# Who meets it: whoever rounds edges so that things slide and roll well, and compares weights, or stacks round on sharp things.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/mass.mjs" <<'JS'
import rapier from '@dimforge/rapier3d-compat';

const warn = console.warn;
console.warn = () => {};
await rapier.init();
console.warn = warn;
const { ColliderDesc, RigidBodyDesc } = rapier;
const corners = (half) => new Float32Array([-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].flatMap((z) => [x * half, y * half, z * half]))));
const pairs = {
  cuboid: [ColliderDesc.cuboid(0.5, 0.5, 0.5), ColliderDesc.roundCuboid(0.4, 0.4, 0.4, 0.1)],
  cylinder: [ColliderDesc.cylinder(0.5, 0.5), ColliderDesc.roundCylinder(0.4, 0.4, 0.1)],
  hull: [ColliderDesc.convexHull(corners(0.5)), ColliderDesc.roundConvexHull(corners(0.4), 0.1)],
  capsule: [ColliderDesc.cylinder(0.5, 0.5), ColliderDesc.capsule(0.4, 0.5)],
};

/** Mass, volume and moment of inertia at density 1, and the height at which the thing rests. */
function weighed(shape) {
  const world = new rapier.World({ x: 0, y: -9.81, z: 0 });
  world.createCollider(ColliderDesc.cuboid(5, 1, 5).setTranslation(0, -1, 0));
  const body = world.createRigidBody(RigidBodyDesc.dynamic().setTranslation(0, 1, 0).lockRotations());
  const part = world.createCollider(shape, body);
  for (let i = 0; i < 180; i++) world.step();
  const numbers = [part.mass(), part.volume(), body.principalInertia().y, body.translation().y].map((x) => Math.round(1000 * x) / 1000);
  world.free();
  return numbers;
}

const found = Object.fromEntries(Object.entries(pairs).map(([name, shapes]) => [name, shapes.map(weighed)]));
console.log('rapier', rapier.version(), 'mass, volume, moment and height, sharp and round:', JSON.stringify(found));
const near = (a, b) => Math.abs(a - b) < 0.01;
const light = ['cuboid', 'cylinder', 'hull'].every((name) => {
  const [sharp, round] = found[name];
  return near(round[0], 0.512 * sharp[0]) && round[1] === round[0] && near(round[2], 0.328 * sharp[2]) && near(round[3], sharp[3]) && near(round[3], 0.5);
});
if (!light || !near(found.capsule[1][0], Math.PI * 0.25 * 0.8 + (Math.PI * 4 / 3) * 0.125)) {
  console.log('this has changed');
  process.exit(1);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit @dimforge/rapier3d-compat@0.21.0 > /dev/null
node mass.mjs

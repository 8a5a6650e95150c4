#!/bin/sh
# Rapier in JavaScript (rapier3d-compat), before and since 0.20, and things that are fast or turn fast.
# One would guess that a body in empty space keeps the velocity that it is given, and that without continuous collision detection a ball of 100 m/s
# goes through a thin wall at 60 steps a second.
# What happens: up to 0.19.3 both are so. 0.21.0 slows every body to 400 units of length a second and to an eighth of a turn a step, without a word, and
# its integration parameters have no number for this. lengthUnit = 1000 raises the first limit a thousandfold and leaves the second. A wall of two
# triangles that does not move stops the ball with CCD off.
# Who meets it: whoever simulates in millimetres (400 mm/s), spins a drill or a rotor (47 rad/s at 60 steps), or compares engines by what they miss.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/speed.mjs" <<'JS'
import rapier from '@dimforge/rapier3d-compat';

await rapier.init();

function flight(unit, step, speed, turning, wall, ccd) {
  const world = new rapier.World({ x: 0, y: 0, z: 0 });
  world.timestep = step;
  world.lengthUnit = unit;
  if (wall)
    world.createCollider(rapier.ColliderDesc.trimesh(new Float32Array([3, -50, -50, 3, 50, -50, 3, 50, 50, 3, -50, 50]), new Uint32Array([0, 1, 2, 0, 2, 3])));
  const body = world.createRigidBody(rapier.RigidBodyDesc.dynamic().setLinvel(speed, 0, 0).setAngvel({ x: 0, y: 0, z: turning }).setCcdEnabled(ccd));
  world.createCollider(rapier.ColliderDesc.ball(0.1), body);
  for (let i = 0; i < 30; i++) world.step();
  const at = [body.linvel().x, body.angvel().z, body.translation().x].map((x) => Math.round(10 * x) / 10);
  world.free();
  return at;
}

const free = [[1, 1 / 60], [1, 1 / 600], [1000, 1 / 60]].map(([unit, step]) => flight(unit, step, 3000, 3000, false, false).slice(0, 2));
const [off, on] = [false, true].map((ccd) => flight(1, 1 / 60, 100, 0, true, ccd)[2]);
console.log('rapier', rapier.version(), '3000 m/s and rad/s become', JSON.stringify(free), 'the ball is at', off, 'without CCD and at', on, 'with it; the wall at 3');
const isCapped = JSON.stringify(free) === '[[400,47.1],[400,471.2],[3000,47.1]]';
const isFree = free.flat().every((x) => x === 3000);
if (on > 3 || (process.argv[2] === 'capped' ? !isCapped || off > 3 : !isFree || off < 49)) {
  console.log('this has changed');
  process.exit(1);
}
JS
for pair in 0.19.3:free 0.21.0:capped; do
  mkdir "$folder/${pair%:*}"
  cp "$folder/speed.mjs" "$folder/${pair%:*}"
  (cd "$folder/${pair%:*}" && npm install --silent --no-fund --no-audit "@dimforge/rapier3d-compat@${pair%:*}" > /dev/null && node speed.mjs "${pair#*:}" 2> /dev/null)
done

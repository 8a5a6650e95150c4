#!/bin/sh
# Rapier in JavaScript (rapier3d-compat) and a ball inside of a tube, with flags that mend contacts with meshes.
# One would guess that FIX_INTERNAL_EDGES takes away bumps at edges and nothing else, so a ball with CCD that starts inside stays inside, whichever
# way the triangles face.
# What happens: with this flag a wall has one side. A tube whose triangles face outwards, as those of every closed surface do, lets the ball
# out at 1 m/s, with CCD as without; one whose triangles face inwards lets a ball in from outside. The flag ORIENTED, which did
# nothing here up to 0.19.3, lets a fast ball out of the first tube since 0.20. FIX_INTERNAL_EDGES_TWO_SIDED, which came with 0.21, holds on both sides.
# Who meets it: whoever simulates in a vessel, a pipe or a room of one surface and takes the flag for smooth sliding.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/tube.mjs" <<'JS'
import rapier from '@dimforge/rapier3d-compat';

await rapier.init();
const count = 24;

/** A tube of radius 1 along z, of one layer of triangles. */
function tube(inwards) {
  const points = [], triangles = [];
  for (let i = 0; i < count; i++) {
    const angle = (2 * Math.PI * i) / count, low = 2 * i, next = 2 * ((i + 1) % count);
    points.push(Math.cos(angle), Math.sin(angle), -50, Math.cos(angle), Math.sin(angle), 50);
    for (const [a, b, c] of [[low, next, next + 1], [low, next + 1, low + 1]]) triangles.push(a, inwards ? c : b, inwards ? b : c);
  }
  return [new Float32Array(points), new Uint32Array(triangles)];
}

/** Whether a ball is held, that starts inside or outside with CCD. */
function holds(flags, inwards, speed, isInside) {
  const world = new rapier.World({ x: 0, y: 0, z: 0 });
  world.createCollider(rapier.ColliderDesc.trimesh(...tube(inwards), flags));
  const start = isInside ? [0, speed, 0.3 * speed] : [3, -speed, 0];
  const body = world.createRigidBody(rapier.RigidBodyDesc.dynamic().setTranslation(start[0], 0, 0).setLinvel(start[1], start[2], 0).setCcdEnabled(true));
  world.createCollider(rapier.ColliderDesc.ball(0.1).setFriction(0), body);
  let isHeld = true;
  for (let i = 0; i < 180 / Math.min(speed, 3); i++) {
    world.step();
    const away = Math.hypot(body.translation().x, body.translation().y);
    isHeld &&= isInside ? away < 1 : away > 1;
  }
  world.free();
  return isHeld;
}

const flags = rapier.TriMeshFlags, found = {};
for (const [name, flag] of [['none', 0], ['ORIENTED', flags.ORIENTED], ['FIX_INTERNAL_EDGES', flags.FIX_INTERNAL_EDGES], ['FIX_INTERNAL_EDGES_TWO_SIDED', flags.FIX_INTERNAL_EDGES_TWO_SIDED]])
  if (flag !== undefined) found[name] = [holds(flag, false, 1, true), holds(flag, false, 20, true), holds(flag, true, 20, true), holds(flag, true, 1, false)];
console.log('rapier', rapier.version(), 'held inside at 1 and 20 m/s, facing outwards; at 20, facing inwards; outside, facing inwards:', JSON.stringify(found));
const all = [true, true, true, true], isNew = process.argv[2] === 'new';
const expected = { none: all, ORIENTED: isNew ? [true, false, true, true] : all, FIX_INTERNAL_EDGES: [false, false, true, false], ...(isNew ? { FIX_INTERNAL_EDGES_TWO_SIDED: all } : {}) };
if (JSON.stringify(found) !== JSON.stringify(expected)) {
  console.log('this has changed');
  process.exit(1);
}
JS
for pair in 0.19.3:old 0.21.0:new; do
  mkdir "$folder/${pair%:*}"
  cp "$folder/tube.mjs" "$folder/${pair%:*}"
  (cd "$folder/${pair%:*}" && npm install --silent --no-fund --no-audit "@dimforge/rapier3d-compat@${pair%:*}" > /dev/null && node tube.mjs "${pair#*:}" 2> /dev/null)
done

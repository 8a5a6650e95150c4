#!/bin/sh
# Jolt in JavaScript (jolt-physics) and things inside of a tube of triangles.
# One would guess that motion quality LinearCast, Jolt's continuous collision detection, keeps a ball in a tube, and a rod from turning through its wall.
# What happens: a mesh is solid from the side that its triangles face. A tube that faces outwards, as a closed surface does, lets the ball out at 1 m/s,
# also with LinearCast. One that faces inwards holds it at 1,000 m/s with LinearCast, and without at 1 m/s only. LinearCast is of translations:
# a rod that can tilt by 19.5 degrees in the tube tilts by 85 once it turns at 100 rad/s, and is then on the other side of the wall.
# Who meets it: whoever puts a catheter, a drill or a marble into a vessel or pipe of one surface.
# Needs node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/tube.mjs" <<'JS'
import { readFileSync } from 'node:fs';
import start from 'jolt-physics';

const jolt = await start(), count = 24, point = (i, z) => [Math.cos((2 * Math.PI * i) / count), Math.sin((2 * Math.PI * i) / count), z];
const settings = new jolt.JoltSettings(), pairs = new jolt.ObjectLayerPairFilterTable(2), layers = new jolt.BroadPhaseLayerInterfaceTable(2, 2);
pairs.EnableCollision(0, 1);
for (const layer of [0, 1]) layers.MapObjectToBroadPhaseLayer(layer, new jolt.BroadPhaseLayer(layer));
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
const world = new jolt.JoltInterface(settings), bodies = world.GetPhysicsSystem().GetBodyInterface();
world.GetPhysicsSystem().SetGravity(new jolt.Vec3(0, 0, 0));

/** A tube of radius 1 along z, of one layer of triangles. */
function tube(inwards) {
  const triangles = new jolt.TriangleList();
  triangles.resize(2 * count);
  for (let i = 0; i < 2 * count; i++) {
    const [a, b] = [i >> 1, (i >> 1) + 1], corners = i % 2 ? [point(a, -50), point(b, 50), point(a, 50)] : [point(a, -50), point(b, -50), point(b, 50)];
    (inwards ? [corners[0], corners[2], corners[1]] : corners).forEach((place, k) => {
      const corner = triangles.at(i).get_mV(k);
      [corner.x, corner.y, corner.z] = place;
    });
  }
  return new jolt.MeshShapeSettings(triangles).Create().Get();
}

/** How far from the axis a body comes in two seconds, and by how many degrees it tilts. */
function run(shape, inwards, speed, turning, quality) {
  const none = new jolt.Quat(0, 0, 0, 1), along = new jolt.Quat(Math.SQRT1_2, 0, 0, Math.SQRT1_2), zero = new jolt.RVec3(0, 0, 0);
  const wall = bodies.CreateBody(new jolt.BodyCreationSettings(tube(inwards), zero, none, jolt.EMotionType_Static, 0));
  const made = new jolt.BodyCreationSettings(shape, zero, along, jolt.EMotionType_Dynamic, 1);
  Object.assign(made, { mMotionQuality: quality, mMaxLinearVelocity: 5000, mMaxAngularVelocity: 5000, mFriction: 0, mRestitution: 0.5 });
  made.mLinearVelocity = new jolt.Vec3(speed, 0.3 * speed, 0);
  made.mAngularVelocity = new jolt.Vec3(turning, 0, 0);
  const body = bodies.CreateBody(made);
  bodies.AddBody(wall.GetID(), jolt.EActivation_DontActivate);
  bodies.AddBody(body.GetID(), jolt.EActivation_Activate);
  let away = 0, tilt = 0;
  for (let i = 0; i < 120; i++) {
    world.Step(1 / 60, 1);
    const at = body.GetPosition();
    away = Math.max(away, Math.hypot(at.GetX(), at.GetY()));
    tilt = Math.max(tilt, (180 / Math.PI) * Math.acos(Math.min(1, Math.abs(body.GetRotation().RotateAxisY().GetZ()))));
  }
  for (const one of [body, wall]) {
    bodies.RemoveBody(one.GetID());
    bodies.DestroyBody(one.GetID());
  }
  return [away, tilt];
}

const [discrete, cast] = [jolt.EMotionQuality_Discrete, jolt.EMotionQuality_LinearCast];
const held = (inwards, speed, quality) => run(new jolt.SphereShape(0.1), inwards, speed, 0, quality)[0] < 1;
const found = { outwards: [1, 1000].map((speed) => held(false, speed, cast)), inwards: [1, 1000].map((speed) => held(true, speed, cast)), discrete: [1, 1000].map((speed) => held(true, speed, discrete)) };
const tilts = [1, 100].map((turning) => Math.round(run(new jolt.CapsuleShape(3, 0.02), true, 0, turning, cast)[1]));
console.log('jolt-physics', JSON.parse(readFileSync('node_modules/jolt-physics/package.json')).version, 'held at 1 and 1,000 m/s:', JSON.stringify(found), 'tilt of a rod at 1 and 100 rad/s:', tilts.join(', '), 'of', Math.round((180 / Math.PI) * Math.asin(1 / 3)));
if (JSON.stringify(found) !== '{"outwards":[false,false],"inwards":[true,true],"discrete":[true,false]}' || tilts[0] > 21 || tilts[1] < 60) {
  console.log('this has changed');
  process.exit(1);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit jolt-physics@1.1.0 > /dev/null
node tube.mjs

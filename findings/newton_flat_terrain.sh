#!/bin/sh
# Newton and a box that slides without friction over flat ground: a plane, a flat mesh of triangles, and a flat height field.
# One would guess that it keeps its speed on all three, because nothing holds it back: the ground is level and friction is 0.
# What happens: on the plane it keeps 1 m/s. On the mesh and on the height field it has less than half of it after two seconds, and has drifted sideways, for a
# box whose side is four cells long; on a height field with cells twice as large a third is lost. Contacts with inner edges of the flat ground have normals of
# their own: those of a ball that is 0.01 deep in the height field are tilted by up to 36 degrees. No warning is given.
# Who meets it: whoever learns or tests walking, pushing or sliding on terrain, and measures friction, slip or energy there.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export WARP_CACHE_PATH="$folder/cache"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile newton==1.8.0 warp-lang==1.19.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import newton
import numpy as np
import warp as wp

wp.config.quiet = True
wp.config.optimization_level = 0
SMOOTH = newton.ModelBuilder.ShapeConfig(mu=0.0)


def model(ground, cell, shape, height):
    builder, count = newton.ModelBuilder(), round(8 / cell) + 1
    if ground == "plane":
        builder.add_ground_plane(cfg=SMOOTH)
    elif ground == "mesh":
        along = np.linspace(-4, 4, count)
        corners = np.array([(x, y, 0) for x in along for y in along], np.float32)
        first = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
        sides = np.stack([first, first + count, first + count + 1, first, first + count + 1, first + 1], axis=1)
        builder.add_shape_mesh(-1, mesh=newton.Mesh(corners, sides.ravel().astype(np.int32)), cfg=SMOOTH)
    else:
        flat = newton.Heightfield(data=np.zeros((count, count), np.float32), nrow=count, ncol=count, hx=4.0, hy=4.0)
        builder.add_shape_heightfield(heightfield=flat, cfg=SMOOTH)
    body = builder.add_body(xform=wp.transform((-1.47, -0.48, height), wp.quat_identity()))
    if shape == "box":
        builder.add_shape_box(body, hx=0.5, hy=0.5, hz=0.5, cfg=SMOOTH)
        builder.joint_qd[:] = [1, 0, 0, 0, 0, 0]
    else:
        builder.add_shape_sphere(body, radius=0.5, cfg=SMOOTH)
    return builder.finalize()


def slide(ground, cell):
    made = model(ground, cell, "box", 0.5)
    state, after, control = made.state(), made.state(), made.control()
    newton.eval_fk(made, made.joint_q, made.joint_qd, state)
    solver, pipeline = newton.solvers.SolverXPBD(made), newton.CollisionPipeline(made)
    contacts = pipeline.contacts()
    for _ in range(480):
        state.clear_forces()
        pipeline.collide(state, contacts)
        solver.step(state, after, control, contacts, 1 / 240)
        state, after = after, state
    return [round(float(state.body_qd.numpy()[0][0]), 2), round(float(state.body_q.numpy()[0][1]) + 0.48, 2)]


def tilt(ground):
    made = model(ground, 0.5, "ball", 0.49)
    pipeline = newton.CollisionPipeline(made)
    contacts = pipeline.contacts()
    pipeline.collide(made.state(), contacts)
    normals = contacts.rigid_contact_normal.numpy()[: int(contacts.rigid_contact_count.numpy()[0])]
    return round(float(np.degrees(np.arccos(np.abs(normals[:, 2]).min()))))


speeds = {(ground, cell): slide(ground, cell) for ground, cell in (("plane", 0.25), ("mesh", 0.25), ("height field", 0.25), ("height field", 0.5))}
tilts = {ground: tilt(ground) for ground in ("plane", "height field")}
print("newton", newton.__version__, "speed of 1 and drift after two seconds, by ground and cell:", speeds, "largest angle of a ball's normals in degrees:", tilts)
assert abs(speeds["plane", 0.25][0] - 1) < 0.01
assert all(speeds[ground, 0.25][0] < 0.6 for ground in ("mesh", "height field")) and speeds["height field", 0.5][0] < 0.8, "speed is kept now"
assert tilts["plane"] == 0 and tilts["height field"] > 30
PY

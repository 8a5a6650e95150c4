#!/bin/sh
# MuJoCo and a hollow mesh: a tube with a thick wall, and a ball inside.
# One would guess that a ball inside of a tube stays there.
# What happens: a geom of type `mesh` is the convex hull of its mesh, so the ball is pushed out of the tube at once. As a geom of type `sdf` the
# same mesh is hollow: the ball falls to the wall and lies there. Models of cables by <composite> or the plugin mujoco.elasticity.cable, which
# load up to 3.17, are refused since 4.0.0.
# Who meets it: everybody who takes a vessel or a pipe from a surface file, and everybody whose cables were made by the plugin.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > "$folder/tube.py" <<'PY'
import sys

import mujoco
import numpy as np

print("mujoco", mujoco.__version__)
mujoco.set_mju_user_warning(lambda message: None)
around = np.arange(24) * np.pi / 12
ring = np.stack([np.cos(around), np.sin(around)], axis=1)
corners, faces = [], []
for radius, z in ((0.5, -1), (0.5, 1), (1.0, 1), (1.0, -1)):  # round the section of the wall
    corners.append(np.column_stack([radius * ring, np.full(24, float(z))]))
for k in range(4):
    for i in range(24):
        a, b, c, d = 24 * k + i, 24 * k + (i + 1) % 24, 24 * ((k + 1) % 4) + (i + 1) % 24, 24 * ((k + 1) % 4) + i
        faces += [(a, c, b), (a, d, c)]
points, faces = np.concatenate(corners), np.array(faces)
volume = np.einsum("ij,ij->i", points[faces[:, 0]], np.cross(points[faces[:, 1]], points[faces[:, 2]])).sum() / 6
if volume < 0:
    faces = faces[:, ::-1]


def distance(kind):
    """How far from the axis the ball is after two seconds."""
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="0.002" gravity="-9.81 0 0"/>
      <asset><mesh name="tube" vertex="{' '.join(map(repr, points.ravel().tolist()))}" face="{' '.join(map(str, faces.ravel().tolist()))}"/></asset>
      <worldbody><geom type="{kind}" mesh="tube"/><body><freejoint/><geom size="0.1"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=1000)
    return float(np.hypot(*(data.qpos[:2]))), float(data.qpos[2])


def loads(name, text):
    try:
        mujoco.MjModel.from_xml_string(text)
    except ValueError as error:
        print(f"{name}:", str(error).splitlines()[0])
        return False
    print(f"{name}: loads")
    return True


if sys.argv[1] == "tube":
    mesh, sdf = distance("mesh"), distance("sdf")
    print("mesh: the ball is", mesh[0], "from the axis and", mesh[1], "along it")
    print("sdf: the ball is", sdf[0], "from the axis and", sdf[1], "along it")
    assert max(mesh) > 0.6 or mesh[0] > 0.6, "a mesh is hollow now"
    assert 0.3 < sdf[0] < 0.5 and abs(sdf[1]) < 1, "an sdf does not hold the ball"
composite = loads("composite", """<mujoco><worldbody><composite type="cable" curve="s" count="5 1 1" size="1"><geom type="capsule" size=".01"/></composite></worldbody></mujoco>""")
plugin = loads("cable plugin", """<mujoco><extension><plugin plugin="mujoco.elasticity.cable"/></extension><worldbody/></mujoco>""")
assert composite == plugin == (sys.argv[2] == "has"), "which releases have the cable is not what it was"
PY
for release in "3.17.0 plain has" "4.0.0 tube has_not"; do
  set -- $release
  python3 -m venv "$folder/$1"
  "$folder/$1/bin/pip" install -q --no-compile "mujoco==$1" numpy==2.4.6
  (cd "$folder" && "$1/bin/python" tube.py "$2" "$3")
done

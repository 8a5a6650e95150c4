#!/bin/sh
# FCL (through python-fcl) and the continuous test of two meshes.
# One would guess that a box of triangles that moves through a wall of triangles is found.
# What happens: sampling finds it. Conservative advancement does not, for a translation and for the motion between two transforms: it says that
# there is no collision. The polynomial solver finds it for a translation, and for the other motion says no as well, after a warning on stderr.
# Two boxes in their place are found, and a static test of the meshes half way finds them crossed.
# Who meets it: everybody who asks for the continuous collision of two meshes, for example a planner.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile python-fcl==0.7.0.11 numpy==2.2.6
cat > "$folder/meshes.py" <<'PY'
import fcl
import numpy as np

corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) / 2
faces = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])


def mesh(size):
    model = fcl.BVHModel()
    model.beginModel(len(corners), len(faces))
    model.addSubModel(corners * size, faces)
    model.endModel()
    return model


small, wall = (1.0, 1.0, 1.0), (0.2, 6.0, 6.0)
start, end = fcl.Transform(np.array([-3.0, 0.1, 0.05])), fcl.Transform(np.array([3.0, 0.1, 0.05]))


def moves_through(body, obstacle, motion, solver):
    moving, standing = fcl.CollisionObject(body, start), fcl.CollisionObject(obstacle, fcl.Transform())
    request = fcl.ContinuousCollisionRequest(num_max_iterations=1000, ccd_motion_type=motion, ccd_solver_type=solver)
    result = fcl.ContinuousCollisionResult()
    fcl.continuousCollide(moving, end, standing, fcl.Transform(), request, result)
    return result.is_collide


motions = (fcl.CCDMotionType.CCDM_TRANS, fcl.CCDMotionType.CCDM_LINEAR)
solvers = (fcl.CCDSolverType.CCDC_NAIVE, fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT, fcl.CCDSolverType.CCDC_POLYNOMIAL_SOLVER)
found = [moves_through(mesh(small), mesh(wall), motion, solver) for motion in motions for solver in solvers]
print("two meshes, by motion and solver:", found)
boxes = moves_through(fcl.Box(*small), fcl.Box(*wall), motions[0], solvers[0])
half_way = fcl.collide(fcl.CollisionObject(mesh(small), fcl.Transform(np.array([0.0, 0.1, 0.05]))), fcl.CollisionObject(mesh(wall), fcl.Transform()))
print("two boxes:", boxes, "meshes half way:", half_way)
assert found == [True, False, True, True, False, False] and boxes and half_way > 0, "FCL does otherwise now"
PY
"$folder/venv/bin/python" "$folder/meshes.py"

#!/bin/sh
# meshio++ (meshioplusplus) and the places of parts in OpenUSD files (.usda, .usd): three cubes of side 1 in a row, under a group that is scaled by 2.
# One would guess three cubes of side 2 with free room between them, as usd-core tells their bounds: the reader's help says that the stage's prims come back as
# one mesh, one behind the other, and names with warnings what it skips. Its reader of glTF puts parts where their nodes are.
# What happens: all three have side 1 and lie in the origin, in one another: translations, mirroring and the group's scale are left out. The cube whose
# orientation is leftHanded is inside out, so the volume of all is 1 and not 24. From glTF places and sizes are right, but a part that is mirrored by its
# node, which the format wants to be turned, is inside out as well: 16 + 8 - 8. No warning is given in either case.
# Who meets it: whoever takes scenes of Omniverse, Isaac or Blender into a mesher, a distance or a contact: every part overlaps every other one.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile meshioplusplus==17.21.0 usd-core==26.11 numpy==2.4.6
"$folder/venv/bin/python" - > "$folder/out.txt" 2> "$folder/warnings.txt" <<'PY' || { cat "$folder/out.txt" "$folder/warnings.txt"; exit 1; }
import base64
import importlib.metadata
import itertools
import json
import pathlib

import meshioplusplus
import numpy as np
from pxr import Usd, UsdGeom

CORNERS = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
TRIANGLES = np.array([corners for a, b, c, d in SIDES for corners in ((a, b, c), (a, c, d))])
PARTS = {"middle": (0, 1), "right": (3, 1), "mirrored": (-3, -1)}


def usd(name):
    """Writes the scene, and returns the bounds that usd-core has for it."""
    stage = Usd.Stage.CreateNew(name)
    group = UsdGeom.Xform.Define(stage, "/World")
    group.AddScaleOp().Set((2, 2, 2))
    for part, (place, factor) in PARTS.items():
        mesh = UsdGeom.Mesh.Define(stage, f"/World/{part}")
        mesh.CreatePointsAttr([tuple(map(float, corner)) for corner in CORNERS])
        mesh.CreateFaceVertexCountsAttr([3] * 12)
        # Both ways are the same cube: the other order, and the word for it.
        turned = TRIANGLES[:, ::-1] if part == "right" else TRIANGLES
        mesh.CreateFaceVertexIndicesAttr([int(corner) for corner in turned.ravel()])
        if part == "right":
            mesh.CreateOrientationAttr("leftHanded")
        mesh.CreateSubdivisionSchemeAttr("none")
        mesh.AddTranslateOp().Set((place, 0, 0))
        mesh.AddScaleOp().Set((factor, 1, 1))
    stage.Save()
    box = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default"]).ComputeWorldBound(group.GetPrim()).ComputeAlignedRange()
    return [list(box.GetMin()), list(box.GetMax())]


def gltf(name):
    data = CORNERS.astype("<f4").tobytes() + TRIANGLES.astype("<u2").tobytes()
    split = CORNERS.size * 4
    nodes = [{"children": [1, 2, 3], "scale": [2, 2, 2]}]
    nodes += [{"mesh": 0, "name": part, "translation": [place, 0, 0], "scale": [factor, 1, 1]} for part, (place, factor) in PARTS.items()]
    pathlib.Path(name).write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": split}, {"buffer": 0, "byteOffset": split, "byteLength": len(data) - split}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-0.5] * 3, "max": [0.5] * 3},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
    }))


def look(name):
    """Bounds, and the volumes of all cubes and of each."""
    mesh = meshioplusplus.read(name)
    cells = np.vstack([block.data for block in mesh.cells if block.type == "triangle"])
    a, b, c = mesh.points[cells].transpose(1, 0, 2)
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)).reshape(3, 12).sum(axis=1) / 6
    return [mesh.points.min(axis=0).tolist(), mesh.points.max(axis=0).tolist()], volumes.round(3).tolist()


true = usd("scene.usda")
gltf("scene.gltf")
found = {name: look(name) for name in ("scene.usda", "scene.gltf")}
print("meshioplusplus", importlib.metadata.version("meshioplusplus"), "bounds by usd-core:", true, "bounds and volumes of the cubes by meshio++:", found)
assert np.allclose(true, [[-7, -1, -1], [7, 1, 1]], atol=1e-6)
assert found["scene.usda"] == ([[-0.5] * 3, [0.5] * 3], [1, -1, 1]), "parts of USD files have places now"
assert np.allclose(found["scene.gltf"][0], true) and found["scene.gltf"][1] == [8, 8, -8], "mirrored parts of glTF face outwards now"
PY
cat "$folder/out.txt" "$folder/warnings.txt"
if grep -qi warning "$folder/warnings.txt"; then
  echo "this is told now"
  exit 1
fi

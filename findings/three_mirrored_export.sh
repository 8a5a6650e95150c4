#!/bin/sh
# three.js and a part and its mirror image (the scale -1 along x, as glTF, CAD and editors have left and right parts), written as STL, OBJ and PLY.
# One would guess that both are closed solids in the files, with their triangles facing outwards: rays of three.js meet the mirrored part from outside, and its
# writers put scales into the points. What they say of themselves has nothing on mirroring, while the writer of USDZ warns of it.
# What happens: in all three formats the points are mirrored and the triangles stay as they were, so the mirrored part is inside out: its volume is -1, and that
# of the pair is 0. The normals in STL point inwards, too. In OBJ and PLY normals point outwards, against the triangles beside them. If the files are read by
# three.js, a ray that met the part at 4.5 goes through the near wall and meets the far one at 5.5. No warning is given.
# Who meets it: whoever brings scenes from a browser to a slicer, a boolean, a contact or a signed distance: half of what comes in pairs is a hole. Needs
# node and npm.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/mirror.mjs" <<'JS'
import assert from 'node:assert';
import * as THREE from 'three';
import { OBJExporter } from 'three/addons/exporters/OBJExporter.js';
import { PLYExporter } from 'three/addons/exporters/PLYExporter.js';
import { STLExporter } from 'three/addons/exporters/STLExporter.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';

const FORMATS = {
  stl: (object) => [new STLLoader().parse(new STLExporter().parse(object))],
  'stl, binary': (object) => [new STLLoader().parse(new STLExporter().parse(object, { binary: true }).buffer)],
  obj: (object) => new OBJLoader().parse(new OBJExporter().parse(object)).children.map((mesh) => mesh.geometry),
  ply: (object) => [new PLYLoader().parse(new PLYExporter().parse(object))],
};

function scene(scales) {
  const group = new THREE.Group();
  for (const scale of scales) {
    const part = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 1));
    part.scale.x = scale;
    part.position.x = scales.length > 1 ? scale : 0;
    group.add(part);
  }
  group.updateMatrixWorld(true);
  return group;
}

function volume(geometries) {
  const [a, b, c] = [0, 1, 2].map(() => new THREE.Vector3());
  let sum = 0;
  for (const geometry of geometries) {
    const points = (geometry.index ? geometry.toNonIndexed() : geometry).attributes.position;
    for (let i = 0; i < points.count; i += 3) {
      [a, b, c].forEach((point, j) => point.fromBufferAttribute(points, i + j));
      sum += a.dot(b.cross(c)) / 6;
    }
  }
  return Number(sum.toFixed(3)) + 0;
}

function meet(object) {
  const ray = new THREE.Raycaster(new THREE.Vector3(5, 0.1, 0.2), new THREE.Vector3(-1, 0, 0));
  return ray.intersectObject(object, true)[0].distance;
}

function outwards(geometry) {
  const [point, normal] = [new THREE.Vector3(), new THREE.Vector3()];
  point.fromBufferAttribute(geometry.attributes.position, 0);
  normal.fromBufferAttribute(geometry.attributes.normal, 0);
  return point.dot(normal) > 0;
}

const found = {};
for (const [name, carry] of Object.entries(FORMATS)) {
  const read = carry(scene([-1]));
  found[name] = {
    part: volume(carry(scene([1]))), mirrored: volume(read), pair: volume(carry(scene([1, -1]))),
    normals: outwards(read[0]) ? 'outwards' : 'inwards', ray: meet(new THREE.Mesh(read[0])),
  };
}
console.log('three', THREE.REVISION, 'the ray in the scene:', meet(scene([-1])), 'volumes, normals and the ray by format:', JSON.stringify(found));
assert.equal(meet(scene([-1])), 4.5);
for (const [name, row] of Object.entries(found)) {
  assert.equal(row.part, 1);
  assert.deepEqual([row.mirrored, row.pair], [-1, 0], 'mirrored parts face outwards now');
  assert.equal(row.normals, name.startsWith('stl') ? 'inwards' : 'outwards');
  assert.equal(row.ray, 5.5);
}
JS
cd "$folder"
npm install --silent --no-fund --no-audit three@0.187.0 > "$folder/npm.txt"
node mirror.mjs

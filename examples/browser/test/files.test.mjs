// What the page makes of files, without a browser: files.test.mjs
import assert from 'node:assert/strict';
import fs from 'node:fs';
import test from 'node:test';

const source = fs.readFileSync(new URL('../src/files.js', import.meta.url), 'utf8');
const {readFile} = await import(`data:text/javascript,${encodeURIComponent(source)}`);

const read = (name, content) => readFile(new File([content], name));
const refused = (name, content, reason) => assert.rejects(read(name, content), error => {
  assert.ok(error.message.startsWith(`${name}: `), error.message);
  assert.match(error.message, reason);
  return true;
});

const CUBE = [0, 1].flatMap(z => [0, 1].flatMap(y => [0, 1].map(x => `${x} ${y} ${z}`))).join('\n');

function vtk(cells) {
  const lists = cells.map(([, ...corners]) => [corners.length, ...corners]);
  return ['# vtk DataFile Version 3.0', 'test', 'ASCII', 'DATASET UNSTRUCTURED_GRID', 'POINTS 8 double', CUBE,
    `CELLS ${cells.length} ${lists.flat().length}`, ...lists.map(list => list.join(' ')),
    `CELL_TYPES ${cells.length}`, ...cells.map(([type]) => type)].join('\n');
}

test('volumes: a voxel is a hexahedron, sides are left out', async () => {
  const {question, left} = await read('one.vtk', vtk([[11, 0, 1, 2, 3, 4, 5, 6, 7], [9, 0, 1, 3, 2]]));
  assert.equal(left, 1);
  assert.deepEqual([...question.types], [12]);
  assert.deepEqual([...question.corners], [0, 1, 3, 2, 4, 5, 7, 6]);
});

test('volumes: no cell is dropped without a word', async () => {
  const polyhedron = [42, 4, 3, 0, 1, 2, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 0, 4];
  await refused('two.vtk', vtk([[10, 0, 1, 2, 4], polyhedron]), /1 of its 2 cells have types that cannot be read here, such as 42 of VTK/);
  await refused('quadratic.vtk', vtk([[24, 0, 1, 2, 4, 5, 6, 7, 3, 0, 1]]), /such as 24 of VTK/);
  await refused('plane.vtk', vtk([[5, 0, 1, 2]]), /no tetrahedra, hexahedra, wedges or pyramids/);
  await refused('far.vtk', vtk([[10, 0, 1, 2, 8]]), /which do not fit/);
});

test('volumes: a file that is not what it says', async () => {
  await refused('xml.vtk', '<?xml version="1.0"?><VTKFile/>', /does not begin with/);
  await refused('fluent.msh', '(0 "grid")\n(2 3)\n', /no \$MeshFormat/);
  await refused('parametric.msh', '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n2 1 1 1\n1\n0 0 0 0.5 0.5\n$EndNodes\n', /parameters/);
});

test('surfaces: colours behind faces of .off are no faces', async () => {
  const {question, closed} = await read('colours.off', 'OFF # a comment\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n' +
    '3 0 2 1 255 0 0\n3 0 1 3 255 0 0\n3 1 2 3 0 255 0\n3 2 0 3 0 0 255\n');
  assert.equal(question.triangles.length, 12);
  assert.equal(closed, 0);
});

test('surfaces: files that end early, or hold something else', async () => {
  const binary = new Uint8Array(84 + 50 * 3 - 7);
  new DataView(binary.buffer).setUint32(80, 3, true);
  await refused('short.stl', binary, /227 bytes, but its 3 triangles take 234/);
  await refused('page.stl', '<html></html>', /ends early/);
  await refused('short.off', 'OFF\n4 4 0\n0 0 0\n', /ends early/);
  await refused('flat.obj', 'v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n', /fewer than three coordinates/);
  await refused('line.obj', 'v 0 0 0\nv 1 0 0\nf 1 2\n', /a face has 2 corners/);
  await refused('mesh.vtu', '<VTKFile/>', /reads only files that end in .obj, .off, .stl, .vtk, .msh\. In Python, dartsweep.read takes many more kinds/);
});

for (const name of ['tube.obj', 'tube.off', 'tube.stl', 'box.vtk', 'box.msh']) {
  test(`the sample ${name} is read`, async () => {
    const {question} = await read(name, fs.readFileSync(new URL(`files/${name}`, import.meta.url)));
    assert.ok(question.points.length > 0);
  });
}

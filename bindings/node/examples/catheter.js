// A catheter is pushed along a square vessel, against its wall: it slides, and contacts say where it touches.
'use strict';
const { CellType, Environment, ImpassableError, Mark, Response, Scene } = require('dartsweep');

const WIDTH = 5, LENGTH = 10, LINKS = 8; // cells, cells, vertices

// Hexahedra of side 1; those on the outside are region 2.
function createVessel() {
  const points = WIDTH + 1;
  const positions = new Float64Array(3 * points * points * (LENGTH + 1));
  for (let p = 0; p < positions.length / 3; ++p)
    positions.set([p % points, Math.trunc(p / points) % points, Math.trunc(p / (points * points))], 3 * p);
  const cells = [], regions = [];
  const corners = [0, 1, points + 1, points]; // of a square, counter-clockwise
  for (let k = 0; k < LENGTH; ++k)
    for (let j = 0; j < WIDTH; ++j)
      for (let i = 0; i < WIDTH; ++i) {
        for (let c = 0; c < 8; ++c) cells.push(((k + Math.trunc(c / 4)) * points + j) * points + i + corners[c % 4]);
        regions.push(i > 0 && i < WIDTH - 1 && j > 0 && j < WIDTH - 1 ? 1 : 2);
      }
  return new Environment(positions, Int32Array.from(cells), { type: CellType.Hexahedron, regions });
}

/** @param {Scene} scene */
function createChain(scene) {
  const positions = new Float64Array(3 * LINKS);
  for (let i = 0; i < LINKS; ++i) positions.set([2.5, 2.5, 0.25 + 0.5 * i], 3 * i);
  const edges = Array.from({ length: LINKS - 1 }, (_, i) => [i, i + 1]).flat();
  return scene.createBody(positions, edges);
}

const vessel = createVessel();
console.log(`${vessel.markRegion(2, Mark.Impassable).marked} cells are wall`);
const scene = new Scene(vessel);
const catheter = createChain(scene);
for (let step = 1; step <= 4; ++step) {
  const targets = catheter.getPositions();
  for (let i = 0; i < targets.length; i += 3) {
    targets[i] += 0.4;
    targets[i + 2] += 0.5;
  }
  const { contactCount } = catheter.move(targets, { vertexResponse: Response.Slide, edgeResponse: Response.Slide });
  console.log(`step ${step}: ${contactCount} contacts`);
}
const [contact] = catheter.getContacts();
console.log(`vertex ${contact.vertex.index} met the wall at x = ${contact.point[0].toFixed(3)}, at ${contact.time.toFixed(3)} of its way`);
try {
  scene.createParticle([0.5, 0.5, 5]);
} catch (refused) {
  if (!(refused instanceof ImpassableError)) throw refused;
  console.log(`a particle in the wall: ${refused.code}`);
}
scene.close();
vessel.close();

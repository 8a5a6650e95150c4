// The catheter: a tube with round ends about a line whose vertices come and go.
import {BufferAttribute, BufferGeometry, FrontSide, Mesh, Vector3} from 'three';

import {litMaterial} from './shading.js';

const SIDES = 12;
const END_ANGLES = [-Math.PI / 2, -Math.PI / 4]; // of the rings of a round end, against the plane across the line

const VERTEX = `
  uniform float radius;
  attribute vec3 outward;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    vNormal = normalMatrix * outward;
    eye.xyz += vNormal * grow(radius, 1.6, -eye.z);
    vToEye = -eye.xyz;
    gl_Position = projectionMatrix * eye;
  }`;

export class Tube {
  #along = new Vector3();
  #up = new Vector3();
  #side = new Vector3();
  #ring = 0;

  /** Room for lines of up to `capacity` vertices; `up` starts the frame carried along the line. */
  constructor(capacity, up) {
    this.up = up;
    this.radius = {value: 1};
    const rings = capacity + 2 * END_ANGLES.length;
    const index = [];
    for (let ring = 0; ring + 1 < rings; ++ring) {
      for (let side = 0; side < SIDES; ++side) {
        const here = ring * SIDES + side;
        const beside = ring * SIDES + (side + 1) % SIDES;
        index.push(here, beside, here + SIDES, beside, beside + SIDES, here + SIDES);
      }
    }
    const geometry = new BufferGeometry();
    this.position = new BufferAttribute(new Float32Array(3 * SIDES * rings), 3);
    this.outward = new BufferAttribute(new Float32Array(3 * SIDES * rings), 3);
    geometry.setAttribute('position', this.position);
    geometry.setAttribute('outward', this.outward);
    geometry.setIndex(index);
    // From within, where the endoscope's camera is, the tube can't be seen.
    this.mesh = new Mesh(geometry, litMaterial(VERTEX, {radius: this.radius}, {side: FrontSide}));
    this.mesh.frustumCulled = false;
    // Where the endoscope is and how it looks.
    this.eye = new Vector3();
    this.ahead = new Vector3(1, 0, 0);
    this.eyeUp = new Vector3().copy(up);
  }

  /** Shows a line of x, y, z; one of fewer than two vertices shows nothing. */
  set(line) {
    const count = line.length / 3;
    this.#ring = 0;
    if (count >= 2) {
      this.#build(line, count);
    }
    this.mesh.geometry.setDrawRange(0, Math.max(this.#ring - 1, 0) * SIDES * 6);
    this.position.needsUpdate = true;
    this.outward.needsUpdate = true;
  }

  #build(line, count) {
    const at = new Vector3();
    const before = new Vector3();
    const after = new Vector3();
    this.#along.set(0, 0, 0);
    this.#up.copy(this.up);
    for (let i = 0; i < count; ++i) {
      at.fromArray(line, 3 * i);
      before.fromArray(line, 3 * Math.max(i - 1, 0));
      after.fromArray(line, 3 * Math.min(i + 1, count - 1));
      this.#turn(after.sub(before));
      if (i === 0) {
        END_ANGLES.forEach(angle => this.#add(at, angle));
      }
      this.#add(at, 0);
      if (i === count - 1) {
        END_ANGLES.toReversed().forEach(angle => this.#add(at, -angle));
      }
    }
    // The eye lies on the last edge, for each point of an edge is free while the tip may touch the wall. It looks the way of
    // the last edges together: one alone may be short and turned by a contact.
    const back = new Vector3().fromArray(line, 3 * (count - 2));
    this.eye.copy(at).lerp(back, 0.25);
    this.ahead.copy(at).sub(before.fromArray(line, 3 * Math.max(count - 4, 0))).normalize();
    this.eyeUp.copy(this.#up);
  }

  // Carries the frame along to the direction `way`, without a twist.
  #turn(way) {
    if (way.lengthSq() > 0) {
      this.#along.copy(way).normalize();
    }
    this.#up.addScaledVector(this.#along, -this.#up.dot(this.#along));
    if (this.#up.lengthSq() < 1e-12) { // along the line: any direction across will do
      this.#up.set(this.#along.y, this.#along.z, this.#along.x).cross(this.#along);
    }
    this.#up.normalize();
    this.#side.crossVectors(this.#along, this.#up);
  }

  #add(centre, angle) {
    const across = Math.cos(angle);
    const forth = Math.sin(angle);
    for (let side = 0; side < SIDES; ++side) {
      const turn = 2 * Math.PI * side / SIDES;
      const u = across * Math.cos(turn);
      const s = across * Math.sin(turn);
      const to = this.#ring * SIDES + side;
      this.position.setXYZ(to, centre.x, centre.y, centre.z);
      this.outward.setXYZ(to, u * this.#up.x + s * this.#side.x + forth * this.#along.x,
          u * this.#up.y + s * this.#side.y + forth * this.#along.y, u * this.#up.z + s * this.#side.z + forth * this.#along.z);
    }
    ++this.#ring;
  }
}

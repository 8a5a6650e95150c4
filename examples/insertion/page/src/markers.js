// Many equal shapes at points, turned along directions, never smaller than some pixels: contacts, vertices; and the trail.
import {BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry, FrontSide, IcosahedronGeometry,
  InstancedBufferAttribute, InstancedBufferGeometry, Mesh, Points, ShaderMaterial} from 'three';
import {mergeGeometries} from 'three/addons/utils/BufferGeometryUtils.js';

import {GROW, LIT, pixel} from './shading.js';

const VERTEX = `
  ${GROW}
  uniform float size;
  uniform float pixels;
  attribute vec3 at;
  attribute vec3 direction;
  attribute vec3 tint;
  varying vec3 vNormal;
  varying vec3 vToEye;
  varying vec3 vTint;
  void main() {
    vec3 z = dot(direction, direction) > 0.0 ? normalize(direction) : vec3(0.0, 0.0, 1.0);
    vec3 x = normalize(cross(abs(z.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), z));
    mat3 turned = mat3(x, cross(z, x), z);
    vec4 eye = modelViewMatrix * vec4(at, 1.0);
    eye.xyz += mat3(modelViewMatrix) * (turned * position) * grow(size, pixels, -eye.z);
    vNormal = mat3(modelViewMatrix) * (turned * normal);
    vToEye = -eye.xyz;
    vTint = tint;
    gl_Position = projectionMatrix * eye;
  }`;

const FRAGMENT = `
  varying vec3 vNormal;
  varying vec3 vToEye;
  varying vec3 vTint;
  ${LIT}
  void main() {
    gl_FragColor = vec4(lit(vTint, normalize(vNormal), normalize(vToEye)), 1.0);
    #include <colorspace_fragment>
  }`;

/** An arrow of length 1 along z with a ball at its foot. */
export function arrow() {
  return mergeGeometries([
    new IcosahedronGeometry(0.16, 2),
    new CylinderGeometry(0.045, 0.045, 0.7, 10).rotateX(Math.PI / 2).translate(0, 0, 0.35),
    new ConeGeometry(0.13, 0.34, 14).rotateX(Math.PI / 2).translate(0, 0, 0.83),
  ].map(shape => shape.index ? shape.toNonIndexed() : shape));
}

export function ball() {
  return new IcosahedronGeometry(1, 2);
}

export class Markers {
  #count = 0;

  /** Up to `capacity` copies of `shape`, `size` large in the scene and at least `pixels` on the screen. */
  constructor(shape, capacity, size, pixels, side = FrontSide) {
    this.geometry = new InstancedBufferGeometry();
    this.geometry.setAttribute('position', shape.getAttribute('position'));
    this.geometry.setAttribute('normal', shape.getAttribute('normal'));
    for (const name of ['at', 'direction', 'tint']) {
      this[name] = new InstancedBufferAttribute(new Float32Array(3 * Math.max(capacity, 1)), 3);
      this.geometry.setAttribute(name, this[name]);
    }
    this.size = {value: size};
    const uniforms = {pixel, size: this.size, pixels: {value: pixels}};
    this.mesh = new Mesh(this.geometry, new ShaderMaterial({uniforms, side, vertexShader: VERTEX, fragmentShader: FRAGMENT}));
    this.mesh.frustumCulled = false;
    this.clear();
  }

  clear() {
    this.#count = 0;
    this.geometry.instanceCount = 0;
  }

  /** `at` and `direction`: arrays with x, y, z from `from` on; `tint` a colour. */
  add(at, direction, from, tint) {
    this.at.setXYZ(this.#count, at[from], at[from + 1], at[from + 2]);
    this.direction.setXYZ(this.#count, direction[from], direction[from + 1], direction[from + 2]);
    this.tint.setXYZ(this.#count, tint.r, tint.g, tint.b);
    this.geometry.instanceCount = ++this.#count;
    for (const attribute of [this.at, this.direction, this.tint]) {
      attribute.needsUpdate = true;
    }
  }
}

/** Contacts of all frames as dots, `size` large but within a few pixels, of which the first so many are shown. */
export class Trail {
  constructor(points, kinds, size) {
    this.kinds = kinds;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    this.tint = new BufferAttribute(new Float32Array(points.length), 3);
    geometry.setAttribute('tint', this.tint);
    this.ratio = {value: 1};
    this.mesh = new Points(geometry, new ShaderMaterial({
      uniforms: {pixel, ratio: this.ratio, size: {value: size}},
      vertexShader: `
        uniform float pixel;
        uniform float ratio;
        uniform float size;
        attribute vec3 tint;
        varying vec3 vTint;
        void main() {
          vTint = tint;
          gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
          gl_PointSize = ratio * clamp(size / (pixel * gl_Position.w), 1.5, 5.0);
        }`,
      fragmentShader: `
        varying vec3 vTint;
        void main() {
          vec2 middle = 2.0 * gl_PointCoord - 1.0;
          if (dot(middle, middle) > 1.0 || vTint.r < 0.0) discard;
          gl_FragColor = vec4(vTint, 1.0);
          #include <colorspace_fragment>
        }`,
    }));
    this.mesh.frustumCulled = false;
  }

  /** `tints`: a colour for each kind, null to hide it. */
  paint(tints) {
    const hidden = new Color(-1, -1, -1);
    this.kinds.forEach((kind, at) => {
      const {r, g, b} = tints[kind] ?? hidden;
      this.tint.setXYZ(at, r, g, b);
    });
    this.tint.needsUpdate = true;
  }

  show(count) {
    this.mesh.geometry.setDrawRange(0, count);
  }
}

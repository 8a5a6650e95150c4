// The lumen's wall: translucent, its triangles drawn from back to front, each side lit; opaque from inside.
import {BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, ShaderMaterial, Vector3,
  WireframeGeometry} from 'three';

import {LIT} from './shading.js';

export const VERTEX = `
  varying vec3 vNormal;
  varying vec3 vEye;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    vNormal = normalMatrix * normal;
    vEye = eye.xyz;
    gl_Position = projectionMatrix * eye;
  }`;

// Clear where it faces the viewer, dense where it turns away, as a thin shell is.
export const GLASS = `
  uniform vec3 colour;
  uniform float opacity;
  varying vec3 vNormal;
  varying vec3 vEye;
  ${LIT}
  void main() {
    vec3 toEye = normalize(-vEye);
    vec3 normal = normalize(vNormal);
    float turned = 1.0 - abs(dot(normal, toEye));
    float alpha = mix(opacity * opacity, sqrt(opacity), turned * turned);
    gl_FragColor = vec4(lit(colour, normal, toEye), alpha);
    #include <colorspace_fragment>
  }`;

// Lit by a lamp at the camera that reaches a few radii of the lumen far.
const INSIDE = `
  uniform vec3 colour;
  uniform float reach;
  varying vec3 vNormal;
  varying vec3 vEye;
  void main() {
    float distance = length(vEye) / reach;
    // Half of it lit flat: the triangles give the eye a hold.
    vec3 flatNormal = normalize(cross(dFdx(vEye), dFdy(vEye)));
    vec3 toEye = -vEye / length(vEye);
    float facing = mix(abs(dot(normalize(vNormal), toEye)), abs(dot(flatNormal, toEye)), 0.5);
    vec3 lamp = colour * (0.12 + 1.1 * facing) + vec3(0.3 * pow(facing, 16.0));
    gl_FragColor = vec4(lamp / (1.0 + distance * distance), 1.0);
    #include <colorspace_fragment>
  }`;

/** The radius of a tube with this surface and the volume it encloses. */
function lumenRadius(positions, triangles) {
  const corners = [new Vector3(), new Vector3(), new Vector3()];
  const cross = new Vector3();
  let area = 0;
  let volume = 0;
  for (let at = 0; at < triangles.length; at += 3) {
    corners.forEach((corner, i) => corner.fromArray(positions, 3 * triangles[at + i]));
    volume += corners[0].dot(cross.crossVectors(corners[1], corners[2])) / 6;
    area += cross.crossVectors(corners[1].sub(corners[0]), corners[2].sub(corners[0])).length() / 2;
  }
  return 2 * Math.abs(volume) / area;
}

export class Wall {
  #centres; // of the triangles
  #order; // triangles by bucket of depth
  #depths;
  #sortedFor = new Vector3();

  constructor({positions, triangles}) {
    this.triangles = triangles;
    this.radius = lumenRadius(positions, triangles);
    const count = triangles.length / 3;
    this.#centres = new Float32Array(3 * count);
    for (let at = 0; at < triangles.length; ++at) {
      for (let axis = 0; axis < 3; ++axis) {
        this.#centres[3 * Math.floor(at / 3) + axis] += positions[3 * triangles[at] + axis] / 3;
      }
    }
    this.#depths = new Float32Array(count);
    this.#order = new Uint32Array(1 << 16);

    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(triangles), 1));
    geometry.computeVertexNormals();
    const colour = {value: new Color()};
    const tissue = {value: new Color('#b8323d')}; // whatever the theme, for there is no background
    this.opacity = {value: 0.42};
    const options = {vertexShader: VERTEX, side: DoubleSide};
    this.glass = new ShaderMaterial(
        {...options, fragmentShader: GLASS, uniforms: {colour, opacity: this.opacity}, transparent: true, depthWrite: false});
    this.inside = new ShaderMaterial(
        {...options, fragmentShader: INSIDE, uniforms: {colour: tissue, reach: {value: 4 * this.radius}}});
    this.mesh = new Mesh(geometry, this.glass);
    this.colour = colour.value;
  }

  /** The edges of the triangles, made when first asked for. */
  get edges() {
    if (!this.lines) {
      this.lines = new LineSegments(new WireframeGeometry(this.mesh.geometry),
          new LineBasicMaterial({transparent: true, opacity: 0.25, depthWrite: false}));
    }
    return this.lines;
  }

  /** Before a picture from inside, where the wall is opaque tissue, or from outside. */
  prepare(inside, ink) {
    this.mesh.material = inside ? this.inside : this.glass;
    this.lines?.material.color.set(inside ? '#000' : ink);
  }

  /** Orders the triangles from back to front along `direction`, the way the camera looks: a counting sort, so that tens of
   * thousands of them can be sorted anew for each picture. */
  sort(direction) {
    if (this.#sortedFor.distanceToSquared(direction) < 1e-6) {
      return;
    }
    this.#sortedFor.copy(direction);
    const centres = this.#centres;
    const depths = this.#depths;
    let least = Infinity;
    let most = -Infinity;
    for (let i = 0; i < depths.length; ++i) {
      const depth = centres[3 * i] * direction.x + centres[3 * i + 1] * direction.y + centres[3 * i + 2] * direction.z;
      depths[i] = depth;
      least = Math.min(least, depth);
      most = Math.max(most, depth);
    }
    const next = this.#order.fill(0);
    const scale = (next.length - 2) / Math.max(most - least, Number.MIN_VALUE);
    for (let i = 0; i < depths.length; ++i) {
      depths[i] = Math.floor((most - depths[i]) * scale); // the farthest comes first
      ++next[depths[i] + 1];
    }
    for (let bucket = 1; bucket < next.length; ++bucket) {
      next[bucket] += next[bucket - 1];
    }
    const index = this.mesh.geometry.index;
    for (let i = 0; i < depths.length; ++i) {
      const to = 3 * next[depths[i]]++;
      index.array[to] = this.triangles[3 * i];
      index.array[to + 1] = this.triangles[3 * i + 1];
      index.array[to + 2] = this.triangles[3 * i + 2];
    }
    index.needsUpdate = true;
  }
}

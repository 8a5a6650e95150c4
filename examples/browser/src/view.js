// The 3D view: the wall as glass, the wire as a tube out of a grip, contacts as arrows along their normals.
import {BackSide, BufferAttribute, BufferGeometry, Color, CylinderGeometry, FrontSide, Group,
  LineBasicMaterial, LineSegments, Mesh, PerspectiveCamera, Scene,
  ShaderMaterial, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {arrow, Markers} from '../../insertion/page/src/markers.js';
import {litMaterial, pixel} from '../../insertion/page/src/shading.js';
import {colour} from '../../insertion/page/src/theme.js';
import {Tube} from '../../insertion/page/src/tube.js';
import {GLASS, VERTEX} from '../../insertion/page/src/wall.js';

const FIELD = 30; // of view, degrees
const MOST_VERTICES = 240;
const MOST_CONTACTS = 512;
const CONTACT = 9; // doubles of a scene_contact: point, normal, impulse, kind, time
const RATIOS = [2, 1.5, 1.25, 1, 0.8, 0.65, 0.5, 0.4]; // pixels of the picture for each of CSS: fewer where drawing is slow
const GRIP = 12; // its distance from where the wire comes in, in links

const GRIP_VERTEX = `
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    vNormal = normalMatrix * normal;
    vToEye = -eye.xyz;
    gl_Position = projectionMatrix * eye;
  }`;

/** Glass whose far side is drawn before its near side, and the rims of its openings. Without the far side, if that is too slow,
 * the glass is a little clearer. */
class Wall {
  constructor() {
    this.geometry = new BufferGeometry();
    this.mesh = new Group();
    this.uniforms = {colour: {value: new Color(colour('--wall'))}, opacity: {value: 0.5}};
    for (const [order, side] of [BackSide, FrontSide].entries()) {
      const material = new ShaderMaterial({
        uniforms: this.uniforms, vertexShader: VERTEX, fragmentShader: GLASS, side, transparent: true, depthWrite: false,
      });
      const mesh = new Mesh(this.geometry, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = 1 + order;
      this.mesh.add(mesh);
    }
    this.farSide = this.mesh.children[0];
    this.rim = new BufferGeometry();
    const lines = new LineSegments(this.rim, new LineBasicMaterial({color: colour('--rim')}));
    lines.frustumCulled = false;
    this.mesh.add(lines);
  }

  set({positions, normals, triangles, rim}) {
    const old = this.geometry.getAttribute('position');
    if (old?.array.length === positions.length && this.geometry.index.array.length === triangles.length) {
      for (const [name, array] of [['position', positions], ['normal', normals]]) {
        this.geometry.getAttribute(name).copyArray(array).needsUpdate = true;
      }
      return;
    }
    this.geometry.dispose();
    this.geometry.setAttribute('position', new BufferAttribute(positions, 3));
    this.geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    this.geometry.setIndex(new BufferAttribute(triangles, 1));
    this.rim.dispose();
    this.rim.setAttribute('position', this.geometry.getAttribute('position'));
    this.rim.setIndex(new BufferAttribute(rim, 1));
  }
}

/** A knurled handle through which the wire goes. */
function makeGrip() {
  const grip = new Group();
  const material = litMaterial(GRIP_VERTEX, {});
  material.uniforms.colour.value.set(colour('--grip'));
  const dark = litMaterial(GRIP_VERTEX, {});
  dark.uniforms.colour.value.set(colour('--grip')).multiplyScalar(0.35);
  grip.add(new Mesh(new CylinderGeometry(1, 1, 5.2, 24).rotateX(Math.PI / 2), material));
  for (const end of [-1, 1]) {
    grip.add(new Mesh(new CylinderGeometry(end < 0 ? 0.75 : 0.55, end < 0 ? 0.55 : 0.75, 0.9, 24).rotateX(Math.PI / 2)
        .translate(0, 0, 3 * end), dark));
  }
  for (let rib = 0; rib < 8; ++rib) {
    const ribMesh = new Mesh(new CylinderGeometry(0.17, 0.17, 4.4, 8).rotateX(Math.PI / 2).translate(1, 0, 0), dark);
    ribMesh.rotation.z = rib * Math.PI / 4;
    grip.add(ribMesh);
  }
  return grip;
}

/** Whether pictures are made without a graphics card: smooth edges would cost most of the time then. */
function isDrawnBySoftware() {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? context.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class View {
  #tip = new Vector3();
  #entry = new Vector3();
  #direction = new Vector3(1, 0, 0);
  #middle = new Vector3();
  #size = 1;
  #follow = false;
  #quality = RATIOS.indexOf(1);
  #pace = 16; // mean time of recent pictures, ms
  #slow = 0;
  #sharp = false;
  #isSlow = isDrawnBySoftware();
  #quick = 0;
  #width = 1;
  #height = 1;

  /** Needs WebGL 2. */
  constructor(host) {
    this.host = host;
    this.renderer = new WebGLRenderer({antialias: !this.#isSlow, alpha: !this.#isSlow, powerPreference: 'high-performance'});
    this.canvas = this.renderer.domElement;
    host.prepend(this.canvas);
    this.camera = new PerspectiveCamera(FIELD, 1, 1, 1000);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = true;
    this.wall = new Wall();
    if (this.#isSlow) {
      this.#quality = RATIOS.indexOf(0.65);
      this.wall.farSide.visible = false;
      this.renderer.setClearColor(colour('--plain')); // to blend with a gradient takes as long as the picture
      document.body.classList.add('plain');
    }
    this.tube = new Tube(MOST_VERTICES, new Vector3(0, 0, 1));
    this.tube.mesh.material.uniforms.colour.value.set(colour('--catheter'));
    this.arrows = new Markers(arrow(), MOST_CONTACTS, 1, 34);
    this.tints = ['--plane', '--plane', '--edge', '--vertex'].map(name => new Color(colour(name)));
    this.grip = makeGrip();
    this.scene = new Scene();
    this.scene.add(this.tube.mesh, this.arrows.mesh, this.grip, this.wall.mesh);
    new ResizeObserver(() => this.#resize()).observe(host);
    this.#resize();
  }

  /** Another scene. */
  begin({size, wall}) {
    this.#entry.fromArray(size.entry);
    this.#direction.fromArray(size.direction);
    this.link = size.link;
    this.tube.radius.value = size.radius;
    this.arrows.size.value = 7 * size.radius;
    this.wall.set(wall);
    const lower = new Vector3().fromArray(size.lower);
    const upper = new Vector3().fromArray(size.upper);
    lower.min(this.#gripPlace(1.2));
    upper.max(this.#gripPlace(1.2));
    this.#middle.addVectors(lower, upper).multiplyScalar(0.5);
    this.box = upper.clone().sub(lower);
    this.#middle.x += 0.03 * this.box.x; // beside the figures
    this.#size = this.box.length();
    this.camera.near = 0.01 * this.#size;
    this.camera.far = 20 * this.#size;
    this.grip.scale.setScalar(3.6 * size.radius);
    this.grip.position.copy(this.#gripPlace(1));
    this.reset();
  }

  #gripPlace(share) {
    return this.#entry.clone().addScaledVector(this.#direction, -share * GRIP * this.link);
  }

  /** The whole, from its broad side. */
  reset() {
    const towards = new Vector3(0.12, -0.45, 1).normalize();
    const half = Math.tan(FIELD * Math.PI / 360);
    const distance = Math.max(this.box.y / 2 / half, this.box.x / 2 / half / this.camera.aspect) * 1.2 + this.box.z / 2;
    this.controls.target.copy(this.#middle);
    this.camera.position.copy(this.#middle).addScaledVector(towards, distance);
    this.controls.update();
  }

  set follow(on) {
    this.#follow = on;
    if (!on) {
      this.reset();
    }
  }

  /** A step's wire and contacts, and the wall if it has changed; `angle` of the hand. */
  show({wire, contacts, wall}, angle) {
    const count = wire.length / 3;
    const line = new Float64Array(wire.length + 6);
    line.set(wire);
    this.#gripPlace(1).toArray(line, wire.length);
    this.#gripPlace(1.5).toArray(line, wire.length + 3);
    this.tube.set(line.subarray(0, 3 * Math.min(count + 2, MOST_VERTICES)));
    this.#tip.fromArray(wire);
    this.arrows.clear();
    for (let at = 0; at < contacts.length; at += CONTACT) {
      this.arrows.add(contacts.subarray(at, at + 3), contacts.subarray(at + 3, at + 6), 0, this.tints[contacts[at + 7]]);
    }
    if (wall) {
      this.wall.set(wall);
    }
    this.grip.lookAt(this.grip.position.clone().add(this.#direction));
    this.grip.rotateZ(angle);
  }

  #resize() {
    const {clientWidth: width, clientHeight: height} = this.host;
    this.#width = Math.max(width, 1);
    this.#height = Math.max(height, 1);
    this.camera.aspect = this.#width / this.#height;
    this.camera.updateProjectionMatrix();
    this.renderer.setPixelRatio(this.#sharp ? 2 : Math.min(RATIOS[this.#quality], Math.max(devicePixelRatio, 1)));
    this.renderer.setSize(this.#width, this.#height);
    pixel.value = 2 * Math.tan(FIELD * Math.PI / 360) / this.#height;
  }

  /** Fewer pixels where pictures come slowly, more where there is time. `milliseconds` since the last picture. */
  adapt(milliseconds) {
    this.#pace += 0.1 * (Math.min(milliseconds, 100) - this.#pace);
    this.#slow = this.#pace > 26 ? this.#slow + 1 : 0;
    this.#quick = this.#pace < 18 ? this.#quick + 1 : 0;
    const change = this.#slow > 15 ? 1 : (this.#quick > 240 ? -1 : 0);
    const wanted = Math.max(0, Math.min(RATIOS.length - 1, this.#quality + change));
    if (change !== 0) {
      this.#slow = this.#quick = 0;
      this.#pace = 22; // between both limits
    }
    if (wanted !== this.#quality && (change > 0 || RATIOS[this.#quality] < devicePixelRatio)) {
      this.#quality = wanted;
      this.#resize();
    }
  }

  /** Pictures have smooth edges and all of the glass, however long they take. */
  set sharp(on) {
    this.#sharp = on;
    this.wall.farSide.visible = on || !this.#isSlow;
    this.#resize();
  }

  draw() {
    if (this.#follow) {
      const way = this.#tip.clone().sub(this.controls.target).multiplyScalar(0.12);
      const distance = this.camera.position.distanceTo(this.controls.target);
      const wanted = 0.32 * this.#size;
      this.controls.target.add(way);
      this.camera.position.add(way);
      if (distance > wanted) {
        this.camera.position.lerp(this.controls.target, 0.06 * (1 - wanted / distance));
      }
    }
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
  }

  /** Where a point of the scene is in the view, in CSS pixels. */
  #place(point) {
    const at = point.clone().project(this.camera);
    return {x: (at.x + 1) / 2 * this.#width, y: (1 - at.y) / 2 * this.#height};
  }

  get gripPlace() {
    return this.#place(this.grip.position);
  }

  /** Whether the pointer is at the grip. */
  isGrip(x, y) {
    const place = this.gripPlace;
    return Math.hypot(place.x - x, place.y - y) < 44;
  }

  /** A drag in the view as a push in the scene and a turn. */
  asHand(dx, dy) {
    const from = this.gripPlace;
    const to = this.#place(this.grip.position.clone().add(this.#direction));
    const [ax, ay] = [to.x - from.x, to.y - from.y];
    const square = Math.max(ax * ax + ay * ay, 1);
    return {push: (dx * ax + dy * ay) / square, turn: (dy * ax - dx * ay) / Math.sqrt(square) / 60};
  }
}

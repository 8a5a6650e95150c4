// The three ways to look: around the whole, with the tip, and from the tip.
import {Box3, PerspectiveCamera, Vector3} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

const AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
const FIELD = 32; // of view, degrees
const TILT = 14 * Math.PI / 180;

export class Cameras {
  #mode = 'overview';
  #tip = new Vector3();
  #middle = new Vector3();
  #extent = new Vector3();

  /** `wall` is seen whole at first; from the tip, `radius` of the lumen is what is near. */
  constructor(element, wall, radius, changed) {
    const box = new Box3().setFromBufferAttribute(wall.geometry.getAttribute('position'));
    box.getCenter(this.#middle);
    box.getSize(this.#extent);
    const size = this.#extent.length();
    // The longest extent lies across the picture (upright on a tall one, see reset), the shortest along the view.
    const order = [0, 1, 2].sort((a, b) => this.#extent.getComponent(b) - this.#extent.getComponent(a));
    [this.longest, this.middling, this.shortest] = order.map(axis => AXES[axis]);
    this.around = new PerspectiveCamera(FIELD, 1, size * 1e-3, size * 20);
    this.within = new PerspectiveCamera(96, 1, radius * 1e-2, size * 2);
    this.nearby = 14 * radius;
    this.controls = new OrbitControls(this.around, element);
    this.controls.zoomToCursor = true;
    this.controls.maxDistance = size * 10;
    this.controls.addEventListener('change', changed);
  }

  get mode() {
    return this.#mode;
  }

  get current() {
    return this.#mode === 'endoscope' ? this.within : this.around;
  }

  set mode(mode) {
    const before = this.#mode;
    this.#mode = mode;
    this.controls.enabled = mode !== 'endoscope';
    this.controls.zoomToCursor = mode === 'overview';
    if (mode === 'overview' && before !== 'overview') {
      this.reset();
    } else if (mode === 'follow' && before !== 'follow') {
      const way = this.around.position.clone().sub(this.controls.target).setLength(this.nearby);
      this.controls.target.copy(this.#tip);
      this.around.position.copy(this.#tip).add(way);
      this.controls.update();
    }
  }

  /** The whole wall, from its broad side. */
  reset() {
    const tall = this.around.aspect < 0.8;
    const up = tall ? this.longest : this.middling;
    const across = tall ? this.middling : this.longest;
    this.around.up.copy(up);
    const towards = new Vector3().crossVectors(across, up).multiplyScalar(Math.cos(TILT)).addScaledVector(up, Math.sin(TILT));
    const half = Math.tan(FIELD * Math.PI / 360);
    const distance = Math.max(this.#extent.dot(up) / 2 / half, this.#extent.dot(across) / 2 / half / this.around.aspect) * 1.12 +
        this.#extent.dot(this.shortest) / 2;
    this.controls.target.copy(this.#middle);
    this.around.position.copy(this.#middle).addScaledVector(towards, distance);
    this.controls.update();
  }

  /** Goes on with the tube's tip. */
  carry(tube) {
    const moved = tube.eye.clone().sub(this.#tip);
    this.#tip.copy(tube.eye);
    if (this.#mode === 'follow') {
      this.around.position.add(moved);
      this.controls.target.add(moved);
      this.controls.update();
    }
    this.within.position.copy(tube.eye);
    this.within.up.copy(tube.eyeUp);
    this.within.lookAt(tube.ahead.clone().add(tube.eye));
  }

  /** Looks at a point from near by. */
  visit(point) {
    const way = this.around.position.clone().sub(this.controls.target);
    this.controls.target.copy(point);
    this.around.position.copy(point).add(way.setLength(Math.min(way.length(), this.nearby)));
    this.controls.update();
  }

  resize(aspect) {
    this.around.aspect = aspect;
    this.around.updateProjectionMatrix();
  }
}

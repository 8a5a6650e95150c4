// The 3D view: wall, catheter, contacts, and which camera draws them. A picture is drawn when something has changed.
import {BackSide, Color, Scene, Vector2, Vector3, WebGLRenderer} from 'three';

import {Cameras} from './cameras.js';
import {arrow, ball, Markers, Trail} from './markers.js';
import {pixel} from './shading.js';
import {colour, kindColour} from './theme.js';
import {Tube} from './tube.js';
import {Wall} from './wall.js';

const INSET = {share: 0.3, most: 230, margin: 12}; // of the view's width; CSS pixels
const REACH = 14; // how near to a contact the pointer has to be, CSS pixels

export class View {
  #pending = false;
  #size = new Vector2(1, 1);
  #frame = 0;
  #hidden = new Set(); // kinds of contacts
  #selected = -1;

  /** Needs WebGL 2. */
  constructor(host, data) {
    this.host = host;
    this.frames = data.frames;
    this.contacts = data.contacts;
    this.renderer = new WebGLRenderer({antialias: true, alpha: true});
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.canvas.addEventListener('webglcontextrestored', () => this.draw());
    host.prepend(this.canvas);

    const every = Array.from({length: data.frames.count}, (_, frame) => frame);
    const most = wanted => every.reduce((most, frame) => Math.max(most, wanted(frame)), 0);
    const mostVertices = most(frame => data.frames.vertexCount(frame));
    this.wall = new Wall(data.wall);
    const {radius} = this.wall;
    this.cameras = new Cameras(this.canvas, this.wall.mesh, radius, () => this.draw());
    this.tube = new Tube(mostVertices, this.cameras.shortest);
    this.vertices = new Markers(ball(), mostVertices, 0, 1.8);
    this.inserted = new Markers(ball(), most(frame => data.frames.insertedOf(frame).length), 0, 2.2);
    this.arrows = new Markers(arrow(), most(frame => data.frames.contactCount(frame)), 1.1 * radius, 18);
    this.mark = new Markers(ball(), 1, 0.26 * radius, 5, BackSide); // seen as a rim about the foot of the arrow
    this.trail = new Trail(data.contacts.local, data.contacts.kind, 0.12 * radius);
    this.vertices.mesh.visible = false;
    this.scene = new Scene();
    for (const part of [this.wall, this.tube, this.vertices, this.inserted, this.arrows, this.mark, this.trail]) {
      this.scene.add(part.mesh);
    }
    this.wall.mesh.renderOrder = 1; // after what is opaque, so that it shows through
    this.inset = true;
    this.thickness = 0.4;
    this.paint();
    this.resize();
    this.cameras.reset();
  }

  /** Takes the colours of the theme. */
  paint() {
    this.wall.colour.set(colour('--wall'));
    this.tube.mesh.material.uniforms.colour.value.set(colour('--catheter'));
    this.tints = this.contacts.kinds.map((_, kind) => new Color(kindColour(kind)));
    this.insertedTint = new Color(colour('--inserted'));
    this.vertexTint = new Color(colour('--catheter')).multiplyScalar(0.6);
    this.markTint = new Color(colour('--mark'));
    this.trail.paint(this.tints.map((tint, kind) => this.#hidden.has(kind) ? null : tint));
    this.show(this.#frame);
  }

  show(frame) {
    this.#frame = frame;
    const line = this.frames.line(frame);
    this.tube.set(line);
    this.cameras.carry(this.tube);
    this.vertices.clear();
    this.inserted.clear();
    const inserted = new Set(this.frames.insertedOf(frame));
    for (let vertex = 0; vertex < line.length / 3; ++vertex) {
      if (inserted.has(vertex)) {
        this.inserted.add(line, line, 3 * vertex, this.insertedTint);
      } else {
        this.vertices.add(line, line, 3 * vertex, this.vertexTint);
      }
    }
    this.arrows.clear();
    const {begin, end} = this.frames.contactsOf(frame);
    for (let contact = begin; contact < end; ++contact) {
      const kind = this.contacts.kind[contact];
      if (!this.#hidden.has(kind)) {
        this.arrows.add(this.contacts.local.subarray(3 * contact, 3 * contact + 3),
            this.contacts.normal.subarray(3 * contact, 3 * contact + 3), 0, this.tints[kind]);
      }
    }
    this.trail.show(end);
    this.select(this.#selected);
  }

  hide(kind, hidden) {
    hidden ? this.#hidden.add(kind) : this.#hidden.delete(kind);
    this.paint();
  }

  /** Marks a contact; -1 marks none. */
  select(contact) {
    this.#selected = contact;
    this.mark.clear();
    if (contact >= 0) {
      this.mark.add(this.contacts.local, this.contacts.normal, 3 * contact, this.markTint);
    }
    this.draw();
  }

  visit(contact) {
    this.cameras.visit(new Vector3().fromArray(this.contacts.local, 3 * contact));
  }

  set camera(mode) {
    this.cameras.mode = mode;
    this.draw();
  }

  /** 0 is the thinnest line that can be seen, 1 half the lumen's radius. */
  set thickness(share) {
    const {radius} = this.wall;
    this.tube.radius.value = 0.5 * radius * share * share;
    this.vertices.size.value = this.tube.radius.value * 1.35;
    this.inserted.size.value = this.tube.radius.value * 1.6;
    this.draw();
  }

  set edges(shown) {
    if (shown) {
      this.scene.add(this.wall.edges);
    } else {
      this.scene.remove(this.wall.edges);
    }
    this.draw();
  }

  /** The shown contact nearest to a point of the view, -1 if none is near. Those of the frame win against the trail. */
  pick(x, y) {
    if (this.cameras.mode !== 'endoscope' && this.inset && this.#inInset(x, y)) {
      return -1;
    }
    const {begin, end} = this.frames.contactsOf(this.#frame);
    const now = this.#nearest(x, y, begin, end);
    return now >= 0 || !this.trail.mesh.visible ? now : this.#nearest(x, y, 0, begin);
  }

  /** Where a contact is in the view, CSS pixels from the top left; null if it is behind the camera or too far. */
  place(contact) {
    const point = new Vector3().fromArray(this.contacts.local, 3 * contact).project(this.cameras.current);
    return Math.abs(point.z) > 1 ? null : {x: (point.x + 1) / 2 * this.#size.x, y: (1 - point.y) / 2 * this.#size.y};
  }

  #nearest(x, y, begin, end) {
    let best = -1;
    let least = REACH;
    for (let contact = begin; contact < end; ++contact) {
      const place = this.#hidden.has(this.contacts.kind[contact]) ? null : this.place(contact);
      const distance = place ? Math.hypot(place.x - x, place.y - y) : Infinity;
      if (distance < least) {
        least = distance;
        best = contact;
      }
    }
    return best;
  }

  #inInset(x, y) {
    const {left, top, side} = this.insetPlace();
    return x >= left && x <= left + side && y >= top && y <= top + side;
  }

  /** Where the small view is, in CSS pixels from the top left. */
  insetPlace() {
    const side = Math.min(INSET.most, this.#size.x * INSET.share);
    return {side, left: this.#size.x - side - INSET.margin, top: this.#size.y - side - INSET.margin};
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.host;
    if (width === 0 || height === 0) {
      return;
    }
    this.#size.set(width, height);
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.trail.ratio.value = this.renderer.getPixelRatio();
    this.cameras.resize(width / height);
    this.draw();
  }

  /** Draws before the next picture of the screen. */
  draw() {
    if (!this.#pending) {
      this.#pending = true;
      requestAnimationFrame(() => {
        this.#pending = false;
        this.drawNow();
      });
    }
  }

  drawNow() {
    const {x: width, y: height} = this.#size;
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, width, height);
    if (this.cameras.mode === 'endoscope') {
      this.#within(width, height);
      return;
    }
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.wall.prepare(false, this.markTint);
    this.wall.sort(this.cameras.around.getWorldDirection(new Vector3()));
    this.#render(this.cameras.around, height);
    if (this.inset) {
      const {left, top, side} = this.insetPlace();
      this.renderer.setScissorTest(true);
      this.renderer.setScissor(left, height - top - side, side, side);
      this.renderer.setViewport(left, height - top - side, side, side);
      this.#within(side, side);
    }
  }

  #within(width, height) {
    this.cameras.within.aspect = width / height;
    this.cameras.within.updateProjectionMatrix();
    this.renderer.setClearColor(0, 1);
    this.renderer.clear();
    this.wall.prepare(true);
    // The eye is in the catheter, or even in the ball of a vertex.
    const {vertices, inserted} = this;
    const shown = [vertices.mesh.visible, inserted.mesh.visible];
    vertices.mesh.visible = inserted.mesh.visible = false;
    this.#render(this.cameras.within, height);
    [vertices.mesh.visible, inserted.mesh.visible] = shown;
  }

  #render(camera, height) {
    pixel.value = 2 * Math.tan(camera.fov * Math.PI / 360) / height;
    this.renderer.render(this.scene, camera);
  }
}

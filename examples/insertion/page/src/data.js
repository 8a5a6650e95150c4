// What build_page.py has put into the page. Base64 of little-endian numbers becomes typed arrays.

const TYPES = {
  float32: Float32Array, float64: Float64Array, uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array, int32: Int32Array,
};

function unpack({type, base64}) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) {
    bytes[i] = text.charCodeAt(i);
  }
  return new TYPES[type](bytes.buffer);
}

function unpackAll(packed) {
  return Object.fromEntries(
      Object.entries(packed).map(([key, value]) => [key, value?.base64 === undefined ? value : unpack(value)]));
}

/** The catheter's frames: line and inserted vertices of each, and which contacts are its own. */
class Frames {
  constructor(packed) {
    Object.assign(this, unpackAll(packed));
    this.count = this.time.length;
  }

  /** x, y, z from tail to tip, counted from the origin of the page. */
  line(frame) {
    return this.positions.subarray(this.first_coordinate[frame], this.first_coordinate[frame + 1]);
  }

  vertexCount(frame) {
    return (this.first_coordinate[frame + 1] - this.first_coordinate[frame]) / 3;
  }

  insertedOf(frame) {
    return this.inserted.subarray(this.first_inserted[frame], this.first_inserted[frame + 1]);
  }

  contactsOf(frame) {
    return {begin: this.first_contact[frame], end: this.first_contact[frame + 1]};
  }

  contactCount(frame) {
    return this.first_contact[frame + 1] - this.first_contact[frame];
  }

  /** The last frame that is not after `time`. */
  at(time) {
    let low = 0;
    let high = this.count;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      [low, high] = this.time[middle] <= time ? [middle, high] : [low, middle];
    }
    return low;
  }

  frameOfContact(contact) {
    let frame = 0;
    while (this.first_contact[frame + 1] <= contact) {
      ++frame;
    }
    return frame;
  }
}

/** All contacts in the order of frames, one array a figure. */
class Contacts {
  constructor(packed, origin) {
    Object.assign(this, unpackAll(packed));
    this.origin = origin;
    this.count = this.kind.length;
    this.local = Float32Array.from(this.point, (value, at) => value - origin[at % 3]);
  }

  /** One contact as the input had it. */
  get(at) {
    return {
      point: Array.from(this.point.subarray(3 * at, 3 * at + 3)),
      normal: Array.from(this.normal.subarray(3 * at, 3 * at + 3)),
      kind: this.kinds[this.kind[at]],
      time: this.time[at],
      tag: this.tag[at],
      vertex: this.vertex[at],
      impulse: this.impulse[at],
    };
  }
}

/** The data of the page; positions of wall and frames count from `origin`. */
export function readData() {
  const data = JSON.parse(document.getElementById('data').textContent);
  return {
    ...data,
    wall: unpackAll(data.wall),
    frames: new Frames(data.frames),
    contacts: new Contacts(data.contacts, data.origin),
  };
}

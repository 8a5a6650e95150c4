// The worker: the library as WebAssembly, one scene in its memory, and what the page asks of it. It runs behind the text of
// the module (dartsweep.js), which defines createDartsweep.
let library; // the module
let scene = 0; // a pointer
let wallVersion = -1;
let drawn = {triangles: [], turned: [], rim: []}; // the triangles of the wall last drawn, and what findTurned gave
let recording = null; // states of all steps since the scene began, as bytes

const text = pointer => library.UTF8ToString(pointer);

/** Copies an array into the memory of the module; `use` gets its address. */
function withArrays(arrays, use) {
  const addresses = arrays.map(array => library._malloc(Math.max(array.byteLength, 8)));
  try {
    if (addresses.includes(0)) {
      throw new Error('out of memory');
    }
    arrays.forEach((array, at) =>
      library.HEAPU8.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), addresses[at]));
    return use(...addresses);
  } finally {
    addresses.forEach(address => library._free(address));
  }
}

/** Calls get(scene, &count) and copies `width` numbers for each of what it counts, out of one of the library's views. The copy
 * is needed: a later call may make the memory grow, which detaches all views of it. */
function read(view, get, width) {
  const count = library._malloc(4);
  const pointer = get(scene, count);
  const numbers = library.HEAPU32[count >> 2] * width;
  library._free(count);
  if (pointer === 0) {
    throw new Error(text(library._scene_message()));
  }
  const first = pointer / library[view].BYTES_PER_ELEMENT;
  return library[view].slice(first, first + numbers);
}
const readDoubles = (get, width) => read('HEAPF64', get, width);
const readIndices = (get, width) => read('HEAPU32', get, width);

const readWire = () => readDoubles(library._scene_get_wire, 3);
const readContacts = () => readDoubles(library._scene_get_contacts, 9);

/** Turns triangles so that neighbours agree, and each part looks outwards: those of a wall between two passable volumes may
 * look either way. Gives for each triangle whether it was turned, and both ends of each edge with one triangle. */
function findTurned(points, triangles) {
  const count = triangles.length / 3;
  const vertices = points.length / 3;
  const sides = new Map(); // by both ends: triangles there, with +1 or -1 for the way they run it
  for (let at = 0; at < triangles.length; ++at) {
    const triangle = Math.floor(at / 3);
    const from = triangles[at];
    const to = triangles[3 * triangle + (at + 1) % 3];
    const name = Math.min(from, to) * vertices + Math.max(from, to);
    const side = sides.get(name) ?? [];
    side.push(triangle, from < to ? 1 : -1);
    sides.set(name, side);
  }
  const turned = new Int8Array(count); // 1 or -1; 0: not reached yet
  for (let first = 0; first < count; ++first) {
    if (turned[first] !== 0) {
      continue;
    }
    const part = [first];
    let volume = 0;
    turned[first] = 1;
    for (let next = 0; next < part.length; ++next) {
      const triangle = part[next];
      const [a, b, c] = [3 * triangles[3 * triangle], 3 * triangles[3 * triangle + 1], 3 * triangles[3 * triangle + 2]];
      volume += turned[triangle] * (points[a] * (points[b + 1] * points[c + 2] - points[b + 2] * points[c + 1]) +
          points[a + 1] * (points[b + 2] * points[c] - points[b] * points[c + 2]) +
          points[a + 2] * (points[b] * points[c + 1] - points[b + 1] * points[c]));
      for (let at = 3 * triangle; at < 3 * triangle + 3; ++at) {
        const from = triangles[at];
        const to = triangles[3 * triangle + (at + 1) % 3];
        const way = (from < to ? 1 : -1) * turned[triangle];
        const side = sides.get(Math.min(from, to) * vertices + Math.max(from, to));
        for (let other = 0; side.length === 4 && other < 4; other += 2) {
          if (turned[side[other]] === 0) {
            turned[side[other]] = -way * side[other + 1];
            part.push(side[other]);
          }
        }
      }
    }
    if (volume < 0) {
      part.forEach(triangle => { turned[triangle] = -turned[triangle]; });
    }
  }
  const rim = [];
  for (const [name, side] of sides) {
    if (side.length === 2) {
      rim.push(Math.floor(name / vertices), name % vertices);
    }
  }
  return {turned, rim: Uint32Array.from(rim)};
}

/** The wall for a graphics card: single precision, with normals that are means of those of the triangles. */
function readWall() {
  const points = readDoubles(library._scene_get_wall_points, 3);
  const triangles = readIndices(library._scene_get_wall_triangles, 3);
  if (drawn.triangles.length !== triangles.length || drawn.triangles.some((corner, at) => corner !== triangles[at])) {
    drawn = {triangles: triangles.slice(), ...findTurned(points, triangles)};
  }
  const positions = Float32Array.from(points);
  const normals = new Float32Array(positions.length);
  for (let at = 0; at < triangles.length; at += 3) {
    if (drawn.turned[at / 3] < 0) {
      [triangles[at + 1], triangles[at + 2]] = [triangles[at + 2], triangles[at + 1]];
    }
    const [a, b, c] = [3 * triangles[at], 3 * triangles[at + 1], 3 * triangles[at + 2]];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normals[corner] += nx;
      normals[corner + 1] += ny;
      normals[corner + 2] += nz;
    }
  }
  return {positions, normals, triangles, rim: drawn.rim.slice()};
}

/** The struct scene_size: only doubles, in this order. */
function readSize() {
  const at = library._scene_get_size(scene) >> 3;
  const numbers = library.HEAPF64.slice(at, at + 16);
  const vector = from => Array.from(numbers.subarray(from, from + 3));
  return {
    volumes: numbers[0], points: numbers[1], radius: numbers[2], link: numbers[3], lower: vector(4), upper: vector(7),
    entry: vector(10), direction: vector(13),
  };
}

function remember() {
  if (recording) {
    const wire = readWire();
    const contacts = readContacts();
    recording.push(new Uint8Array(Uint32Array.of(wire.length / 3, contacts.length / 9).buffer), new Uint8Array(wire.buffer),
        new Uint8Array(contacts.buffer));
  }
}

function create(make) {
  const start = performance.now();
  const made = make();
  if (!made) {
    throw new Error(text(library._scene_message()));
  }
  library._scene_destroy(scene);
  scene = made;
  wallVersion = library._scene_get_wall_version(scene);
  return {size: readSize(), wire: readWire(), contacts: readContacts(), wall: readWall(), milliseconds: performance.now() - start};
}

const answers = {
  async start({binary}) {
    library = await createDartsweep({wasmBinary: binary});
    const version = library._dsw_version();
    return {version: `${Math.floor(version / 1e6)}.${Math.floor(version / 1e3) % 1000}.${version % 1000}`};
  },

  vessel: () => create(() => library._scene_create_vessel()),

  volumes: ({points, types, corners}) => create(() => withArrays([points, types, corners], (p, t, c) =>
    library._scene_create_volumes(p, points.length / 3, t, types.length, c, corners.length))),

  surface: ({points, triangles}) => create(() => withArrays([points, triangles], (p, t) =>
    library._scene_create_surface(p, points.length / 3, t, triangles.length / 3))),

  /** Some steps with the same push, turn and beat, after a cut if one is wanted. */
  step({steps, push, turn, beat, cut}) {
    const answer = {cut: null};
    if (cut) {
      answer.cut = library._scene_cut(scene) ? '' : text(library._scene_message());
    }
    const start = performance.now();
    for (let step = 0; step < steps; ++step) {
      if (!library._scene_step(scene, push, turn, beat ? 1 : 0)) {
        throw new Error(text(library._scene_message()));
      }
      remember();
    }
    answer.milliseconds = (performance.now() - start) / steps;
    Object.assign(answer, {wire: readWire(), contacts: readContacts()});
    if (library._scene_get_wall_version(scene) !== wallVersion) {
      wallVersion = library._scene_get_wall_version(scene);
      answer.wall = readWall();
    }
    return answer;
  },

  /** For tests: a new vessel, of which all states are kept. */
  record() {
    recording = [];
    return answers.vessel();
  },

  async recorded() {
    const bytes = new Uint8Array(await new Blob(recording).arrayBuffer());
    recording = null;
    return {bytes};
  },
};

/** All typed arrays of an answer, at any depth: they move to the page instead of being copied. */
function buffersOf(value) {
  if (ArrayBuffer.isView(value)) {
    return [value.buffer];
  }
  return value && typeof value === 'object' ? Object.values(value).flatMap(buffersOf) : [];
}

// Questions are answered one after the other, in their order.
let before = Promise.resolve();
self.onmessage = ({data: {id, what, ...arguments_}}) => {
  before = before.then(async () => {
    try {
      const answer = await answers[what](arguments_);
      self.postMessage({id, answer}, buffersOf(answer));
    } catch (error) {
      self.postMessage({id, error: error.message});
    }
  });
};

// Files that a visitor drops: surfaces (.obj, .stl, .off) and volumes (legacy .vtk, Gmsh .msh of versions 2 and 4.1, as text).
// Errors are sentences for the visitor.

const CORNERS = {10: 4, 12: 8, 13: 6, 14: 5}; // of VTK's tetrahedra, hexahedra, wedges, pyramids
const VOXEL = 11;
const VOXEL_AS_HEXAHEDRON = [0, 1, 3, 2, 4, 5, 7, 6];
const SIDES = new Set([1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23, 28, 30, 34, 35, 36]); // VTK's points, lines and polygons: they bound volumes
const GMSH = {4: 10, 5: 12, 6: 13, 7: 14}; // the same cells by Gmsh's numbers
const VTK_SIDES = {1: 3, 2: 5, 3: 9, 15: 1}; // lines, triangles, quads and points by Gmsh's numbers
const MOST = 2_000_000; // points, or corners; more would take a browser's patience

const WAY_ON = 'In Python, dartsweep.read takes many more kinds of files, and meshio can write one as .vtk in text';

class FileError extends Error {}

function numbersOf(text, what) {
  const numbers = text.trim().split(/\s+/).map(Number);
  if (numbers.some(number => !Number.isFinite(number))) {
    throw new FileError(`${what} is not a list of numbers`);
  }
  return numbers;
}

/** Reads words one after the other. */
class Words {
  #at = 0;

  constructor(text) {
    this.words = text.split(/\s+/).filter(Boolean);
  }

  get done() {
    return this.#at >= this.words.length;
  }

  word() {
    if (this.done) {
      throw new FileError('the file ends early');
    }
    return this.words[this.#at++];
  }

  number() {
    const word = this.word();
    const number = Number(word);
    if (!Number.isFinite(number)) {
      throw new FileError(`'${word.slice(0, 40)}' stands where a number should be`);
    }
    return number;
  }

  count(what, most = MOST) {
    const number = this.number();
    if (!Number.isInteger(number) || number < 0 || number > most) {
      throw new FileError(`${what} is ${number}; it must be a whole number of at most ${most}`);
    }
    return number;
  }

  skip(count) {
    this.#at += count;
  }

  /** Goes behind the next `word`; false if there is none. */
  find(word) {
    const at = this.words.indexOf(word, this.#at);
    this.#at = at < 0 ? this.#at : at + 1;
    return at >= 0;
  }
}

// ---- Surfaces: points and triangles ----

function fan(corners, triangles) {
  if (corners.length < 3) {
    throw new FileError(`a face has ${corners.length === 1 ? '1 corner' : `${corners.length} corners`}`);
  }
  for (let at = 1; at + 1 < corners.length; ++at) {
    triangles.push(corners[0], corners[at], corners[at + 1]);
  }
}

function readObj(text) {
  const points = [];
  const triangles = [];
  for (const line of text.split('\n')) {
    if (line.startsWith('v ')) {
      const place = numbersOf(line.slice(2), 'a line with v');
      if (place.length < 3) {
        throw new FileError('a point has fewer than three coordinates');
      }
      points.push(...place.slice(0, 3));
    } else if (line.startsWith('f ')) {
      const corners = line.slice(2).trim().split(/\s+/).map(word => Number.parseInt(word, 10));
      fan(corners.map(corner => corner < 0 ? points.length / 3 + corner : corner - 1), triangles);
    }
  }
  return {points, triangles};
}

/** Reads line by line, because colours may stand behind the corners of a face. */
function readOff(text) {
  const lines = text.split('\n').map(line => line.replace(/#.*/, '').trim()).filter(Boolean);
  const [, behind] = /^OFF\b\s*(.*)$/.exec(lines[0] ?? '') ?? [];
  if (behind === undefined) {
    throw new FileError('the first word of an .off file must be OFF');
  }
  const rest = behind === '' ? lines.slice(1) : [behind, ...lines.slice(1)];
  const counts = new Words(rest[0] ?? '');
  const pointCount = counts.count('the number of points');
  const faceCount = counts.count('the number of faces');
  if (rest.length < 1 + pointCount + faceCount) {
    throw new FileError('the file ends early');
  }
  const points = [];
  for (const line of rest.slice(1, 1 + pointCount)) {
    const words = new Words(line);
    points.push(words.number(), words.number(), words.number());
  }
  const triangles = [];
  for (const line of rest.slice(1 + pointCount, 1 + pointCount + faceCount)) {
    const words = new Words(line);
    fan(Array.from({length: words.count('the number of corners of a face', 1000)}, () => words.number()), triangles);
  }
  return {points, triangles};
}

/** STL repeats each corner in each triangle: equal ones become one point. */
function readStl(buffer) {
  const view = new DataView(buffer);
  const count = buffer.byteLength >= 84 ? view.getUint32(80, true) : -1;
  const corners = [];
  if (buffer.byteLength === 84 + 50 * count) {
    for (let triangle = 0; triangle < count; ++triangle) {
      for (let number = 0; number < 9; ++number) {
        corners.push(view.getFloat32(84 + 50 * triangle + 12 + 4 * number, true));
      }
    }
  } else if (!new TextDecoder().decode(buffer.slice(0, 1000)).trimStart().startsWith('solid')) {
    throw new FileError(count < 0 ? 'the file ends early' :
      `the file has ${buffer.byteLength} bytes, but its ${count} triangles take ${84 + 50 * count}`);
  } else {
    for (const [, numbers] of new TextDecoder().decode(buffer).matchAll(/vertex\s+(\S+\s+\S+\s+\S+)/g)) {
      corners.push(...numbersOf(numbers, 'a vertex'));
    }
  }
  if (corners.length % 9 !== 0) {
    throw new FileError('a triangle has fewer than three corners');
  }
  const places = new Map();
  const points = [];
  const triangles = [];
  for (let at = 0; at < corners.length; at += 3) {
    const name = `${corners[at]} ${corners[at + 1]} ${corners[at + 2]}`;
    if (!places.has(name)) {
      places.set(name, points.length / 3);
      points.push(corners[at], corners[at + 1], corners[at + 2]);
    }
    triangles.push(places.get(name));
  }
  return {points, triangles};
}

/** Drops triangles without area, and closes openings by fans about their middles. Returns how many it closed. */
function close(surface) {
  const {points} = surface;
  const triangles = [];
  for (let at = 0; at < surface.triangles.length; at += 3) {
    const [a, b, c] = surface.triangles.slice(at, at + 3);
    if (a !== b && b !== c && c !== a) {
      triangles.push(a, b, c);
    }
  }
  const count = points.length / 3;
  const sides = new Map(); // by both ends: how many more triangles run it forth than back
  for (let at = 0; at < triangles.length; at += 3) {
    for (let side = 0; side < 3; ++side) {
      const from = triangles[at + side];
      const to = triangles[at + (side + 1) % 3];
      const name = Math.min(from, to) * count + Math.max(from, to);
      sides.set(name, (sides.get(name) ?? 0) + (from < to ? 1 : -1));
    }
  }
  const next = new Map(); // along the rims, against their triangles
  for (const [name, times] of sides) {
    if (Math.abs(times) > 1) {
      throw new FileError('triangles at an edge are turned against each other, or more than two meet there');
    }
    const [low, high] = [Math.floor(name / count), name % count];
    if (times !== 0) {
      const [from, to] = times > 0 ? [high, low] : [low, high];
      if (next.has(from)) {
        throw new FileError('two openings of the surface meet in a point, so they cannot be closed');
      }
      next.set(from, to);
    }
  }
  let closed = 0;
  while (next.size > 0) {
    const [first] = next.keys();
    const rim = [];
    for (let at = first; next.has(at);) {
      rim.push(at);
      const to = next.get(at);
      next.delete(at);
      at = to;
    }
    const middle = [0, 1, 2].map(axis => rim.reduce((sum, point) => sum + points[3 * point + axis], 0) / rim.length);
    rim.forEach((point, at) => triangles.push(point, rim[(at + 1) % rim.length], points.length / 3));
    points.push(...middle);
    ++closed;
  }
  surface.triangles = triangles;
  return closed;
}

function finishSurface(surface) {
  const {points} = surface;
  if (points.length % 3 !== 0) {
    throw new FileError('a point has fewer than three coordinates');
  }
  const wrong = surface.triangles.find(corner => !(Number.isInteger(corner) && corner >= 0 && corner < points.length / 3));
  if (wrong !== undefined) {
    throw new FileError(`a face names point ${wrong}, but there are ${points.length / 3}`);
  }
  if (surface.triangles.length === 0) {
    throw new FileError('there are no triangles in the file');
  }
  const closed = close(surface);
  return {
    what: 'surface',
    closed,
    left: 0,
    question: {points: Float64Array.from(points), triangles: Uint32Array.from(surface.triangles)},
  };
}

// ---- Volumes: points and cells ----

function readVtk(text) {
  const [version, , format] = text.split('\n', 3).map(line => line.trim());
  if (!version.startsWith('# vtk DataFile')) {
    throw new FileError('the file does not begin with "# vtk DataFile"');
  }
  if (format !== 'ASCII') {
    throw new FileError(`the file is ${format}; only ASCII can be read here`);
  }
  const words = new Words(text);
  if (!words.find('UNSTRUCTURED_GRID') || !words.find('POINTS')) {
    throw new FileError('the file holds no UNSTRUCTURED_GRID with POINTS');
  }
  const pointCount = words.count('the number of points');
  words.skip(1);
  const points = Array.from({length: 3 * pointCount}, () => words.number());
  if (!words.find('CELLS')) {
    throw new FileError('the file holds no CELLS');
  }
  const first = words.count('the number of cells');
  const size = words.count('the size of the cells', 10 * MOST);
  const lists = [];
  if (Number(version.replace('# vtk DataFile Version ', '')) >= 5 && words.find('OFFSETS')) {
    words.skip(1);
    const offsets = Array.from({length: first}, () => words.count('an offset', 10 * MOST));
    words.find('CONNECTIVITY');
    words.skip(1);
    const corners = Array.from({length: size}, () => words.number());
    offsets.slice(1).forEach((end, cell) => lists.push(corners.slice(offsets[cell], end)));
  } else {
    for (let cell = 0; cell < first; ++cell) {
      lists.push(Array.from({length: words.count('the number of corners of a cell', 1000)}, () => words.number()));
    }
  }
  if (!words.find('CELL_TYPES')) {
    throw new FileError('the file holds no CELL_TYPES');
  }
  words.skip(1);
  return {points, cells: lists.map(corners => ({type: words.number(), corners}))};
}

function readMsh(text) {
  const words = new Words(text);
  if (!words.find('$MeshFormat')) {
    throw new FileError('the file holds no $MeshFormat');
  }
  const version = words.number();
  if (words.number() !== 0) {
    throw new FileError('the file is binary; only text can be read here (gmsh -format msh41)');
  }
  if (![2, 2.1, 2.2, 4.1].includes(version)) {
    throw new FileError(`the file is of version ${version}; versions 2 and 4.1 can be read here`);
  }
  if (!words.find('$Nodes')) {
    throw new FileError('the file holds no $Nodes');
  }
  const points = [];
  const places = new Map();
  const add = name => {
    places.set(name, points.length / 3);
    points.push(words.number(), words.number(), words.number());
  };
  if (version < 4) {
    for (let left = words.count('the number of nodes'); left > 0; --left) {
      add(words.number());
    }
  } else {
    let blocks = words.count('the number of blocks');
    words.skip(3);
    for (; blocks > 0; --blocks) {
      words.skip(2);
      if (words.number() !== 0) {
        throw new FileError('nodes have parameters, which cannot be read here');
      }
      const names = Array.from({length: words.count('the number of nodes')}, () => words.number());
      names.forEach(add);
    }
  }
  if (!words.find('$Elements')) {
    throw new FileError('the file holds no $Elements');
  }
  const cells = [];
  const NODES = {1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 6: 6, 7: 5, 15: 1};
  const cell = (kind, skipped) => {
    if (!NODES[kind]) {
      throw new FileError(`cells of Gmsh's type ${kind} cannot be read here; cells must be linear`);
    }
    words.skip(skipped);
    const corners = Array.from({length: NODES[kind]}, () => places.get(words.number()));
    cells.push({type: GMSH[kind] ?? VTK_SIDES[kind], corners});
  };
  if (version < 4) {
    for (let left = words.count('the number of elements', 10 * MOST); left > 0; --left) {
      words.skip(1);
      cell(words.number(), words.count('the number of tags', 100));
    }
  } else {
    let blocks = words.count('the number of blocks');
    words.skip(3);
    for (; blocks > 0; --blocks) {
      words.skip(2);
      const kind = words.number();
      for (let left = words.count('the number of elements', 10 * MOST); left > 0; --left) {
        cell(kind, 1);
      }
    }
  }
  return {points, cells};
}

function asHexahedron({type, corners}) {
  return type === VOXEL && corners.length === 8 ? {type: 12, corners: VOXEL_AS_HEXAHEDRON.map(at => corners[at])} : {type, corners};
}

function finishVolumes({points, cells}) {
  const every = cells.map(asHexahedron);
  const volumes = every.filter(({type}) => CORNERS[type]);
  const unknown = every.filter(({type}) => !CORNERS[type] && !SIDES.has(type));
  if (unknown.length > 0) {
    throw new FileError(`${unknown.length} of its ${every.length} cells have types that cannot be read here, such as ${unknown[0].type} of VTK`);
  }
  if (volumes.length === 0) {
    throw new FileError('there are no tetrahedra, hexahedra, wedges or pyramids in the file');
  }
  const wrong = volumes.find(({type, corners}) => corners.length !== CORNERS[type] ||
    corners.some(corner => !(Number.isInteger(corner) && corner >= 0 && corner < points.length / 3)));
  if (wrong) {
    throw new FileError(`a cell of type ${wrong.type} has the corners ${wrong.corners.join(' ')}, which do not fit`);
  }
  return {
    what: 'volumes',
    closed: 0,
    left: every.length - volumes.length,
    question: {
      points: Float64Array.from(points),
      types: Uint8Array.from(volumes, ({type}) => type),
      corners: Int32Array.from(volumes.flatMap(({corners}) => corners)),
    },
  };
}

const READERS = {
  obj: buffer => finishSurface(readObj(new TextDecoder().decode(buffer))),
  off: buffer => finishSurface(readOff(new TextDecoder().decode(buffer))),
  stl: buffer => finishSurface(readStl(buffer)),
  vtk: buffer => finishVolumes(readVtk(new TextDecoder().decode(buffer))),
  msh: buffer => finishVolumes(readMsh(new TextDecoder().decode(buffer))),
};

/** A question to the worker: `what` it creates, its arrays, how many openings were closed, and how many points, lines and
 * polygons beside volumes were left out. Throws an error with a
 * sentence that begins with the file's name. */
export async function readFile(file) {
  const ending = file.name.split('.').pop().toLowerCase();
  try {
    if (!READERS[ending]) {
      throw new FileError(`the page reads only files that end in ${Object.keys(READERS).map(name => `.${name}`).join(', ')}`);
    }
    return READERS[ending](await file.arrayBuffer());
  } catch (error) {
    throw error instanceof FileError ? new Error(`${file.name}: ${error.message}. ${WAY_ON}.`) : error;
  }
}

/// <reference lib="esnext.disposable" />
// Types of the package dartsweep. What a call does and guarantees is told by the C headers; structs and enumerators, and their comments,
// are in structs.d.ts.
// {imports}

export * from './structs.js';

/** Points, x, y, z of each, in the plane x, y: a Float64Array is read where it is, an array is copied. */
export type Points = Float64Array | readonly number[];
/** One point. */
export type Point = Points | Readonly<Vec3>;
/** Indices: typed arrays are read where they are. */
export type Indices = Int32Array | Uint32Array | BigInt64Array | readonly number[];
/** Not below 0, of 32 bits: a Uint32Array is read where it is. */
export type Numbers = Uint32Array | readonly number[];
/** Structs: a list of them is read where it is, an array is copied. */
export type Structs<T> = StructArray<T> | readonly T[];

/** The base of VolumeIdArray, FlightArray and so on: structs as C has them in `buffer`, which calls read and fill in place. */
export class StructArray<T> implements Iterable<T> {
  /** Makes an array of a number of entries, of the memory of another array (also on another thread), or of values. */
  constructor(source: number | ArrayBuffer | SharedArrayBuffer | Iterable<T>);
  readonly buffer: ArrayBuffer | SharedArrayBuffer;
  readonly length: number;
  /** A copy; negative indices count from the end. */
  at(index: number): T | undefined;
  set(index: number, value: T): void;
  [Symbol.iterator](): IterableIterator<T>;
  toArray(): T[];
}

/** The base of the errors, one for each status of C. A call that throws one has changed nothing. */
export class DartsweepError extends Error {
  readonly status: Status;
  /** The status by name, as DSW_STALE_ID. */
  readonly code: string;
}
/** A call on an object after close(). */
export class ClosedError extends DartsweepError {}

/** Threads for calls that use several, 0 as many as there are processors; and the log, called after the call that wrote it. */
export class Context {
  constructor(options?: { threads?: number; log?: (level: LogLevel, text: string) => void });
}

export interface Cells {
  /** The type of all cells, or with `types` that of each. */
  type?: CellType;
  types?: Uint8Array | readonly number[];
  /** Where each cell's indices begin, and the end; not needed where all are of one type. */
  offsets?: Indices;
  /** A label for each cell. */
  regions?: Int32Array | readonly number[];
  /** A number of the host's for each cell. */
  tags?: Numbers;
}

export class Environment {
  /** `points` are copied; `cells` are the indices of each cell's points, in VTK's order. */
  constructor(points: Points, cells: Indices,
    options?: Cells & { faces?: Indices; faceLocations?: Indices; context?: Context } & Omit<EnvironmentDesc, 'uniformCellType'>);
  static load(block: Uint8Array, context?: Context): Environment;
  coarsen(options?: CoarsenOptions, volumeMap?: Uint32Array): Environment;
  /** May be repeated. Scenes of the environment go on. */
  close(): void;
  [Symbol.dispose](): void;
  /** 2 in the plane, where points have two coordinates (points in results a third, 0), else 3. */
  dimension(): number;
  /** Throws BoundaryCrossesError where the boundary does. */
  checkAll(): void;

  /** Finds faces by their vertices, which stand one after the other; `offsets` says where each face begins, and the
   * end. */
  findFaces(offsets: BigUint64Array | readonly number[], indices: Numbers): FaceIdArray;
  findEdges(pairs: Numbers): EdgeIdArray;
  /** A copy. */
  getPoints(): Float64Array;

  /** `locations` are of type Location. */
  locatePoints(points: Points, hints?: Structs<VolumeId>): { volumes: VolumeIdArray; locations: Int32Array };
  /** How far points are from the outer boundary, negative inside. `nearest` is filled where it is given. */
  findSignedDistances(points: Points, options?: { distances?: Float64Array; nearest?: NearestArray }): Float64Array;
  cast(from: Point, to: Point, options?: CastOptions & { start?: VolumeId | null }): Flight;
  castPath(from: Point, to: Point, options?: CastOptions & { start?: VolumeId | null }): CrossingArray;
  findNearest(point: Point, radius: number, volume?: VolumeId | null): Nearest;

  /** How many were skipped. */
  markVolumes(volumes: Structs<VolumeId>, mark: Mark, flags?: number): number;

  addVolumes(points: Points, cells: Indices,
    options?: Cells & { vertices?: Structs<VertexId>; sewTo?: Structs<FaceId> } & Omit<VolumesDesc, 'uniformCellType'>): VolumeIdArray;

  /** `blade` has rows * columns points, row by row. */
  cut(blade: Points, rows: number, columns: number, options?: CutDesc): Change;
  tearFaces(faces: Structs<FaceId>, loads: Points, threshold: number): Change;
  remesh(options?: RemeshDesc & { volumes?: Structs<VolumeId>; next?: Points }): Change;
  /** A piece becomes a body of the scene; getChange says more. */
  detach(options: DetachDesc): BodyId;
  /** Tells about the last change of the topology. */
  getChange(): Change;

  /** Takes the environment to positions of its vertices: a copy, which getPoints reads. */
  deform(positions: Points, options?: DeformOptions): DeformReport;

  // {methods of Environment}
}

/** What a change of the topology did; its numbers are in structs.d.ts. */
export interface Change extends Readonly<ChangeNumbers> {}
export class Change {
  private constructor();
  /** What became of each volume. */
  getVolumes(): VolumeChangeArray;
  /** Vertices added by a cut or a crack. */
  getVertices(): VertexOriginArray;
  /** Faces of a cut or tear; lips of a crack. */
  getFaces(): CutFaceArray;
  /** Cut: volumes crossed, but not split. */
  getWhole(): VolumeIdArray;
  /** Carving: volumes made passable. */
  getCarved(): VolumeIdArray;
  /** Repair: volumes left invalid, by index. */
  getUnrepaired(): VolumeIdArray;
  /** Volumes of the detached piece. */
  getDetached(): VolumeIdArray;
  /** Tells where the vertices of the detached body come from, by index. */
  getBodyVertices(): VertexOriginArray;
  getBodyFaces(): FaceOriginArray;
}

/** It keeps its environment. */
export class Scene {
  constructor(environment: Environment, options?: SceneDesc);
  static load(environment: Environment, block: Uint8Array): Scene;
  /** May be repeated. Bodies of the scene are closed with it. */
  close(): void;
  [Symbol.dispose](): void;
  /** The dimension of the scene's environment. */
  dimension(): number;
  /** Into a file; without a path the latest calls are kept for writeBugReport, which needs RECORDING_LATEST among the flags. */
  startRecording(path: string | null, flags?: number): void;
  /** A bug report of the last recorded call. */
  writeBugReport(path: string, note?: string): Validation;

  getParticlePositions(particles: Structs<ParticleId>): { positions: Float64Array; volumes: VolumeIdArray };

  /** Two indices for each. */
  getOffendingEdges(): Uint32Array;

  /** `edges` are pairs of indices of vertices, `triangles` threes. */
  createBody(positions: Points, edges?: Numbers, options?: BodyDesc & { triangles?: Numbers; hints?: Structs<VolumeId> }): Body;
  body(id: BodyId): Body;
  /** Bodies go to their targets while the environment goes to new positions, a copy, all at once. What touches stops, or is pushed, as options.stop and options.response say. */
  deform(
    positions: Points,
    options?: SceneDeformOptions & { bodies?: Structs<BodyId> | readonly Body[]; targets?: Points; reports?: MoveReportArray },
  ): { report: DeformReport; reports: MoveReportArray };

  /** Moves bodies, each on a rigid motion of its own, all at once, up to the first touch. A motion has 10 numbers: a quaternion x, y, z, w, a
   * centre and a translation. `reports` is filled where it is given. */
  moveRigid(bodies: Structs<BodyId> | readonly Body[], motions: Float64Array | readonly number[],
    options?: TogetherOptions & { reports?: MoveReportArray }): MoveReportArray;
  /** What segments meet first, of walls and bodies; `partners` are the bodies and parts that they met, null at walls. */
  cast(from: Points, to: Points, options?: CastOptions & { starts?: Structs<VolumeId> }): { flights: FlightArray; partners: ContactPartnerArray };
  /** What is nearest to points, of walls and bodies. */
  findNearest(
    points: Points,
    radius?: number,
    options?: { hints?: Structs<VolumeId>; volumes?: VolumeIdArray; locations?: Int32Array },
  ): { nearest: NearestArray; partners: ContactPartnerArray };
  /** Moves bodies as moveRigid while the environment goes to new positions, a copy, all at once, up to the first touch of anything. */
  deformRigid(positions: Points, bodies: Structs<BodyId> | readonly Body[], motions: Float64Array | readonly number[],
    options?: SceneDeformOptions & { reports?: MoveReportArray }): { report: DeformReport; reports: MoveReportArray };
  /** The largest part of steps, body after body, that is free when all vertices go at once; nothing moves. `fractions` are those of each body's
   * island, `places` where `fraction` leads, with stop ISLAND where `fractions` lead. */
  stepFraction(bodies: Structs<BodyId> | readonly Body[], steps: Float64Array | readonly number[],
    options?: TogetherOptions & { environmentSteps?: Float64Array | readonly number[] }):
    { fraction: number; fractions: Float64Array; places: Float64Array; environmentPlaces?: Float64Array };
  // {methods of Scene}
}

/** A body in a scene, which it keeps; the body goes with destroy(). */
export class Body {
  constructor(scene: Scene, id: BodyId);
  id(): BodyId;
  /** The dimension of the scene's environment. */
  dimension(): number;
  /** The distance that the body keeps from everything. */
  getRadius(): number;
  /** A lower bound of the least gap: distance less the radii; at most `limit`. */
  findLeastGap(limit: number): number;
  /** Whether the body was created with BODY_START_PENETRATING where it is not free, and has not been freed yet. */
  isPenetrating(): boolean;
  /** Moves such a body out, to the side of walls on which `inside` is, if that is given; at most so far, if not 0. */
  depenetrate(inside?: VolumeId, maxDistance?: number): { freed: boolean; distance: number };

  /** Gives the positions of all vertices by index; the arrays are filled where they are given. */
  getPositions(positions?: Float64Array, volumes?: VolumeIdArray): Float64Array;
  /** Gives two indices of vertices for each edge by index; for each triangle three. */
  getEdgeIndices(): Uint32Array;

  /** Vertices go to their targets, in `order` (all, by index, where that is left out), each as far as it goes. */
  move(targets: Points, options?: MoveOptions & { order?: Numbers }): MoveReport;
  moveRigid(motion: RigidMotion, options?: MoveOptions & { order?: Numbers }): MoveReport;
  /** The motion from where moveRigid has left the body to where it should be. */
  getMotionLeft(): RigidMotion;
  /** By vertex, the way from where moveTogether or deform has left it to its target; empty after other moves. */
  getWaysLeft(): Float64Array;
  /** How far the body could go along paths through poses; nothing moves. A pose has 7 numbers: a quaternion x, y, z, w and a translation, from
   * where the body is now, round `centre`. A path has two indices of poses, or those from `offsets[i]` to `offsets[i + 1]`. `fractions` and
   * `contacts`, what stops each path, are filled where given. */
  findFreeFractions(centre: Point, poses: Float64Array | readonly number[], indices: Numbers,
    options?: { offsets?: Numbers; fractions?: FreeFractionArray; contacts?: BodyContactArray }): FreeFractionArray;

  /** Finds the parts that are near to something, and returns how many rows there are. */
  findNearRows(options?: NearOptions): number;
  /** Gives the Jacobian of the gaps, with NEAR_JACOBIAN, in compressed sparse rows. */
  getNearOffsets(): Uint32Array;

  // {methods of Body}
}

/** Geometry for viewers. */
export class Trace {
  constructor();
  clear(): void;
  addImpassable(environment: Environment, withBoundary?: boolean, label?: number): void;
  addWalk(environment: Environment, from: Point, to: Point,
    options?: CastOptions & { normalLength?: number; label?: number; start?: VolumeId | null }): void;
  addContact(flight: Flight, normalLength?: number, label?: number): void;

  // {methods of Trace}
}

/** When each of many pairs first touches. A pair has `dimension + 1` points, pair after pair; kinds are of type PairKind, `flags` are
 * PAIRS_ constants. `touches` is filled where it is given. */
export function sweepPairs(dimension: 2 | 3, kinds: Uint8Array | readonly number[], from: Points, to: Points,
  options?: { flags?: number; touches?: PairTouchArray; context?: Context | null }): PairTouchArray;
/** sweepPairs with features that may turn: `motions` has 17 numbers for each motion, `indices` two for each pair, 4294967295 for no motion.
 * `to` may be empty: features without a motion stand. */
export function sweepRigidPairs(dimension: 2 | 3, kinds: Uint8Array | readonly number[], from: Points, to: Points,
  motions: Float64Array | readonly number[], indices: Uint32Array | readonly number[],
  options?: { flags?: number; touches?: PairTouchArray; context?: Context | null }): PairTouchArray;
/** The cell that an id names. */
export function cellOf(id: VertexId | EdgeId | FaceId | VolumeId): Cell;
/** The version of the library that is loaded: 1000000 major + 1000 minor + patch. */
export function version(): number;
export function statusString(status: Status): string;

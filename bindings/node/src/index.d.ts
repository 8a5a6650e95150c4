/// <reference lib="esnext.disposable" />
// Types of the package dartsweep. What a call does and guarantees is told by the C headers; structs and enumerators, and their comments,
// are in structs.d.ts.
import type {
  BodyContact, BodyContactArray, BodyCounts, BodyDesc, BodyEdgeId, BodyEdgeIdArray, BodyEdit, BodyEditArray,
  BodyFaceId, BodyFaceIdArray, BodyFilter, BodyId, BodyIdArray, BodyVertexId, BodyVertexIdArray, BuildReport,
  CarveDesc, CastOptions, Cell, CellKind, CellType, ChangeNumbers, CoarsenOptions, ContactPartnerArray, CrossCheck,
  CrossingArray, CutDesc, CutFace, CutFaceArray, DeformOptions, DeformReport, DetachDesc, EdgeId, EdgeIdArray,
  EdgeSplit, EnvironmentDesc, EnvironmentInfo, FaceId, FaceIdArray, FaceOriginArray, FaceSplit, FaceVolumes, Flight,
  FlightArray, Level, Located, LogLevel, Mark, Marked, MoveOptions, MoveReport, MoveReportArray, Nearest, NearestArray, NearOptions, NearRowArray, Neighbour,
  OpenCrackDesc, PairTouchArray, Particle, ParticleId, ParticleIdArray, PreviousContactArray, RemeshDesc, RigidMotion, SceneDesc,
  SegmentNearestArray,
  Statistics, Status, SweepArray, SweepOptions, TieDesc, TogetherOptions, Validation, Vec3, VertexId, VertexIdArray, VertexOriginArray,
  VolumeChangeArray, VolumeCounts, VolumeId, VolumeIdArray, VolumesDesc, VolumeSplit, WallContactArray,
} from './structs.js';

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
  save(): Uint8Array;
  coarsen(options?: CoarsenOptions, volumeMap?: Uint32Array): Environment;
  /** May be repeated. Scenes of the environment go on. */
  close(): void;
  [Symbol.dispose](): void;
  isClosed(): boolean;
  /** 2 in the plane, where points have two coordinates (points in results a third, 0), else 3. */
  dimension(): number;
  buildReport(): BuildReport;
  info(): EnvironmentInfo;
  /** Throws BoundaryCrossesError where the boundary does. */
  checkAll(): void;

  getVolumeId(index: number): VolumeId;
  getVertexId(index: number): VertexId;
  getVertexPosition(vertex: VertexId): Vec3;
  getCentre(volume: VolumeId): Vec3;
  getVolumeCounts(volume: VolumeId): VolumeCounts;
  getFaceId(volume: VolumeId, local: number): FaceId;
  getEdgeId(volume: VolumeId, local: number): EdgeId;
  copyVertices(cell: Cell): VertexIdArray;
  getFaceVolumes(face: FaceId): FaceVolumes;
  getNeighbour(volume: VolumeId, local: number): Neighbour;
  /** Finds faces by their vertices, which stand one after the other; `offsets` says where each face begins, and the
   * end. */
  findFaces(offsets: BigUint64Array | readonly number[], indices: Numbers): FaceIdArray;
  findEdges(pairs: Numbers): EdgeIdArray;
  getRegion(volume: VolumeId): number;
  getParent(volume: VolumeId): number;
  getTag(volume: VolumeId): number;
  setTag(volume: VolumeId, tag: number): void;
  isValid(volume: VolumeId): boolean;
  /** A copy. */
  getPoints(): Float64Array;

  locate(point: Point, hint?: VolumeId | null): Located;
  /** `locations` are of type Location. */
  locatePoints(points: Points, hints?: Structs<VolumeId>): { volumes: VolumeIdArray; locations: Int32Array };
  classify(point: Point, volume: VolumeId): Cell;
  cast(from: Point, to: Point, options?: CastOptions & { start?: VolumeId | null }): Flight;
  castPath(from: Point, to: Point, options?: CastOptions & { start?: VolumeId | null }): CrossingArray;
  /** `flights` is filled where it is given. */
  castSegments(from: Points, to: Points, options?: CastOptions & { starts?: Structs<VolumeId>; flights?: FlightArray }): FlightArray;
  findNearest(point: Point, radius: number, volume?: VolumeId | null): Nearest;
  /** The nearest places inside, `by` from the boundary. `volumes`, of the places, are filled where they are given. */
  findInside(points: Points, by?: number, options?: { hints?: Structs<VolumeId>; volumes?: VolumeIdArray }): Float64Array;
  /** `volumes`, of the points, `locations`, of type Location, and `nearest` are filled where they are given. */
  findNearestToPoints(points: Points, radius: number,
    options?: { hints?: Structs<VolumeId>; volumes?: VolumeIdArray; locations?: Int32Array; nearest?: NearestArray }): NearestArray;
  /** Finds what is nearest to segments. `volumes` and `locations` are those of the first points; all are filled where
   * they are given. */
  findNearestToSegments(from: Points, to: Points, radius: number,
    options?: { hints?: Structs<VolumeId>; volumes?: VolumeIdArray; locations?: Int32Array; nearest?: SegmentNearestArray }): SegmentNearestArray;
  /** One end of each edge moves, the other is `fixed`. */
  sweepEdges(from: Points, to: Points, fixed: Points,
    options?: SweepOptions & { starts?: Structs<VolumeId>; sweeps?: SweepArray }): SweepArray;
  crossCheck(contact: BodyContact): CrossCheck;

  /** How many were skipped. */
  markVolumes(volumes: Structs<VolumeId>, mark: Mark, flags?: number): number;
  markFaces(faces: Structs<FaceId>, mark: Mark): void;
  markEdges(edges: Structs<EdgeId>, mark: Mark): void;
  markVertices(vertices: Structs<VertexId>, mark: Mark): void;
  markRegion(region: number, mark: Mark, flags?: number): Marked;
  markBetween(a: number, b: number, mark: Mark): number;
  isMarked(cell: Cell): boolean;
  isImpassable(cell: Cell): boolean;
  getMarkCount(kind: CellKind): number;

  sewFaces(a: Structs<FaceId>, b: Structs<FaceId>): void;
  unsewFace(face: FaceId): void;
  addVolumes(points: Points, cells: Indices,
    options?: Cells & { vertices?: Structs<VertexId>; sewTo?: Structs<FaceId> } & Omit<VolumesDesc, 'uniformCellType'>): VolumeIdArray;
  removeVolumes(volumes: Structs<VolumeId>): void;
  mergeVolumes(face: FaceId): VolumeId;
  splitVolume(volume: VolumeId, loop: Structs<VertexId>): VolumeSplit;
  mergeFaces(edge: EdgeId): FaceId;
  splitFace(face: FaceId, a: VertexId, b: VertexId): FaceSplit;
  splitEdge(edge: EdgeId, edgeParameter: number): EdgeSplit;
  mergeEdges(edge: EdgeId, vertex: VertexId): EdgeId;
  collapseEdge(edge: EdgeId, vertex: VertexId): void;

  /** `blade` has rows * columns points, row by row. */
  cut(blade: Points, rows: number, columns: number, options?: CutDesc): Change;
  tearFaces(faces: Structs<FaceId>, loads: Points, threshold: number): Change;
  openCrack(faces: Structs<CutFace>, options: OpenCrackDesc): Change;
  carve(points: Points, triangles: Numbers, options?: CarveDesc): Change;
  tie(loop: Points, options?: TieDesc): Change;
  remesh(options?: RemeshDesc & { volumes?: Structs<VolumeId>; next?: Points }): Change;
  /** A piece becomes a body of the scene; getChange says more. */
  detach(options: DetachDesc): BodyId;
  /** Tells about the last change of the topology. */
  getChange(): Change;

  /** Takes the environment to positions of its vertices: a copy, which getPoints reads. */
  deform(positions: Points, options?: DeformOptions): DeformReport;
  getWallContacts(): WallContactArray;
  getHeldVertices(): VertexIdArray;
  getInvalidVolumes(): VolumeIdArray;
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
  save(): Uint8Array;
  /** May be repeated. Bodies of the scene are closed with it. */
  close(): void;
  [Symbol.dispose](): void;
  isClosed(): boolean;
  /** The dimension of the scene's environment. */
  dimension(): number;
  getStatistics(): Statistics;
  resetStatistics(): void;
  getMemoryBytes(): number;
  getParticleCount(): number;
  getBodyCount(): number;
  getParticleIds(): ParticleIdArray;
  getBodyIds(): BodyIdArray;
  /** Into a file; without a path the latest calls are kept for writeBugReport, which needs RECORDING_LATEST among the flags. */
  startRecording(path: string | null, flags?: number): void;
  stopRecording(): void;
  /** A bug report of the last recorded call. */
  writeBugReport(path: string, note?: string): Validation;

  createParticle(position: Point, hint?: VolumeId | null): ParticleId;
  /** All or none. */
  createParticles(positions: Points, options?: { hints?: Structs<VolumeId>; particles?: ParticleIdArray }): ParticleIdArray;
  destroyParticle(particle: ParticleId): void;
  getParticlePosition(particle: ParticleId): Particle;
  getParticlePositions(particles: Structs<ParticleId>): { positions: Float64Array; volumes: VolumeIdArray };
  moveParticle(particle: ParticleId, target: Point, options?: CastOptions): Flight;
  /** Each to the first wall in its way; `flights` is filled where it is given. */
  moveParticles(particles: Structs<ParticleId>, targets: Points, options?: CastOptions & { flights?: FlightArray }): FlightArray;
  castFromParticles(particles: Structs<ParticleId>, to: Points, options?: CastOptions & { flights?: FlightArray }): FlightArray;
  getCrossings(): CrossingArray;
  getCrossingOffsets(): number[];

  getOccupants(): ParticleIdArray;
  getOccupantBodies(): BodyIdArray;
  /** Two indices for each. */
  getOffendingEdges(): Uint32Array;

  /** `edges` are pairs of indices of vertices, `triangles` threes. */
  createBody(positions: Points, edges?: Numbers, options?: BodyDesc & { triangles?: Numbers; hints?: Structs<VolumeId> }): Body;
  body(id: BodyId): Body;
  /** `targets` of all vertices of one body after the other. */
  moveBodies(bodies: Structs<BodyId> | readonly Body[], targets: Points, options?: MoveOptions & { reports?: MoveReportArray }): MoveReportArray;
  /** All vertices of all bodies move at once; targets body after body. */
  moveTogether(
    bodies: Structs<BodyId> | readonly Body[],
    targets: Points,
    options?: TogetherOptions & { reports?: MoveReportArray },
  ): MoveReportArray;
  /** The environment goes to new positions, a copy, and bodies go to their targets, all at once, up to the first contact. */
  deform(
    positions: Points,
    options?: DeformOptions & { bodies?: Structs<BodyId> | readonly Body[]; targets?: Points; reports?: MoveReportArray },
  ): { report: DeformReport; reports: MoveReportArray };
}

/** A body in a scene, which it keeps; the body goes with destroy(). */
export class Body {
  constructor(scene: Scene, id: BodyId);
  id(): BodyId;
  /** The dimension of the scene's environment. */
  dimension(): number;
  destroy(): void;
  getCounts(): BodyCounts;
  getLevel(): Level;
  setLevel(level: Level): void;
  getFilter(): BodyFilter;
  setFilter(category: number, mask: number): void;
  /** The distance that the body keeps from everything. */
  getRadius(): number;
  setRadius(radius: number): void;
  /** A lower bound of the least gap: distance less the radii; at most `limit`. */
  findLeastGap(limit: number): number;

  /** Gives the positions of all vertices by index; the arrays are filled where they are given. */
  getPositions(positions?: Float64Array, volumes?: VolumeIdArray): Float64Array;
  getVertexIds(): BodyVertexIdArray;
  getEdgeIds(): BodyEdgeIdArray;
  getFaceIds(): BodyFaceIdArray;
  getEdgeEnds(edge: BodyEdgeId): BodyVertexIdArray;
  getFaceCorners(face: BodyFaceId): BodyVertexIdArray;
  /** Gives two indices of vertices for each edge by index; for each triangle three. */
  getEdgeIndices(): Uint32Array;
  getFaceIndices(): Uint32Array;
  getVertexId(index: number): BodyVertexId;
  addVertex(position: Point, hint?: VolumeId | null): BodyVertexId;
  addEdge(a: BodyVertexId, b: BodyVertexId): BodyEdgeId;
  addFace(a: BodyVertexId, b: BodyVertexId, c: BodyVertexId): BodyFaceId;
  removeFace(face: BodyFaceId): void;
  removeEdge(edge: BodyEdgeId): void;
  removeVertex(vertex: BodyVertexId): void;
  splitEdge(edge: BodyEdgeId, edgeParameter: number): BodyEdit;
  collapseEdge(edge: BodyEdgeId, vertex: BodyVertexId): BodyEdit;

  /** Vertices go to their targets, in `order` (all, by index, where that is left out), each as far as it goes. */
  move(targets: Points, options?: MoveOptions & { order?: Numbers }): MoveReport;
  moveRigid(motion: RigidMotion, options?: MoveOptions & { order?: Numbers }): MoveReport;
  getContacts(): BodyContactArray;
  getContactPartners(): ContactPartnerArray;
  getPreviousContacts(): PreviousContactArray;
  getEdits(): BodyEditArray;

  /** Finds the parts that are near to something, and returns how many rows there are. */
  findNearRows(options?: NearOptions): number;
  getNearRows(): NearRowArray;
  /** Gives the Jacobian of the gaps, with NEAR_JACOBIAN, in compressed sparse rows. */
  getNearOffsets(): Uint32Array;
  getNearColumns(): Uint32Array;
  getNearValues(): Float64Array;
}

/** Geometry for viewers. */
export class Trace {
  constructor();
  clear(): void;
  addVolumes(environment: Environment, volumes: Structs<VolumeId>, label?: number): void;
  addImpassable(environment: Environment, withBoundary?: boolean, label?: number): void;
  addWalk(environment: Environment, from: Point, to: Point,
    options?: CastOptions & { normalLength?: number; label?: number; start?: VolumeId | null }): void;
  addContact(flight: Flight, normalLength?: number, label?: number): void;
  getPoints(): Float64Array;
  getVertices(): Uint32Array;
  getVertexLabels(): Uint32Array;
  getSegments(): Uint32Array;
  getSegmentLabels(): Uint32Array;
  getTriangles(): Uint32Array;
  getTriangleLabels(): Uint32Array;
}

/** When each of many pairs first touches. A pair has `dimension + 1` points, pair after pair; kinds are of type PairKind, `flags` are
 * PAIRS_ constants. `touches` is filled where it is given. */
export function sweepPairs(dimension: 2 | 3, kinds: Uint8Array | readonly number[], from: Points, to: Points,
  options?: { flags?: number; touches?: PairTouchArray; context?: Context | null }): PairTouchArray;
/** The cell that an id names. */
export function cellOf(id: VertexId | EdgeId | FaceId | VolumeId): Cell;
/** The version of the library that is loaded: 1000000 major + 1000 minor + patch. */
export function version(): number;
export function statusString(status: Status): string;

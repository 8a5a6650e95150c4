// Compiled, not run: what types allow, and what they refuse.
import dartsweep, {
  CellType, Change, Environment, FaceId, FlightArray, Level, Mark, Outcome, Scene, StaleIdError, Status, VertexId,
  VolumeId,
} from 'dartsweep';

using environment = new Environment(new Float64Array(24), [0, 1, 2, 3, 4, 5, 6, 7], { type: CellType.Hexahedron, tags: [1] });
const { volume, location } = environment.locate([0, 0, 0]);
environment.markVolumes([volume], Mark.Impassable);
const { time, position: [x] } = environment.cast([0, 0, 0], new Float64Array(3), { start: volume, maxVolumes: 10 });
const flights: FlightArray = environment.castSegments(new Float64Array(3), new Float64Array(3), { flights: new FlightArray(1) });
const reached: boolean = [...flights].every((flight) => flight.outcome === Outcome.Reached && flight.time >= time * x);
const change: Change = environment.cut(new Float64Array(12), 2, 2);
const walls: FaceId[] = [...change.getFaces()].map((face) => face.front).slice(change.volumesSplit);
const scene: Scene = new dartsweep.Scene(environment, { features: dartsweep.FEATURE_CROSSINGS });
const body = scene.createBody([0, 0, 0], [], { level: Level.Points, triangles: new Uint32Array(3) });
export const results = [location, reached, walls, body, (error: unknown) => error instanceof StaleIdError && error.status === Status.StaleId];

// @ts-expect-error: another kind of id
environment.getCentre(new VertexId(0, 1));
// @ts-expect-error: no such option
environment.cast([0, 0, 0], [1, 1, 1], { maxCels: 10 });
// @ts-expect-error: not a point
environment.locate(0);
// @ts-expect-error: read only
volume.index = new VolumeId(0, 1).index;
// @ts-expect-error: read only
change.volumesSplit = 0;

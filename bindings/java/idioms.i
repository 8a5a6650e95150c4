// What Java's users expect beyond the shared methods and those of fillers.i, which are made: double[] where buffers would do. Points are x,
// y, z of each, in the plane x, y.

%typemap(javaimports) dartsweep::Environment, dartsweep::Scene, dartsweep::Body "import java.nio.DoubleBuffer;"

%javamethodmodifiers dartsweep::Scene::create_body "private";
%rename(createBodyId) dartsweep::Scene::create_body;

%typemap(javacode) dartsweep::Environment %{
  /** Makes an environment of cells of one type: points as x, y, z, in the plane (triangles, quads) as x, y; the indices
   * of each cell's points as in VTK; a region for each cell, or null. */
  public Environment(double[] points, int[] cells, CellType type, int[] regions) {
    this(points, cells, type, regions, null);
  }

  /** Makes an environment of cells of one type, with the threads and the log of a context. */
  public Environment(double[] points, int[] cells, CellType type, int[] regions, Context context) {
    this(DoubleBuffer.wrap(points), cells, null, null, regions, null, null, null, describe(type), context);
  }

  private static EnvironmentDesc describe(CellType type) {
    EnvironmentDesc desc = new EnvironmentDesc();
    desc.setUniformCellType(type.swigValue());
    boolean planar = type == CellType.TRIANGLE || type == CellType.QUAD || type == CellType.POLYGON;
    desc.setDimension(planar ? 2 : 3);
    return desc;
  }

  /** Cuts along a blade of rows * columns points (x, y, z), row by row. */
  public Change cut(double[] blade, int rows, int columns) {
    return cut(DoubleBuffer.wrap(blade), rows, columns);
  }

  /** Takes the environment to positions of its vertices (x, y, z): a copy, which getPoints reads. */
  public DeformReport deform(double[] positions) {
    return deform(DoubleBuffer.wrap(positions));
  }
%}

%typemap(javacode) dartsweep::Scene %{
  /** A scene with features, the sum of FEATURE_ constants. */
  public Scene(Environment environment, int features) {
    this(environment, describe(features));
  }

  private static SceneDesc describe(int features) {
    SceneDesc desc = new SceneDesc();
    desc.setFeatures(features);
    return desc;
  }

  /** Moves all vertices of bodies to targets (x, y, z; body after body), all at once; options may be null. */
  public MoveReportArray moveTogether(BodyIdArray bodies, double[] targets, TogetherOptions options) {
    MoveReportArray reports = new MoveReportArray(bodies.size());
    moveTogether(bodies, DoubleBuffer.wrap(targets), options, reports);
    return reports;
  }

  /** What segments (x, y, z) meet first, of walls and bodies; fills `partners` with the body and part that each met; options may be null. */
  public FlightArray cast(double[] from, double[] to, ContactPartnerArray partners, CastOptions options) {
    FlightArray flights = new FlightArray(partners.size());
    cast(DoubleBuffer.wrap(from), DoubleBuffer.wrap(to), null, options, flights, partners);
    return flights;
  }

  /** What is nearest to points (x, y, z), of walls and bodies; fills `partners` with the body and part that this is. */
  public NearestArray findNearest(double[] points, double radius, ContactPartnerArray partners) {
    NearestArray nearest = new NearestArray(partners.size());
    findNearest(DoubleBuffer.wrap(points), radius, null, nearest, partners);
    return nearest;
  }

  /** Moves bodies, each on a rigid motion of its own, all at once; a motion has 10 numbers: a quaternion x, y, z, w, a centre and a translation; options may be null. */
  public MoveReportArray moveRigid(BodyIdArray bodies, double[] motions, TogetherOptions options) {
    MoveReportArray reports = new MoveReportArray(bodies.size());
    moveRigid(bodies, motions, options, reports);
    return reports;
  }

  /** Moves bodies as moveRigid while the environment goes to positions of its vertices, a copy, all at once; options may be null. */
  public DeformReport deformRigid(double[] positions, BodyIdArray bodies, double[] motions, SceneDeformOptions options) {
    return deformRigid(DoubleBuffer.wrap(positions), bodies, motions, options);
  }

  /** Takes the environment to positions of its vertices, a copy, and bodies to targets, all at once; bodies and targets may be null. */
  public DeformReport deform(double[] positions, BodyIdArray bodies, double[] targets) {
    return deform(DoubleBuffer.wrap(positions), bodies, targets == null ? null : DoubleBuffer.wrap(targets));
  }

  /** A body of vertices (x, y, z) and edges (pairs of indices). */
  public Body createBody(double[] positions, int[] edges) {
    return createBody(DoubleBuffer.wrap(positions), edges, null, null);
  }

  /** A body: `edges` are pairs of indices, `triangles` threes; what there is none of is null, also `desc`. */
  public Body createBody(DoubleBuffer positions, int[] edges, int[] triangles, BodyDesc desc) {
    int[] offsets = null;
    if (triangles != null) {
      offsets = new int[triangles.length / 3 + 1];
      for (int i = 0; i < offsets.length; ++i) offsets[i] = 3 * i;
    }
    return body(createBodyId(positions, edges, offsets, triangles, null, desc));
  }

  /** The body with an id. */
  public Body body(BodyId id) {
    return new Body(this, id);
  }
%}

%typemap(javacode) dartsweep::Body %{
  /** Positions of the vertices by index (x, y, z). */
  public double[] getPositions() {
    double[] positions = new double[dimension() * getCounts().getVertexSlots()];
    getPositions(DoubleBuffer.wrap(positions));
    return positions;
  }

  /** Moves all vertices to targets (x, y, z), one after the other, each as far as it goes; options may be null. */
  public MoveReport move(double[] targets, MoveOptions options) {
    return move(DoubleBuffer.wrap(targets), options);
  }

  /** The rows whose gap is at most a margin, in order of their keys; `flags` is the sum of NEAR_ constants. */
  public NearRowArray findNearRows(double margin, double radius, int flags) {
    NearOptions options = new NearOptions();
    options.setMargin(margin);
    options.setRadius(radius);
    options.setFlags(flags);
    findNearRows(options);
    return getNearRows();
  }

  /** How far the body could go along paths through poses; nothing moves. A pose has 7 numbers: a quaternion x, y, z, w and a translation, from where
   * the body is now, round `centre`. A path has two indices of poses, or those from offsets[i] to offsets[i + 1]; `offsets` may be null. */
  public FreeFractionArray findFreeFractions(double[] centre, double[] poses, int[] indices, int[] offsets) {
    FreeFractionArray fractions = new FreeFractionArray(offsets == null ? indices.length / 2 : offsets.length - 1);
    findFreeFractions(centre, poses, indices, offsets, fractions);
    return fractions;
  }
%}

%pragma(java) modulecode=%{
  /** When each of many pairs first touches. A pair has dimension + 1 points; kinds are those of PairKind, `flags` is the sum of PAIRS_ constants. */
  public static PairTouchArray sweepPairs(int dimension, byte[] kinds, double[] from, double[] to, int flags) {
    PairTouchArray touches = new PairTouchArray(kinds.length);
    sweepPairs(dimension, kinds, java.nio.DoubleBuffer.wrap(from), java.nio.DoubleBuffer.wrap(to), touches, flags);
    return touches;
  }

  /** sweepPairs with features that may turn: 17 numbers for each motion, two indices for each pair, -1 for no motion. `to` may be empty: features without a motion stand. */
  public static PairTouchArray sweepRigidPairs(int dimension, byte[] kinds, double[] from, double[] to, double[] motions, int[] indices, int flags) {
    PairTouchArray touches = new PairTouchArray(kinds.length);
    sweepRigidPairs(dimension, kinds, java.nio.DoubleBuffer.wrap(from), java.nio.DoubleBuffer.wrap(to), motions, indices, touches, flags);
    return touches;
  }
%}

package dartsweep;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** The scenario of bindings/tests/README.md, in Java. */
final class Scenario {
  static final int NX = 6, NY = 6, NZ = 12, LINKS = 12, PARTICLES = 50, SIDE = 10;
  static final double[] INSIDE = {24, 24, 48}, OUTSIDE = {-9, 0, 0};
  private static final int[][] CORNERS = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}
  };

  private final Map<String, List<String>> result = new LinkedHashMap<>();
  private List<String> stage;
  private int seed = 1;

  static Map<String, List<String>> play() {
    Scenario scenario = new Scenario();
    scenario.playAll();
    scenario.deform();
    scenario.plane();
    return scenario.result;
  }

  // --- the result
  private void stage(String name) {
    stage = new ArrayList<>();
    result.put(name, stage);
  }

  private void say(long... values) {
    for (long value : values) stage.add(String.format("%016x", value));
  }

  private void say(double... values) {
    for (double value : values) say(Double.doubleToRawLongBits(value));
  }

  // --- what it is played with
  private double[] draw(int count) {
    double[] points = new double[3 * count];
    for (int i = 0; i < points.length; ++i) {
      seed = (seed * 4093 + 1021) % 65536;
      points[i] = i % 3 == 2 ? 1.5 * (seed / 1024.0) : 4 + 0.625 * (seed / 1024.0);
    }
    return points;
  }

  private double[] drawInPlane(int count) {
    double[] points = new double[2 * count];
    for (int i = 0; i < points.length; ++i) {
      seed = (seed * 4093 + 1021) % 65536;
      points[i] = 11 + 0.90625 * (seed / 1024.0);
    }
    return points;
  }

  private static int at(int i, int j, int k) {
    return (k * (NY + 1) + j) * (NX + 1) + i;
  }

  static double[] points() {
    double[] points = new double[3 * (NX + 1) * (NY + 1) * (NZ + 1)];
    for (int k = 0; k <= NZ; ++k)
      for (int j = 0; j <= NY; ++j)
        for (int i = 0; i <= NX; ++i) {
          int p = 3 * at(i, j, k);
          points[p] = 8 * i + j * k % 3;
          points[p + 1] = 8 * j + i * k % 3;
          points[p + 2] = 8 * k + i * j % 3;
        }
    return points;
  }

  static int[] regions() {
    int[] regions = new int[NX * NY * NZ];
    for (int cell = 0; cell < regions.length; ++cell) {
      int i = cell % NX, j = cell / NX % NY;
      regions[cell] = i > 0 && i < NX - 1 && j > 0 && j < NY - 1 ? 1 : 2;
    }
    return regions;
  }

  static Environment create() {
    int[] cells = new int[8 * NX * NY * NZ];
    for (int c = 0; c < cells.length; ++c) {
      int cell = c / 8;
      int[] corner = CORNERS[c % 8];
      cells[c] = at(cell % NX + corner[0], cell / NX % NY + corner[1], cell / (NX * NY) + corner[2]);
    }
    return new Environment(points(), cells, CellType.HEXAHEDRON, regions());
  }

  static Body createCatheter(Scene scene) {
    double[] positions = new double[3 * LINKS];
    int[] edges = new int[2 * (LINKS - 1)];
    for (int i = 0; i < LINKS; ++i) {
      positions[3 * i] = 24.5;
      positions[3 * i + 1] = 25.25;
      positions[3 * i + 2] = 8.125 + 2.0 * i;
    }
    for (int i = 0; i + 1 < LINKS; ++i) {
      edges[2 * i] = i;
      edges[2 * i + 1] = i + 1;
    }
    return scene.createBody(positions, edges);
  }

  // --- stages, in the order of README.md
  private void playAll() {
    stage("vessel");
    try (Environment environment = create()) {
      EnvironmentInfo info = environment.info();
      Marked marked = environment.markRegion(2, Mark.IMPASSABLE);
      say(info.getVertexCount(), info.getVolumeCount(), info.getFaceCount(), info.getBoundaryFaceCount(), marked.getMarked());
      queries(environment);
      try (Scene scene = new Scene(environment)) {
        double[] centres = new double[3 * PARTICLES];
        int[] regions = regions();
        for (int i = 0, cell = 0; i < PARTICLES; ++cell) {
          if (regions[cell] != 1) continue;
          double[] centre = environment.getCentre(environment.getVolumeId(cell));
          System.arraycopy(centre, 0, centres, 3 * i++, 3);
        }
        ParticleIdArray particles = scene.createParticles(centres);
        stage("particles");
        for (int i = 0; i < 4; ++i) move(scene, particles);
        push(createCatheter(scene));
        snapshots(environment, scene, particles);
        errors(environment, scene, particles);
        cut("cut", environment, new double[] {-5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25}, 2, 2);
      }
    }
  }

  private void sayFlights(FlightArray flights) {
    for (Flight flight : flights) {
      say(flight.getOutcome().swigValue());
      say(flight.getTime());
      say(flight.getPosition());
      say(flight.getContact().getNormal());
      FaceId wall = flight.getContact().getWall();
      say(wall.volume(), wall.local(), flight.getVolumesVisited());
    }
  }

  private void saySweeps(SweepArray sweeps) {
    for (Sweep sweep : sweeps) {
      say(sweep.getOutcome().swigValue());
      say(sweep.getTime());
      say(sweep.getPoint());
      say(sweep.getEdgeParameter());
    }
  }

  private void say(Nearest nearest) {
    say(nearest.getDistance());
    say(nearest.getCell().getKind().swigValue(), nearest.getCell().getIndex());
  }

  private void queries(Environment environment) {
    stage("locate");
    double[] from = draw(64);
    VolumeIdArray volumes = new VolumeIdArray(64);
    int[] locations = new int[64];
    environment.locatePoints(java.nio.DoubleBuffer.wrap(from), null, volumes, locations);
    for (int i = 0; i < 64; ++i) say(locations[i], volumes.get(i).index(), volumes.get(i).generation());

    stage("cast");
    double[] to = draw(64);
    sayFlights(environment.castSegments(from, to));

    stage("sweep");
    double[] fixed = draw(16);
    double[] some = java.util.Arrays.copyOf(from, 48), targets = java.util.Arrays.copyOf(to, 48);
    saySweeps(environment.sweepEdges(some, targets, fixed));

    stage("nearest");
    for (int i = 0; i < 64; ++i) {
      if (locations[i] != Location.PASSABLE.swigValue()) continue;
      double[] point = java.util.Arrays.copyOfRange(from, 3 * i, 3 * i + 3);
      say(environment.findNearest(point, 20.0, volumes.get(i)));
    }
  }

  private void move(Scene scene, ParticleIdArray particles) {
    for (Flight flight : scene.moveParticles(particles, draw(PARTICLES))) {
      say(flight.getOutcome().swigValue());
      say(flight.getTime());
      say(flight.getPosition());
    }
  }

  private void push(Body body) {
    double[] way = new double[3 * LINKS];
    for (int i = 0; i < LINKS; ++i) {
      way[3 * i] = 1.75;
      way[3 * i + 1] = -0.5 * (i % 3);
      way[3 * i + 2] = 3.0;
    }
    push("catheter", body, way);
    sayContacts("contacts", body.getContacts());
  }

  private void push(String name, Body body, double[] way) {
    stage(name);
    MoveOptions slide = new MoveOptions();
    slide.setVertexResponse(Response.SLIDE);
    slide.setEdgeResponse(Response.SLIDE);
    for (int step = 0; step < 10; ++step) {
      double[] positions = body.getPositions();
      for (int i = 0; i < way.length; ++i) positions[i] += way[i];
      MoveReport report = body.move(positions, slide);
      say(report.getVerticesStopped(), report.getContactCount());
      say(body.getPositions());
    }

  }

  private void sayContacts(String name, BodyContactArray contacts) {
    stage(name);
    say(contacts.size());
    for (BodyContact contact : contacts) {
      say(contact.getVertex().index(), contact.getContact().getKind().swigValue());
      say(contact.getTime());
      say(contact.getPoint());
      say(contact.getContact().getNormal());
      say(contact.getContact().getWall().volume());
    }
  }

  private void sayBlock(byte[] block) {
    long sum = 0;
    for (byte each : block) sum += Byte.toUnsignedInt(each);
    say(block.length, sum);
  }

  private void snapshots(Environment environment, Scene scene, ParticleIdArray particles) {
    stage("snapshot");
    byte[] block = environment.save(), sceneBlock = scene.save();
    sayBlock(block);
    sayBlock(sceneBlock);
    try (Environment other = Environment.load(block);
        Scene copy = Scene.load(other, sceneBlock)) {
      move(copy, particles);
    }

    stage("damaged");
    say(statusOf(() -> Environment.load(java.util.Arrays.copyOf(block, block.length / 2))));
    byte[] flipped = block.clone();
    flipped[block.length / 2] ^= 1;
    say(statusOf(() -> Environment.load(flipped)));
  }

  private static long statusOf(Runnable call) {
    try {
      call.run();
      return Status.OK.swigValue();
    } catch (DartsweepException error) {
      return error.status().swigValue();
    }
  }

  private void errors(Environment environment, Scene scene, ParticleIdArray particles) {
    stage("errors");
    say(statusOf(() -> environment.cast(new double[] {0, Double.NaN, 0}, INSIDE)));
    say(statusOf(() -> environment.cast(INSIDE, OUTSIDE, new VolumeId(3, 7))));
    say(statusOf(() -> environment.getVolumeId(NX * NY * NZ)));
    say(statusOf(() -> scene.createParticle(OUTSIDE)));
    say(statusOf(() -> scene.createParticle(new double[] {4, 4, 4})));
    ParticleIdArray twice = ParticleIdArray.of(particles.get(0), particles.get(0));
    say(statusOf(() -> scene.moveParticles(twice, new double[] {24, 24, 48, 24, 24, 48})));
    ParticleId particle = scene.createParticle(INSIDE);
    VolumeIdArray occupied = VolumeIdArray.of(scene.getParticlePosition(particle).getVolume());
    say(statusOf(() -> environment.markVolumes(occupied, Mark.IMPASSABLE)));
    scene.destroyParticle(particle);
    say(statusOf(() -> scene.destroyParticle(particle)));
    say(statusOf(scene::resetStatistics));
    say(statusOf(() -> new Environment(points(), new int[] {0, 1, 7, 7}, CellType.TETRA, null)));
  }

  private void cut(String name, Environment environment, double[] blade, int rows, int columns) {
    stage(name);
    Change change = environment.cut(blade, rows, columns);
    say(change.getDistance());
    say(change.getVolumesSplit(), change.getFaces().size(), environment.info().getVolumeCount());
    for (VertexOrigin vertex : change.getVertices()) {
      say(vertex.getVertex().index());
      say(vertex.getWeights()[0]);
    }
  }

  private void deform() {
    stage("deform");
    try (Environment environment = create()) {
      environment.markRegion(2, Mark.IMPASSABLE);
      try (Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
        Body body = createCatheter(scene);
        double[] next = environment.getPoints();
        for (int i = 0; i < next.length; i += 3) next[i] += (48 - next[i]) * 0.4375;
        say(environment.deform(next), body);
      }
    }
  }

  private void say(DeformReport report, Body body) {
    say(report.getOutcome().swigValue(), report.getHeldCount(), report.getContactCount(), report.getPushedCount());
    say(body.getPositions());
  }

  /** Squares whose corners have moved, half of them cut into two triangles. */
  static Environment createPlane() {
    double[] points = new double[2 * (SIDE + 1) * (SIDE + 1)];
    for (int p = 0; p < points.length / 2; ++p) {
      int i = p % (SIDE + 1), j = p / (SIDE + 1);
      points[2 * p] = 8 * i + i * j % 3;
      points[2 * p + 1] = 8 * j + (i + 2 * j) % 3;
    }
    int[] corners = new int[SIDE * SIDE * 5], offsets = new int[SIDE * SIDE * 3 / 2 + 1], regions = new int[offsets.length - 1];
    byte[] types = new byte[regions.length];
    for (int square = 0, cell = 0; square < SIDE * SIDE; ++square) {
      int i = square % SIDE, j = square / SIDE, a = j * (SIDE + 1) + i, d = a + SIDE + 1;
      boolean quad = (i + j) % 2 == 0;
      int[][] cells = quad ? new int[][] {{a, a + 1, d + 1, d}} : new int[][] {{a, a + 1, d + 1}, {a, d + 1, d}};
      for (int[] each : cells) {
        System.arraycopy(each, 0, corners, offsets[cell], each.length);
        types[cell] = (byte) (quad ? CellType.QUAD : CellType.TRIANGLE).swigValue();
        regions[cell] = i > 0 && i < SIDE - 1 && j > 0 && j < SIDE - 1 ? 1 : 2;
        offsets[cell + 1] = offsets[cell] + each.length;
        ++cell;
      }
    }
    corners = java.util.Arrays.copyOf(corners, offsets[offsets.length - 1]);
    EnvironmentDesc desc = new EnvironmentDesc();
    desc.setDimension(2);
    return new Environment(java.nio.DoubleBuffer.wrap(points), corners, offsets, types, regions, null, null, null, desc, null);
  }

  private void plane() {
    stage("plane");
    try (Environment environment = createPlane()) {
      EnvironmentInfo info = environment.info();
      Marked marked = environment.markRegion(2, Mark.IMPASSABLE);
      environment.markVertices(VertexIdArray.of(environment.getVertexId(5 * (SIDE + 1) + 5)), Mark.IMPASSABLE);
      say(info.getDimension(), info.getVertexCount(), info.getVolumeCount(), info.getFaceCount(), info.getBoundaryFaceCount(), marked.getMarked());

      stage("plane locate");
      seed = 1;
      double[] from = drawInPlane(32);
      VolumeIdArray volumes = new VolumeIdArray(32);
      int[] locations = new int[32];
      environment.locatePoints(java.nio.DoubleBuffer.wrap(from), null, volumes, locations);
      for (int i = 0; i < 32; ++i) {
        say(locations[i], volumes.get(i).index(), volumes.get(i).generation());
        double[] point = {from[2 * i], from[2 * i + 1]};
        if (locations[i] == Location.PASSABLE.swigValue()) say(environment.findNearest(point, 20.0, volumes.get(i)));
      }

      stage("plane cast");
      double[] to = drawInPlane(32);
      for (int i = 0; i < to.length; i += 4) to[i] += 40;
      sayFlights(environment.castSegments(from, to));

      stage("plane sweep");
      saySweeps(environment.sweepEdges(java.util.Arrays.copyOf(from, 32), java.util.Arrays.copyOf(to, 32), drawInPlane(16)));

      try (Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
        stage("plane particles");
        ParticleIdArray particles = scene.createParticles(from);
        scene.moveParticles(particles, to);
        double[] reached = new double[from.length];
        scene.getParticlePositions(particles, java.nio.DoubleBuffer.wrap(reached));
        say(reached);
        double[] positions = new double[2 * LINKS], way = new double[2 * LINKS];
        int[] edges = new int[2 * (LINKS - 1)];
        for (int i = 0; i < LINKS; ++i) {
          positions[2 * i] = 20.25 + 3.0 * i;
          positions[2 * i + 1] = 40.5;
          way[2 * i] = 1.5;
          way[2 * i + 1] = 4.0 - 0.75 * (i % 3);
        }
        for (int i = 0; i < edges.length; ++i) edges[i] = i / 2 + i % 2;
        Body rope = scene.createBody(positions, edges);
        push("rope", rope, way);
        sayContacts("rope contacts", rope.getContacts());
        stage("plane snapshot");
        sayBlock(environment.save());
        sayBlock(scene.save());

        stage("plane deform");
        double[] points = environment.getPoints(), bent = java.util.Arrays.copyOf(points, points.length + 2 * 64);
        for (int i = 1; i < points.length; i += 2) bent[i] += (40 - bent[i]) * 0.125;
        say(environment.deform(bent), rope);
        cut("plane cut", environment, new double[] {20, 20.5, 60.25, 41.25}, 2, 1);
      }
    }
  }
}

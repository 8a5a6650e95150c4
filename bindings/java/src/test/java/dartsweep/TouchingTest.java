package dartsweep;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertFalse;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.nio.DoubleBuffer;
import org.junit.jupiter.api.Test;

/** Parts of a mesh that lie on each other: counted, and sewn. */
class TouchingTest {
  private static final double[][] CORNERS = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}
  };

  /** Cubes with points of their own; each is x, y, z and a width. */
  private static Environment create(int flags, double distance, double[]... cubes) {
    double[] points = new double[24 * cubes.length];
    int[] cells = new int[8 * cubes.length];
    for (int i = 0; i < cells.length; ++i) {
      double[] cube = cubes[i / 8];
      for (int k = 0; k < 3; ++k) points[3 * i + k] = cube[k] + cube[3] * CORNERS[i % 8][k];
      cells[i] = i;
    }
    EnvironmentDesc desc = new EnvironmentDesc();
    desc.setFlags(flags);
    desc.setMergeDistance(distance);
    return new Environment(DoubleBuffer.wrap(points), cells, null, null, null, null, null, null, desc, null);
  }

  private static final double[][] ONE_BESIDE_FOUR = {
    {0, 0, 0, 1}, {1, 0, 0, 0.5}, {1, 0.5, 0, 0.5}, {1, 0, 0.5, 0.5}, {1, 0.5, 0.5, 0.5}
  };

  @Test
  void particlesAndVerticesLeave() {
    try (Environment environment = create(0, 0, new double[] {0, 0, 0, 1});
        Scene scene = new Scene(environment)) {
      FaceId top = environment.cast(new double[] {0.5, 0.5, 0.5}, new double[] {0.5, 0.5, 3}).getContact().getWall();
      FaceIdArray faces = new FaceIdArray(1);
      faces.set(0, top);
      environment.markExits(faces, 6);
      assertEquals(6, environment.getExit(top));
      assertEquals(1, environment.getExitFaces().size());
      CastOptions leave = new CastOptions();
      leave.setFlags(Dartsweep.CAST_LEAVE);
      ParticleId particle = scene.createParticle(new double[] {0.25, 0.25, 0.5});
      assertEquals(Outcome.EXIT, scene.moveParticle(particle, new double[] {0.25, 0.25, 2.5}, leave).getOutcome());
      assertEquals(0, scene.getParticleCount());
      assertEquals(1, scene.getExits().size());
      assertEquals(6, scene.getExits().get(0).getPatch());
      assertEquals(0.25, scene.getExits().get(0).getTime());
      double[] rod = {0.25, 0.5, 0.25, 0.25, 0.5, 0.75};
      Body body = scene.createBody(DoubleBuffer.wrap(rod), new int[] {0, 1}, null, new BodyDesc());
      MoveOptions away = new MoveOptions();
      away.setFlags(Dartsweep.MOVE_LEAVE);
      body.move(DoubleBuffer.wrap(new double[] {0.25, 0.5, 0.75, 0.25, 0.5, 1.25}), away);
      assertEquals(1, body.getExits().get(0).getVertex().index());
    }
  }

  @Test
  void bodiesThatPenetrateAreFreed() {
    try (Environment environment = create(0, 0, new double[] {0, 0, 0, 1});
        Scene scene = new Scene(environment)) {
      double[] line = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5, 1.25, 0.5, 0.5};
      int[] edges = {0, 1, 1, 2};
      BodyDesc desc = new BodyDesc();
      assertThrows(DartsweepException.Outside.class, () -> scene.createBody(DoubleBuffer.wrap(line), edges, null, desc));
      desc.setFlags(Dartsweep.BODY_START_PENETRATING);
      Body wire = scene.createBody(DoubleBuffer.wrap(line), edges, null, desc);
      assertTrue(wire.isPenetrating());
      assertEquals(1, wire.findPenetrations().size());
      assertEquals(1, wire.findPenetrations().get(0).getPart().getEdge().index());
      assertThrows(DartsweepException.Occupied.class, () -> wire.move(DoubleBuffer.wrap(line)));
      assertFalse(wire.depenetrate(new VolumeId(0, 0), 0.125).getFreed());
      Depenetration made = wire.depenetrate();
      assertTrue(made.getFreed());
      assertEquals(0.3, made.getDistance(), 0.2);
      assertFalse(wire.isPenetrating());
    }
  }

  @Test
  void threadsAreCut() {
    try (Environment environment = create(0, 0, new double[] {0, 0, 0, 1});
        Scene scene = new Scene(environment)) {
      double[] line = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5};
      Body thread = scene.createBody(DoubleBuffer.wrap(line), new int[] {0, 1}, null, new BodyDesc());
      DoubleBuffer blade = DoubleBuffer.wrap(new double[] {0.375, 0, 0, 0.375, 0, 1, 0.375, 1, 0, 0.375, 1, 1});
      assertEquals(1, scene.cutBodies(blade, 2, 2));
      assertEquals(0.25, scene.getBodyCuts().get(0).getEdgeParameter());
      assertEquals(thread.id().index(), scene.getBodyCuts().get(0).getBody().index());
      assertEquals(0, scene.cutBodies(blade, 2, 2));
      assertEquals(2, thread.getCounts().getEdgeCount());
      assertThrows(DartsweepException.WrongSize.class, () -> scene.cutBodies(blade, 2, 3));
    }
  }

  @Test
  void raysMeetBodies() {
    try (Environment environment = create(0, 0, new double[] {0, 0, 0, 1});
        Scene scene = new Scene(environment, Dartsweep.FEATURE_BODY_CONTACTS)) {
      double[] corners = {0.25, 0.25, 0.5, 0.75, 0.25, 0.5, 0.25, 0.75, 0.5};
      BodyDesc desc = new BodyDesc();
      desc.setLevel(Level.FACES);
      Body leaf = scene.createBody(DoubleBuffer.wrap(corners), null, new int[] {0, 1, 2}, desc);
      ContactPartnerArray partners = new ContactPartnerArray(2);
      FlightArray flights = scene.cast(new double[] {0.3, 0.3, 0.75, 0.9, 0.9, 0.75}, new double[] {0.3, 0.3, 0.25, 0.9, 0.9, 0.25}, partners, null);
      assertEquals(0.5, flights.get(0).getTime());
      assertEquals(leaf.id().index(), partners.get(0).getBody().index());
      assertEquals(Outcome.REACHED, flights.get(1).getOutcome());
      ContactPartnerArray near = new ContactPartnerArray(1);
      assertEquals(0.125, scene.findNearest(new double[] {0.3, 0.3, 0.625}, 1, near).get(0).getDistance());
      assertEquals(1, near.get(0).getFace().generation());
      double[] distances = new double[2];
      environment.findSignedDistances(DoubleBuffer.wrap(new double[] {0.5, 0.5, 0.75, 0.5, 0.5, 3}), distances, null);
      assertEquals(-0.25, distances[0]);
      assertEquals(2, distances[1]);
      CastOptions open = new CastOptions();
      open.setFlags(Dartsweep.CAST_OPEN_ENDS);
      assertEquals(Outcome.REACHED, scene.cast(new double[] {0, 0.5, 0.75}, new double[] {1, 0.5, 0.75}, near, open).get(0).getOutcome());
    }
  }

  @Test
  void facesThatTouchAreCounted() {
    try (Environment environment = create(Dartsweep.ENVIRONMENT_FIND_TOUCHING, 0, ONE_BESIDE_FOUR)) {
      BuildReport report = environment.buildReport();
      assertEquals(13, report.getTouchingFaceCount());
      assertEquals(0, report.getTouchingFace().volume());
      assertEquals(1, report.getTouchedFace().volume());
    }
  }

  @Test
  void aFaceIsSplitByThoseThatCoverIt() {
    int flags = Dartsweep.ENVIRONMENT_CONFORM | Dartsweep.ENVIRONMENT_FIND_TOUCHING;
    try (Environment environment = create(flags, 0, ONE_BESIDE_FOUR)) {
      BuildReport report = environment.buildReport();
      assertEquals(1, report.getPartCount());
      assertEquals(1, report.getChangedCount());
      assertEquals(0, report.getTouchingFaceCount());
      assertEquals(Outcome.REACHED, environment.cast(new double[] {0.25, 0.5, 0.5}, new double[] {1.375, 0.375, 0.25}).getOutcome());
    }
  }

  @Test
  void pointsAreMergedWithinADistance() {
    double[][] cubes = {{0, 0, 0, 1}, {1 + 1e-10, 0, 0, 1}};
    try (Environment environment = create(Dartsweep.ENVIRONMENT_MERGE_POINTS, 1e-9, cubes)) {
      assertEquals(4, environment.buildReport().getMergedPointCount());
      assertEquals(1, environment.buildReport().getPartCount());
    }
    assertThrows(DartsweepException.OutOfRange.class, () -> create(0, 1e-9, cubes));
  }

  @Test
  void facesThatCrossAreRefused() {
    double[][] cubes = {{0, 0, 0, 1}, {1, 0.25, 0.25, 1}};
    assertThrows(DartsweepException.NotConforming.class, () -> create(Dartsweep.ENVIRONMENT_CONFORM, 0, cubes));
  }
}

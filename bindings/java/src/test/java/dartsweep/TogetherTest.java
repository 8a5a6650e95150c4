package dartsweep;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.nio.DoubleBuffer;
import org.junit.jupiter.api.Test;

class TogetherTest {
  private static final int FEATURES = Dartsweep.FEATURE_BODY_CONTACTS | Dartsweep.FEATURE_DEFORMING;
  private static final int[] EDGES = {0, 1, 1, 2};

  /** One hexahedron with its floor at a height. */
  private static double[] room(double height) {
    return new double[] {0, 0, height, 4, 0, height, 4, 4, height, 0, 4, height, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4};
  }

  private static Environment makeRoom() {
    return new Environment(room(0), new int[] {0, 1, 2, 3, 4, 5, 6, 7}, CellType.HEXAHEDRON, null);
  }

  private static double[] strand(double x, double z) {
    return new double[] {x, 1, z, x, 2, z, x, 3, z};
  }

  private static double[] strands(double x, double other) {
    double[] both = new double[18];
    System.arraycopy(strand(x, 1), 0, both, 0, 9);
    System.arraycopy(strand(other, 1), 0, both, 9, 9);
    return both;
  }

  private static BodyIdArray idsOf(Body... bodies) {
    BodyIdArray ids = new BodyIdArray(bodies.length);
    for (int i = 0; i < bodies.length; ++i) ids.set(i, bodies[i].id());
    return ids;
  }

  /** Around once, into a wall, and from a pose that is not free. */
  @Test
  void freeFractionsMoveNothing() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, 0)) {
      Body bar = scene.createBody(new double[] {1, 2, 2, 3, 2, 2}, new int[] {0, 1});
      double[] centre = {2, 2, 2}, poses = {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 4, 0, 0};
      FreeFractionArray found = bar.findFreeFractions(centre, poses, new int[] {0, 1, 0, 0, 2, 2}, new int[] {0, 3, 5, 6});
      assertEquals(1, found.get(0).getFraction());
      assertEquals(2, found.get(0).getPiece());
      assertEquals(0.25, found.get(1).getFraction(), 1e-12);
      assertEquals(0, found.get(2).getStartsFree());
      BodyContactArray contacts = new BodyContactArray(1);
      bar.findFreeFractions(centre, poses, new int[] {0, 2}, null, found = new FreeFractionArray(1), contacts);
      assertEquals(found.get(0).getPieceFraction(), contacts.get(0).getTime(), 1e-12);
      assertArrayEquals(new double[] {1, 2, 2, 3, 2, 2}, bar.getPositions());
      assertThrows(DartsweepException.WrongSize.class, () -> bar.findFreeFractions(centre, new double[6], new int[] {0, 0}, null));
    }
  }

  @Test
  void aBarSlidesAlongAWall() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, 0)) {
      Body bar = scene.createBody(new double[] {1, 2, 2, 3, 2, 2}, new int[] {0, 1});
      RigidMotion motion = new RigidMotion();
      motion.setRotation(new double[] {0, 0, 0, 1});
      motion.setTranslation(new double[] {4, 1, 0});
      MoveOptions options = new MoveOptions();
      options.setFlags(Dartsweep.MOVE_SLIDE_WHOLE);
      assertEquals(0.25, bar.moveRigid(motion, options).getFraction(), 1e-12);
      assertArrayEquals(new double[] {2, 3, 2, 4, 3, 2}, bar.getPositions(), 1e-9);
      assertEquals(3, bar.getMotionLeft().getTranslation()[0], 1e-9);
    }
  }

  @Test
  void rigidBodiesMoveAtOnce() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body left = scene.createBody(new double[] {0.5, 2, 2, 1, 2, 2}, new int[] {0, 1});
      Body right = scene.createBody(new double[] {3, 2, 2, 3.5, 2, 2}, new int[] {0, 1});
      double[] motions = {0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0};
      MoveReportArray reports = scene.moveRigid(idsOf(left, right), motions, null);
      assertEquals(0.25, reports.get(0).getFraction(), 1e-12);
      assertEquals(reports.get(0).getFraction(), reports.get(1).getFraction());
    }
  }

  @Test
  void thickRigidBodiesKeepTheirDistanceAtOnce() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      BodyDesc desc = new BodyDesc();
      desc.setRadius(0.125);
      Body left = scene.createBody(DoubleBuffer.wrap(new double[] {0.5, 2, 2, 1, 2, 2}), new int[] {0, 1}, null, desc);
      Body right = scene.createBody(DoubleBuffer.wrap(new double[] {3, 2, 2, 3.5, 2, 2}), new int[] {0, 1}, null, desc);
      double[] motions = {0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0};
      MoveReportArray reports = scene.moveRigid(idsOf(left, right), motions, null);
      assertEquals(0.21875, reports.get(0).getFraction(), 1e-9);
      assertEquals(reports.get(0).getFraction(), reports.get(1).getFraction());
    }
  }

  @Test
  void aBarTurnsWhileTheFloorRises() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body bar = scene.createBody(new double[] {1, 2, 2, 3, 2, 2}, new int[] {0, 1});
      double half = Math.sqrt(0.5);
      double[] motion = {0, 0, half, half, 2, 2, 2, 0, 0, 0};
      DeformReport report = scene.deformRigid(room(3), idsOf(bar), motion, null);
      assertEquals(DeformOutcome.FRACTION, report.getOutcome());
      assertEquals(2.0 / 3, report.getFraction(), 1e-9);
      assertEquals(2.0 / 3, environment.getWallContacts().get(0).getTime(), 1e-12);
      assertThrows(DartsweepException.WrongSize.class, () -> scene.deformRigid(room(3), idsOf(bar), new double[4], null));
    }
  }

  @Test
  void strandsDoNotStopEachOther() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body left = scene.createBody(strand(1, 1), EDGES), right = scene.createBody(strand(1.25, 1), EDGES);
      BodyIdArray both = idsOf(left, right);
      MoveReportArray reports = scene.moveTogether(both, strands(2, 2.25), null);
      assertEquals(1, reports.get(0).getFraction());
      assertEquals(1, reports.get(1).getFraction());
      assertArrayEquals(strand(2, 1), left.getPositions());
      TogetherOptions options = new TogetherOptions();
      options.setStop(TogetherStop.FEATURE);
      options.setMaxRounds(4);
      reports = scene.moveTogether(both, strands(3, 5), options);
      assertEquals(0, reports.get(0).getVerticesStopped());
      assertEquals(3, reports.get(1).getVerticesStopped());
      assertArrayEquals(strand(3, 1), left.getPositions());
      // One vertex at a time the left strand runs into the right one.
      scene.moveTogether(both, strands(1, 1.25), null);
      scene.moveBodies(both, DoubleBuffer.wrap(strands(2, 2.25)), null, reports);
      assertEquals(3, reports.get(0).getVerticesStopped());
      assertEquals(0, reports.get(1).getVerticesStopped());
    }
  }

  @Test
  void howMuchOfStepsIsFree() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body body = scene.createBody(strand(1, 1), EDGES);
      DoubleBuffer steps = DoubleBuffer.wrap(new double[] {4, 0, 0, 4, 0, 0, 4, 0, 0}), places = DoubleBuffer.wrap(new double[9]);
      double fraction = scene.stepFraction(idsOf(body), steps, null, places);
      assertTrue(fraction < 0.75 && fraction > 0.7499999);
      assertEquals(1 + 4 * fraction, places.get(0));
      assertArrayEquals(strand(1, 1), body.getPositions());
    }
  }

  @Test
  void theFloorStopsBeforeAStrand() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body body = scene.createBody(strand(2, 1), EDGES);
      DeformReport report = scene.deform(room(2), null, null);
      assertEquals(DeformOutcome.FRACTION, report.getOutcome());
      assertTrue(report.getFraction() < 0.5 && report.getFraction() > 0.4999999);
      WallContactArray contacts = environment.getWallContacts();
      assertTrue(contacts.size() > 0);
      assertEquals(report.getContactCount(), contacts.size());
      assertEquals(0.5, contacts.get(0).getTime());
      assertEquals(body.id(), contacts.get(0).getBody());
      assertArrayEquals(strand(2, 1), body.getPositions());
    }
  }

  @Test
  void aStrandRisesWithTheFloor() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body body = scene.createBody(strand(2, 1), EDGES);
      MoveReportArray reports = new MoveReportArray(1);
      DeformReport report = scene.deform(DoubleBuffer.wrap(room(1.5)), idsOf(body), DoubleBuffer.wrap(strand(2, 2)), null, reports);
      assertEquals(DeformOutcome.DONE, report.getOutcome());
      assertEquals(1, reports.get(0).getFraction());
      assertArrayEquals(strand(2, 2), body.getPositions());
    }
  }

  @Test
  void atTheWorkLimitNothingMoves() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body body = scene.createBody(strand(2, 1), EDGES);
      MoveReportArray reports = new MoveReportArray(1);
      DoubleBuffer side = DoubleBuffer.wrap(strand(Double.MIN_VALUE, 1)); // integers are long beside it
      SceneDeformOptions options = new SceneDeformOptions();
      options.setMaxWork(1);
      DeformReport report = scene.deform(DoubleBuffer.wrap(room(2)), idsOf(body), side, options, reports);
      assertEquals(DeformOutcome.LIMITED, report.getOutcome());
      assertEquals(3, reports.get(0).getVerticesLimited());
      assertArrayEquals(strand(2, 1), body.getPositions());
      report = scene.deform(DoubleBuffer.wrap(room(2)), idsOf(body), side, null, reports);
      assertEquals(DeformOutcome.FRACTION, report.getOutcome());
      assertEquals(0, reports.get(0).getVerticesLimited());
    }
  }

  @Test
  void onlyThePartsThatTouchStop() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body body = scene.createBody(strand(2, 1), EDGES);
      MoveReportArray reports = new MoveReportArray(1);
      SceneDeformOptions options = new SceneDeformOptions();
      options.setStop(TogetherStop.FEATURE);
      DeformReport report = scene.deform(DoubleBuffer.wrap(room(2)), idsOf(body), DoubleBuffer.wrap(strand(2, 1)), options, reports);
      assertEquals(DeformOutcome.HELD, report.getOutcome());
      assertEquals(0.5, reports.get(0).getFraction());
      assertEquals(9, body.getWaysLeft().length);
    }
  }

  @Test
  void whatIsWrongIsRefused() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, FEATURES)) {
      Body body = scene.createBody(strand(2, 1), EDGES);
      BodyIdArray one = idsOf(body), twice = idsOf(body, body), stale = new BodyIdArray(1);
      stale.set(0, new BodyId(5, 1));
      double[] few = {2, 1, 1}, same = strands(2, 2), wrong = strand(Double.NaN, 1), good = strand(2, 1);
      assertThrows(DartsweepException.WrongSize.class, () -> scene.moveTogether(one, few, null));
      assertThrows(DartsweepException.DuplicateId.class, () -> scene.moveTogether(twice, same, null));
      assertThrows(DartsweepException.StaleId.class, () -> scene.moveTogether(stale, good, null));
      assertThrows(DartsweepException.NonFinite.class, () -> scene.moveTogether(one, wrong, null));
      assertThrows(DartsweepException.WrongSize.class, () -> scene.deform(room(1), one, few));
      assertThrows(DartsweepException.DuplicateId.class, () -> scene.deform(room(1), twice, same));
      assertThrows(DartsweepException.NonFinite.class, () -> scene.deform(room(1), one, wrong));
      assertThrows(DartsweepException.WrongSize.class, () -> scene.deform(good, null, null));
      try (Environment other = makeRoom(); Scene plain = new Scene(other, 0)) {
        assertThrows(DartsweepException.NotEnabled.class, () -> plain.deform(room(1), null, null));
      }
    }
  }

  @Test
  void backEdgesThatAreLeftAreListed() {
    double[] corners = {1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 1, 2}, inwards = {1, 1, 1, 2, 1, 1, 1, 2, 1, 1.1, 1.1, 1.7};
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, 0)) {
      BodyDesc desc = new BodyDesc();
      desc.setLevel(Level.EDGES);
      desc.setFlags(Dartsweep.BODY_SKIP_BACK_EDGES | Dartsweep.BODY_LEAVE_BACK_EDGES);
      Body body = scene.createBody(DoubleBuffer.wrap(corners), null, new int[] {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, desc);
      assertEquals(0, body.getUntestedEdges().size());
      body.move(inwards, null);
      assertEquals(3, body.getUntestedEdges().size());
      body.move(corners, null);
      assertEquals(0, body.getUntestedEdges().size());
    }
  }

  @Test
  void aParticleHasAState() {
    try (Environment environment = makeRoom(); Scene scene = new Scene(environment, 0)) {
      ParticleId particle = scene.createParticle(new double[] {2, 2, 2});
      assertEquals(CellKind.VOLUME, scene.getParticleCell(particle).getKind());
      assertEquals(CellKind.NONE, scene.getParticleAim(particle).getKind());
      scene.moveParticle(particle, new double[] {2, 2, 9});
      assertEquals(CellKind.FACE, scene.getParticleAim(particle).getKind());
    }
  }
}

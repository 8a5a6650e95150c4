package dartsweep;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertNull;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.lang.ref.WeakReference;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.ReadOnlyBufferException;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.function.Executable;

class OwnershipTest {
  private static DoubleBuffer direct(double... numbers) {
    DoubleBuffer buffer = ByteBuffer.allocateDirect(8 * numbers.length).order(ByteOrder.nativeOrder()).asDoubleBuffer();
    return buffer.put(numbers).flip();
  }

  @Test
  void closingTwiceIsFine() {
    Environment environment = Scenario.create();
    Scene scene = new Scene(environment);
    scene.close();
    scene.close();
    environment.close();
    environment.close();
    assertTrue(scene.isClosed() && environment.isClosed());
  }

  @Test
  void useAfterCloseIsAnException() {
    Environment environment = Scenario.create();
    Scene scene = new Scene(environment);
    Body body = Scenario.createCatheter(scene);
    ParticleId particle = scene.createParticle(Scenario.INSIDE);
    scene.close();
    List<Executable> calls = List.of(body::getPositions, () -> body.move(new double[36], null), scene::save,
        () -> scene.moveParticle(particle, Scenario.INSIDE), () -> scene.createParticle(Scenario.INSIDE));
    for (Executable call : calls)
      assertEquals("the scene is closed", assertThrows(DartsweepException.Closed.class, call).getMessage());
    environment.close();
    calls = List.of(environment::save, () -> environment.cast(Scenario.INSIDE, Scenario.INSIDE), () -> new Scene(environment));
    for (Executable call : calls)
      assertEquals("the environment is closed", assertThrows(DartsweepException.Closed.class, call).getMessage());
  }

  @Test
  void aSceneKeepsItsEnvironment() throws InterruptedException {
    Environment environment = Scenario.create();
    Scene scene = new Scene(environment);
    environment.close();
    collect(new WeakReference<>(environment), environment = null);
    Flight flight = scene.moveParticle(scene.createParticle(Scenario.INSIDE), new double[] {24, 24, 50});
    assertEquals(Outcome.REACHED, flight.getOutcome());
    scene.close();
  }

  private static void collect(WeakReference<?> gone, Object none) throws InterruptedException {
    for (int i = 0; i < 100 && gone.get() != null; ++i) {
      System.gc();
      Thread.sleep(10);
    }
    assertNull(gone.get());
    assertNull(none);
  }

  @Test
  void aBodyKeepsItsSceneAndCanBeDestroyed() throws InterruptedException {
    Environment environment = Scenario.create();
    Scene scene = new Scene(environment);
    Body body = Scenario.createCatheter(scene);
    collect(new WeakReference<>(scene), scene = null);
    assertEquals(36, body.getPositions().length);
    body.destroy();
    assertThrows(DartsweepException.StaleId.class, body::destroy);
    assertThrows(DartsweepException.StaleId.class, body::getPositions);
  }

  @Test
  void whatIsForgottenIsGivenBack() throws InterruptedException {
    // A scene that is open makes marking a second one's environment fail: the collector closes the forgotten one.
    try (Environment environment = Scenario.create()) {
      forget(environment);
      for (int i = 0; i < 100; ++i) {
        System.gc();
        Thread.sleep(10);
        try {
          environment.markRegion(1, Mark.IMPASSABLE);
          return;
        } catch (DartsweepException.Shared notYet) {
          assertTrue(i < 99, "two scenes are still there");
        }
      }
    }
  }

  private static void forget(Environment environment) {
    Scene first = new Scene(environment), second = new Scene(environment);
    assertThrows(DartsweepException.Shared.class, () -> environment.markRegion(1, Mark.IMPASSABLE));
    assertTrue(!first.isClosed() && !second.isClosed());
  }

  @Test
  void anElementKeepsItsList() throws InterruptedException {
    try (Environment environment = Scenario.create()) {
      FlightArray flights = environment.castSegments(Scenario.INSIDE, Scenario.OUTSIDE);
      WeakReference<FlightArray> list = new WeakReference<>(flights);
      Flight flight = flights.get(0);
      double time = flight.getTime();
      flights = null;
      for (int i = 0; i < 5; ++i) System.gc();
      assertTrue(list.get() != null);
      assertEquals(time, flight.getTime());
    }
  }

  @Test
  void placesInsideAreFound() {
    try (Environment environment = Scenario.create()) {
      double[] places = environment.findInside(new double[] {24, 24, 900, 24, 24, 48}, 0.5);
      assertEquals(48, places[5]);
      assertTrue(environment.findNearestToPoints(places, 20).get(0).getDistance() > 0);
    }
  }

  @Test
  void whatIsNearestToPointsAndSegmentsIsFound() {
    try (Environment environment = Scenario.create()) {
      double[] from = {24, 24, 48, 25, 25, 50}, to = {24, 24, 50, 25, 27, 50};
      NearestArray points = environment.findNearestToPoints(from, 20);
      SegmentNearestArray segments = environment.findNearestToSegments(from, to, 20);
      VolumeIdArray volumes = new VolumeIdArray(2);
      SegmentNearestArray again = new SegmentNearestArray(2);
      environment.findNearestToSegments(direct(from), direct(to), 20, null, again, volumes);
      for (int i = 0; i < 2; ++i) {
        SegmentNearest segment = segments.get(i);
        assertTrue(segment.getNearest().getDistance() <= points.get(i).getDistance());
        assertTrue(segment.getSegmentParameter() >= 0 && segment.getSegmentParameter() <= 1);
        assertEquals(segment.getNearest().getDistance(), again.get(i).getNearest().getDistance());
        assertTrue(!volumes.get(i).isNull());
      }
    }
  }

  @Test
  void directBuffersArraysAndPartsOfThemAreAlike() {
    try (Environment environment = Scenario.create()) {
      double[] from = {24, 24, 48, 25, 25, 50}, to = {-9, 0, 0, 0, -9, 0};
      FlightArray expected = environment.castSegments(from, to), flights = new FlightArray(2);
      DoubleBuffer part = DoubleBuffer.wrap(new double[] {9, 24, 24, 48, 25, 25, 50, 9}, 1, 6);
      DoubleBuffer foreign = ByteBuffer.allocateDirect(48).order(ByteOrder.BIG_ENDIAN).asDoubleBuffer().put(from).flip();
      for (DoubleBuffer buffer : List.of(direct(from), part, foreign, part.asReadOnlyBuffer())) {
        environment.castSegments(buffer, direct(to), null, null, flights);
        for (int i = 0; i < 2; ++i) assertArrayEquals(expected.get(i).getPosition(), flights.get(i).getPosition());
        assertEquals(6, buffer.remaining());
      }
      try (Scene scene = new Scene(environment)) {
        Body body = Scenario.createCatheter(scene);
        double[] positions = body.getPositions(), larger = new double[40];
        body.getPositions(DoubleBuffer.wrap(larger, 2, 36));
        for (int i = 0; i < 36; ++i) assertEquals(positions[i], larger[i + 2]);
        DoubleBuffer filled = direct(new double[36]);
        body.getPositions(filled);
        assertEquals(DoubleBuffer.wrap(positions), filled);
        assertThrows(ReadOnlyBufferException.class, () -> body.getPositions(filled.asReadOnlyBuffer()));
      }
    }
  }

  @Test
  void lentPositionsAreReadInPlace() {
    Environment environment = Scenario.create();
    DoubleBuffer first = direct(environment.getPoints()), second = direct(environment.getPoints());
    try (Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
      environment.deform(first);
      assertThrows(DartsweepException.InUse.class, () -> environment.deform(first));
      for (int i = 2; i < second.limit(); i += 3) second.put(i, second.get(i) + 0.25);
      environment.deform(second);
      second.put(0, 1.5); // it is read, not copied
      assertEquals(1.5, environment.getPoints()[0]);
    }
    environment.close();
  }

  @Test
  void threadsMayCallAndCloseAsTheyLike() throws InterruptedException {
    ConcurrentLinkedQueue<Throwable> problems = new ConcurrentLinkedQueue<>();
    double[] inside = new double[3 * 500], points = new double[3 * 500];
    for (int i = 0; i < points.length; ++i) {
      points[i] = 10 + i * 7919 % 2800 / 100.0;
      inside[i] = Scenario.INSIDE[i % 3];
    }
    try (Environment environment = Scenario.create()) {
      for (int round = 0; round < 3; ++round) {
        Scene scene = new Scene(environment);
        ParticleIdArray particles = scene.createParticles(inside);
        List<Thread> threads = new ArrayList<>();
        for (int number = 0; number < 8; ++number) {
          int mine = number;
          threads.add(new Thread(() -> {
            try {
              for (int i = 0; i < 30; ++i) {
                if (mine == 0 && i == 20) scene.close();
                if (mine % 2 == 1) scene.moveParticles(particles, points);
                else {
                  environment.castSegments(points, inside);
                  scene.getParticlePosition(particles.get(i));
                }
              }
            } catch (DartsweepException.Closed expected) {
              // by thread 0
            } catch (Throwable problem) {
              problems.add(problem);
            }
          }));
        }
        threads.forEach(Thread::start);
        for (Thread thread : threads) thread.join();
        assertTrue(scene.isClosed());
      }
    }
    assertTrue(problems.isEmpty(), problems::toString);
  }

  @Test
  void theLogIsALambda() {
    List<String> lines = new ArrayList<>();
    double[] points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    int[] cell = {0, 1, 2, 3};
    Log log = (level, text) -> lines.add(level + " " + text);
    try (Environment environment = new Environment(points, cell, CellType.TETRA, null, new Context(2, log))) {
      assertEquals(1, lines.size());
      assertTrue(lines.get(0).startsWith("INFO dsw_environment_create: 1 volumes"), lines.get(0));
    }
    Log thrower = (level, text) -> {
      throw new IllegalStateException("dropped");
    };
    new Environment(points, cell, CellType.TETRA, null, new Context(1, thrower)).close();
    new Environment(points, cell, CellType.TETRA, null, new Context()).close();
  }

  @Test
  void versionIsThatOfThePackage() {
    assertEquals(1000000 * Dartsweep.VERSION_MAJOR + 1000 * Dartsweep.VERSION_MINOR + Dartsweep.VERSION_PATCH, Dartsweep.version());
  }
}

package dartsweep;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.function.Executable;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

class ErrorsTest {
  @ParameterizedTest
  @EnumSource(mode = EnumSource.Mode.EXCLUDE, names = "OK")
  void everyStatusHasItsException(Status status) {
    String name = Stream.of(status.name().split("_")).map(part -> part.charAt(0) + part.substring(1).toLowerCase())
        .collect(Collectors.joining());
    DartsweepException error = assertThrows(DartsweepException.class, () -> Dartsweep.raiseStatus(status));
    assertEquals(name, error.getClass().getSimpleName());
    assertEquals(status, error.status());
  }

  @Test
  void theTextIsThatOfTheLibrary() {
    try (Environment environment = Scenario.create()) {
      var error = assertThrows(DartsweepException.NonFinite.class, () -> environment.cast(new double[] {0, Double.NaN, 0}, new double[3]));
      assertTrue(error.getMessage().contains("dsw_environment_cast: from[1] is nan, must be finite"), error.getMessage());
    }
  }

  @Test
  void theFailingCallChangesNothing() {
    try (Environment environment = Scenario.create();
        Scene scene = new Scene(environment)) {
      scene.createParticles(Scenario.INSIDE);
      byte[] before = scene.save();
      assertThrows(DartsweepException.Outside.class, () -> scene.createParticles(new double[] {24, 24, 48, -9, 0, 0}));
      var occupied = VolumeIdArray.of(environment.locate(Scenario.INSIDE).getVolume());
      assertThrows(DartsweepException.Occupied.class, () -> environment.markVolumes(occupied, Mark.IMPASSABLE));
      assertArrayEquals(before, scene.save());
      assertEquals(1, scene.getOccupants().size());
    }
  }

  @Test
  void pointsOfThePlaneHaveTwoCoordinates() {
    double[] square = {0, 0, 1, 0, 1, 1, 0, 1};
    try (Environment environment = new Environment(square, new int[] {0, 1, 2, 0, 2, 3}, CellType.TRIANGLE, null)) {
      assertEquals(2, environment.dimension());
      assertArrayEquals(square, environment.getPoints());
      assertArrayEquals(new double[] {1, 1}, environment.getVertexPosition(environment.getVertexId(2)));
      Flight flight = environment.cast(new double[] {0.5, 0.25}, new double[] {0.5, 2.25});
      assertEquals(0.375, flight.getTime());
      assertArrayEquals(new double[] {0, -1, 0}, flight.getContact().getNormal());
      FaceId side = environment.findFaces(new long[] {0, 2}, new int[] {1, 2}).get(0);
      VertexId vertex = environment.splitEdge(new EdgeId(side.volume(), side.generation(), side.local()), 0.25).getVertex();
      assertArrayEquals(new double[] {1, 0.25}, environment.getVertexPosition(vertex));
      environment.markVertices(VertexIdArray.of(environment.getVertexId(2)), Mark.IMPASSABLE);
      try (Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
        Body body = scene.createBody(new double[] {0.5, 0.25, 0.75, 0.25}, new int[] {0, 1});
        MoveReport report = body.move(new double[] {0.5, 1.25, 0.75, 0.5}, null);
        assertEquals(1, report.getVerticesStopped());
        assertEquals(0.75, body.getContacts().get(0).getTime());
        assertEquals(4, body.getPositions().length);
        DoubleBuffer memory = ByteBuffer.allocateDirect(6 * Double.BYTES).order(ByteOrder.nativeOrder()).asDoubleBuffer();
        body.getPositions(memory.duplicate().position(1).limit(5));
        assertTrue(memory.get(1) == 0.5 && memory.get(4) == 0.5);
        assertTrue(memory.get(0) == 0 && memory.get(5) == 0);
        DeformReport moved = environment.deform(new double[] {0, 0, 1, 0, 1, 2, 0, 2, 1, 0.5});
        assertEquals(DeformOutcome.DONE, moved.getOutcome());
      }
    }
  }

  private static void assertWrongSize(String text, Executable call) {
    var error = assertThrows(DartsweepException.WrongSize.class, call);
    assertTrue(error.getMessage().contains(text), error.getMessage());
  }

  @Test
  void wrongLengthsInThePlaneAreTold() {
    try (Environment environment = Scenario.createPlane();
        Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
      double[] point = {40, 30};
      assertWrongSize("2 coordinates, or a third that is 0", () -> environment.cast(new double[] {40, 30, 1}, point));
      var error = assertThrows(IllegalArgumentException.class, () -> environment.cast(new double[] {40}, point));
      assertEquals("a point is an array of 3 numbers, or 2 in the plane", error.getMessage());
      assertThrows(IllegalArgumentException.class, () -> environment.locate(null));
      assertWrongSize("2 coordinates; 3 numbers are no points", () -> environment.castSegments(new double[3], new double[3]));
      assertWrongSize("2 coordinates; 5 numbers are no points", () -> scene.createParticles(new double[5]));
      assertWrongSize("point_count is 3, the environment has 121", () -> environment.deform(new double[6]));
      Body body = scene.createBody(new double[] {40, 30, 45, 30}, new int[] {0, 1});
      assertWrongSize("target_count is 3, there are 2", () -> body.move(new double[6], null));
      assertWrongSize("positions has 3 entries, not 2", () -> body.getPositions(DoubleBuffer.wrap(new double[6])));
      assertWrongSize("positions has 3 entries, not 1",
          () -> scene.getParticlePositions(scene.createParticles(point), DoubleBuffer.wrap(new double[6])));
    }
  }

  @Test
  void argumentsOfTheWrongShapeAreRefused() {
    try (Environment environment = Scenario.create()) {
      assertThrows(DartsweepException.WrongSize.class, () -> environment.cast(new double[2], new double[3]));
      assertThrows(IllegalArgumentException.class, () -> environment.cast(new double[4], new double[3]));
      assertThrows(DartsweepException.WrongSize.class, () -> environment.castSegments(new double[4], new double[4]));
      assertThrows(IllegalArgumentException.class, () -> environment.cast(null, new double[3]));
      assertThrows(DartsweepException.WrongSize.class, () -> environment.castSegments(new double[3], new double[6]));
    }
  }

  @Test
  void listsAreLists() {
    VolumeId a = new VolumeId(1, 2), b = new VolumeId(3, -1);
    VolumeIdArray ids = VolumeIdArray.of(a, b);
    assertEquals(List.of(a, b), ids);
    assertEquals(b, ids.set(1, null));
    assertTrue(ids.get(1).isNull());
    assertEquals(Arrays.asList(a, VolumeId.NULL), ids);
    assertThrows(IndexOutOfBoundsException.class, () -> ids.get(2));
    assertThrows(IndexOutOfBoundsException.class, () -> new FlightArray(1).get(-1));
    assertThrows(IndexOutOfBoundsException.class, () -> new FlightArray(-1));
    assertEquals(List.of(), new FlightArray(0));
    assertEquals(Outcome.NONE, new FlightArray(3).get(2).getOutcome());
    assertTrue(new VolumeIdArray(3).get(2).isNull());
  }
}

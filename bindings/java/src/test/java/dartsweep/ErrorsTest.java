package dartsweep;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
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
      assertArrayEquals(new double[] {1, 1}, environment.getPosition(environment.getVertex(2)));
      Flight flight = environment.cast(new double[] {0.5, 0.25}, new double[] {0.5, 2.25});
      assertEquals(0.375, flight.getTime());
      assertArrayEquals(new double[] {0, -1, 0}, flight.getNormal());
      assertThrows(DartsweepException.WrongSize.class, () -> environment.cast(new double[] {0.5, 0.25, 1}, new double[2]));
      assertThrows(DartsweepException.WrongSize.class, () -> environment.castSegments(new double[3], new double[3]));
      environment.markVertices(VertexIdArray.of(environment.getVertex(2)), Mark.IMPASSABLE);
      try (Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
        Body body = scene.createBody(new double[] {0.5, 0.25, 0.75, 0.25}, new int[] {0, 1});
        MoveReport report = body.move(new double[] {0.5, 1.25, 0.75, 0.5}, null);
        assertEquals(1, report.getVerticesStopped());
        assertEquals(0.75, body.getContacts().get(0).getTime());
        assertEquals(4, body.getPositions().length);
        assertEquals(DeformOutcome.DONE, scene.deform(new double[] {0, 0, 1, 0, 1, 2, 0, 2}).getOutcome());
      }
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

package dartsweep;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.nio.DoubleBuffer;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;

class ReportsTest {
  @Test
  void aChangeOutlastsTheNext() {
    Environment environment = Scenario.create();
    Change first = environment.cut(new double[] {-5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25}, 2, 2);
    assertEquals(List.of(36, 24, 36, 0),
        List.of(first.getVolumesCrossed(), first.getVolumesSplit(), first.getVolumesChanged(), first.getIsClosed()));
    assertEquals(first.getDistance(), environment.getChange().getDistance());
    VolumeId volume = environment.getVolumeId(3);
    environment.removeVolumes(VolumeIdArray.of(volume));
    Change second = environment.getChange();
    assertEquals(List.of(0, 1, 0), List.of(second.getVolumesSplit(), second.getVolumes().size(), second.getFaces().size()));
    assertEquals(volume, second.getVolumes().get(0).getBefore());
    assertTrue(second.getVolumes().get(0).getAfter().isNull());
    environment.close();
    assertEquals(List.of(60, 35, 24, 12),
        List.of(first.getVolumes().size(), first.getVertices().size(), first.getFaces().size(), first.getWhole().size()));
    assertEquals(List.of(0, 0, 0), List.of(first.getCarved().size(), first.getUnrepaired().size(), first.getDetached().size()));
    VertexOrigin origin = first.getVertices().get(0);
    assertEquals(1, origin.getWeights()[0] + origin.getWeights()[1]);
    assertTrue(!origin.getFrom().get(0).equals(origin.getFrom().get(1)));
  }

  @Test
  void aDrillHalvesWhatItCrosses() {
    try (Environment environment = Scenario.create()) {
      environment.markVolumes(VolumeIdArray.of(environment.getVolumeId(237)), Mark.IMPASSABLE);
      double[] drill = {29.25, 29.25, 53.25, 29.25, 27.25, 51.25, 27.25, 29.25, 51.25, 27.25, 27.25, 53.25};
      CarveDesc desc = new CarveDesc();
      desc.setFinest(1);
      desc.setFlags(CarveFlag.COVER.swigValue());
      Change change = environment.carve(DoubleBuffer.wrap(drill), new int[] {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}, desc);
      assertEquals(List.of(1, 63, 0),
          List.of(change.getVolumesSplit(), change.getCarved().size(), change.getWhole().size()));
    }
  }

  @Test
  void aPieceBecomesABody() {
    try (Environment environment = Scenario.create();
        Scene scene = new Scene(environment)) {
      VolumeId volume = environment.getVolumeId(237);
      environment.markVolumes(VolumeIdArray.of(volume), Mark.IMPASSABLE);
      DetachDesc desc = new DetachDesc();
      desc.setVolume(volume);
      Body body = scene.body(environment.detach(desc));
      Change change = environment.getChange();
      assertEquals(8, body.getCounts().getVertexSlots());
      assertEquals(8, change.getBodyVertices().size());
      assertEquals(12, change.getBodyFaces().size());
      assertEquals(List.of(volume), change.getDetached());
      assertEquals(volume, change.getBodyFaces().get(0).getVolume());
      assertTrue(change.getDistance() > 0);
      VertexOrigin origin = change.getBodyVertices().get(7);
      assertTrue(origin.getVertex().isNull() && !origin.getFrom().get(0).isNull());
      assertEquals(origin.getFrom().get(0), origin.getFrom().get(1));
      assertArrayEquals(new double[] {1, 0}, origin.getWeights());
    }
  }

  @Test
  void eachReportSaysWhatWasTouched() {
    try (Environment environment = Scenario.create();
        Scene scene = new Scene(environment, Dartsweep.FEATURE_DEFORMING)) {
      environment.markRegion(2, Mark.IMPASSABLE);
      Contact contact = environment.cast(Scenario.INSIDE, new double[] {90, 24, 48}).getContact();
      assertEquals(ContactKind.PLANE, contact.getKind());
      assertEquals(CellKind.VOLUME, contact.getMarkedKind());
      assertEquals(CellKind.FACE, contact.getObstacle().getKind());
      assertEquals(contact.getWall().volume(), contact.getObstacle().getIndex());
      assertTrue(environment.isImpassable(Dartsweep.cellOf(contact.getBehind())));
      assertEquals(ContactKind.NONE, environment.cast(Scenario.INSIDE, new double[] {24, 24, 50}).getContact().getKind());
      Body body = Scenario.createCatheter(scene);
      BodyEdgeId edge = body.getEdgeIds().get(0);
      assertEquals(0.25, body.splitEdge(edge, 0.25).getEdgeParameter());
      assertEquals(2, body.getEdgeEnds(edge).size());
      double[] next = environment.getPoints();
      for (int i = 0; i < next.length; i += 3) next[i] += (48 - next[i]) * 0.4375;
      assertEquals(environment.deform(next).getContactCount(), environment.getWallContacts().size());
      WallContact touched = environment.getWallContacts().get(0);
      assertEquals(body.id(), touched.getBody());
      assertTrue(touched.getContact().getNormal()[0] > 0.9);
      assertTrue(touched.getContact().getObstacle().getKind() != CellKind.NONE);
      assertEquals(WallResponse.PUSH, touched.getResponse());
      assertEquals(List.of(), environment.getHeldVertices());
    }
  }

  @Test
  void nearRowsSayWhereABodyIsClose() {
    double[] points = new double[54];
    for (int i = 0; i < 18; ++i) {
      points[3 * i] = i % 3;
      points[3 * i + 1] = i / 3 % 3;
      points[3 * i + 2] = i / 9;
    }
    int[] cells = new int[32], corners = {0, 1, 4, 3, 9, 10, 13, 12};
    for (int i = 0; i < 32; ++i) cells[i] = corners[i % 8] + i / 8 % 2 + 3 * (i / 16);
    double[] from = {0.25, 1.5, 0.375, 1.5, 0.25, 0.375}, to = {0.265625, 1.5, 0.375, 1.515625, 0.25, 0.375};
    double half = Math.sqrt(0.5);
    try (Environment environment = new Environment(points, cells, CellType.HEXAHEDRON, new int[] {1, 1, 1, 2});
        Scene scene = new Scene(environment, 0)) {
      environment.markRegion(2, Mark.IMPASSABLE); // a pillar, whose edge is at x = y = 1
      Body wire = scene.createBody(from, new int[] {0, 1});
      assertEquals(List.of(), wire.getNearRows());
      NearRowArray rows = wire.findNearRows(0.25, 0.0625, Dartsweep.NEAR_JACOBIAN);
      assertEquals(3, rows.size());
      assertEquals(0.25, rows.get(0).getDistance());
      assertEquals(0.1875, rows.get(0).getGap());
      assertArrayEquals(new double[] {1, 0, 0}, rows.get(0).getNormal());
      assertArrayEquals(new int[] {1, -1, -1}, rows.get(1).getVertices());
      NearRow atEdge = rows.get(2);
      assertEquals(CellKind.EDGE, atEdge.getObstacle().getKind());
      assertEquals(half / 4, atEdge.getDistance(), 1e-15);
      assertArrayEquals(new double[] {-half, -half, 0}, atEdge.getNormal(), 1e-15);
      assertArrayEquals(new double[] {0.5, 0.5, 0}, atEdge.getWeights());
      assertArrayEquals(new double[] {1, 1, 0.375}, atEdge.getObstaclePoint());
      assertTrue(atEdge.getBody().isNull() && !atEdge.getWall().isNull());
      assertArrayEquals(new int[] {0, 3, 6, 12}, wire.getNearOffsets());
      assertArrayEquals(new int[] {0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5}, wire.getNearColumns());
      assertArrayEquals(new double[] {1, 0, 0, 0, 1, 0}, Arrays.copyOf(wire.getNearValues(), 6));
      assertEquals(-half / 2, wire.getNearValues()[6], 1e-15);
      wire.move(to, null);
      NearRowArray next = wire.findNearRows(0.25, 0.0625, 0);
      assertEquals(3, next.size());
      for (int i = 0; i < 3; ++i) {
        assertArrayEquals(rows.get(i).getKey(), next.get(i).getKey());
        assertEquals(i, next.get(i).getPrevious());
      }
      assertEquals(0.265625, next.get(0).getDistance());
      assertEquals(0, wire.getNearOffsets().length);
      assertThrows(DartsweepException.OutOfRange.class, () -> wire.findNearRows(-1, 0, 0));
    }
  }

  @Test
  void aThickBodyKeepsItsRadius() {
    double[] points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    double[] from = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5}, down = {0.25, 0.5, -0.5, 0.75, 0.5, -0.5};
    BodyDesc desc = new BodyDesc();
    desc.setRadius(0.1);
    try (Environment environment = new Environment(points, new int[] {0, 1, 2, 3, 4, 5, 6, 7}, CellType.HEXAHEDRON, null);
        Scene scene = new Scene(environment, 0)) {
      Body wire = scene.createBody(DoubleBuffer.wrap(from), new int[] {0, 1}, null, desc);
      assertEquals(0.1, wire.getRadius());
      assertThrows(DartsweepException.OutOfRange.class, () -> wire.setRadius(-1));
      assertThrows(DartsweepException.OutOfRange.class, () -> wire.findLeastGap(Double.NaN));
      wire.setRadius(0.125);
      assertEquals(0.125, wire.getRadius());
      assertEquals(0.0625, wire.findLeastGap(0.0625));
      assertEquals(0.125, wire.findLeastGap(1), 1e-8);
      assertThrows(DartsweepException.Occupied.class, () -> wire.setRadius(0.5));
      assertArrayEquals(new int[] {0, 1}, scene.getOffendingEdges());
      wire.setRadius(0.1);
      assertEquals(0.15, wire.findLeastGap(1), 1e-8);
      wire.move(down, null);
      assertEquals(0.1, wire.getPositions()[2], 1e-3);
      assertTrue(wire.findLeastGap(0.1) >= -1e-9);
      desc.setRadius(0.3);
      assertThrows(
          DartsweepException.Occupied.class, () -> scene.createBody(DoubleBuffer.wrap(from), new int[] {0, 1}, null, desc));
    }
  }
}

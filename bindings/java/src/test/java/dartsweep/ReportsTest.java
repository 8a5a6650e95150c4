package dartsweep;

import static org.junit.jupiter.api.Assertions.assertArrayEquals;
import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertTrue;

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
}

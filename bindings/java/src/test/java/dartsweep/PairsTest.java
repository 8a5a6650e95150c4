package dartsweep;

import static org.junit.jupiter.api.Assertions.assertEquals;
import static org.junit.jupiter.api.Assertions.assertThrows;
import static org.junit.jupiter.api.Assertions.assertTrue;

import java.nio.DoubleBuffer;
import org.junit.jupiter.api.Test;

class PairsTest {
  private static final byte VERTEX_FACE = (byte) PairKind.VERTEX_FACE.swigValue();
  private static final byte EDGE_EDGE = (byte) PairKind.EDGE_EDGE.swigValue();
  private static final byte VERTEX_EDGE = (byte) PairKind.VERTEX_EDGE.swigValue();
  private static final byte[] KINDS = {VERTEX_FACE, EDGE_EDGE, VERTEX_FACE};
  private static final double[] FROM = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, // a vertex above a triangle
    -1, 0.25, 1, 1, 0.25, 1, 0, -1, 0, 0, 1, 0, // an edge above an edge
    0.5, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};

  /** Where the points end, if the first features fall to these heights. */
  private static double[] to(double first, double second, double third) {
    double[] to = FROM.clone();
    to[2] = first;
    to[14] = to[17] = second;
    to[26] = third;
    return to;
  }

  @Test
  void timesAndRanksAreExact() {
    PairTouchArray touches = Dartsweep.sweepPairs(3, KINDS, FROM, to(-2, -2, -1), Dartsweep.PAIRS_RANK);
    double[] times = {1.0 / 3, 1.0 / 3, 0.5};
    int[] ranks = {0, 0, 2};
    for (int i = 0; i < 3; ++i) {
      assertEquals(times[i], touches.get(i).getTime());
      assertEquals(ranks[i], touches.get(i).getRank());
      assertEquals(1, touches.get(i).getTouches());
    }
    touches = Dartsweep.sweepPairs(3, KINDS, FROM, to(-2 + Math.ulp(1.0), -9, 2), Dartsweep.PAIRS_RANK);
    assertEquals(1.0 / 3, touches.get(0).getTime());
    assertEquals(Math.nextDown(0.1), touches.get(1).getTime());
    assertEquals(1, touches.get(0).getRank());
    assertEquals(0, touches.get(2).getTouches());
    assertEquals(2, touches.get(2).getRank());
  }

  @Test
  void listsAreFilledAndThePlaneHasOneKind() {
    double[] from = {0.5, 1, 0, 0, 1, 0}, to = {0.5, -1, 0, 0, 1, 0};
    PairTouchArray touches = new PairTouchArray(1);
    Dartsweep.sweepPairs(2, new byte[] {VERTEX_EDGE}, DoubleBuffer.wrap(from), DoubleBuffer.wrap(to), touches, 0,
        new Context(2, null));
    assertEquals(0.5, touches.get(0).getTime());
    assertTrue(Dartsweep.sweepPairs(3, new byte[0], new double[0], new double[0], 0).isEmpty());
  }

  @Test
  void featuresTurn() {
    double[] motion = new double[17]; // half a turn about z, from -y over x to y
    motion[3] = motion[6] = 1;
    byte[] kinds = {VERTEX_EDGE};
    double[] from = {0, -5, 3, -9, 3, 9}, none = {};
    assertEquals(0.25, Dartsweep.sweepRigidPairs(2, kinds, from, none, motion, new int[] {0, -1}, 0).get(0).getTime());
    assertEquals(0, Dartsweep.sweepRigidPairs(2, kinds, from, none, motion, new int[] {0, 0}, 0).get(0).getTouches());
    assertThrows(DartsweepException.OutOfRange.class,
        () -> Dartsweep.sweepRigidPairs(2, kinds, from, none, motion, new int[] {0, 1}, 0));
    assertThrows(DartsweepException.WrongSize.class,
        () -> Dartsweep.sweepRigidPairs(2, kinds, from, none, new double[16], new int[] {0, -1}, 0));
  }

  @Test
  void whatIsWrongIsRefused() {
    double[] to = to(-2, -2, -1);
    assertThrows(DartsweepException.Unsupported.class,
        () -> Dartsweep.sweepPairs(3, new byte[] {VERTEX_FACE, VERTEX_EDGE, EDGE_EDGE}, FROM, to, 0));
    assertThrows(DartsweepException.OutOfRange.class, () -> Dartsweep.sweepPairs(4, KINDS, FROM, to, 0));
    assertThrows(DartsweepException.WrongSize.class, () -> Dartsweep.sweepPairs(2, KINDS, FROM, to, 0));
    assertThrows(DartsweepException.WrongSize.class, () -> Dartsweep.sweepPairs(3, KINDS, FROM, new double[24], 0));
    assertThrows(DartsweepException.WrongSize.class, () -> Dartsweep.sweepPairs(3, KINDS, new double[35], to, 0));
    assertThrows(DartsweepException.NonFinite.class,
        () -> Dartsweep.sweepPairs(3, KINDS, FROM, to(Double.NaN, 0, 0), 0));
  }
}

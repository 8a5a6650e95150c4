import dartsweep.Body;
import dartsweep.BodyContact;
import dartsweep.CellType;
import dartsweep.DartsweepException;
import dartsweep.Environment;
import dartsweep.Mark;
import dartsweep.MoveOptions;
import dartsweep.MoveReport;
import dartsweep.Response;
import dartsweep.Scene;

/** A catheter is pushed along a square vessel, against its wall: it slides, and contacts say where it touches. */
public class Catheter {
  private static final int WIDTH = 5, LENGTH = 10, LINKS = 8; // cells, cells, vertices

  public static void main(String[] arguments) {
    try (Environment vessel = vessel();
        Scene scene = new Scene(vessel)) {
      System.out.println(vessel.markRegion(2, Mark.IMPASSABLE).getMarked() + " cells are wall");
      Body catheter = catheter(scene);
      MoveOptions slide = new MoveOptions();
      slide.setVertexResponse(Response.SLIDE);
      slide.setEdgeResponse(Response.SLIDE);
      for (int step = 1; step <= 4; ++step) {
        double[] targets = catheter.getPositions();
        for (int i = 0; i < targets.length; i += 3) {
          targets[i] += 0.4;
          targets[i + 2] += 0.5;
        }
        MoveReport report = catheter.move(targets, slide);
        System.out.println("step " + step + ": " + report.getContactCount() + " contacts");
      }
      BodyContact contact = catheter.getContacts().get(0);
      System.out.printf("vertex %d met the wall at x = %.3f, at %.3f of its way%n", contact.getVertex().index(),
          contact.getPoint()[0], contact.getTime());
      try {
        scene.createParticle(new double[] {0.5, 0.5, 5});
      } catch (DartsweepException.Impassable refused) {
        System.out.println("a particle in the wall: " + refused.status());
      }
    }
  }

  /** Hexahedra of side 1; those on the outside are region 2. */
  private static Environment vessel() {
    int points = WIDTH + 1;
    double[] positions = new double[3 * points * points * (LENGTH + 1)];
    for (int p = 0; p < positions.length / 3; ++p) {
      positions[3 * p] = p % points;
      positions[3 * p + 1] = p / points % points;
      positions[3 * p + 2] = p / (points * points);
    }
    int[] cells = new int[8 * WIDTH * WIDTH * LENGTH];
    int[] regions = new int[cells.length / 8];
    int[] corners = {0, 1, points + 1, points}; // of a square, counter-clockwise
    for (int cell = 0; cell < regions.length; ++cell) {
      int i = cell % WIDTH, j = cell / WIDTH % WIDTH, k = cell / (WIDTH * WIDTH);
      for (int c = 0; c < 8; ++c) cells[8 * cell + c] = ((k + c / 4) * points + j) * points + i + corners[c % 4];
      regions[cell] = i > 0 && i < WIDTH - 1 && j > 0 && j < WIDTH - 1 ? 1 : 2;
    }
    return new Environment(positions, cells, CellType.HEXAHEDRON, regions);
  }

  private static Body catheter(Scene scene) {
    double[] positions = new double[3 * LINKS];
    int[] edges = new int[2 * (LINKS - 1)];
    for (int i = 0; i < LINKS; ++i) {
      positions[3 * i] = positions[3 * i + 1] = 2.5;
      positions[3 * i + 2] = 0.25 + 0.5 * i;
      if (i > 0) {
        edges[2 * i - 2] = i - 1;
        edges[2 * i - 1] = i;
      }
    }
    return scene.createBody(positions, edges);
  }
}

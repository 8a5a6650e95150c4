// A catheter is pushed along a square vessel, against its wall: it slides, and contacts say where it touches.
using System;
using Dartsweep;
using Environment = Dartsweep.Environment; // System has one, too

static class Catheter
{
  const int Width = 5, Length = 10, Links = 8; // cells, cells, vertices

  static void Main()
  {
    using (Environment vessel = Vessel())
    using (Scene scene = new Scene(vessel))
    {
      Console.WriteLine(vessel.MarkRegion(2, Mark.Impassable).Count + " cells are wall");
      Body catheter = Chain(scene);
      MoveOptions slide = new MoveOptions { VertexResponse = Response.Slide, EdgeResponse = Response.Slide };
      for (int step = 1; step <= 4; ++step)
      {
        double[] targets = catheter.GetPositions();
        for (int i = 0; i < targets.Length; i += 3)
        {
          targets[i] += 0.4;
          targets[i + 2] += 0.5;
        }
        MoveReport report = catheter.Move(targets, slide);
        Console.WriteLine("step " + step + ": " + report.ContactCount + " contacts");
      }
      BodyContact contact = catheter.GetContacts()[0];
      Console.WriteLine("vertex {0} met the wall at x = {1:F3}, at {2:F3} of its way", contact.Vertex.Index, contact.Point.X, contact.Time);
      try
      {
        scene.CreateParticle(new Vec3(0.5, 0.5, 5));
      }
      catch (ImpassableException refused)
      {
        Console.WriteLine("a particle in the wall: " + refused.Status);
      }
    }
  }

  // Hexahedra of side 1; those on the outside are region 2.
  static Environment Vessel()
  {
    const int points = Width + 1;
    double[] positions = new double[3 * points * points * (Length + 1)];
    for (int p = 0; p < positions.Length / 3; ++p)
    {
      positions[3 * p] = p % points;
      positions[3 * p + 1] = p / points % points;
      positions[3 * p + 2] = p / (points * points);
    }
    int[] cells = new int[8 * Width * Width * Length], regions = new int[cells.Length / 8];
    int[] corners = { 0, 1, points + 1, points }; // of a square, counter-clockwise
    for (int cell = 0; cell < regions.Length; ++cell)
    {
      int i = cell % Width, j = cell / Width % Width, k = cell / (Width * Width);
      for (int c = 0; c < 8; ++c) cells[8 * cell + c] = ((k + c / 4) * points + j) * points + i + corners[c % 4];
      regions[cell] = i > 0 && i < Width - 1 && j > 0 && j < Width - 1 ? 1 : 2;
    }
    return new Environment(positions, cells, CellType.Hexahedron, regions);
  }

  static Body Chain(Scene scene)
  {
    double[] positions = new double[3 * Links];
    uint[] edges = new uint[2 * (Links - 1)];
    for (int i = 0; i < Links; ++i)
    {
      positions[3 * i] = positions[3 * i + 1] = 2.5;
      positions[3 * i + 2] = 0.25 + 0.5 * i;
    }
    for (uint i = 0; i < edges.Length; ++i) edges[i] = i / 2 + i % 2;
    return scene.CreateBody(positions, edges);
  }
}

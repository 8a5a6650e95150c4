// The scenario of bindings/tests/README.md, in C#. Its result is text, as in scenario.json.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Dartsweep;
using Environment = Dartsweep.Environment;

sealed class Scenario
{
  public const int Links = 12, Particles = 50, NX = 6, NY = 6, NZ = 12, Side = 10;
  public static readonly Vec3 Inside = new Vec3(24, 24, 48), Outside = new Vec3(-9, 0, 0);
  static readonly int[,] corners = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

  readonly List<string> stages = new List<string>();
  List<string> now;
  string name;
  int seed = 1;

  public static string Play()
  {
    Scenario scenario = new Scenario();
    scenario.PlayAll();
    scenario.Deform();
    scenario.Plane();
    scenario.EndStage();
    return "{\n" + string.Join(",\n", scenario.stages) + "\n}\n";
  }

  // --- the result
  void Stage(string next)
  {
    EndStage();
    name = next;
    now = new List<string>();
  }

  void EndStage()
  {
    if (now != null) stages.Add("  \"" + name + "\": [\"" + string.Join("\", \"", now) + "\"]");
  }

  void Say(params long[] values) { now.AddRange(values.Select(value => value.ToString("x16", CultureInfo.InvariantCulture))); }
  void Say(params double[] values) { Say(values.Select(BitConverter.DoubleToInt64Bits).ToArray()); }
  void Say(Vec3 point) { Say(point.X, point.Y, point.Z); }

  // --- what it is played with
  double[] Draw(int count)
  {
    double[] points = new double[3 * count];
    for (int i = 0; i < points.Length; ++i)
    {
      seed = (seed * 4093 + 1021) % 65536;
      points[i] = i % 3 == 2 ? 1.5 * (seed / 1024.0) : 4 + 0.625 * (seed / 1024.0);
    }
    return points;
  }

  double[] DrawInPlane(int count)
  {
    double[] points = new double[2 * count];
    for (int i = 0; i < points.Length; ++i)
    {
      seed = (seed * 4093 + 1021) % 65536;
      points[i] = 11 + 0.90625 * (seed / 1024.0);
    }
    return points;
  }

  static int At(int i, int j, int k) { return (k * (NY + 1) + j) * (NX + 1) + i; }

  public static double[] Points()
  {
    double[] points = new double[3 * (NX + 1) * (NY + 1) * (NZ + 1)];
    for (int k = 0; k <= NZ; ++k)
      for (int j = 0; j <= NY; ++j)
        for (int i = 0; i <= NX; ++i)
        {
          int p = 3 * At(i, j, k);
          points[p] = 8 * i + j * k % 3;
          points[p + 1] = 8 * j + i * k % 3;
          points[p + 2] = 8 * k + i * j % 3;
        }
    return points;
  }

  static int[] Regions()
  {
    return Enumerable.Range(0, NX * NY * NZ).Select(cell =>
    {
      int i = cell % NX, j = cell / NX % NY;
      return i > 0 && i < NX - 1 && j > 0 && j < NY - 1 ? 1 : 2;
    }).ToArray();
  }

  public static Environment Create()
  {
    int[] cells = new int[8 * NX * NY * NZ];
    for (int c = 0; c < cells.Length; ++c)
    {
      int cell = c / 8, corner = c % 8;
      cells[c] = At(cell % NX + corners[corner, 0], cell / NX % NY + corners[corner, 1], cell / (NX * NY) + corners[corner, 2]);
    }
    return new Environment(Points(), cells, CellType.Hexahedron, Regions());
  }

  public static Body CreateCatheter(Scene scene)
  {
    double[] positions = new double[3 * Links];
    uint[] edges = new uint[2 * (Links - 1)];
    for (int i = 0; i < Links; ++i)
    {
      positions[3 * i] = 24.5;
      positions[3 * i + 1] = 25.25;
      positions[3 * i + 2] = 8.125 + 2.0 * i;
    }
    for (uint i = 0; i < edges.Length; ++i) edges[i] = i / 2 + i % 2;
    return scene.CreateBody(positions, edges);
  }

  // --- stages, in the order of README.md
  void PlayAll()
  {
    Stage("vessel");
    using (Environment environment = Create())
    {
      EnvironmentInfo info = environment.Info();
      Marked marked = environment.MarkRegion(2, Mark.Impassable);
      Say((long)info.VertexCount, (long)info.VolumeCount, (long)info.FaceCount, (long)info.BoundaryFaceCount, marked.Count);
      Queries(environment);
      using (Scene scene = new Scene(environment))
      {
        int[] regions = Regions();
        double[] centres = Enumerable.Range(0, regions.Length).Where(cell => regions[cell] == 1).Take(Particles)
          .Select(cell => environment.GetCentre(environment.GetVolumeId((uint)cell)))
          .SelectMany(point => new[] { point.X, point.Y, point.Z }).ToArray();
        ParticleId[] particles = scene.CreateParticles(centres);
        Stage("particles");
        for (int i = 0; i < 4; ++i) Move(scene, particles);
        Push(CreateCatheter(scene));
        Snapshots(environment, scene, particles);
        Mistakes(environment, scene, particles);
        Cut("cut", environment, new[] { -5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25 }, 2, 2);
      }
    }
  }

  void SayFlights(Flight[] flights)
  {
    foreach (Flight flight in flights)
    {
      Say((long)flight.Outcome);
      Say(flight.Time);
      Say(flight.Position);
      Say(flight.Contact.Normal);
      Say(flight.Contact.Wall.Volume, flight.Contact.Wall.Local, flight.VolumesVisited);
    }
  }

  void SaySweeps(Sweep[] sweeps)
  {
    foreach (Sweep sweep in sweeps)
    {
      Say((long)sweep.Outcome);
      Say(sweep.Time);
      Say(sweep.Point);
      Say(sweep.EdgeParameter);
    }
  }

  void Say(Nearest nearest)
  {
    Say(nearest.Distance);
    Say((long)nearest.Cell.Kind, nearest.Cell.Index);
  }

  void Queries(Environment environment)
  {
    Stage("locate");
    double[] from = Draw(64);
    VolumeId[] volumes = new VolumeId[64];
    int[] locations = new int[64];
    environment.LocatePoints(from, null, volumes, locations);
    for (int i = 0; i < 64; ++i) Say(locations[i], volumes[i].Index, volumes[i].Generation);

    Stage("cast");
    double[] to = Draw(64);
    SayFlights(environment.CastSegments(from, to));

    Stage("sweep");
    SaySweeps(environment.SweepEdges(from.Take(48).ToArray(), to.Take(48).ToArray(), Draw(16)));

    Stage("nearest");
    for (int i = 0; i < 64; ++i)
    {
      if (locations[i] != (int)Location.Passable) continue;
      Say(environment.FindNearest(new Vec3(from[3 * i], from[3 * i + 1], from[3 * i + 2]), 20.0, volumes[i]));
    }
  }

  void Move(Scene scene, ParticleId[] particles)
  {
    foreach (Flight flight in scene.MoveParticles(particles, Draw(Particles)))
    {
      Say((long)flight.Outcome);
      Say(flight.Time);
      Say(flight.Position);
    }
  }

  void Push(Body body)
  {
    Push("catheter", body, Enumerable.Range(0, Links).SelectMany(i => new[] { 1.75, -0.5 * (i % 3), 3.0 }).ToArray());
    SayContacts("contacts", body.GetContacts());
  }

  void Push(string next, Body body, double[] way)
  {
    Stage(next);
    MoveOptions slide = new MoveOptions { VertexResponse = Response.Slide, EdgeResponse = Response.Slide };
    for (int step = 0; step < 10; ++step)
    {
      double[] positions = body.GetPositions();
      for (int i = 0; i < way.Length; ++i) positions[i] += way[i];
      MoveReport report = body.Move(positions, slide);
      Say(report.VerticesStopped, (long)report.ContactCount);
      Say(body.GetPositions());
    }
  }

  void SayContacts(string next, BodyContact[] contacts)
  {
    Stage(next);
    Say(contacts.Length);
    foreach (BodyContact contact in contacts)
    {
      Say(contact.Vertex.Index, (long)contact.Contact.Kind);
      Say(contact.Time);
      Say(contact.Point);
      Say(contact.Contact.Normal);
      Say(contact.Contact.Wall.Volume);
    }
  }

  void SayBlocks(params byte[][] blocks)
  {
    foreach (byte[] block in blocks) Say(block.Length, block.Sum(each => (long)each));
  }

  void Snapshots(Environment environment, Scene scene, ParticleId[] particles)
  {
    Stage("snapshot");
    byte[] block = environment.Save(), sceneBlock = scene.Save();
    SayBlocks(block, sceneBlock);
    using (Environment other = Environment.Load(block))
    using (Scene copy = Scene.Load(other, sceneBlock)) Move(copy, particles);

    Stage("damaged");
    Say(StatusOf(() => Environment.Load(block.Take(block.Length / 2).ToArray())));
    byte[] flipped = (byte[])block.Clone();
    flipped[block.Length / 2] ^= 1;
    Say(StatusOf(() => Environment.Load(flipped)));
  }

  static long StatusOf(Action call)
  {
    try
    {
      call();
      return (long)Status.Ok;
    }
    catch (DartsweepException error)
    {
      return (long)error.Status;
    }
  }

  void Mistakes(Environment environment, Scene scene, ParticleId[] particles)
  {
    Stage("errors");
    Say(StatusOf(() => environment.Cast(new Vec3(0, double.NaN, 0), Inside)));
    Say(StatusOf(() => environment.Cast(Inside, Outside, new VolumeId(3, 7))));
    Say(StatusOf(() => environment.GetVolumeId((uint)(NX * NY * NZ))));
    Say(StatusOf(() => scene.CreateParticle(Outside)));
    Say(StatusOf(() => scene.CreateParticle(new Vec3(4, 4, 4))));
    Say(StatusOf(() => scene.MoveParticles(new[] { particles[0], particles[0] }, new double[] { 24, 24, 48, 24, 24, 48 })));
    ParticleId particle = scene.CreateParticle(Inside);
    Say(StatusOf(() => environment.MarkVolumes(new[] { scene.GetParticlePosition(particle).Volume }, Mark.Impassable)));
    scene.DestroyParticle(particle);
    Say(StatusOf(() => scene.DestroyParticle(particle)));
    Say(StatusOf(scene.ResetStatistics));
    Say(StatusOf(() => new Environment(Points(), new[] { 0, 1, 7, 7 }, CellType.Tetra)));
  }

  void Cut(string next, Environment environment, double[] blade, uint rows, uint columns)
  {
    Stage(next);
    Change change = environment.Cut(blade, rows, columns);
    Say(change.Distance);
    Say((long)change.VolumesSplit, change.GetFaces().Length, (long)environment.Info().VolumeCount);
    foreach (VertexOrigin vertex in change.GetVertices())
    {
      Say(vertex.Vertex.Index);
      Say(vertex.Weights0);
    }
  }

  void Deform()
  {
    Stage("deform");
    using (Environment environment = Create())
    {
      environment.MarkRegion(2, Mark.Impassable);
      using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
      {
        Body body = CreateCatheter(scene);
        double[] next = environment.GetPoints();
        for (int i = 0; i < next.Length; i += 3) next[i] += (48 - next[i]) * 0.4375;
        SayDeformed(environment.Deform(next), body);
      }
    }
  }

  void SayDeformed(DeformReport report, Body body)
  {
    Say((long)report.Outcome, (long)report.HeldCount, (long)report.ContactCount, (long)report.PushedCount);
    Say(body.GetPositions());
  }

  /// <summary>Squares whose corners have moved, half of them cut into two triangles.</summary>
  public static Environment CreatePlane()
  {
    double[] points = Enumerable.Range(0, (Side + 1) * (Side + 1)).SelectMany(p =>
    {
      int i = p % (Side + 1), j = p / (Side + 1);
      return new double[] { 8 * i + i * j % 3, 8 * j + (i + 2 * j) % 3 };
    }).ToArray();
    List<int> corners = new List<int>(), offsets = new List<int> { 0 }, regions = new List<int>();
    List<byte> types = new List<byte>();
    for (int square = 0; square < Side * Side; ++square)
    {
      int i = square % Side, j = square / Side, a = j * (Side + 1) + i, d = a + Side + 1;
      bool quad = (i + j) % 2 == 0;
      foreach (int[] cell in quad ? new[] { new[] { a, a + 1, d + 1, d } } : new[] { new[] { a, a + 1, d + 1 }, new[] { a, d + 1, d } })
      {
        corners.AddRange(cell);
        offsets.Add(corners.Count);
        types.Add((byte)(quad ? CellType.Quad : CellType.Triangle));
        regions.Add(i > 0 && i < Side - 1 && j > 0 && j < Side - 1 ? 1 : 2);
      }
    }
    return new Environment(points, corners.ToArray(), offsets.ToArray(), types.ToArray(), regions.ToArray(), null, null, null,
                           new EnvironmentDesc { Dimension = 2 }, null);
  }

  void Plane()
  {
    Stage("plane");
    using (Environment environment = CreatePlane())
    {
      EnvironmentInfo info = environment.Info();
      Marked marked = environment.MarkRegion(2, Mark.Impassable);
      environment.MarkVertices(new[] { environment.GetVertexId((uint)(5 * (Side + 1) + 5)) }, Mark.Impassable);
      Say((long)info.Dimension, (long)info.VertexCount, (long)info.VolumeCount, (long)info.FaceCount, (long)info.BoundaryFaceCount, marked.Count);

      Stage("plane locate");
      seed = 1;
      double[] from = DrawInPlane(32);
      VolumeId[] volumes = new VolumeId[32];
      int[] found = new int[32];
      environment.LocatePoints(from, null, volumes, found);
      for (int i = 0; i < 32; ++i)
      {
        Say(found[i], volumes[i].Index, volumes[i].Generation);
        if (found[i] == (int)Location.Passable) Say(environment.FindNearest(new Vec3(from[2 * i], from[2 * i + 1]), 20.0, volumes[i]));
      }

      Stage("plane cast");
      double[] to = DrawInPlane(32);
      for (int i = 0; i < to.Length; i += 4) to[i] += 40;
      SayFlights(environment.CastSegments(from, to));

      Stage("plane sweep");
      SaySweeps(environment.SweepEdges(from.Take(32).ToArray(), to.Take(32).ToArray(), DrawInPlane(16)));

      using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
      {
        Stage("plane particles");
        ParticleId[] particles = scene.CreateParticles(from);
        scene.MoveParticles(particles, to);
        double[] locations = new double[from.Length];
        scene.GetParticlePositions(particles, locations);
        Say(locations);
        Body rope = scene.CreateBody(Enumerable.Range(0, Links).SelectMany(i => new[] { 20.25 + 3.0 * i, 40.5 }).ToArray(),
                                     Enumerable.Range(0, 2 * (Links - 1)).Select(i => (uint)(i / 2 + i % 2)).ToArray());
        Push("rope", rope, Enumerable.Range(0, Links).SelectMany(i => new[] { 1.5, 4.0 - 0.75 * (i % 3) }).ToArray());
        SayContacts("rope contacts", rope.GetContacts());
        Stage("plane snapshot");
        SayBlocks(environment.Save(), scene.Save());

        Stage("plane deform");
        double[] points = environment.GetPoints();
        double[] bent = points.Select((x, i) => i % 2 == 1 ? x + (40 - x) * 0.125 : x).Concat(new double[2 * 64]).ToArray();
        SayDeformed(environment.Deform(bent), rope);
        Cut("plane cut", environment, new[] { 20, 20.5, 60.25, 41.25 }, 2, 1);
      }
    }
  }
}

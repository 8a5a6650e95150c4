// The scenario of bindings/tests/README.md, in C#. Its result is text, as in scenario.json.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Dartsweep;
using Environment = Dartsweep.Environment;

sealed class Scenario
{
  public const int Links = 12, Particles = 50, NX = 6, NY = 6, NZ = 12;
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
          .Select(cell => environment.GetCentre(environment.GetVolume((uint)cell)))
          .SelectMany(point => new[] { point.X, point.Y, point.Z }).ToArray();
        ParticleId[] particles = scene.CreateParticles(centres);
        Stage("particles");
        for (int i = 0; i < 4; ++i) Move(scene, particles);
        Push(CreateCatheter(scene));
        Snapshots(environment, scene, particles);
        Mistakes(environment, scene, particles);
        Cut(environment);
      }
    }
  }

  void Queries(Environment environment)
  {
    Stage("locate");
    double[] from = Draw(64);
    VolumeId[] volumes = new VolumeId[64];
    int[] places = new int[64];
    environment.LocatePoints(from, null, volumes, places);
    for (int i = 0; i < 64; ++i) Say(places[i], volumes[i].Index, volumes[i].Generation);

    Stage("cast");
    double[] to = Draw(64);
    foreach (Flight flight in environment.CastSegments(from, to))
    {
      Say((long)flight.Outcome);
      Say(flight.Time);
      Say(flight.Position);
      Say(flight.Normal);
      Say(flight.Face.Volume, flight.Face.Local, flight.CellsVisited);
    }

    Stage("sweep");
    foreach (Sweep sweep in environment.SweepEdges(from.Take(48).ToArray(), to.Take(48).ToArray(), Draw(16)))
    {
      Say((long)sweep.Outcome);
      Say(sweep.Time);
      Say(sweep.Point);
      Say(sweep.Along);
    }

    Stage("nearest");
    for (int i = 0; i < 64; ++i)
    {
      if (places[i] != (int)Place.Passable) continue;
      Nearest nearest = environment.FindNearest(new Vec3(from[3 * i], from[3 * i + 1], from[3 * i + 2]), 20.0, volumes[i]);
      Say(nearest.Distance);
      Say((long)nearest.Cell.Kind, nearest.Cell.Index);
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
    Stage("catheter");
    MoveOptions slide = new MoveOptions { VertexResponse = Response.Slide, EdgeResponse = Response.Slide };
    for (int step = 0; step < 10; ++step)
    {
      double[] positions = body.GetPositions();
      for (int i = 0; i < Links; ++i)
      {
        positions[3 * i] += 1.75;
        positions[3 * i + 1] -= 0.5 * (i % 3);
        positions[3 * i + 2] += 3.0;
      }
      MoveReport report = body.Move(positions, slide);
      Say(report.VerticesStopped, (long)report.ContactCount);
      Say(body.GetPositions());
    }

    Stage("contacts");
    Contact[] contacts = body.GetContacts();
    Say(contacts.Length);
    foreach (Contact contact in contacts)
    {
      Say(contact.Vertex.Index, (long)contact.Kind);
      Say(contact.Time);
      Say(contact.Point);
      Say(contact.Normal);
      Say(contact.Wall.Volume);
    }
  }

  void Snapshots(Environment environment, Scene scene, ParticleId[] particles)
  {
    Stage("snapshot");
    byte[] block = environment.Save(), sceneBlock = scene.Save();
    foreach (byte[] saved in new[] { block, sceneBlock }) Say(saved.Length, saved.Sum(each => (long)each));
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
    Say(StatusOf(() => environment.GetVolume((uint)(NX * NY * NZ))));
    Say(StatusOf(() => scene.CreateParticle(Outside)));
    Say(StatusOf(() => scene.CreateParticle(new Vec3(4, 4, 4))));
    Say(StatusOf(() => scene.MoveParticles(new[] { particles[0], particles[0] }, new double[] { 24, 24, 48, 24, 24, 48 })));
    ParticleId particle = scene.CreateParticle(Inside);
    Say(StatusOf(() => environment.MarkVolumes(new[] { scene.GetParticle(particle).Volume }, Mark.Impassable)));
    scene.DestroyParticle(particle);
    Say(StatusOf(() => scene.DestroyParticle(particle)));
    Say(StatusOf(scene.ResetStatistics));
    Say(StatusOf(() => new Environment(Points(), new[] { 0, 1, 7, 7 }, CellType.Tetra)));
  }

  void Cut(Environment environment)
  {
    Stage("cut");
    CutReport report = environment.Cut(new[] { -5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25 }, 2, 2);
    Say(report.Distance);
    Say((long)report.VolumesSplit, (long)report.FaceCount, (long)environment.Info().VolumeCount);
    foreach (CutVertex vertex in environment.GetCutVertices())
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
        DeformReport report = scene.Deform(next);
        Say((long)report.Outcome, (long)report.HeldCount, (long)report.ContactCount, (long)report.PushedCount);
        Say(body.GetPositions());
      }
    }
  }
}

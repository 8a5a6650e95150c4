// The tests: every public static method of Tests. No framework, so that mono's runtime and compiler are enough. Usage: tests.exe SCENARIO.JSON
using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Threading;
using Dartsweep;
using Environment = Dartsweep.Environment;

static class Program
{
  public static string ScenarioFile;

  static int Main(string[] arguments)
  {
    ScenarioFile = arguments[0];
    int failed = 0, passed = 0;
    foreach (MethodInfo test in typeof(Tests).GetMethods(BindingFlags.Static | BindingFlags.Public | BindingFlags.DeclaredOnly))
    {
      try
      {
        test.Invoke(null, null);
        ++passed;
      }
      catch (TargetInvocationException error)
      {
        Console.WriteLine(test.Name + ": " + error.InnerException);
        ++failed;
      }
    }
    Console.WriteLine(passed + " tests passed" + (failed == 0 ? "" : ", " + failed + " failed"));
    return failed == 0 ? 0 : 1;
  }
}

static partial class Tests
{
  static void True(bool condition, string what = "") { if (!condition) throw new Exception("not true: " + what); }
  static void Same<T>(T expected, T value) { True(Equals(expected, value), "expected " + expected + ", got " + value); }

  static T Throws<T>(Action call) where T : Exception
  {
    try
    {
      call();
    }
    catch (Exception error)
    {
      if (error.GetType() == typeof(T)) return (T)error;
      throw new Exception("expected " + typeof(T).Name, error);
    }
    throw new Exception("expected " + typeof(T).Name + ", nothing was thrown");
  }

  static readonly Vec3 inside = Scenario.Inside;

  public static void AllBitsAreThoseOfC()
  {
    string[] expected = File.ReadAllLines(Program.ScenarioFile), result = Scenario.Play().TrimEnd('\n').Split('\n');
    Same(expected.Length, result.Length);
    for (int i = 0; i < expected.Length; ++i) True(expected[i] == result[i], "line " + (i + 1) + " of " + Program.ScenarioFile);
  }

  public static void StructsAreThoseOfC()
  {
    Type all = typeof(Environment).Assembly.GetType("Dartsweep.Structs");
    Type[] types = (Type[])all.GetField("All", BindingFlags.Static | BindingFlags.NonPublic).GetValue(null);
    True(types.Length > 25, "structs");
    MethodInfo size = typeof(Environment).Assembly.GetType("Dartsweep.Callbacks").GetMethod("dartsweep_size_of", BindingFlags.Static | BindingFlags.NonPublic);
    for (int i = 0; i < types.Length; ++i)
      True((UIntPtr)size.Invoke(null, new object[] { i }) == (UIntPtr)Marshal.SizeOf(types[i]), types[i].Name);
  }

  public static void EveryStatusHasItsException()
  {
    MethodInfo raise = typeof(Library).GetMethod("RaiseStatus", BindingFlags.Static | BindingFlags.NonPublic);
    foreach (Status status in Enum.GetValues(typeof(Status)))
    {
      if (status == Status.Ok) continue;
      try
      {
        raise.Invoke(null, new object[] { status });
        True(false, status.ToString());
      }
      catch (TargetInvocationException error)
      {
        Same(status + "Exception", error.InnerException.GetType().Name);
        Same(status, ((DartsweepException)error.InnerException).Status);
      }
    }
  }

  public static void TheTextIsThatOfTheLibrary()
  {
    using (Environment environment = Scenario.Create())
    {
      var error = Throws<NonFiniteException>(() => environment.Cast(new Vec3(0, double.NaN, 0), inside));
      True(error.Message.Contains("dsw_environment_cast: from[1] is nan, must be finite"), error.Message);
    }
  }

  public static void TheFailingCallChangesNothing()
  {
    using (Environment environment = Scenario.Create())
    using (Scene scene = new Scene(environment))
    {
      scene.CreateParticle(inside);
      byte[] before = scene.Save();
      Throws<OutsideException>(() => scene.CreateParticles(new double[] { 24, 24, 48, -9, 0, 0 }));
      Throws<OccupiedException>(() => environment.MarkVolumes(new[] { environment.Locate(inside).Volume }, Mark.Impassable));
      True(before.SequenceEqual(scene.Save()));
      Same(1, scene.GetOccupants().Length);
    }
  }

  public static void PointsOfThePlaneHaveTwoCoordinates()
  {
    using (Environment environment = new Environment(new double[] { 0, 0, 1, 0, 1, 1, 0, 1 }, new[] { 0, 1, 2, 0, 2, 3 }, CellType.Triangle))
    {
      True(environment.Dimension() == 2 && environment.GetPoints().Length == 8);
      Flight flight = environment.Cast(new Vec3(0.5, 0.25), new Vec3(0.5, 2.25));
      True(flight.Time == 0.375 && flight.Contact.Normal.Y == -1 && flight.Contact.Normal.Z == 0);
      FaceId side = environment.FindFaces(new ulong[] { 0, 2 }, new uint[] { 1, 2 })[0];
      VertexId vertex = environment.SplitEdge(new EdgeId(side.Volume, side.Generation, side.Local), 0.25).Vertex;
      Same(new Vec3(1, 0.25), environment.GetVertexPosition(vertex));
      environment.MarkVertices(new[] { environment.GetVertexId(2) }, Mark.Impassable);
      using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
      {
        Body body = scene.CreateBody(new[] { 0.5, 0.25, 0.75, 0.25 }, new uint[] { 0, 1 });
        MoveReport report = body.Move(new[] { 0.5, 1.25, 0.75, 0.5 }, null);
        True(report.VerticesStopped == 1 && body.GetContacts()[0].Time == 0.75 && body.GetPositions().Length == 4);
        True(environment.Deform(new double[] { 0, 0, 1, 0, 1, 2, 0, 2, 1, 0.5 }).Outcome == DeformOutcome.Done);
      }
    }
  }

  static void WrongSize(string text, Action call)
  {
    string message = Throws<WrongSizeException>(call).Message;
    True(message.Contains(text), message);
  }

  public static void WrongLengthsInThePlaneAreTold()
  {
    using (Environment environment = Scenario.CreatePlane())
    using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
    {
      WrongSize("2 coordinates, or a third that is 0", () => environment.Cast(new Vec3(40, 30, 1), new Vec3(40, 30)));
      WrongSize("2 coordinates; 3 numbers are no points", () => environment.CastSegments(new double[3], new double[3]));
      WrongSize("2 coordinates; 5 numbers are no points", () => scene.CreateParticles(new double[5]));
      WrongSize("point_count is 3, the environment has 121", () => environment.Deform(new double[6]));
      Body body = scene.CreateBody(new double[] { 40, 30, 45, 30 }, new uint[] { 0, 1 });
      WrongSize("target_count is 3, there are 2", () => body.Move(new double[6]));
      WrongSize("positions has 3 entries, not 2", () => body.GetPositions(new double[6]));
      ParticleId[] particle = scene.CreateParticles(new double[] { 40, 30 });
      WrongSize("positions has 3 entries, not 1", () => scene.GetParticlePositions(particle, new double[6]));
      Throws<ArgumentException>(() => new RigidMotion().Translation = new double[2]);
    }
  }

  public static void PlacesInsideAreFound()
  {
    using (Environment environment = Scenario.Create())
    {
      double[] places = environment.FindInside(new double[] { 24, 24, 900, 24, 24, 48 }, 0.5);
      Same(24.0, places[3]);
      Same(48.0, places[5]);
      True(environment.FindNearestToPoints(places, 20)[0].Distance > 0);
    }
  }

  public static void WhatIsNearestToPointsAndSegmentsIsFound()
  {
    using (Environment environment = Scenario.Create())
    {
      double[] from = { 24, 24, 48, 25, 25, 50 }, to = { 24, 24, 50, 25, 27, 50 };
      Nearest[] points = environment.FindNearestToPoints(from, 20);
      SegmentNearest[] segments = environment.FindNearestToSegments(from, to, 20);
      VolumeId[] volumes = new VolumeId[2];
      SegmentNearest[] again = new SegmentNearest[2];
      environment.FindNearestToSegments(from, to, 20, null, again, volumes);
      for (int i = 0; i < 2; ++i)
      {
        True(segments[i].Nearest.Distance <= points[i].Distance);
        True(segments[i].SegmentParameter >= 0 && segments[i].SegmentParameter <= 1);
        Same(segments[i].Nearest.Distance, again[i].Nearest.Distance);
        True(environment.IsValid(volumes[i]));
      }
    }
  }

  public static void TimesAndRanksOfPairsAreExact()
  {
    byte face = (byte)PairKind.VertexFace, edge = (byte)PairKind.EdgeEdge, plane = (byte)PairKind.VertexEdge;
    byte[] kinds = { face, edge, face };
    double[] from = { 0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0.25, 1, 1, 0.25, 1, 0, -1, 0, 0, 1, 0, 0.5, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    double[] to = (double[])from.Clone(), flat = { 0.5, 1, 0, 0, 1, 0 }, flatTo = { 0.5, -1, 0, 0, 1, 0 };
    to[2] = to[14] = to[17] = -2;
    to[26] = -1;
    PairTouch[] touches = Library.SweepPairs(3, kinds, from, to, Library.PAIRS_RANK);
    True(touches.Select(touch => touch.Time).SequenceEqual(new[] { 1 / 3.0, 1 / 3.0, 0.5 }));
    True(touches.Select(touch => touch.Rank).SequenceEqual(new uint[] { 0, 0, 2 }) && touches.All(touch => touch.Touches == 1));
    to[2] = -2 + Math.Pow(2, -52); // later, by so little that the rounded time is the same
    Library.SweepPairs(3, kinds, from, to, touches, Library.PAIRS_RANK, new Context(2, null));
    True(touches.Select(touch => touch.Rank).SequenceEqual(new uint[] { 1, 0, 2 }) && touches[0].Time == 1 / 3.0);
    True(Library.SweepPairs(2, new[] { plane }, flat, flatTo)[0].Time == 0.5 && Library.SweepPairs(3, new byte[0], new double[0], new double[0]).Length == 0);
    double[] halfTurn = { 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }, wall = { 0, -5, 3, -9, 3, 9 };
    Same(0.25, Library.SweepRigidPairs(2, new[] { plane }, wall, new double[0], halfTurn, new uint[] { 0, uint.MaxValue })[0].Time);
    Throws<UnsupportedException>(() => Library.SweepPairs(3, new[] { face, plane, edge }, from, to));
    WrongSize("from has 18 entries, not 9", () => Library.SweepPairs(2, kinds, from, to));
    WrongSize("to has 8 entries, not 12", () => Library.SweepPairs(3, kinds, from, new double[24]));
    to[5] = double.NaN;
    Throws<NonFiniteException>(() => Library.SweepPairs(3, kinds, from, to));
  }

  // One hexahedron with its floor at a height.
  static double[] Room(double z) { return new[] { 0, 0, z, 4, 0, z, 4, 4, z, 0, 4, z, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4 }; }
  static Environment MakeRoom() { return new Environment(Room(0), new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron); }
  static double[] Strand(double x, double z = 1) { return new[] { x, 1, z, x, 2, z, x, 3, z }; }
  static double[] Strands(double x, double other) { return Strand(x).Concat(Strand(other)).ToArray(); }
  static readonly uint[] edgesOfStrand = { 0, 1, 1, 2 };
  const uint deformingContacts = Library.FEATURE_BODY_CONTACTS | Library.FEATURE_DEFORMING;

  public static void StrandsThatMoveTogetherDoNotStopEachOther()
  {
    using (Environment environment = MakeRoom())
    using (Scene scene = new Scene(environment, deformingContacts))
    {
      Body left = scene.CreateBody(Strand(1), edgesOfStrand), right = scene.CreateBody(Strand(1.25), edgesOfStrand);
      BodyId[] both = { left.Id(), right.Id() };
      MoveReport[] reports = scene.MoveTogether(both, Strands(2, 2.25));
      True(reports.All(report => report.Fraction == 1) && left.GetPositions().SequenceEqual(Strand(2)));
      reports = scene.MoveTogether(both, Strands(3, 5), new TogetherOptions { Stop = TogetherStop.Feature, MaxRounds = 4 });
      True(reports[0].VerticesStopped == 0 && reports[1].VerticesStopped == 3 && left.GetPositions().SequenceEqual(Strand(3)));
      // One vertex at a time the left strand runs into the right one.
      scene.MoveTogether(both, Strands(1, 1.25));
      scene.MoveBodies(both, Strands(2, 2.25), null, reports);
      True(reports[0].VerticesStopped == 3 && reports[1].VerticesStopped == 0);
    }
  }

  public static void AFloorStopsBeforeAStrandOrRisesWithIt()
  {
    using (Environment environment = MakeRoom())
    using (Scene scene = new Scene(environment, deformingContacts))
    {
      Body body = scene.CreateBody(Strand(2), edgesOfStrand);
      DeformReport report = scene.Deform(Room(2));
      True(report.Outcome == DeformOutcome.Fraction && report.Fraction < 0.5 && report.Fraction > 0.4999999 && report.ContactCount > 0);
      True(environment.GetWallContacts().All(contact => contact.Time == 0.5 && contact.Body.Index == body.Id().Index));
      MoveReport[] reports = new MoveReport[1]; // integers are long beside the least double
      report = scene.Deform(Room(2), new[] { body.Id() }, Strand(double.Epsilon), new SceneDeformOptions { MaxWork = 1 }, reports);
      True(report.Outcome == DeformOutcome.Limited && reports[0].VerticesLimited == 3 && body.GetPositions().SequenceEqual(Strand(2)));
      report = scene.Deform(Room(1.5), new[] { body.Id() }, Strand(2, 2), null, reports);
      True(report.Outcome == DeformOutcome.Done && reports[0].Fraction == 1 && body.GetPositions().SequenceEqual(Strand(2, 2)));
    }
  }

  public static void WrongMovesTogetherAreRefused()
  {
    using (Environment environment = MakeRoom())
    using (Scene scene = new Scene(environment, deformingContacts))
    {
      Body body = scene.CreateBody(Strand(2), edgesOfStrand);
      BodyId[] one = { body.Id() }, twice = { body.Id(), body.Id() };
      WrongSize("target_count is 1, there are 3", () => scene.MoveTogether(one, new double[3]));
      WrongSize("target_count is 1, there are 3", () => scene.Deform(Room(1), one, new double[3]));
      WrongSize("point_count is 3", () => scene.Deform(Strand(2)));
      Throws<DuplicateIdException>(() => scene.MoveTogether(twice, Strands(2, 2)));
      Throws<NonFiniteException>(() => scene.MoveTogether(one, Strand(double.NaN)));
      Throws<NonFiniteException>(() => scene.Deform(Room(1), one, Strand(double.NaN)));
      Throws<StaleIdException>(() => scene.MoveTogether(new[] { new BodyId { Index = 5, Generation = 1 } }, Strand(2)));
    }
    using (Environment environment = MakeRoom())
    using (Scene scene = new Scene(environment, 0))
      Throws<NotEnabledException>(() => scene.Deform(Room(1)));
  }

  public static void NearRowsSayWhereABodyIsClose()
  {
    double[] points = new double[54];
    for (int i = 0; i < 18; ++i)
    {
      points[3 * i] = i % 3;
      points[3 * i + 1] = i / 3 % 3;
      points[3 * i + 2] = i / 9;
    }
    int[] cells = new int[32], corners = { 0, 1, 4, 3, 9, 10, 13, 12 };
    for (int i = 0; i < 32; ++i) cells[i] = corners[i % 8] + i / 8 % 2 + 3 * (i / 16);
    double[] from = { 0.25, 1.5, 0.375, 1.5, 0.25, 0.375 }, to = { 0.265625, 1.5, 0.375, 1.515625, 0.25, 0.375 };
    double half = Math.Sqrt(0.5);
    using (Environment environment = new Environment(points, cells, CellType.Hexahedron, new[] { 1, 1, 1, 2 }))
    using (Scene scene = new Scene(environment, 0))
    {
      environment.MarkRegion(2, Mark.Impassable); // a pillar, whose edge is at x = y = 1
      Body wire = scene.CreateBody(from, new uint[] { 0, 1 });
      Same(0, wire.GetNearRows().Length);
      NearRow[] rows = wire.FindNearRows(0.25, 0.0625, Library.NEAR_JACOBIAN);
      Same(3, rows.Length);
      Same(0.25, rows[0].Distance);
      Same(0.1875, rows[0].Gap);
      Same(1.0, rows[0].Normal.X);
      True(rows[1].Vertices0 == 1 && rows[1].Vertices1 == uint.MaxValue);
      Same(CellKind.Edge, rows[2].Obstacle.Kind);
      True(Math.Abs(rows[2].Distance - half / 4) < 1e-15);
      True(Math.Abs(rows[2].Normal.X + half) < 1e-15 && Math.Abs(rows[2].Normal.Y + half) < 1e-15);
      True(rows[2].Weights.X == 0.5 && rows[2].Weights.Y == 0.5 && rows[2].ObstaclePoint.Z == 0.375);
      True(rows[2].Body.IsNull && !rows[2].Wall.IsNull);
      True(wire.GetNearOffsets().SequenceEqual(new uint[] { 0, 3, 6, 12 }));
      True(wire.GetNearColumns().SequenceEqual(new uint[] { 0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5 }));
      True(wire.GetNearValues().Take(6).SequenceEqual(new double[] { 1, 0, 0, 0, 1, 0 }));
      wire.Move(to);
      NearRow[] next = wire.FindNearRows(0.25, 0.0625);
      Same(3, next.Length);
      for (int i = 0; i < 3; ++i)
        True(rows[i].Key0 == next[i].Key0 && rows[i].Key2 == next[i].Key2 && rows[i].Key3 == next[i].Key3 && next[i].Previous == i);
      Same(0.265625, next[0].Distance);
      Same(0, wire.GetNearOffsets().Length);
      Throws<OutOfRangeException>(() => wire.FindNearRows(-1));
    }
  }

  public static void AThickBodyKeepsItsRadius()
  {
    double[] points = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1 };
    double[] from = { 0.25, 0.5, 0.5, 0.75, 0.5, 0.5 };
    using (Environment environment = new Environment(points, new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron))
    using (Scene scene = new Scene(environment, 0))
    {
      Body wire = scene.CreateBody(from, new uint[] { 0, 1 }, null, new BodyDesc { Radius = 0.1 });
      Same(0.1, wire.GetRadius());
      Throws<OutOfRangeException>(() => wire.SetRadius(-1));
      Throws<OutOfRangeException>(() => wire.FindLeastGap(double.NaN));
      wire.SetRadius(0.125);
      Same(0.125, wire.GetRadius());
      Same(0.0625, wire.FindLeastGap(0.0625));
      True(Math.Abs(wire.FindLeastGap(1) - 0.125) < 1e-8, "the gap of a thicker wire");
      Throws<OccupiedException>(() => wire.SetRadius(0.5));
      True(scene.GetOffendingEdges().SequenceEqual(new uint[] { 0, 1 }));
      wire.SetRadius(0.1);
      True(Math.Abs(wire.FindLeastGap(1) - 0.15) < 1e-8, "the gap");
      wire.Move(new[] { 0.25, 0.5, -0.5, 0.75, 0.5, -0.5 });
      True(Math.Abs(wire.GetPositions()[2] - 0.1) < 1e-3, "the place");
      True(wire.FindLeastGap(0.1) >= -1e-9, "the gap after a move");
      Throws<OccupiedException>(() => scene.CreateBody(from, new uint[] { 0, 1 }, null, new BodyDesc { Radius = 0.3 }));
    }
  }

  public static void ArgumentsOfTheWrongShapeAreRefused()
  {
    using (Environment environment = Scenario.Create())
    {
      Throws<WrongSizeException>(() => environment.CastSegments(new double[4], new double[4]));
      Throws<WrongSizeException>(() => environment.CastSegments(new double[3], new double[6]));
      Throws<ArgumentException>(() => new RigidMotion().Rotation = new double[3]);
      Throws<ArgumentException>(() => new Scene(null));
      using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
      {
        Throws<ArgumentNullException>(() => environment.Deform(null));
        Throws<WrongSizeException>(() => environment.Deform(new double[4]));
      }
    }
  }

  public static void ClosingTwiceIsFine()
  {
    Environment environment = Scenario.Create();
    Scene scene = new Scene(environment);
    scene.Dispose();
    scene.Dispose();
    environment.Dispose();
    environment.Dispose();
    True(scene.IsClosed() && environment.IsClosed());
  }

  public static void UseAfterDisposeIsAnException()
  {
    Environment environment = Scenario.Create();
    Scene scene = new Scene(environment);
    Body body = Scenario.CreateCatheter(scene);
    ParticleId particle = scene.CreateParticle(inside);
    scene.Dispose();
    Action[] calls = { () => body.GetPositions(), () => body.Move(new double[36]), () => scene.Save(),
      () => scene.MoveParticle(particle, inside), () => scene.CreateParticle(inside) };
    foreach (Action call in calls) Same("the scene is closed", Throws<ClosedException>(call).Message);
    environment.Dispose();
    calls = new Action[] { () => environment.Save(), () => environment.Cast(inside, inside), () => new Scene(environment) };
    foreach (Action call in calls) Same("the environment is closed", Throws<ClosedException>(call).Message);
  }

  // Not inlined, and on a thread of its own: mono's collector takes what it finds on the stack for references.
  static T OnAnotherThread<T>(Func<T> make)
  {
    T made = default(T);
    Thread thread = new Thread(() => made = make());
    thread.Start();
    thread.Join();
    return made;
  }

  static void Collect()
  {
    for (int i = 0; i < 3; ++i)
    {
      GC.Collect();
      GC.WaitForPendingFinalizers();
    }
  }

  public static void ASceneKeepsItsEnvironment()
  {
    Scene scene = OnAnotherThread(() =>
    {
      Environment environment = Scenario.Create();
      Scene made = new Scene(environment);
      environment.Dispose();
      return made;
    });
    Collect();
    Same(Outcome.Reached, scene.MoveParticle(scene.CreateParticle(inside), new Vec3(24, 24, 50)).Outcome);
    scene.Dispose();
  }

  public static void ABugReportIsOneCall()
  {
    string path = Path.GetTempFileName();
    using (Environment environment = Scenario.Create())
    using (Scene scene = new Scene(environment))
    {
      scene.StartRecording(null, Library.RECORDING_LATEST);
      scene.CreateParticle(inside);
      Validation validation = scene.WriteBugReport(path, "a note");
      Same(1u, validation.IsRight);
      Same("", validation.Text);
      scene.StopRecording();
    }
    True(File.ReadAllText(path).Contains("a note"));
    File.Delete(path);
  }

  public static void ABodyKeepsItsSceneAndCanBeDestroyed()
  {
    Body body = OnAnotherThread(() => Scenario.CreateCatheter(new Scene(Scenario.Create())));
    Collect();
    Same(36, body.GetPositions().Length);
    body.Destroy();
    Throws<StaleIdException>(body.Destroy);
    Throws<StaleIdException>(() => body.GetPositions());
  }

  public static void WhatIsForgottenIsGivenBack()
  {
    using (Environment environment = Scenario.Create())
    {
      // Two scenes that are open forbid marks.
      OnAnotherThread(() =>
      {
        Scene[] both = { new Scene(environment), new Scene(environment) };
        Throws<SharedException>(() => environment.MarkRegion(1, Mark.Impassable));
        return both[0].IsClosed() || both[1].IsClosed();
      });
      Collect();
      environment.MarkRegion(1, Mark.Impassable);
    }
  }

  public static void LentPositionsAreReadInPlace()
  {
    using (Environment environment = Scenario.Create())
    {
      double[] first = environment.GetPoints(), second = environment.GetPoints();
      using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
      {
        environment.Deform(first);
        Throws<InUseException>(() => environment.Deform(first));
        for (int i = 2; i < second.Length; i += 3) second[i] += 0.25;
        environment.Deform(second);
        Collect();
        second[0] = 1.5; // it is read, not copied
        Same(1.5, environment.GetPoints()[0]);
      }
    }
  }

  public static void LentPositionsAreLetGo()
  {
    using (Environment environment = Scenario.Create())
    using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
    {
      WeakReference first = OnAnotherThread(() =>
      {
        double[] next = environment.GetPoints();
        environment.Deform(next);
        return new WeakReference(next);
      });
      Collect();
      True(OnAnotherThread(() => first.IsAlive), "held while it is lent");
      environment.Deform(environment.GetPoints());
      bool alive = true;
      for (int i = 0; alive && i < 100; ++i)
      {
        Collect();
        alive = OnAnotherThread(() => first.IsAlive);
      }
      True(!alive, "let go after the next");
    }
  }

  public static void ThreadsMayCallAndCloseAsTheyLike()
  {
    double[] start = new double[3 * 500], points = new double[3 * 500];
    for (int i = 0; i < points.Length; ++i)
    {
      points[i] = 10 + i * 7919 % 2800 / 100.0;
      start[i] = i % 3 == 2 ? 48 : 24;
    }
    ConcurrentQueue<Exception> problems = new ConcurrentQueue<Exception>();
    using (Environment environment = Scenario.Create())
    {
      for (int round = 0; round < 3; ++round)
      {
        Scene scene = new Scene(environment);
        ParticleId[] particles = scene.CreateParticles(start);
        List<Thread> threads = Enumerable.Range(0, 8).Select(number => new Thread(() =>
        {
          try
          {
            for (int i = 0; i < 30; ++i)
            {
              if (number == 0 && i == 20) scene.Dispose();
              if (number % 2 == 1) scene.MoveParticles(particles, points);
              else
              {
                environment.CastSegments(points, start);
                scene.GetParticlePosition(particles[i]);
              }
            }
          }
          catch (ClosedException)
          {
            // by thread 0
          }
          catch (Exception problem)
          {
            problems.Enqueue(problem);
          }
        })).ToList();
        threads.ForEach(thread => thread.Start());
        threads.ForEach(thread => thread.Join());
        True(scene.IsClosed());
      }
    }
    True(problems.IsEmpty, string.Join("\n", problems));
  }

  public static void AChangeOutlastsTheNext()
  {
    Environment environment = Scenario.Create();
    Change first = environment.Cut(new[] { -5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25 }, 2, 2);
    True(first.VolumesCrossed == 36 && first.VolumesSplit == 24 && first.VolumesChanged == 36 && first.IsClosed == 0);
    Same(first.Distance, environment.GetChange().Distance);
    VolumeId volume = environment.GetVolumeId(3);
    environment.RemoveVolumes(new[] { volume });
    Change second = environment.GetChange();
    True(second.VolumesSplit == 0 && second.GetVolumes().Length == 1 && second.GetFaces().Length == 0);
    True(second.GetVolumes()[0].Before.Equals(volume) && second.GetVolumes()[0].After.IsNull);
    environment.Dispose();
    Collect();
    True(first.GetVolumes().Length == 60 && first.GetVertices().Length == 35);
    True(first.GetFaces().Length == 24 && first.GetWhole().Length == 12);
    True(first.GetCarved().Length == 0 && first.GetUnrepaired().Length == 0 && first.GetDetached().Length == 0);
    VertexOrigin origin = first.GetVertices()[0];
    True(origin.Weights0 + origin.Weights1 == 1 && !origin.From0.Equals(origin.From1));
  }

  public static void EachReportSaysWhatWasTouched()
  {
    using (Environment environment = Scenario.Create())
    using (Scene scene = new Scene(environment, Library.FEATURE_DEFORMING))
    {
      environment.MarkRegion(2, Mark.Impassable);
      Contact contact = environment.Cast(inside, new Vec3(90, 24, 48)).Contact;
      Same(ContactKind.Plane, contact.Kind);
      Same(CellKind.Volume, contact.MarkedKind);
      Same(Library.CellOf(contact.Wall), contact.Obstacle);
      True(environment.IsImpassable(Library.CellOf(contact.Behind)));
      Same(ContactKind.None, environment.Cast(inside, new Vec3(24, 24, 50)).Contact.Kind);
      Body body = Scenario.CreateCatheter(scene);
      BodyEdgeId edge = body.GetEdgeIds()[0];
      Same(0.25, body.SplitEdge(edge, 0.25).EdgeParameter);
      Same(2, body.GetEdgeEnds(edge).Length);
      double[] next = environment.GetPoints();
      for (int i = 0; i < next.Length; i += 3) next[i] += (48 - next[i]) * 0.4375;
      Same(environment.Deform(next).ContactCount, (uint)environment.GetWallContacts().Length);
      WallContact touched = environment.GetWallContacts()[0];
      Same(body.Id(), touched.Body);
      True(touched.Contact.Normal.X > 0.9 && touched.Contact.Obstacle.Kind != CellKind.None);
      True(touched.Response == WallResponse.Push && environment.GetHeldVertices().Length == 0);
    }
  }

  public static void TheLogIsADelegate()
  {
    List<string> lines = new List<string>();
    double[] points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    int[] cell = { 0, 1, 2, 3 };
    using (new Environment(points, cell, CellType.Tetra, null, new Context(2, (level, text) => lines.Add(level + " " + text))))
    {
      Same(1, lines.Count);
      True(lines[0].StartsWith("Info dsw_environment_create: 1 volumes"), lines[0]);
    }
    new Environment(points, cell, CellType.Tetra, null, new Context(1, (level, text) => { throw new Exception("dropped"); })).Dispose();
    new Environment(points, cell, CellType.Tetra, null, new Context()).Dispose();
  }

  public static void MembersAreValues()
  {
    RigidMotion motion = new RigidMotion { Translation = new double[] { 1, 2, 3 } };
    Same(2.0, motion.Translation[1]);
    Same(new VolumeId(3, 4), new VolumeId(3, 4));
    True(default(FaceId).IsNull && !new FaceId(0, 1, 0).IsNull);
  }

  public static void TheBaseLibraryIsAllItNeeds()
  {
    foreach (AssemblyName needed in typeof(Environment).Assembly.GetReferencedAssemblies())
      True(needed.Name == "mscorlib" || needed.Name == "System" || needed.Name == "System.Core", needed.Name);
  }

  public static void VersionIsThatOfTheHeaders()
  {
    Same((uint)(1000000 * Library.VERSION_MAJOR + 1000 * Library.VERSION_MINOR + Library.VERSION_PATCH), Library.Version());
  }
}

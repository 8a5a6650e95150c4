// Tests of meshes whose parts lie on each other.
using System;
using System.Linq;
using Dartsweep;
using Environment = Dartsweep.Environment;

static partial class Tests
{
  /// Cubes with points of their own; each is x, y, z and a width.
  static Environment CreateCubes(uint flags, double distance, params double[][] cubes)
  {
    int[,] corners = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
    double[] points = new double[24 * cubes.Length];
    int[] cells = Enumerable.Range(0, 8 * cubes.Length).ToArray();
    for (int i = 0; i < points.Length; ++i) points[i] = cubes[i / 24][i % 3] + cubes[i / 24][3] * corners[i / 3 % 8, i % 3];
    return new Environment(points, cells, null, null, null, null, null, null, new EnvironmentDesc { Flags = flags, MergeDistance = distance }, null);
  }

  public static void ParticlesAndVerticesLeave()
  {
    using (Environment environment = CreateCubes(0, 0, new[] { 0.0, 0, 0, 1 }))
    using (Scene scene = new Scene(environment))
    {
      FaceId top = environment.Cast(new Vec3(0.5, 0.5, 0.5), new Vec3(0.5, 0.5, 3)).Contact.Wall;
      environment.MarkExits(new[] { top }, 6);
      Same(6u, environment.GetExit(top));
      Same(1, environment.GetExitFaces().Length);
      ParticleId particle = scene.CreateParticle(new Vec3(0.25, 0.25, 0.5));
      Same(Outcome.Exit, scene.MoveParticle(particle, new Vec3(0.25, 0.25, 2.5), new CastOptions { Flags = Library.CAST_LEAVE }).Outcome);
      Same(0, (int)scene.GetParticleCount());
      Same(6u, scene.GetExits()[0].Patch);
      Same(0.25, scene.GetExits()[0].Time);
      Body rod = scene.CreateBody(new[] { 0.25, 0.5, 0.25, 0.25, 0.5, 0.75 }, new uint[] { 0, 1 }, null, new BodyDesc());
      rod.Move(new[] { 0.25, 0.5, 0.75, 0.25, 0.5, 1.25 }, new MoveOptions { Flags = Library.MOVE_LEAVE });
      Same(1u, rod.GetExits()[0].Vertex.Index);
    }
  }

  public static void BodiesThatPenetrateAreFreed()
  {
    using (Environment environment = CreateCubes(0, 0, new[] { 0.0, 0, 0, 1 }))
    using (Scene scene = new Scene(environment))
    {
      double[] line = { 0.25, 0.5, 0.5, 0.75, 0.5, 0.5, 1.25, 0.5, 0.5 };
      uint[] edges = { 0, 1, 1, 2 };
      Throws<OutsideException>(() => scene.CreateBody(line, edges, null, new BodyDesc()));
      Body wire = scene.CreateBody(line, edges, null, new BodyDesc { Flags = Library.BODY_START_PENETRATING });
      True(wire.IsPenetrating(), "a wire that begins crossed");
      Same(1, wire.FindPenetrations().Length);
      Same(1u, wire.FindPenetrations()[0].Part.Edge.Index);
      Throws<OccupiedException>(() => wire.Move(line));
      True(!wire.Depenetrate(new VolumeId(), 0.125).Freed, "a way that is too long");
      Depenetration made = wire.Depenetrate();
      True(made.Freed && made.Distance >= 0.25 && made.Distance <= 0.5, "the way out");
      True(!wire.IsPenetrating(), "a wire that is free");
      Same(0, wire.FindPenetrations().Length);
    }
  }

  public static void ThreadsAreCut()
  {
    using (Environment environment = CreateCubes(0, 0, new[] { 0.0, 0, 0, 1 }))
    using (Scene scene = new Scene(environment))
    {
      Body thread = scene.CreateBody(new[] { 0.25, 0.5, 0.5, 0.75, 0.5, 0.5 }, new uint[] { 0, 1 }, null, new BodyDesc());
      double[] blade = { 0.375, 0, 0, 0.375, 0, 1, 0.375, 1, 0, 0.375, 1, 1 };
      Same(1, (int)scene.CutBodies(blade, 2, 2));
      Same(0.25, scene.GetBodyCuts()[0].EdgeParameter);
      Same(thread.Id().Index, scene.GetBodyCuts()[0].Body.Index);
      Same(0, (int)scene.CutBodies(blade, 2, 2));
      Same(2u, thread.GetCounts().EdgeCount);
    }
  }

  public static void RaysMeetBodies()
  {
    using (Environment environment = CreateCubes(0, 0, new[] { 0.0, 0, 0, 1 }))
    using (Scene scene = new Scene(environment, Library.FEATURE_BODY_CONTACTS))
    {
      double[] corners = { 0.25, 0.25, 0.5, 0.75, 0.25, 0.5, 0.25, 0.75, 0.5 };
      Body leaf = scene.CreateBody(corners, null, new uint[] { 0, 1, 2 }, new BodyDesc { Level = Level.Faces });
      ContactPartner[] partners;
      Flight[] flights = scene.Cast(new[] { 0.3, 0.3, 0.75, 0.9, 0.9, 0.75 }, new[] { 0.3, 0.3, 0.25, 0.9, 0.9, 0.25 }, out partners);
      Same(0.5, flights[0].Time);
      Same(leaf.Id().Index, partners[0].Body.Index);
      Same(Outcome.Reached, flights[1].Outcome);
      Same(0.125, scene.FindNearest(new[] { 0.3, 0.3, 0.625 }, 1, out partners)[0].Distance);
      Same(1u, partners[0].Face.Generation);
      double[] distances = new double[2];
      environment.FindSignedDistances(new[] { 0.5, 0.5, 0.75, 0.5, 0.5, 3 }, distances, null);
      Same(-0.25, distances[0]);
      Same(2.0, distances[1]);
      CastOptions open = new CastOptions { Flags = Library.CAST_OPEN_ENDS };
      Same(Outcome.Reached, scene.Cast(new[] { 0.0, 0.5, 0.75 }, new[] { 1, 0.5, 0.75 }, out partners, open)[0].Outcome);
    }
  }

  public static void PartsThatTouchAreCountedAndSewn()
  {
    double[][] cubes = { new[] { 0.0, 0, 0, 1 }, new[] { 1, 0, 0, 0.5 }, new[] { 1, 0.5, 0, 0.5 }, new[] { 1, 0, 0.5, 0.5 }, new[] { 1, 0.5, 0.5, 0.5 } };
    using (Environment environment = CreateCubes(Library.ENVIRONMENT_FIND_TOUCHING, 0, cubes))
    {
      BuildReport report = environment.BuildReport();
      Same(13u, report.TouchingFaceCount);
      Same(0u, report.TouchingFace.Volume);
      Same(1u, report.TouchedFace.Volume);
    }
    using (Environment environment = CreateCubes(Library.ENVIRONMENT_CONFORM | Library.ENVIRONMENT_FIND_TOUCHING, 0, cubes))
    {
      BuildReport report = environment.BuildReport();
      Same(1u, report.PartCount);
      Same(1u, report.ChangedCount);
      Same(0u, report.TouchingFaceCount);
      Same(Outcome.Reached, environment.Cast(new Vec3(0.25, 0.5, 0.5), new Vec3(1.375, 0.375, 0.25)).Outcome);
    }
    double[][] near = { new[] { 0.0, 0, 0, 1 }, new[] { 1 + 1e-10, 0, 0, 1 } };
    using (Environment environment = CreateCubes(Library.ENVIRONMENT_MERGE_POINTS, 1e-9, near))
      Same(4u, environment.BuildReport().MergedPointCount);
    Throws<NotConformingException>(() => CreateCubes(Library.ENVIRONMENT_CONFORM, 0, cubes[0], new[] { 1, 0.25, 0.25, 1 }));
  }
}

// Tests of rigid motions: how far bodies could go. And of what touches while all vertices move at once.
using System;
using System.Linq;
using Dartsweep;
using Environment = Dartsweep.Environment;

static partial class Tests
{
  public static void FreeFractionsMoveNothing()
  {
    double[] points = { 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4 }, bar = { 1, 2, 2, 3, 2, 2 };
    double[] poses = { 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 4, 0, 0 };
    using (Environment environment = new Environment(points, new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron))
    using (Scene scene = new Scene(environment))
    {
      Body body = scene.CreateBody(bar, new uint[] { 0, 1 });
      FreeFraction[] found = body.FindFreeFractions(new Vec3(2, 2, 2), poses, new uint[] { 0, 1, 0, 0, 2, 2 }, new uint[] { 0, 3, 5, 6 });
      True(found[0].Fraction == 1 && found[0].Piece == 2 && found[2].StartsFree == 0);
      True(found[1].Fraction < 0.25 && found[1].Fraction > 0.25 - 1e-12 && body.GetPositions().SequenceEqual(bar));
      Throws<WrongSizeException>(() => body.FindFreeFractions(new Vec3(2, 2, 2), bar, new uint[] { 0, 0 }));
    }
  }

  public static void ABarSlidesAlongAWall()
  {
    double[] points = { 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4 }, bar = { 1, 2, 2, 3, 2, 2 };
    using (Environment environment = new Environment(points, new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron))
    using (Scene scene = new Scene(environment))
    {
      Body body = scene.CreateBody(bar, new uint[] { 0, 1 });
      RigidMotion motion = new RigidMotion { Rotation = new double[] { 0, 0, 0, 1 }, Translation = new double[] { 4, 1, 0 } };
      True(body.MoveRigid(motion, new MoveOptions { Flags = Library.MOVE_SLIDE_WHOLE }).Fraction < 0.25);
      True(Math.Abs(body.GetPositions()[3] - 4) < 1e-9 && Math.Abs(body.GetPositions()[4] - 3) < 1e-9);
      True(Math.Abs(body.GetMotionLeft().Translation[0] - 3) < 1e-9);
    }
  }

  public static void RigidBodiesMoveAtOnce()
  {
    double[] points = { 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4 };
    using (Environment environment = new Environment(points, new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron))
    using (Scene scene = new Scene(environment, Library.FEATURE_BODY_CONTACTS))
    {
      Body left = scene.CreateBody(new[] { 0.5, 2, 2, 1, 2, 2 }, new uint[] { 0, 1 }), right = scene.CreateBody(new[] { 3, 2, 2, 3.5, 2, 2 }, new uint[] { 0, 1 });
      double[] motions = { 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0 };
      MoveReport[] reports = scene.MoveRigid(new[] { left.Id(), right.Id() }, motions);
      True(reports[0].Fraction < 0.25 && reports[0].Fraction > 0.25 - 1e-12 && reports[0].Fraction == reports[1].Fraction);
    }
  }

  public static void ThickRigidBodiesKeepTheirDistanceAtOnce()
  {
    using (Environment environment = MakeRoom())
    using (Scene scene = new Scene(environment, Library.FEATURE_BODY_CONTACTS))
    {
      BodyDesc thick = new BodyDesc { Radius = 0.125 };
      Body left = scene.CreateBody(new[] { 0.5, 2, 2, 1, 2, 2 }, new uint[] { 0, 1 }, null, thick);
      Body right = scene.CreateBody(new[] { 3, 2, 2, 3.5, 2, 2 }, new uint[] { 0, 1 }, null, thick);
      double[] motions = { 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0 };
      MoveReport[] reports = scene.MoveRigid(new[] { left.Id(), right.Id() }, motions);
      True(Math.Abs(reports[0].Fraction - 0.21875) < 1e-9 && reports[0].Fraction == reports[1].Fraction);
    }
  }

  public static void ABarTurnsWhileTheFloorRises()
  {
    using (Environment environment = MakeRoom())
    using (Scene scene = new Scene(environment, deformingContacts))
    {
      Body bar = scene.CreateBody(new double[] { 1, 2, 2, 3, 2, 2 }, new uint[] { 0, 1 });
      double half = Math.Sqrt(0.5);
      BodyId[] bars = { bar.Id() };
      MoveReport[] reports = new MoveReport[1];
      DeformReport report = scene.DeformRigid(Room(3), bars, new[] { 0, 0, half, half, 2, 2, 2, 0, 0, 0 }, null, reports);
      True(report.Outcome == DeformOutcome.Fraction && Math.Abs(report.Fraction - 2.0 / 3) < 1e-9);
      True(reports[0].Fraction == report.Fraction && Math.Abs(environment.GetWallContacts()[0].Time - 2.0 / 3) < 1e-12);
      Throws<WrongSizeException>(() => scene.DeformRigid(Room(3), bars, new double[4]));
    }
  }

  public static void HowMuchOfStepsIsFree()
  {
    double[] points = { 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4 }, bar = { 1, 2, 2, 1, 3, 2 }, places = new double[6];
    using (Environment environment = new Environment(points, new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron))
    using (Scene scene = new Scene(environment))
    {
      Body body = scene.CreateBody(bar, new uint[] { 0, 1 });
      double[] steps = { 4, 0, 0, 4, 0, 0 };
      double fraction = scene.StepFraction(new[] { body.Id() }, steps);
      True(fraction < 0.75 && fraction > 0.7499999 && fraction == scene.StepFraction(new[] { body.Id() }, steps, null, places));
      True(places[0] == 1 + fraction * 4 && body.GetPositions().SequenceEqual(bar));
    }
  }

  public static void OnlyThePartsThatTouchStopOrArePushed()
  {
    foreach (TogetherResponse response in new[] { TogetherResponse.Stop, TogetherResponse.Slide })
    {
      using (Environment environment = MakeRoom())
      using (Scene scene = new Scene(environment, deformingContacts))
      {
        Body body = scene.CreateBody(Strand(2), edgesOfStrand);
        MoveReport[] reports = new MoveReport[1];
        SceneDeformOptions options = new SceneDeformOptions { Stop = TogetherStop.Feature, Response = response };
        DeformReport report = scene.Deform(Room(2), new[] { body.Id() }, Strand(2), options, reports);
        True(report.Outcome == (response == TogetherResponse.Stop ? DeformOutcome.Held : DeformOutcome.Done));
        True(report.HeldCount == environment.GetHeldVertices().Length && reports[0].Fraction == 0.5);
        True(Math.Abs(body.GetWaysLeft()[2] + (response == TogetherResponse.Stop ? 0 : 1)) < 1e-9);
      }
    }
  }

  public static void BackEdgesThatAreLeftAreListed()
  {
    double[] points = { 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4 };
    double[] corners = { 1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 1, 2 }, inwards = { 1, 1, 1, 2, 1, 1, 1, 2, 1, 1.1, 1.1, 1.7 };
    BodyDesc desc = new BodyDesc { Level = Level.Edges, Flags = Library.BODY_SKIP_BACK_EDGES | Library.BODY_LEAVE_BACK_EDGES };
    using (Environment environment = new Environment(points, new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, CellType.Hexahedron))
    using (Scene scene = new Scene(environment))
    {
      Body body = scene.CreateBody(corners, null, new uint[] { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 }, desc);
      Same(0, body.GetUntestedEdges().Length);
      body.Move(inwards);
      Same(3, body.GetUntestedEdges().Length);
      body.Move(corners);
      Same(0, body.GetUntestedEdges().Length);
      ParticleId particle = scene.CreateParticle(new Vec3(2, 2, 2));
      True(scene.GetParticleCell(particle).Kind == CellKind.Volume && scene.GetParticleAim(particle).Kind == CellKind.None);
      scene.MoveParticle(particle, new Vec3(2, 2, 9));
      Same(CellKind.Face, scene.GetParticleAim(particle).Kind);
    }
  }
}

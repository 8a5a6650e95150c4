// Tests of what is drilled away, and of pieces that come off.
using System.Linq;
using Dartsweep;
using Environment = Dartsweep.Environment;

static partial class Tests
{
  public static void ADrillHalvesWhatItCrosses()
  {
    using (Environment environment = Scenario.Create())
    {
      environment.MarkVolumes(new[] { environment.GetVolumeId(237) }, Mark.Impassable);
      double[] drill = { 29.25, 29.25, 53.25, 29.25, 27.25, 51.25, 27.25, 29.25, 51.25, 27.25, 27.25, 53.25 };
      CarveDesc desc = new CarveDesc { Finest = 1, Flags = (uint)CarveFlag.Cover };
      Change change = environment.Carve(drill, new uint[] { 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2 }, desc);
      True(change.VolumesSplit == 1 && change.GetCarved().Length == 63 && change.GetWhole().Length == 0);
    }
  }

  public static void APieceBecomesABody()
  {
    using (Environment environment = Scenario.Create())
    using (Scene scene = new Scene(environment))
    {
      VolumeId volume = environment.GetVolumeId(237);
      environment.MarkVolumes(new[] { volume }, Mark.Impassable);
      Body body = scene.Body(environment.Detach(new DetachDesc { Volume = volume }));
      Change change = environment.GetChange();
      Same(8u, body.GetCounts().VertexSlots);
      True(change.GetBodyVertices().Length == 8 && change.GetBodyFaces().Length == 12 && change.Distance > 0);
      True(change.GetDetached().Single().Equals(volume) && change.GetBodyFaces()[0].Volume.Equals(volume));
      VertexOrigin origin = change.GetBodyVertices()[7];
      True(origin.Vertex.IsNull && !origin.From0.IsNull && origin.From0.Equals(origin.From1));
      True(origin.Weights0 == 1 && origin.Weights1 == 0);
    }
  }
}

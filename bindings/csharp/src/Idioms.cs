// What C#'s users expect beyond the shared methods and those of Fillers.cs, which are made: points are x, y, z of each, in the plane x, y.

namespace Dartsweep
{
  public sealed unsafe partial class Environment
  {
    /// <summary>Of cells of one type: points (x, y, z; x, y of triangles or quads in the plane), and the indices of each cell's points as in VTK; a region for each cell, or
    /// null; threads and log in a context, or null.</summary>
    public Environment(double[] points, int[] cells, CellType type, int[] regions = null, Context context = null)
      : this(points, cells, null, null, regions, null, null, null, Describe(type), context)
    {
    }

    private static EnvironmentDesc Describe(CellType type)
    {
      bool planar = type == CellType.Triangle || type == CellType.Quad || type == CellType.Polygon;
      return new EnvironmentDesc { UniformCellType = (uint)type, Dimension = planar ? 2u : 3u };
    }
  }

  public sealed unsafe partial class Scene
  {
    /// <summary>A scene with features, the sum of Library.FEATURE_ constants.</summary>
    public Scene(Environment environment, uint features) : this(environment, new SceneDesc { Features = features })
    {
    }

    /// <summary>Moves all vertices of bodies to targets, body after body, all at once.</summary>
    public MoveReport[] MoveTogether(BodyId[] bodies, double[] targets, TogetherOptions options = null)
    {
      MoveReport[] reports = new MoveReport[bodies.Length];
      MoveTogether(bodies, targets, options, reports);
      return reports;
    }

    /// <summary>What segments meet first, of walls and bodies, and the body and part that each met.</summary>
    public Flight[] Cast(double[] from, double[] to, out ContactPartner[] partners, CastOptions options = null)
    {
      Flight[] flights = new Flight[from.Length / (int)Dimension()];
      partners = new ContactPartner[flights.Length];
      Cast(from, to, null, options, flights, partners);
      return flights;
    }

    /// <summary>What is nearest to points, of walls and bodies, and the body and part that this is.</summary>
    public Nearest[] FindNearest(double[] points, double radius, out ContactPartner[] partners)
    {
      Nearest[] nearest = new Nearest[points.Length / (int)Dimension()];
      partners = new ContactPartner[nearest.Length];
      FindNearest(points, radius, null, nearest, partners);
      return nearest;
    }

    /// <summary>The largest part of steps, body after body, that is free when all vertices go at once. Nothing moves.</summary>
    public double StepFraction(BodyId[] bodies, double[] steps, TogetherOptions options = null)
    {
      return StepFraction(bodies, steps, options, null);
    }

    /// <summary>Moves bodies, each on a rigid motion of its own, all at once; a motion has 10 numbers: a quaternion x, y, z, w, a centre
    /// and a translation.</summary>
    public MoveReport[] MoveRigid(BodyId[] bodies, double[] motions, TogetherOptions options = null)
    {
      MoveReport[] reports = new MoveReport[bodies.Length];
      MoveRigid(bodies, motions, options, reports);
      return reports;
    }

    /// <summary>A body of vertices; edges are pairs of indices, triangles threes, each null where there are none.</summary>
    public Body CreateBody(double[] positions, uint[] edges, uint[] triangles = null, BodyDesc desc = null)
    {
      uint[] offsets = triangles == null ? null : new uint[triangles.Length / 3 + 1];
      for (uint i = 0; offsets != null && i < offsets.Length; ++i) offsets[i] = 3 * i;
      return Body(CreateBodyId(positions, edges, offsets, triangles, null, desc));
    }

    /// <summary>The body with an id.</summary>
    public Body Body(BodyId id) { return new Body(this, id); }
  }

  public sealed unsafe partial class Body
  {
    /// <summary>Positions of the vertices by index.</summary>
    public double[] GetPositions()
    {
      double[] positions = new double[Dimension() * GetCounts().VertexSlots];
      GetPositions(positions);
      return positions;
    }

    /// <summary>The rows whose gap is at most a margin, in order of their keys; flags are NEAR_ constants.</summary>
    public NearRow[] FindNearRows(double margin, double radius = 0, uint flags = 0)
    {
      FindNearRows(new NearOptions { Margin = margin, Radius = radius, Flags = flags });
      return GetNearRows();
    }

    /// <summary>How far the body could go along paths through poses; nothing moves. A pose has 7 numbers: a quaternion x, y, z, w and a
    /// translation, from where the body is now, round `centre`. A path has two indices of poses, or those from offsets[i] to
    /// offsets[i + 1].</summary>
    public FreeFraction[] FindFreeFractions(Vec3 centre, double[] poses, uint[] indices, uint[] offsets = null)
    {
      FreeFraction[] fractions = new FreeFraction[offsets == null ? indices.Length / 2 : offsets.Length - 1];
      FindFreeFractions(centre, poses, indices, offsets, fractions);
      return fractions;
    }
  }

  public static unsafe partial class Library
  {
    /// <summary>When each of many pairs first touches. A pair has dimension + 1 points; kinds are those of PairKind, flags
    /// PAIRS_ constants.</summary>
    public static PairTouch[] SweepPairs(uint dimension, byte[] kinds, double[] from, double[] to, uint flags = 0)
    {
      PairTouch[] touches = new PairTouch[kinds.Length];
      SweepPairs(dimension, kinds, from, to, touches, flags);
      return touches;
    }

    /// <summary>SweepPairs with features that may turn: 17 numbers for each motion, two indices for each pair. `to` may be
    /// empty: features without a motion stand.</summary>
    public static PairTouch[] SweepRigidPairs(uint dimension, byte[] kinds, double[] from, double[] to, double[] motions,
      uint[] indices, uint flags = 0)
    {
      PairTouch[] touches = new PairTouch[kinds.Length];
      SweepRigidPairs(dimension, kinds, from, to, motions, indices, touches, flags);
      return touches;
    }
  }
}

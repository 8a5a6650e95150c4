// Ids are values; the default one is null and names nothing.
namespace Dartsweep
{
  public partial struct Vec3
  {
    public Vec3(double x, double y, double z)
    {
      X = x;
      Y = y;
      Z = z;
    }

    /// <summary>Of the plane.</summary>
    public Vec3(double x, double y) : this(x, y, 0)
    {
    }

    public override string ToString() { return "(" + X + ", " + Y + ", " + Z + ")"; }
  }

  public partial struct VertexId
  {
    public VertexId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct VolumeId
  {
    public VolumeId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct ParticleId
  {
    public ParticleId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct BodyId
  {
    public BodyId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct BodyVertexId
  {
    public BodyVertexId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct BodyEdgeId
  {
    public BodyEdgeId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct BodyFaceId
  {
    public BodyFaceId(uint index, uint generation)
    {
      Index = index;
      Generation = generation;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct FaceId
  {
    public FaceId(uint volume, uint generation, uint local)
    {
      Volume = volume;
      Generation = generation;
      Local = local;
    }

    public bool IsNull { get { return Generation == 0; } }
  }

  public partial struct EdgeId
  {
    public EdgeId(uint volume, uint generation, uint local)
    {
      Volume = volume;
      Generation = generation;
      Local = local;
    }

    public bool IsNull { get { return Generation == 0; } }
  }
}

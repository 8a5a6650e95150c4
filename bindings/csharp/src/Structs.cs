// Structs of the C interface as they lie in memory, so that arrays of them are used by both sides; tests compare their sizes.
using System.Runtime.InteropServices;

namespace Dartsweep
{
  /// <summary>One point or direction, scene units.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Vec3
  {
    public double X;
    public double Y;
    public double Z;
  }

  /// <summary>A cell of any dimension. For vertices and volumes `index` is theirs and `local` is 0; for faces and edges
  /// `index` is the volume's.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Cell
  {
    public CellKind Kind;
    public uint Index;
    public uint Generation;
    public uint Local;
  }

  /// <summary>A vertex of an environment; index is the point's index at creation.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct VertexId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>A volume of an environment; index is the cell's index at creation.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct VolumeId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>A face: face number `local` of a volume. A face between two volumes has two such names; every report gives
  /// the canonical one, that of the volume with the lower index. Either is accepted. Face numbers follow the VTK order of
  /// the cell type; for polyhedra the order of the face stream.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FaceId
  {
    public uint Volume;
    public uint Generation;
    public uint Local;
  }

  /// <summary>An edge: edge number `local` of a volume, named as faces are. Edge numbers run over the faces in order,
  /// each face's boundary in its order seen from outside, counting an edge when it is first met.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct EdgeId
  {
    public uint Volume;
    public uint Generation;
    public uint Local;
  }

  /// <summary>A particle of a scene.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct ParticleId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>A body of a scene.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>A vertex of a body; index is its place in arrays of targets and positions.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyVertexId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>An edge of a body.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyEdgeId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>A triangle of a body.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyFaceId
  {
    public uint Index;
    public uint Generation;
  }

  /// <summary>Report of one flight from p towards its target. Without a contact the members from `normal` on are zero or
  /// null, but for `volume`.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Flight
  {
    /// <summary>Where it ended. For a particle: the verified position, free and on this side of the wall. For a free
    /// cast: p + time * (target - p), rounded.</summary>
    public Vec3 Position;
    /// <summary>Fraction of the move: 1 when the target was reached. At a contact the largest double that is not later
    /// than the true first time (exact arithmetic decides); at a work limit, not later than the last face
    /// crossed.</summary>
    public double Time;
    /// <summary>Unit normal of the boundary triangle that was hit, pointing out of the obstacle, towards p.</summary>
    public Vec3 Normal;
    /// <summary>The volume it ended in.</summary>
    public VolumeId Volume;
    /// <summary>Canonical id of the face that was hit.</summary>
    public FaceId Face;
    /// <summary>The volume behind that face; null at the outer boundary.</summary>
    public VolumeId Behind;
    public Outcome Outcome;
    public ContactKind Kind;
    /// <summary>What makes it impassable: DSW_CELL_FACE (its own mark, or the outer boundary), or DSW_CELL_VOLUME (the
    /// volume behind is marked and the face is not).</summary>
    public CellKind Obstacle;
    /// <summary>Host tag of the volume behind; at the outer boundary of the volume in front.</summary>
    public uint Tag;
    /// <summary>Volumes entered, the first included; the verification of a stop is not counted.</summary>
    public uint VolumesVisited;
    /// <summary>0; no byte of a report is left undefined.</summary>
    internal uint Reserved0, Reserved1;
  }

  /// <summary>One cell of a flight, in order.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Crossing
  {
    /// <summary>The volume entered.</summary>
    public VolumeId Volume;
    /// <summary>Canonical id of the face it was entered through; null for the first.</summary>
    public FaceId Face;
    /// <summary>When, a fraction of the move, rounded down; 0 for the first.</summary>
    public double Time;
  }

  /// <summary>Report of one swept edge: its end p moves to p', its end q stays. Without a contact `point`, `along`,
  /// `normal` and the members from `front` to `edge`, `kind`, `obstacle` and `tag` are zero or null.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Sweep
  {
    /// <summary>Where the moving end is at `time`: p + time * (p' - p), rounded.</summary>
    public Vec3 Position;
    /// <summary>Fraction of the move: 1 when the edge came through; 0 when it stopped early or could not start. At a
    /// contact the largest double that is not later than the true first time; where the shift alone decides, then its
    /// limit.</summary>
    public double Time;
    /// <summary>Where the edge touches, rounded.</summary>
    public Vec3 Point;
    /// <summary>Where along the edge: 0 the moving end, 1 the fixed one.</summary>
    public double Along;
    /// <summary>Unit, out of the obstacle. DSW_CONTACT_PLANE of the moving end: of the boundary triangle.
    /// DSW_CONTACT_EDGE, and PLANE on a diagonal: across the edge and the obstacle's edge or the diagonal, against the
    /// motion; where those two are parallel, of a boundary triangle at the obstacle's edge, and of a wire against the
    /// motion.</summary>
    public Vec3 Normal;
    /// <summary>Of the moving end: at its target when the edge came through, else at its start.</summary>
    public VolumeId Volume;
    /// <summary>Contact: a passable volume at the reported face, or at the wire; null without. Of several faces at a rim
    /// one that p looks at counts, then the lowest canonical id.</summary>
    public VolumeId Front;
    /// <summary>Canonical id of the impassable face; null for a wire.</summary>
    public FaceId Face;
    /// <summary>DSW_CONTACT_EDGE: canonical id of the obstacle's edge.</summary>
    public EdgeId Edge;
    /// <summary>REACHED, CONTACT, WORK_LIMIT, OUTSIDE (p lies in no volume), IMPASSABLE (p lies in an impassable one, or
    /// p q is not free where it starts).</summary>
    public Outcome Outcome;
    /// <summary>PLANE: the moving end on a face, or the edge on the diagonal of a warped one; EDGE.</summary>
    public ContactKind Kind;
    /// <summary>As in dsw_flight; DSW_CELL_EDGE for a wire.</summary>
    public CellKind Obstacle;
    /// <summary>As in dsw_flight; 0 for a wire.</summary>
    public uint Tag;
    /// <summary>Volumes looked at, all casts included.</summary>
    public uint VolumesVisited;
    /// <summary>0.</summary>
    internal uint Reserved;
  }

  /// <summary>A contact of a body: one vertex was moved from `from` towards `to`, and the vertex itself, one of its edges
  /// or one of its faces touched something impassable at `time`.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Contact
  {
    /// <summary>The flight of the moving vertex.</summary>
    public Vec3 From;
    public Vec3 To;
    /// <summary>Where the other ends of the touching edge (one) or face (two) were; the rest is zero. With `from` and
    /// `to` this is all it takes to sweep it again.</summary>
    public Vec3 Fixed0, Fixed1;
    /// <summary>Fraction of that flight. With exact time the largest double not later than the true first time (its limit
    /// where the shift decides); by bisection a time at which the body is free.</summary>
    public double Time;
    /// <summary>The moving vertex at `time`: from + time * (to - from), rounded.</summary>
    public Vec3 Position;
    /// <summary>Where it touches, rounded.</summary>
    public Vec3 Point;
    /// <summary>Unit, out of the obstacle; see dsw_sweep. Of a face on a vertex: that of the face, against the
    /// motion.</summary>
    public Vec3 Normal;
    /// <summary>Touching edge: 0 at the moving vertex, 1 at the other end; else 0.</summary>
    public double Along;
    /// <summary>Length of the part of the flight that was not made, scene units.</summary>
    public double DistanceLeft;
    /// <summary>The vertex that moved.</summary>
    public BodyVertexId Vertex;
    /// <summary>The edge that touched; null if it was the vertex or a face.</summary>
    public BodyEdgeId Edge;
    /// <summary>The face that touched; null if it was the vertex or an edge.</summary>
    public BodyFaceId Face;
    /// <summary>What was touched, canonical: a face, an edge (DSW_CONTACT_EDGE) or a vertex
    /// (DSW_CONTACT_VERTEX).</summary>
    public Cell Obstacle;
    /// <summary>An impassable face that the obstacle is or belongs to; null for a wire and a marked vertex.</summary>
    public FaceId Wall;
    /// <summary>A passable volume at the obstacle.</summary>
    public VolumeId Front;
    public ContactKind Kind;
    /// <summary>What was marked: DSW_CELL_FACE (or the outer boundary), VOLUME, EDGE, VERTEX.</summary>
    public CellKind Cause;
    /// <summary>Host tag of the volume behind `wall`, at the outer boundary of the one in front; else 0.</summary>
    public uint Tag;
    public ContactHistory History;
  }

  /// <summary>The other body of a contact, and its part that was touched: one of vertex, edge and face; the rest is null.
  /// All is null in a contact with the environment. In a contact of bodies `obstacle`, `wall`, `cause` and `tag` of
  /// dsw_body_contact are null, `front` is the volume that the moving vertex started in, and `kind` is that of the part:
  /// DSW_CONTACT_VERTEX, EDGE or (a face) PLANE.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct ContactPartner
  {
    /// <summary>The body itself where it touches itself.</summary>
    public BodyId Body;
    public BodyVertexId Vertex;
    public BodyEdgeId Edge;
    public BodyFaceId Face;
  }

  /// <summary>What the vertex of a contact touched before: tells resting, sliding and bouncing apart.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct PreviousContact
  {
    /// <summary>Where the vertex was stopped last before this move.</summary>
    public Vec3 Point;
    public Vec3 Normal;
    /// <summary>What was touched there, by the id of that time; null where it was a body.</summary>
    public Cell Obstacle;
    /// <summary>The body that was touched there; null where it was the environment.</summary>
    public BodyId Body;
    /// <summary>How many moves ago that was: 1 in the move before; 0 never.</summary>
    public uint Since;
    /// <summary>For how many moves in a row this obstacle has stopped the vertex, this one included. 1: it is new.</summary>
    public uint Moves;
    /// <summary>For how many moves in a row anything has stopped the vertex, this one included.</summary>
    public uint Touching;
    /// <summary>0.</summary>
    internal uint Reserved;
  }

  /// <summary>What became of an edge that was split at a new vertex, or of a vertex that was merged into another.
  /// Attributes of a new vertex are (1 - share) * those of ends[0] + share * those of ends[1].</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyEdit
  {
    /// <summary>The new vertex, or the one that is gone.</summary>
    public BodyVertexId Vertex;
    /// <summary>Split: of the edge. Merge: ends[0] is the vertex it was merged into.</summary>
    public BodyVertexId Ends0, Ends1;
    /// <summary>Split: keeps ends[0], and its id. Merge: the edge that is gone.</summary>
    public BodyEdgeId Edge;
    /// <summary>Split: the new edge at ends[1].</summary>
    public BodyEdgeId Rest;
    /// <summary>Split: place on the edge, in (0,1).</summary>
    public double Share;
    /// <summary>1: split, 0: merge.</summary>
    public uint Inserted;
    /// <summary>0.</summary>
    internal uint Reserved;
  }

  /// <summary>What a move did.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct MoveReport
  {
    /// <summary>dsw_body_move_rigid: the part of the motion that was made; else 1.</summary>
    public double Fraction;
    /// <summary>Vertices that were to move.</summary>
    public uint VerticesMoved;
    /// <summary>Of these: not at their targets.</summary>
    public uint VerticesStopped;
    /// <summary>See dsw_body_get_contacts.</summary>
    public uint ContactCount;
    /// <summary>See dsw_body_get_edits.</summary>
    public uint EditCount;
    /// <summary>Sweeps of edges that a level above POINTS asks for, both ends counted.</summary>
    public uint EdgesSwept;
    /// <summary>Of these: left out by the body's flags.</summary>
    public uint EdgesSkipped;
    /// <summary>Of vertices_stopped: by the work limit.</summary>
    public uint VerticesLimited;
    /// <summary>0.</summary>
    internal uint Reserved;
  }

  /// <summary>A wall that met something: one vertex of the environment was moved from `from` towards `to`, and a wall at
  /// it touched a vertex, edge or face of a body, or a particle. END_STATE: `from` is the centre of the volume that
  /// something lay in, `to` where that lies, and `moving` is null.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct WallContact
  {
    public Vec3 From;
    public Vec3 To;
    /// <summary>Fraction of that way; the largest double not later than the exact time (its limit where the shift
    /// decides).</summary>
    public double Time;
    /// <summary>Where it is touched, rounded.</summary>
    public Vec3 Point;
    /// <summary>Unit, out of the wall.</summary>
    public Vec3 Normal;
    /// <summary>A touched edge: from its first end (0) to its second (1); else 0.</summary>
    public double Along;
    /// <summary>The vertex of the environment that moved.</summary>
    public VertexId Moving;
    /// <summary>With it the wall's triangle (two) or edge (one) that touches; null beyond that.</summary>
    public VertexId Others0, Others1;
    /// <summary>Canonical; null for a wire and a marked vertex.</summary>
    public FaceId Wall;
    /// <summary>The particle that was touched; null if it was a body.</summary>
    public ParticleId Particle;
    /// <summary>The body; null if it was a particle.</summary>
    public BodyId Body;
    /// <summary>Of these three the feature of it that was touched; the others are null.</summary>
    public BodyVertexId Vertex;
    public BodyEdgeId Edge;
    public BodyFaceId Face;
    /// <summary>What was done.</summary>
    public WallResponse Response;
    /// <summary>Host tag of the volume behind `wall`, at the outer boundary of the one in front; else 0.</summary>
    public uint Tag;
    /// <summary>0.</summary>
    internal uint Reserved;
  }

  /// <summary>What became of a volume. A volume that was split stands in two of these, one that was merged in two as
  /// well.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct VolumeChange
  {
    /// <summary>Null: the volume was added.</summary>
    public VolumeId Before;
    /// <summary>Null: the volume was removed.</summary>
    public VolumeId After;
  }

  /// <summary>A vertex that came, between two that there were: at weights[0] from[0] + weights[1] from[1],
  /// rounded.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct CutVertex
  {
    public VertexId Vertex;
    public VertexId From0, From1;
    /// <summary>Above 0; their sum is 1.</summary>
    public double Weights0, Weights1;
  }

  /// <summary>A face of the cut, named from both of its sides: one face, or two with DSW_CUT_UNSEW.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct CutFace
  {
    /// <summary>That of the volume before the blade.</summary>
    public FaceId Front;
    /// <summary>That of the volume behind it.</summary>
    public FaceId Back;
  }

  /// <summary>Where a vertex of the body comes from: weights[0] from[0] + weights[1] from[1], before it was drawn
  /// in.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct DetachedVertex
  {
    /// <summary>The same twice, but where an edge had to be split.</summary>
    public VertexId From0, From1;
    /// <summary>1 and 0; there 0.5 and 0.5.</summary>
    public double Weights0, Weights1;
  }

  /// <summary>Where a face of the body comes from.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct DetachedFace
  {
    /// <summary>Face of the environment that it is a triangle of, or a part of one.</summary>
    public FaceId Face;
    /// <summary>The piece's volume there, on the inner side of the body's face.</summary>
    public VolumeId Volume;
  }
}

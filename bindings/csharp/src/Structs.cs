// Structs of the C interface as they lie in memory, so that arrays of them are used by both sides; tests compare their sizes.
using System.Runtime.InteropServices;

namespace Dartsweep
{
  /// <summary>A point or a direction.</summary>
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

  /// <summary>What was touched. Every report below, and WallContact, holds one. Without a contact all members are 0.
  /// Where a body was touched, only `Normal`, `Front` and `Kind` are set.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Contact
  {
    /// <summary>Unit normal, out of the obstacle.</summary>
    public Vec3 Normal;
    /// <summary>Touched face, edge or vertex, canonical.</summary>
    public Cell Obstacle;
    /// <summary>Impassable face there, canonical; null for a marked edge or vertex.</summary>
    public FaceId Wall;
    /// <summary>Passable volume at `Obstacle`; volume of the vertex at a body.</summary>
    public VolumeId Front;
    /// <summary>Volume on the other side of `Wall`; null at the outer boundary.</summary>
    public VolumeId Behind;
    /// <summary>What part of the obstacle was touched.</summary>
    public ContactKind Kind;
    /// <summary>Kind of the marked cell: Volume if only the volume behind is marked; Face also at the outer
    /// boundary.</summary>
    public CellKind MarkedKind;
    /// <summary>Host tag behind `Wall`; at the outer boundary, in front.</summary>
    public uint Tag;
  }

  /// <summary>Report of a cast or a particle's move.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Flight
  {
    /// <summary>End of the flight; verified to be free for a particle, rounded for a cast.</summary>
    public Vec3 Position;
    /// <summary>Fraction of the move. At a contact: the largest double not later than the exact time.</summary>
    public double Time;
    /// <summary>What ended the flight.</summary>
    public Contact Contact;
    /// <summary>Volume at the end of the flight.</summary>
    public VolumeId Volume;
    /// <summary>How the flight ended.</summary>
    public Outcome Outcome;
    /// <summary>Volumes entered.</summary>
    public uint VolumesVisited;
  }

  /// <summary>One volume of a flight.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Crossing
  {
    /// <summary>The volume.</summary>
    public VolumeId Volume;
    /// <summary>Its face of entry, canonical; null for the first.</summary>
    public FaceId Face;
    /// <summary>Time of entry, rounded down.</summary>
    public double Time;
  }

  /// <summary>Report of one swept edge.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Sweep
  {
    /// <summary>Moving end at `Time`, rounded.</summary>
    public Vec3 Position;
    /// <summary>As in Flight; 0 if the edge could not start or met the work limit.</summary>
    public double Time;
    /// <summary>Where the edge touches, rounded.</summary>
    public Vec3 Point;
    /// <summary>Place of `Point` on the edge: 0 moving end, 1 fixed end.</summary>
    public double EdgeParameter;
    /// <summary>What the edge touched.</summary>
    public Contact Contact;
    /// <summary>Volume of the moving end; at its start unless Reached.</summary>
    public VolumeId Volume;
    /// <summary>How the sweep ended.</summary>
    public Outcome Outcome;
    /// <summary>Volumes looked at.</summary>
    public uint VolumesVisited;
  }

  /// <summary>The nearest impassable cell.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct Nearest
  {
    /// <summary>Rounded; infinity if nothing is within the radius.</summary>
    public double Distance;
    /// <summary>Its nearest point, rounded.</summary>
    public Vec3 Point;
    /// <summary>Unit, towards the given point; zero for distance 0 or infinity.</summary>
    public Vec3 Normal;
    /// <summary>The face, edge or vertex; of kind None if nothing.</summary>
    public Cell Cell;
    /// <summary>As in Contact, for a face.</summary>
    public uint Tag;
    /// <summary>Volumes looked at; depends on earlier calls.</summary>
    public uint VolumesVisited;
  }

  /// <summary>The impassable cell that is nearest to a segment.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct SegmentNearest
  {
    /// <summary>Its normal points towards SegmentPoint.</summary>
    public Nearest Nearest;
    /// <summary>Of the segment's nearest point: 0 at the first point, 1 at the last.</summary>
    public double SegmentParameter;
    /// <summary>This point, rounded. Zero, as the parameter, if nothing is near.</summary>
    public Vec3 SegmentPoint;
  }

  /// <summary>A contact of a body: a moving vertex, or one of its edges or faces, touched something.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyContact
  {
    /// <summary>Start of the moving vertex.</summary>
    public Vec3 From;
    /// <summary>Its target.</summary>
    public Vec3 To;
    /// <summary>Other ends of the touching edge or face; else 0.</summary>
    public Vec3 Fixed0, Fixed1;
    /// <summary>Moving vertex at `Time`, rounded.</summary>
    public Vec3 Position;
    /// <summary>As in Sweep. By bisection: the body is free then.</summary>
    public double Time;
    /// <summary>Where the body touches, rounded.</summary>
    public Vec3 Point;
    /// <summary>As in Sweep.</summary>
    public double EdgeParameter;
    /// <summary>Length of the way not made.</summary>
    public double DistanceLeft;
    /// <summary>What the body touched.</summary>
    public Contact Contact;
    /// <summary>The moving vertex.</summary>
    public BodyVertexId Vertex;
    /// <summary>The touching edge, or null.</summary>
    public BodyEdgeId Edge;
    /// <summary>The touching face, or null.</summary>
    public BodyFaceId Face;
    /// <summary>Whether the contact is new.</summary>
    public ContactHistory History;
    internal uint Reserved;
  }

  /// <summary>The body that a contact touched; all null for a contact with the environment.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct ContactPartner
  {
    /// <summary>The body; maybe the moving one.</summary>
    public BodyId Body;
    /// <summary>Its touched vertex, or null.</summary>
    public BodyVertexId Vertex;
    /// <summary>Its touched edge, or null.</summary>
    public BodyEdgeId Edge;
    /// <summary>Its touched face, or null.</summary>
    public BodyFaceId Face;
  }

  /// <summary>The previous contact of a vertex. The vertex rests or slides if `Since` is 1, and bounces above
  /// 1.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct PreviousContact
  {
    /// <summary>Where this obstacle, or else anything, stopped the vertex before.</summary>
    public Vec3 Point;
    /// <summary>Normal there.</summary>
    public Vec3 Normal;
    /// <summary>Cell touched there; null for a body.</summary>
    public Cell Obstacle;
    /// <summary>Body touched there; null for the environment.</summary>
    public BodyId Body;
    /// <summary>Moves ago: 1 the move before, 0 never.</summary>
    public uint Since;
    /// <summary>Moves in a row that this obstacle stopped.</summary>
    public uint Moves;
    /// <summary>Moves in a row that anything stopped.</summary>
    public uint Touching;
    internal uint Reserved;
  }

  /// <summary>A split of an edge at a new vertex, or a merge of a vertex into another.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct BodyEdit
  {
    /// <summary>Split: the new vertex. Merge: the removed vertex.</summary>
    public BodyVertexId Vertex;
    /// <summary>Split: ends of the edge. Merge: Ends0 is the vertex that stays.</summary>
    public BodyVertexId Ends0, Ends1;
    /// <summary>Split: the part at Ends0, id kept. Merge: the removed edge.</summary>
    public BodyEdgeId Edge;
    /// <summary>Split: the new edge at Ends1.</summary>
    public BodyEdgeId Rest;
    /// <summary>Split: place on the edge, and weight of Ends1.</summary>
    public double EdgeParameter;
    /// <summary>1: split; 0: merge.</summary>
    public uint Inserted;
    internal uint Reserved;
  }

  /// <summary>What a move did.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct MoveReport
  {
    /// <summary>Part made by Body.MoveRigid; else 1.</summary>
    public double Fraction;
    /// <summary>Vertices to move.</summary>
    public uint VerticesMoved;
    /// <summary>Those not at their targets.</summary>
    public uint VerticesStopped;
    /// <summary>See Body.GetContacts.</summary>
    public uint ContactCount;
    /// <summary>See Body.GetEdits.</summary>
    public uint EditCount;
    /// <summary>Sweeps of edges, from both ends.</summary>
    public uint EdgesSwept;
    /// <summary>Those saved by flags.</summary>
    public uint EdgesSkipped;
    /// <summary>Stopped by the work limit.</summary>
    public uint VerticesLimited;
    internal uint Reserved;
  }

  /// <summary>A part of a body and what it is near to.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct NearRow
  {
    /// <summary>Nearest point of the part.</summary>
    public Vec3 Point;
    /// <summary>Nearest point of the obstacle.</summary>
    public Vec3 ObstaclePoint;
    /// <summary>Unit, from the obstacle towards the part.</summary>
    public Vec3 Normal;
    /// <summary>Between the two points.</summary>
    public double Distance;
    /// <summary>Distance less the radius; of the same body, less it twice.</summary>
    public double Gap;
    /// <summary>Of Vertices0 to Vertices2: sum to 1; `Point` is the weighted sum. 0 unused.</summary>
    public Vec3 Weights;
    /// <summary>Of ObstacleVertices0 to ObstacleVertices2, likewise.</summary>
    public Vec3 ObstacleWeights;
    /// <summary>The part's vertices: 1 to 3, then uint.MaxValue.</summary>
    public uint Vertices0, Vertices1, Vertices2;
    /// <summary>The obstacle's: indices of vertices of the environment, or of the other body.</summary>
    public uint ObstacleVertices0, ObstacleVertices1, ObstacleVertices2;
    /// <summary>The face, edge or vertex, canonical. A diagonal: its face. At a body: none.</summary>
    public Cell Obstacle;
    /// <summary>The lowest impassable face at the obstacle that looks towards the part, canonical; null for a marked
    /// edge or vertex, and at a body.</summary>
    public FaceId Wall;
    /// <summary>As in Contact, of `Wall`.</summary>
    public uint Tag;
    /// <summary>The other body; null for the environment.</summary>
    public BodyId Body;
    /// <summary>Names the row among those of its body, from call to call.</summary>
    public uint Key0, Key1, Key2, Key3;
    /// <summary>Number of this row in the call before, or uint.MaxValue.</summary>
    public uint Previous;
    internal uint Reserved;
  }

  /// <summary>When a pair first touches.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct PairTouch
  {
    /// <summary>The largest double that is not later than the first time of touch; 0 without a touch.</summary>
    public double Time;
    /// <summary>1 if the pair touches at a time in [0,1], else 0.</summary>
    public uint Touches;
    /// <summary>How many pairs of the batch touch earlier, equal for equal times. Without a touch: how many pairs touch. 0
    /// without Library.PAIRS_RANK.</summary>
    public uint Rank;
  }

  /// <summary>A vertex of the environment moved, and a wall at this vertex touched something.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct WallContact
  {
    /// <summary>Start of the vertex.</summary>
    public Vec3 From;
    /// <summary>Its target.</summary>
    public Vec3 To;
    /// <summary>As in Sweep.</summary>
    public double Time;
    /// <summary>Where the wall touches, rounded.</summary>
    public Vec3 Point;
    /// <summary>Place of `Point` on the touched edge, from its first end.</summary>
    public double EdgeParameter;
    /// <summary>The part of the wall that touches.</summary>
    public Contact Contact;
    /// <summary>The vertex that moved.</summary>
    public VertexId Moving;
    /// <summary>Other corners of the touching triangle or edge, or null.</summary>
    public VertexId Others0, Others1;
    /// <summary>Touched particle, or null.</summary>
    public ParticleId Particle;
    /// <summary>Touched body, or null.</summary>
    public BodyId Body;
    /// <summary>Its touched vertex, or null.</summary>
    public BodyVertexId Vertex;
    /// <summary>Its touched edge, or null.</summary>
    public BodyEdgeId Edge;
    /// <summary>Its touched face, or null.</summary>
    public BodyFaceId Face;
    /// <summary>What was done.</summary>
    public WallResponse Response;
    internal uint Reserved;
  }

  /// <summary>What became of a volume. A volume that is split or merged has two of these.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct VolumeChange
  {
    /// <summary>Null: the volume was added.</summary>
    public VolumeId Before;
    /// <summary>Null: the volume was removed.</summary>
    public VolumeId After;
  }

  /// <summary>Origin of a new vertex: Weights0 From0 + Weights1 From1, rounded.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct VertexOrigin
  {
    /// <summary>The new vertex; null for a vertex of a body.</summary>
    public VertexId Vertex;
    /// <summary>Old vertices; equal if the vertex is a copy.</summary>
    public VertexId From0, From1;
    /// <summary>Their sum is 1.</summary>
    public double Weights0, Weights1;
  }

  /// <summary>A face of a cut: one face with two ids, or two faces that lie on each other.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct CutFace
  {
    /// <summary>Its id from the volume in front of the blade.</summary>
    public FaceId Front;
    /// <summary>Its id from the volume behind the blade.</summary>
    public FaceId Back;
  }

  /// <summary>Origin of a face of a detached body.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FaceOrigin
  {
    /// <summary>Face that holds the triangle.</summary>
    public FaceId Face;
    /// <summary>Volume of the piece at that face.</summary>
    public VolumeId Volume;
  }
}

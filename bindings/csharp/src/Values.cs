// Other structs are in Structs.cs, which is made.
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
}

// An exception for each status of the C interface.
using System;

namespace Dartsweep
{
  /// <summary>A call has failed, and nothing has changed. The text is the library's.</summary>
  public abstract class DartsweepException : Exception
  {
    public Status Status { get; private set; }

    internal DartsweepException(Status status, string message) : base(message) { Status = status; }
  }

  internal static class Errors
  {
    /// <summary>What the last call of this thread failed with, until it is thrown.</summary>
    [ThreadStatic]
    internal static Exception Pending;

    internal static Exception Of(int status, bool closed, string message)
    {
      if (status < 0) return new ArgumentException(message);
      if (closed) return new ClosedException(message);
      switch ((Status)status)
      {
        case Status.NullArgument: return new NullArgumentException(message);
        case Status.BadStructSize: return new BadStructSizeException(message);
        case Status.Unsupported: return new UnsupportedException(message);
        case Status.OutOfRange: return new OutOfRangeException(message);
        case Status.NonFinite: return new NonFiniteException(message);
        case Status.WrongSize: return new WrongSizeException(message);
        case Status.StaleId: return new StaleIdException(message);
        case Status.BufferTooSmall: return new BufferTooSmallException(message);
        case Status.OutOfMemory: return new OutOfMemoryException(message);
        case Status.TooLarge: return new TooLargeException(message);
        case Status.IndexOutOfRange: return new IndexOutOfRangeException(message);
        case Status.BadCellType: return new BadCellTypeException(message);
        case Status.BadCell: return new BadCellException(message);
        case Status.InvertedCell: return new InvertedCellException(message);
        case Status.InvalidCell: return new InvalidCellException(message);
        case Status.DuplicateCell: return new DuplicateCellException(message);
        case Status.SharedFace: return new SharedFaceException(message);
        case Status.BoundaryCrosses: return new BoundaryCrossesException(message);
        case Status.Outside: return new OutsideException(message);
        case Status.Impassable: return new ImpassableException(message);
        case Status.Occupied: return new OccupiedException(message);
        case Status.InUse: return new InUseException(message);
        case Status.Shared: return new SharedException(message);
        case Status.DuplicateId: return new DuplicateIdException(message);
        case Status.NotFound: return new NotFoundException(message);
        case Status.Truncated: return new TruncatedException(message);
        case Status.Corrupt: return new CorruptException(message);
        case Status.BadVersion: return new BadVersionException(message);
        case Status.NotEnabled: return new NotEnabledException(message);
        case Status.NotBuilt: return new NotBuiltException(message);
        case Status.Internal: return new InternalException(message);
        case Status.BadTopology: return new BadTopologyException(message);
        case Status.Borrowed: return new BorrowedException(message);
        case Status.WriteFailed: return new WriteFailedException(message);
        case Status.NotClosed: return new NotClosedException(message);
        case Status.RepeatedVertex: return new RepeatedVertexException(message);
        case Status.DuplicatePart: return new DuplicatePartException(message);
        case Status.NotManifold: return new NotManifoldException(message);
        case Status.NotOriented: return new NotOrientedException(message);
        case Status.NotConforming: return new NotConformingException(message);
        default: return new InternalException(message);
      }
    }
  }

  /// <summary>The object was closed before.</summary>
  public sealed class ClosedException : NullArgumentException
  {
    internal ClosedException(string message) : base(message) { }
  }

  /// <summary>A required pointer or handle is null.</summary>
  public class NullArgumentException : DartsweepException
  {
    internal NullArgumentException(string message) : base(Status.NullArgument, message) { }
  }

  /// <summary>struct_size is smaller than the first release's struct.</summary>
  public sealed class BadStructSizeException : DartsweepException
  {
    internal BadStructSizeException(string message) : base(Status.BadStructSize, message) { }
  }

  /// <summary>The library does not know a value, a flag or a non-zero member.</summary>
  public sealed class UnsupportedException : DartsweepException
  {
    internal UnsupportedException(string message) : base(Status.Unsupported, message) { }
  }

  /// <summary>An index or number lies outside the documented range.</summary>
  public sealed class OutOfRangeException : DartsweepException
  {
    internal OutOfRangeException(string message) : base(Status.OutOfRange, message) { }
  }

  /// <summary>A coordinate is NaN or infinite.</summary>
  public sealed class NonFiniteException : DartsweepException
  {
    internal NonFiniteException(string message) : base(Status.NonFinite, message) { }
  }

  /// <summary>Sizes, strides or offsets of arrays contradict each other.</summary>
  public sealed class WrongSizeException : DartsweepException
  {
    internal WrongSizeException(string message) : base(Status.WrongSize, message) { }
  }

  /// <summary>The id names nothing that exists.</summary>
  public sealed class StaleIdException : DartsweepException
  {
    internal StaleIdException(string message) : base(Status.StaleId, message) { }
  }

  /// <summary>The count argument was set to the capacity that is needed.</summary>
  public sealed class BufferTooSmallException : DartsweepException
  {
    internal BufferTooSmallException(string message) : base(Status.BufferTooSmall, message) { }
  }

  /// <summary>The allocator returned null.</summary>
  public sealed class OutOfMemoryException : DartsweepException
  {
    internal OutOfMemoryException(string message) : base(Status.OutOfMemory, message) { }
  }

  /// <summary>More cells or points than 28-bit indices can name.</summary>
  public sealed class TooLargeException : DartsweepException
  {
    internal TooLargeException(string message) : base(Status.TooLarge, message) { }
  }

  /// <summary>A cell names a point that does not exist.</summary>
  public sealed class IndexOutOfRangeException : DartsweepException
  {
    internal IndexOutOfRangeException(string message) : base(Status.IndexOutOfRange, message) { }
  }

  /// <summary>A cell type is unknown.</summary>
  public sealed class BadCellTypeException : DartsweepException
  {
    internal BadCellTypeException(string message) : base(Status.BadCellType, message) { }
  }

  /// <summary>Repeated points in a cell, or faces that do not close a sphere.</summary>
  public sealed class BadCellException : DartsweepException
  {
    internal BadCellException(string message) : base(Status.BadCell, message) { }
  }

  /// <summary>A cell is turned inside out.</summary>
  public sealed class InvertedCellException : DartsweepException
  {
    internal InvertedCellException(string message) : base(Status.InvertedCell, message) { }
  }

  /// <summary>A cell is flat, folded, or not seen whole from the mean of its vertices.</summary>
  public sealed class InvalidCellException : DartsweepException
  {
    internal InvalidCellException(string message) : base(Status.InvalidCell, message) { }
  }

  /// <summary>Two cells lie on the same side of one face.</summary>
  public sealed class DuplicateCellException : DartsweepException
  {
    internal DuplicateCellException(string message) : base(Status.DuplicateCell, message) { }
  }

  /// <summary>A face belongs to three cells or more.</summary>
  public sealed class SharedFaceException : DartsweepException
  {
    internal SharedFaceException(string message) : base(Status.SharedFace, message) { }
  }

  /// <summary>The outer boundary passes through itself.</summary>
  public sealed class BoundaryCrossesException : DartsweepException
  {
    internal BoundaryCrossesException(string message) : base(Status.BoundaryCrosses, message) { }
  }

  /// <summary>The point lies in no cell.</summary>
  public sealed class OutsideException : DartsweepException
  {
    internal OutsideException(string message) : base(Status.Outside, message) { }
  }

  /// <summary>The point lies in an impassable volume.</summary>
  public sealed class ImpassableException : DartsweepException
  {
    internal ImpassableException(string message) : base(Status.Impassable, message) { }
  }

  /// <summary>The change would make a cell impassable that something occupies.</summary>
  public sealed class OccupiedException : DartsweepException
  {
    internal OccupiedException(string message) : base(Status.Occupied, message) { }
  }

  /// <summary>Scenes (or other scenes) use the environment.</summary>
  public sealed class InUseException : DartsweepException
  {
    internal InUseException(string message) : base(Status.InUse, message) { }
  }

  /// <summary>Several scenes share the environment: it can't be changed.</summary>
  public sealed class SharedException : DartsweepException
  {
    internal SharedException(string message) : base(Status.Shared, message) { }
  }

  /// <summary>An id occurs twice in a batch.</summary>
  public sealed class DuplicateIdException : DartsweepException
  {
    internal DuplicateIdException(string message) : base(Status.DuplicateId, message) { }
  }

  /// <summary>No cell has these vertices.</summary>
  public sealed class NotFoundException : DartsweepException
  {
    internal NotFoundException(string message) : base(Status.NotFound, message) { }
  }

  /// <summary>The snapshot block ends early.</summary>
  public sealed class TruncatedException : DartsweepException
  {
    internal TruncatedException(string message) : base(Status.Truncated, message) { }
  }

  /// <summary>The snapshot block is damaged.</summary>
  public sealed class CorruptException : DartsweepException
  {
    internal CorruptException(string message) : base(Status.Corrupt, message) { }
  }

  /// <summary>The snapshot block was written by an unknown format version.</summary>
  public sealed class BadVersionException : DartsweepException
  {
    internal BadVersionException(string message) : base(Status.BadVersion, message) { }
  }

  /// <summary>The scene has not enabled the feature that this call needs.</summary>
  public sealed class NotEnabledException : DartsweepException
  {
    internal NotEnabledException(string message) : base(Status.NotEnabled, message) { }
  }

  /// <summary>The library was built without this part.</summary>
  public sealed class NotBuiltException : DartsweepException
  {
    internal NotBuiltException(string message) : base(Status.NotBuilt, message) { }
  }

  /// <summary>A bug of the library; please report the message.</summary>
  public sealed class InternalException : DartsweepException
  {
    internal InternalException(string message) : base(Status.Internal, message) { }
  }

  /// <summary>The cells are not arranged as the change needs them; the message says how.</summary>
  public sealed class BadTopologyException : DartsweepException
  {
    internal BadTopologyException(string message) : base(Status.BadTopology, message) { }
  }

  /// <summary>The points belong to the host and have no room for another vertex.</summary>
  public sealed class BorrowedException : DartsweepException
  {
    internal BorrowedException(string message) : base(Status.Borrowed, message) { }
  }

  /// <summary>A recording could not be written.</summary>
  public sealed class WriteFailedException : DartsweepException
  {
    internal WriteFailedException(string message) : base(Status.WriteFailed, message) { }
  }

  /// <summary>The body is not a closed surface.</summary>
  public sealed class NotClosedException : DartsweepException
  {
    internal NotClosedException(string message) : base(Status.NotClosed, message) { }
  }

  /// <summary>An edge or face of a body repeats a vertex.</summary>
  public sealed class RepeatedVertexException : DartsweepException
  {
    internal RepeatedVertexException(string message) : base(Status.RepeatedVertex, message) { }
  }

  /// <summary>A body has an edge or face twice.</summary>
  public sealed class DuplicatePartException : DartsweepException
  {
    internal DuplicatePartException(string message) : base(Status.DuplicatePart, message) { }
  }

  /// <summary>A body would not be a manifold.</summary>
  public sealed class NotManifoldException : DartsweepException
  {
    internal NotManifoldException(string message) : base(Status.NotManifold, message) { }
  }

  /// <summary>Faces of a body are turned against each other.</summary>
  public sealed class NotOrientedException : DartsweepException
  {
    internal NotOrientedException(string message) : base(Status.NotOriented, message) { }
  }

  /// <summary>Parts of a mesh lie on each other and can't be sewn.</summary>
  public sealed class NotConformingException : DartsweepException
  {
    internal NotConformingException(string message) : base(Status.NotConforming, message) { }
  }
}

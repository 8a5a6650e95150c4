// What all exceptions are; Exceptions.cs, which is made, has one for each status of the C interface.
using System;

namespace Dartsweep
{
  /// <summary>A call has failed, and nothing has changed. The text is the library's.</summary>
  public abstract class DartsweepException : Exception
  {
    public Status Status { get; private set; }

    internal DartsweepException(Status status, string message) : base(message) { Status = status; }
  }

  internal static partial class Errors
  {
    /// <summary>What the last call of this thread failed with, until it is thrown.</summary>
    [ThreadStatic]
    internal static Exception Pending;

    internal static Exception Of(int status, bool closed, string message)
    {
      if (status < 0) return new ArgumentException(message);
      if (closed) return new ClosedException(message);
      return OfStatus((Status)status, message);
    }
  }

  /// <summary>The object was closed before.</summary>
  public sealed class ClosedException : NullArgumentException
  {
    internal ClosedException(string message) : base(message) { }
  }
}

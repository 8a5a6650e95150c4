// What goes between C#'s memory and C's.
using System;
using System.Runtime.InteropServices;

namespace Dartsweep
{
  /// <summary>An object of C: given back once, when nothing uses it any more.</summary>
  internal sealed class NativeHandle : SafeHandle
  {
    internal static readonly NativeHandle Null = new NativeHandle(IntPtr.Zero, null);
    private readonly Action<NativeHandle> release;

    internal NativeHandle(IntPtr address, Action<NativeHandle> release) : base(IntPtr.Zero, release != null)
    {
      this.release = release;
      SetHandle(address);
    }

    public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

    protected override bool ReleaseHandle()
    {
      release(new NativeHandle(handle, null));
      return true;
    }
  }

  /// <summary>An array that stays where it is: for a call, or until its handle is freed.</summary>
  [StructLayout(LayoutKind.Sequential)]
  internal unsafe struct Pinned
  {
    private readonly void* data;
    private readonly UIntPtr count;
    private readonly IntPtr handle;

    internal Pinned(void* data, Array array)
    {
      this.data = data;
      count = (UIntPtr)(array == null ? 0 : array.Length);
      handle = IntPtr.Zero;
    }

    private Pinned(double[] array, GCHandle pin)
    {
      data = (void*)pin.AddrOfPinnedObject();
      count = (UIntPtr)array.Length;
      handle = GCHandle.ToIntPtr(pin);
    }

    internal static Pinned Lend(double[] array)
    {
      if (array == null) throw new ArgumentNullException("next");
      return new Pinned(array, GCHandle.Alloc(array, GCHandleType.Pinned));
    }
  }

  /// <summary>An array that C made.</summary>
  [StructLayout(LayoutKind.Sequential)]
  internal struct Block
  {
    private readonly IntPtr data;
    private readonly UIntPtr bytes;
    private readonly IntPtr release;

    internal T[] ToArray<T>() where T : struct
    {
      T[] array = new T[(int)((ulong)bytes / (ulong)Marshal.SizeOf(typeof(T)))];
      GCHandle pin = GCHandle.Alloc(array, GCHandleType.Pinned);
      try
      {
        Callbacks.dartsweep_take(ref this, pin.AddrOfPinnedObject());
      }
      finally
      {
        pin.Free();
      }
      return array;
    }
  }

  /// <summary>Marks what C calls, for compilers ahead of time, which look for this name.</summary>
  [AttributeUsage(AttributeTargets.Method)]
  internal sealed class MonoPInvokeCallbackAttribute : Attribute
  {
    internal MonoPInvokeCallbackAttribute(Type type) { }
  }

  internal static class Callbacks
  {
    private delegate void ErrorCallback(int status, int closed, IntPtr message);
    private delegate void FreeCallback(IntPtr handle);
    private delegate void LogCallback(IntPtr handle, int level, IntPtr text);

    // Kept: C calls them as long as the process lives.
    private static readonly ErrorCallback onError = OnError;
    private static readonly FreeCallback onFree = OnFree;
    private static readonly LogCallback onLog = OnLog;

    [DllImport("dartsweep_csharp")]
    internal static extern void dartsweep_take(ref Block block, IntPtr destination);

    [DllImport("dartsweep_csharp")]
    private static extern void dartsweep_set_callbacks(ErrorCallback error, FreeCallback free, LogCallback log);

    [DllImport("dartsweep_csharp")]
    internal static extern UIntPtr dartsweep_size_of(int index);

    internal static void Register() { dartsweep_set_callbacks(onError, onFree, onLog); }

    /// <summary>A handle that keeps a delegate, which C frees; zero for none.</summary>
    internal static IntPtr Keep(Action<LogLevel, string> log)
    {
      return log == null ? IntPtr.Zero : GCHandle.ToIntPtr(GCHandle.Alloc(log));
    }

    [MonoPInvokeCallback(typeof(ErrorCallback))]
    private static void OnError(int status, int closed, IntPtr message)
    {
      Errors.Pending = Errors.Of(status, closed != 0, Marshal.PtrToStringAnsi(message));
    }

    [MonoPInvokeCallback(typeof(FreeCallback))]
    private static void OnFree(IntPtr handle) { GCHandle.FromIntPtr(handle).Free(); }

    [MonoPInvokeCallback(typeof(LogCallback))]
    private static void OnLog(IntPtr handle, int level, IntPtr text)
    {
      try
      {
        ((Action<LogLevel, string>)GCHandle.FromIntPtr(handle).Target)((LogLevel)level, Marshal.PtrToStringAnsi(text));
      }
      catch (Exception)
      {
        // A log that throws is not the caller's fault, and nothing may pass through C.
      }
    }
  }
}

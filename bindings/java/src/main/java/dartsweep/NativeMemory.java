package dartsweep;

import java.lang.ref.Cleaner;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.ReadOnlyBufferException;
import java.util.function.LongConsumer;

/** What goes between Java's memory and C's. */
final class NativeMemory {
  private static final Cleaner CLEANER = Cleaner.create();

  private NativeMemory() {}

  /** Gives C's memory back when an object is collected. */
  static void releaseWith(Object object, long address, LongConsumer release) {
    CLEANER.register(object, () -> release.accept(address));
  }

  /** A direct buffer of what remains in a buffer, where C can use it in place, or a double[]: the buffer's own if it is the whole of it. */
  static Object of(DoubleBuffer buffer) {
    if (buffer == null) return null;
    if (buffer.isDirect() && buffer.order() == ByteOrder.nativeOrder()) return buffer.slice();
    if (isWhole(buffer)) return buffer.array();
    double[] copy = new double[buffer.remaining()];
    buffer.duplicate().get(copy);
    return copy;
  }

  /** Gives memory as `of` does, for C to write to; refuses a buffer that is read-only. */
  static Object writable(DoubleBuffer buffer) {
    if (buffer != null && buffer.isReadOnly()) throw new ReadOnlyBufferException();
    return of(buffer);
  }

  /** After a call that wrote to what `of` made: into the buffer, where that was copied. */
  static void copyBack(Object memory, DoubleBuffer buffer) {
    if (memory instanceof double[] array && !isWhole(buffer)) buffer.duplicate().put(array);
  }

  private static boolean isWhole(DoubleBuffer buffer) {
    return buffer.hasArray() && buffer.remaining() == buffer.array().length;
  }

  /** Called by C. */
  static void log(Log log, int level, String text) {
    log.write(LogLevel.swigToEnum(level), text);
  }
}

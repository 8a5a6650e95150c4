package dartsweep;

/** Receives lines of the library's log, on the thread that calls the library. */
@FunctionalInterface
public interface Log {
  void write(LogLevel level, String text);
}

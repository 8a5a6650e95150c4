package dartsweep;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.file.DirectoryStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Locale;

/** Loads the native library: the one in the jar for this machine, else the one on java.library.path. */
final class NativeLibrary {
  private static final String MODULE = System.mapLibraryName("dartsweep_java");
  private static final String PREFIX = "dartsweep-java-";

  private NativeLibrary() {}

  static void load() {
    try (InputStream module = NativeLibrary.class.getResourceAsStream("native/" + machine() + "/" + MODULE)) {
      if (module == null) {
        System.loadLibrary("dartsweep_java");
        return;
      }
      Path directory = Files.createTempDirectory(PREFIX);
      if (MODULE.endsWith(".dll")) deleteOthers(directory.getParent());
      Path file = directory.resolve(MODULE);
      try {
        Files.copy(module, file);
        System.load(file.toString());
      } finally {
        delete(directory);
      }
    } catch (IOException error) {
      throw new UncheckedIOException(error);
    }
  }

  /** The folder's name: linux-amd64, linux-aarch64, windows-amd64, mac-aarch64 and so on. */
  private static String machine() {
    String system = System.getProperty("os.name").split(" ")[0].toLowerCase(Locale.ROOT);
    String processor = System.getProperty("os.arch").replace("x86_64", "amd64");
    return system + "-" + processor;
  }

  /** Windows does not delete a library that is loaded. A later run deletes it, a day after: a new one may be about to be loaded. */
  private static void deleteOthers(Path directory) throws IOException {
    long old = System.currentTimeMillis() - Duration.ofDays(1).toMillis();
    try (DirectoryStream<Path> others = Files.newDirectoryStream(directory, PREFIX + "*")) {
      for (Path other : others) {
        long written = other.toFile().lastModified(); // 0 if another run has deleted it
        if (written != 0 && written < old) delete(other);
      }
    }
  }

  /** Deletes what may be deleted. */
  private static void delete(Path directory) {
    directory.resolve(MODULE).toFile().delete();
    directory.toFile().delete();
  }
}

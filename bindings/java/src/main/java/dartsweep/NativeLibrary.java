package dartsweep;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Locale;

/** Loads the native libraries: those in the jar for this machine, else the one on java.library.path. */
final class NativeLibrary {
  private static final String MODULE = System.mapLibraryName("dartsweep_java");

  private NativeLibrary() {}

  static void load() {
    String machine = System.getProperty("os.name").split(" ")[0] + "-" + System.getProperty("os.arch");
    String folder = "native/" + machine.toLowerCase(Locale.ROOT) + "/";
    try (InputStream list = NativeLibrary.class.getResourceAsStream(folder + "list.txt")) {
      if (list == null) {
        System.loadLibrary("dartsweep_java");
        return;
      }
      // The module looks for the library beside it; both are loaded before the files go.
      Path directory = Files.createTempDirectory("dartsweep");
      String[] names = new String(list.readAllBytes()).strip().split("\\s+");
      for (String name : names) {
        try (InputStream file = NativeLibrary.class.getResourceAsStream(folder + name)) {
          Files.copy(file, directory.resolve(name));
        }
      }
      try {
        System.load(directory.resolve(MODULE).toString());
      } finally {
        for (String name : names) directory.resolve(name).toFile().delete();
        directory.toFile().delete();
      }
    } catch (IOException error) {
      throw new UncheckedIOException(error);
    }
  }
}

package dartsweep;

/** A call has failed, and nothing has changed. The text is the library's; there is a class for each status. */
@SuppressWarnings("serial") // statuses are numbers of one release
public abstract sealed class DartsweepException extends RuntimeException {
  private final Status status;

  private DartsweepException(Status status, String message) {
    super(message);
    this.status = status;
  }

  public Status status() {
    return status;
  }

  static DartsweepException of(int status, boolean closed, String message) {
    if (closed) return new Closed(message);
    return switch (Status.swigToEnum(status)) {
      case NULL_ARGUMENT -> new NullArgument(message);
      case BAD_STRUCT_SIZE -> new BadStructSize(message);
      case UNSUPPORTED -> new Unsupported(message);
      case OUT_OF_RANGE -> new OutOfRange(message);
      case NON_FINITE -> new NonFinite(message);
      case WRONG_SIZE -> new WrongSize(message);
      case STALE_ID -> new StaleId(message);
      case BUFFER_TOO_SMALL -> new BufferTooSmall(message);
      case OUT_OF_MEMORY -> new OutOfMemory(message);
      case TOO_LARGE -> new TooLarge(message);
      case INDEX_OUT_OF_RANGE -> new IndexOutOfRange(message);
      case BAD_CELL_TYPE -> new BadCellType(message);
      case BAD_CELL -> new BadCell(message);
      case INVERTED_CELL -> new InvertedCell(message);
      case INVALID_CELL -> new InvalidCell(message);
      case DUPLICATE_CELL -> new DuplicateCell(message);
      case SHARED_FACE -> new SharedFace(message);
      case BOUNDARY_CROSSES -> new BoundaryCrosses(message);
      case OUTSIDE -> new Outside(message);
      case IMPASSABLE -> new Impassable(message);
      case OCCUPIED -> new Occupied(message);
      case IN_USE -> new InUse(message);
      case SHARED -> new Shared(message);
      case DUPLICATE_ID -> new DuplicateId(message);
      case NOT_FOUND -> new NotFound(message);
      case TRUNCATED -> new Truncated(message);
      case CORRUPT -> new Corrupt(message);
      case BAD_VERSION -> new BadVersion(message);
      case NOT_ENABLED -> new NotEnabled(message);
      case NOT_BUILT -> new NotBuilt(message);
      case INTERNAL -> new Internal(message);
      case BAD_TOPOLOGY -> new BadTopology(message);
      case BORROWED -> new Borrowed(message);
      case WRITE_FAILED -> new WriteFailed(message);
      case NOT_CLOSED -> new NotClosed(message);
      case REPEATED_VERTEX -> new RepeatedVertex(message);
      case DUPLICATE_PART -> new DuplicatePart(message);
      case NOT_MANIFOLD -> new NotManifold(message);
      case NOT_ORIENTED -> new NotOriented(message);
      case NOT_CONFORMING -> new NotConforming(message);
      case OK -> throw new AssertionError(message);
    };
  }

  /** The object was closed before. */
  public static final class Closed extends NullArgument {
    private Closed(String message) {
      super(message);
    }
  }

  /** A required pointer or handle is null. */
  public static non-sealed class NullArgument extends DartsweepException {
    private NullArgument(String message) {
      super(Status.NULL_ARGUMENT, message);
    }
  }

  /** struct_size is smaller than the first release's struct. */
  public static final class BadStructSize extends DartsweepException {
    private BadStructSize(String message) {
      super(Status.BAD_STRUCT_SIZE, message);
    }
  }

  /** The library does not know a value, a flag or a non-zero member. */
  public static final class Unsupported extends DartsweepException {
    private Unsupported(String message) {
      super(Status.UNSUPPORTED, message);
    }
  }

  /** An index or number lies outside the documented range. */
  public static final class OutOfRange extends DartsweepException {
    private OutOfRange(String message) {
      super(Status.OUT_OF_RANGE, message);
    }
  }

  /** A coordinate is NaN or infinite. */
  public static final class NonFinite extends DartsweepException {
    private NonFinite(String message) {
      super(Status.NON_FINITE, message);
    }
  }

  /** Sizes, strides or offsets of arrays contradict each other. */
  public static final class WrongSize extends DartsweepException {
    private WrongSize(String message) {
      super(Status.WRONG_SIZE, message);
    }
  }

  /** The id names nothing that exists. */
  public static final class StaleId extends DartsweepException {
    private StaleId(String message) {
      super(Status.STALE_ID, message);
    }
  }

  /** The count argument was set to the capacity that is needed. */
  public static final class BufferTooSmall extends DartsweepException {
    private BufferTooSmall(String message) {
      super(Status.BUFFER_TOO_SMALL, message);
    }
  }

  /** The allocator returned null. */
  public static final class OutOfMemory extends DartsweepException {
    private OutOfMemory(String message) {
      super(Status.OUT_OF_MEMORY, message);
    }
  }

  /** More cells or points than 28-bit indices can name. */
  public static final class TooLarge extends DartsweepException {
    private TooLarge(String message) {
      super(Status.TOO_LARGE, message);
    }
  }

  /** A cell names a point that does not exist. */
  public static final class IndexOutOfRange extends DartsweepException {
    private IndexOutOfRange(String message) {
      super(Status.INDEX_OUT_OF_RANGE, message);
    }
  }

  /** A cell type is unknown. */
  public static final class BadCellType extends DartsweepException {
    private BadCellType(String message) {
      super(Status.BAD_CELL_TYPE, message);
    }
  }

  /** Repeated points in a cell, or faces that do not close a sphere. */
  public static final class BadCell extends DartsweepException {
    private BadCell(String message) {
      super(Status.BAD_CELL, message);
    }
  }

  /** A cell is turned inside out. */
  public static final class InvertedCell extends DartsweepException {
    private InvertedCell(String message) {
      super(Status.INVERTED_CELL, message);
    }
  }

  /** A cell is flat, folded, or not seen whole from the mean of its vertices. */
  public static final class InvalidCell extends DartsweepException {
    private InvalidCell(String message) {
      super(Status.INVALID_CELL, message);
    }
  }

  /** Two cells lie on the same side of one face. */
  public static final class DuplicateCell extends DartsweepException {
    private DuplicateCell(String message) {
      super(Status.DUPLICATE_CELL, message);
    }
  }

  /** A face belongs to three cells or more. */
  public static final class SharedFace extends DartsweepException {
    private SharedFace(String message) {
      super(Status.SHARED_FACE, message);
    }
  }

  /** The outer boundary passes through itself. */
  public static final class BoundaryCrosses extends DartsweepException {
    private BoundaryCrosses(String message) {
      super(Status.BOUNDARY_CROSSES, message);
    }
  }

  /** The point lies in no cell. */
  public static final class Outside extends DartsweepException {
    private Outside(String message) {
      super(Status.OUTSIDE, message);
    }
  }

  /** The point lies in an impassable volume. */
  public static final class Impassable extends DartsweepException {
    private Impassable(String message) {
      super(Status.IMPASSABLE, message);
    }
  }

  /** The change would make a cell impassable that something occupies. */
  public static final class Occupied extends DartsweepException {
    private Occupied(String message) {
      super(Status.OCCUPIED, message);
    }
  }

  /** Scenes (or other scenes) use the environment. */
  public static final class InUse extends DartsweepException {
    private InUse(String message) {
      super(Status.IN_USE, message);
    }
  }

  /** Several scenes share the environment: it can't be changed. */
  public static final class Shared extends DartsweepException {
    private Shared(String message) {
      super(Status.SHARED, message);
    }
  }

  /** An id occurs twice in a batch. */
  public static final class DuplicateId extends DartsweepException {
    private DuplicateId(String message) {
      super(Status.DUPLICATE_ID, message);
    }
  }

  /** No cell has these vertices. */
  public static final class NotFound extends DartsweepException {
    private NotFound(String message) {
      super(Status.NOT_FOUND, message);
    }
  }

  /** The snapshot block ends early. */
  public static final class Truncated extends DartsweepException {
    private Truncated(String message) {
      super(Status.TRUNCATED, message);
    }
  }

  /** The snapshot block is damaged. */
  public static final class Corrupt extends DartsweepException {
    private Corrupt(String message) {
      super(Status.CORRUPT, message);
    }
  }

  /** The snapshot block was written by an unknown format version. */
  public static final class BadVersion extends DartsweepException {
    private BadVersion(String message) {
      super(Status.BAD_VERSION, message);
    }
  }

  /** The scene has not enabled the feature that this call needs. */
  public static final class NotEnabled extends DartsweepException {
    private NotEnabled(String message) {
      super(Status.NOT_ENABLED, message);
    }
  }

  /** The library was built without this part. */
  public static final class NotBuilt extends DartsweepException {
    private NotBuilt(String message) {
      super(Status.NOT_BUILT, message);
    }
  }

  /** A bug of the library; please report the message. */
  public static final class Internal extends DartsweepException {
    private Internal(String message) {
      super(Status.INTERNAL, message);
    }
  }

  /** The cells are not arranged as the change needs them; the message says how. */
  public static final class BadTopology extends DartsweepException {
    private BadTopology(String message) {
      super(Status.BAD_TOPOLOGY, message);
    }
  }

  /** The points belong to the host and have no room for another vertex. */
  public static final class Borrowed extends DartsweepException {
    private Borrowed(String message) {
      super(Status.BORROWED, message);
    }
  }

  /** A recording could not be written. */
  public static final class WriteFailed extends DartsweepException {
    private WriteFailed(String message) {
      super(Status.WRITE_FAILED, message);
    }
  }

  /** The body is not a closed surface. */
  public static final class NotClosed extends DartsweepException {
    private NotClosed(String message) {
      super(Status.NOT_CLOSED, message);
    }
  }

  /** An edge or face of a body repeats a vertex. */
  public static final class RepeatedVertex extends DartsweepException {
    private RepeatedVertex(String message) {
      super(Status.REPEATED_VERTEX, message);
    }
  }

  /** A body has an edge or face twice. */
  public static final class DuplicatePart extends DartsweepException {
    private DuplicatePart(String message) {
      super(Status.DUPLICATE_PART, message);
    }
  }

  /** A body would not be a manifold. */
  public static final class NotManifold extends DartsweepException {
    private NotManifold(String message) {
      super(Status.NOT_MANIFOLD, message);
    }
  }

  /** Faces of a body are turned against each other. */
  public static final class NotOriented extends DartsweepException {
    private NotOriented(String message) {
      super(Status.NOT_ORIENTED, message);
    }
  }

  /** Parts of a mesh lie on each other and can't be sewn. */
  public static final class NotConforming extends DartsweepException {
    private NotConforming(String message) {
      super(Status.NOT_CONFORMING, message);
    }
  }
}

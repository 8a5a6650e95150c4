package dartsweep;

/** An edge of a body. */
public record BodyEdgeId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final BodyEdgeId NULL = new BodyEdgeId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static BodyEdgeId of(int[] numbers) {
    return new BodyEdgeId(numbers[0], numbers[1]);
  }

  static int[] numbers(BodyEdgeId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

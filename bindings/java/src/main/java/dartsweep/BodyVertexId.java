package dartsweep;

/** A vertex of a body. */
public record BodyVertexId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final BodyVertexId NULL = new BodyVertexId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static BodyVertexId of(int[] numbers) {
    return new BodyVertexId(numbers[0], numbers[1]);
  }

  static int[] numbers(BodyVertexId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

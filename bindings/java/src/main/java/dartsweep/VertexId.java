package dartsweep;

/** A vertex of an environment; index is the point's index at creation. */
public record VertexId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final VertexId NULL = new VertexId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static VertexId of(int[] numbers) {
    return new VertexId(numbers[0], numbers[1]);
  }

  static int[] numbers(VertexId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

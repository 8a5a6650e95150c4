package dartsweep;

/** A body of a scene. */
public record BodyId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final BodyId NULL = new BodyId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static BodyId of(int[] numbers) {
    return new BodyId(numbers[0], numbers[1]);
  }

  static int[] numbers(BodyId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

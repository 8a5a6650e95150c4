package dartsweep;

/** A triangle of a body. */
public record BodyFaceId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final BodyFaceId NULL = new BodyFaceId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static BodyFaceId of(int[] numbers) {
    return new BodyFaceId(numbers[0], numbers[1]);
  }

  static int[] numbers(BodyFaceId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

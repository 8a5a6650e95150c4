package dartsweep;

/** A face of an environment: face number `local` of a volume. */
public record FaceId(int volume, int generation, int local) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final FaceId NULL = new FaceId(0, 0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static FaceId of(int[] numbers) {
    return new FaceId(numbers[0], numbers[1], numbers[2]);
  }

  static int[] numbers(FaceId id) {
    return id == null ? null : new int[] {id.volume, id.generation, id.local};
  }
}

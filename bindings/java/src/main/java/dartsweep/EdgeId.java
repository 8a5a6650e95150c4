package dartsweep;

/** An edge of an environment: edge number `local` of a volume. */
public record EdgeId(int volume, int generation, int local) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final EdgeId NULL = new EdgeId(0, 0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static EdgeId of(int[] numbers) {
    return new EdgeId(numbers[0], numbers[1], numbers[2]);
  }

  static int[] numbers(EdgeId id) {
    return id == null ? null : new int[] {id.volume, id.generation, id.local};
  }
}

package dartsweep;

/** A particle of a scene. */
public record ParticleId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final ParticleId NULL = new ParticleId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static ParticleId of(int[] numbers) {
    return new ParticleId(numbers[0], numbers[1]);
  }

  static int[] numbers(ParticleId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

package dartsweep;

/** A volume of an environment; index is the cell's index at creation. */
public record VolumeId(int index, int generation) {
  /** Names nothing; null does as well where an id is an argument. */
  public static final VolumeId NULL = new VolumeId(0, 0);

  public boolean isNull() {
    return generation == 0;
  }

  static VolumeId of(int[] numbers) {
    return new VolumeId(numbers[0], numbers[1]);
  }

  static int[] numbers(VolumeId id) {
    return id == null ? null : new int[] {id.index, id.generation};
  }
}

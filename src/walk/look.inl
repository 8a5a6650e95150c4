// What a look at a cell tells of the exit of a cast, in four bytes.

constexpr uint32_t kStays = kNoFacet;

struct Exit {
  uint32_t facet = kStays;  // kStays: the target lies in the cell
  uint32_t simplex = 0;
};

enum class LookKind : uint8_t { kNothing, kPlanes, kBox, kLines };
constexpr uint8_t kNotKnown = 0xff;

/** The first simplex of each facet of a tetrahedron, a pyramid and a box. */
constexpr uint8_t kFirstSimplices[3][6] = {{0, 1, 2, 3}, {0, 2, 3, 4, 5}, {0, 2, 4, 6, 8, 10}};

/** A facet of a cell of these forms: links end its first unit. */
template <int D>
HalfFacet linked_facet(Cell c, uint32_t facet_count, uint32_t facet) {
  return {(c.unit + 1) * kUnitWords<D> - facet_count + facet};
}

/** What the planes of a cell say about the target, or its triangles about the line. */
class Look {
 public:
  /** Makes the look of a tetrahedron, a pyramid or a box: `outside` has the facets with the target outside, or is
   * kNotDecided or more. */
  static Look of_planes(uint32_t outside, uint32_t facet_count, bool is_far = false) {
    return Look(outside | of_cell(facet_count) | (is_far ? kFlag : 0));
  }
  /** The word of such a look without facets and flag. */
  static constexpr uint32_t of_cell(uint32_t facet_count) { return word(facet_count, LookKind::kPlanes); }
  /** Makes the look of a box that need not be convex. */
  template <class Tally>
  static Look of_box(const BoxExits& exits, Tally& tally) {
    tally.tests(12 + 4 * bit_count(exits.candidates));
    const bool several = (exits.pierced & (exits.pierced - 1)) != 0;
    return Look((exits.sure ? exits.pierced : kNotKnown) | word(exits.second, LookKind::kBox) |
                (exits.sure && !several ? kFlag : 0));
  }
  /** The word of a box's look that names no exit yet. */
  static constexpr uint32_t of_box_cell() { return word(0, LookKind::kBox) | kFlag; }
  /** The bits that name an exit. */
  static constexpr int of_box_facet(uint32_t facet, uint32_t second) {
    return static_cast<int>(1u << facet | second << (8 + facet));
  }
  /** This look of a box, but with several exits. */
  Look with_several() const { return Look(word_ & ~kFlag); }
  /** Makes the look of a polyhedron. `is_decided`: the filter decided all triangles. */
  static Look of_lines(bool stays, bool is_decided) {
    return Look((stays ? 0 : kNotKnown) | word(0, LookKind::kLines) | (is_decided ? kFlag : 0));
  }
  static Look of_nothing() { return Look(kNotKnown); }
  static Look of_word(uint32_t word) { return Look(word); }

  /** kPlanes: facets with the target outside; not known from kNotDecided on. kBox: pierced outwards, or kNotKnown. */
  uint32_t facets() const { return word_ & 0xffu; }
  LookKind kind() const { return static_cast<LookKind>(word_ >> 16 & 0xffu); }
  bool may_leave() const { return facets() != 0; }
  /** False for planes side by side of which the filter left some open: ask again. */
  bool is_decided() const { return kind() != LookKind::kPlanes || facets() < kNotDecided; }

  /** How many facets the cell has; for looks of planes. */
  uint32_t facet_count() const { return word_ >> 8 & 0xffu; }
  /** Gives the exit by a facet, through its first simplex; for looks of planes. */
  Exit exit_by(uint32_t facet) const { return {facet, kFirstSimplices[facet_count() - 4][facet]}; }
  /** Tells whether the target of a cast in a tetrahedron is far away, as simplex.inl says; for looks of planes. */
  bool is_far() const { return has_flag(); }
  /** Gives a facet of the cell; for looks of planes. */
  template <int D>
  HalfFacet half_facet(Cell c, uint32_t facet) const {
    return linked_facet<D>(c, facet_count(), facet);
  }

  /** At most one facet is pierced, for certain; for looks of boxes. */
  bool has_one_exit() const { return has_flag(); }
  /** Gives the exit of a box that has one exit. */
  Exit exit_of_box() const {
    const uint32_t f = lowest_bit(facets());
    return {f, 2 * f + is_second(f)};
  }
  /** Tells whether a facet of a box is pierced through its second triangle. */
  uint32_t is_second(uint32_t facet) const { return word_ >> (8 + facet) & 1u; }
  /** The filter decided all triangles; for looks of lines. */
  bool is_sure() const { return has_flag(); }

  static constexpr uint32_t kFlag = 1u << 24;  // of planes is_far, of boxes has_one_exit, of lines is_sure

 private:
  explicit Look(uint32_t word) : word_(word) {}
  static constexpr uint32_t word(uint32_t second, LookKind kind) { return second << 8 | uint32_t(kind) << 16; }
  bool has_flag() const { return (word_ & kFlag) != 0; }

  uint32_t word_;  // facets, of planes their number and of boxes second triangles, kind, flag
};

// Convex cells of the plane. A line sees the vertices on the way round such a cell change from its right to its left
// where it leaves, and once more where it came in: so the side through which it leaves is found by halving.

/** A convex cell and a segment p q whose part from its entry, or from p, on begins in it. Where its vertices stand is
 * found once: asking the map for each costs a short move a sixth more. */
template <class Tally>
class ConvexPolygon {
 public:
  ConvexPolygon(const Environment<2>& env, Cell c, const double* p, const double* q, Tally& tally) noexcept
      : env_(env), p_(p), q_(q), tally_(tally) {
    const uint32_t* const w = env.map.record(c);
    const Form form = form_of(w[0]);
    is_general_ = form == Form::kGeneral;
    size_ = is_general_ ? env.map.general_shape(w[0]).vertex_count() : Map<2>::standard_vertex_count(form);
    vertices_ = w + (form == Form::kBox ? kUnitWords<2> : 0);
    first_ = is_general_ ? first_vertex_item<2>(size_) : 0;
  }

  /** The side through which the segment leaves; kNoFacet: it ends in the cell. `entered`: the side through which it
   * came in; kNoFacet: p lies in the cell, and `forecast` may name a side to ask first. */
  uint32_t exit(uint32_t entered, uint32_t forecast) noexcept {
    if (entered != kNoFacet) {
      const uint32_t f = pierced(next(entered), size_ - 1);
      return is_outside(f) ? f : kNoFacet;
    }
    // Sides with q outside follow each other, and not all are such.
    uint32_t first = forecast < size_ ? forecast : 0, last = first, inside = first;
    if (is_outside(first)) {
      for (inside = previous(first); inside != next(last) && is_outside(inside); inside = previous(first))
        first = inside;
    } else {
      do {
        first = next(first);
        if (first == inside) return kNoFacet;
      } while (!is_outside(first));
      last = first;
    }
    while (next(last) != inside && is_outside(next(last))) last = next(last);
    return pierced(first, (last + size_ - first) % size_ + 1);
  }

 private:
  uint32_t next(uint32_t i) const noexcept { return i + 1 == size_ ? 0 : i + 1; }
  uint32_t previous(uint32_t i) const noexcept { return i == 0 ? size_ - 1 : i - 1; }
  const double* at(uint32_t i) const noexcept {
    return env_.point(vertices_[is_general_ ? item_word<2>(first_ + i) : i] & kVertexMask);
  }
  bool is_outside(uint32_t f) noexcept {
    const double* side[2] = {at(f), at(next(f))};
    return plane_side<2>(side, q_, tally_).sign > 0;
  }
  bool is_left(uint32_t i) noexcept {
    const double* const vertex = at(i);
    return line_side<2>(p_, q_, &vertex, tally_).sign > 0;
  }

  /** Finds the side that the line leaves through among `count` sides in a row, from `first` on. */
  uint32_t pierced(uint32_t first, uint32_t count) noexcept {
    while (count > 1) {
      const uint32_t half = count / 2, middle = (first + half) % size_;
      if (is_left(middle)) {
        count = half;
      } else {
        first = middle;
        count -= half;
      }
    }
    return first;
  }

  const Environment<2>& env_;
  const double* p_;
  const double* q_;
  Tally& tally_;
  const uint32_t* vertices_;
  uint32_t size_, first_;  // item of a general cell
  bool is_general_;
};

/** Whether the filter sees that a point lies strictly inside of all sides of a polygon. */
inline bool is_inside_all_sides(const Environment<2>& env, Cell c, const double* x) noexcept {
  const uint32_t count = env.map.vertices_of(c);
  filter::Vec<2> a = filter::difference<2>(env.point(c, count - 1), x), reach = filter::extent(a);
  double least = HUGE_VAL;
  for (uint32_t i = 0; i < count; ++i) {
    const filter::Vec<2> b = filter::difference<2>(env.point(c, i), x), size = filter::extent(b);
    reach = {filter::larger(reach.x, size.x), filter::larger(reach.y, size.y)};
    least = filter::smaller(least, a.x * b.y - a.y * b.x);
    a = b;
  }
  return least > 0 && filter::certain(least, reach);
}

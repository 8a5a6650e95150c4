// Cells where points have moved: whether they may be entered, and what is asked of the memory before.

/** Finds what known_of finds; `apex` is the cell's centre. */
template <int D>
CheckedCells::Known known_with_centre(const Environment<D>& env, Cell c, const double* apex) noexcept {
  const uint32_t index = env.map.index(c);
  CheckedCells::Known known = env.checked.known(index);
  if (known != CheckedCells::Known::kNothing) return known;
  if constexpr (D == 3) {
    const uint32_t* const w = env.map.record(c);
    if (form_of(w[0]) == Form::kBox) {
      if (is_cuboid(env, c))
        known = CheckedCells::Known::kCuboid;
      else if (is_plainly_valid(env, w, apex))
        known = CheckedCells::Known::kValid;
    }
  }
  if (known == CheckedCells::Known::kNothing) return find_out_validity(env, c);
  env.checked.note(index, known);
  return known;
}

/** Whether a cell is a cuboid. A cuboid is noted. Of another cell nothing is noted: whether it is valid is not asked. */
template <int D>
DSW_HOT bool find_out_cuboid(const Environment<D>& env, Cell c) noexcept {
  const uint32_t index = env.map.index(c);
  const CheckedCells::Known known = env.checked.known(index);
  if (known != CheckedCells::Known::kNothing) return known == CheckedCells::Known::kCuboid;
  if (!is_cuboid(env, c)) return false;
  env.checked.note(index, CheckedCells::Known::kCuboid);
  return true;
}

/** Tells whether a cell admits a cast, as `admits` does, and gives the cell's centre. */
template <int D>
bool admits_with_centre(const Environment<D>& env, Cell c, double* apex) noexcept {
  centre(env, c, apex);
  return !env.has_moved() || CheckedCells::is_valid(known_with_centre(env, c, apex));
}

/** Finds what known_of finds, with the lanes of this walk. */
template <int D>
DSW_NOINLINE CheckedCells::Known known_moving(const Environment<D>& env, Cell c) noexcept {
  const CheckedCells::Known known = env.checked.known(env.map.index(c));
  if (known != CheckedCells::Known::kNothing) return known;
  double apex[D];
  centre(env, c, apex);
  return known_with_centre(env, c, apex);
}

/** Asks for what is beyond a facet, where points have moved: nobody may have looked at it. Vertices of a hexahedron are
 * not asked for, since one that is known is read no sooner than where no point has moved. */
template <int D>
DSW_HOT void prefetch_beyond(const Environment<D>& env, HalfFacet at) noexcept {
  const HalfFacet o = env.map.opposite(at);
  if (!o.valid()) return;
  const Cell c = env.map.cell_of(o);
  if (D == 3 && form_of(env.map.record(c)[0]) == Form::kBox) {
    env.checked.prefetch(env.map.index(c));
  } else {
    prefetch_moving(env, c);
  }
}

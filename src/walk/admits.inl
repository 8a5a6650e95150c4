// Cells where points have moved: whether they may be entered, and what is asked of the memory before.

/** As find_out_validity, with the cell's centre. */
template <int D>
bool find_out_validity(const Environment<D>& env, Cell c, const double* apex) noexcept {
  if constexpr (D == 3) {
    const uint32_t* const w = env.map.record(c);
    if (form_of(w[0]) == Form::kBox && is_plainly_valid(env, w, apex)) {
      env.checked.note(env.map.index(c), CheckedCells::Known::kValid);
      return true;
    }
  }
  return dsw::find_out_validity(env, c);
}

/** As admits; gives the cell's centre, too. */
template <int D>
bool admits_with_centre(const Environment<D>& env, Cell c, double* apex) noexcept {
  centre(env, c, apex);
  if (!env.has_moved()) return true;
  const CheckedCells::Known known = env.checked.known(env.map.index(c));
  return known == CheckedCells::Known::kNothing ? find_out_validity(env, c, apex)
                                                : known == CheckedCells::Known::kValid;
}

/** As admits, where points have moved. */
template <int D>
__attribute__((noinline)) bool admits_moving(const Environment<D>& env, Cell c) noexcept {
  const CheckedCells::Known known = env.checked.known(env.map.index(c));
  if (known != CheckedCells::Known::kNothing) return known == CheckedCells::Known::kValid;
  double apex[D];
  centre(env, c, apex);
  return find_out_validity(env, c, apex);
}

/** Asks for what is beyond a facet, where points have moved: nobody may have looked at it. */
template <int D>
DSW_HOT void prefetch_beyond(const Environment<D>& env, HalfFacet at) noexcept {
  const HalfFacet o = env.map.opposite(at);
  if (o.valid()) prefetch_moving(env, env.map.cell_of(o));
}

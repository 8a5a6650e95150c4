// Included by walk.inl: which facets of cells have points outside, of several cells side by side.

/** Finds what find_outside of short_way.h finds, of one cell. */
DSW_HOT uint8_t facets_outside(const Environment<3>& env, Cell cell, const double* point) noexcept {
  const Form form = env.map.form(cell);
  if (form != Form::kSimplex && form != Form::kPyramid && form != Form::kBox) return 0;
  CountNothing nothing;
  CastLine line;
  const Look look = ExitFinder<3, CountNothing>(env, point, point, nothing).look(cell, Entry{}, line);
  return static_cast<uint8_t>(look.kind() == LookKind::kPlanes ? look.facets() : 0);
}

/** Finds it of at most kAbreast cells together, if they are of one form that can be looked at so. Returns the cells that are left,
 * a bit each. */
DSW_HOT uint32_t find_outside_abreast(const Environment<3>& env, const Cell* cells, const double* const* points,
                                      uint32_t count, uint8_t* facets) noexcept {
  const uint32_t all = (1u << count) - 1, word = env.map.record(cells[0])[0];
  const Form form = form_of(word);
  if (!pays_abreast(form, true, count)) return all;
  Abreast abreast;
  uint32_t different = 0;
  for (uint32_t j = 0; j < kAbreast; ++j) {
    const uint32_t i = std::min(j, count - 1);
    abreast.records[j] = env.map.record(cells[i]);
    abreast.q[j] = points[i];
    different |= abreast.records[j][0] ^ word;
  }
  if ((different & 7u << kFormShift) != 0) return all;
  Sides sides;
  if (form == Form::kSimplex) {
    sides.look_at_tetrahedra(env.points, abreast);
  } else if (form == Form::kPyramid) {
    sides.look_at_pyramids(env.points, abreast);
  } else {
    sides.look_at_boxes(env.points, abreast);
  }
  uint32_t left = 0;
  for (uint32_t j = 0; j < count; ++j) {
    const uint32_t seen = Look::of_word(sides.looks[j]).facets();
    facets[j] = static_cast<uint8_t>(seen);
    left |= (seen < kNotDecided ? 0 : 1u) << j;
  }
  return left;
}

template <int D>
void find_outside(const Environment<D>& env, const Cell* cells, const double* const* points, uint32_t count,
                  uint8_t* facets) noexcept {
  if constexpr (D == 3) {
    for (uint32_t k = 0; k < count; k += kAbreast) {
      const uint32_t some = std::min(kAbreast, count - k);
      uint32_t left = find_outside_abreast(env, cells + k, points + k, some, facets + k);
      for (; left != 0; left &= left - 1) {
        const uint32_t i = k + lowest_bit(left);
        facets[i] = facets_outside(env, cells[i], points[i]);
      }
    }
  }
}

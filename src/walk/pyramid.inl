// Pyramids that are convex with a flat base: five planes from the vertices relative to the target, three cross products
// serving all of them, one filter bound for the cell.

struct RelativePyramid {
  double x[5], y[5], z[5];

  Vector cross(uint32_t a, uint32_t b) const noexcept {
    return {y[a] * z[b] - z[a] * y[b], z[a] * x[b] - x[a] * z[b], x[a] * y[b] - y[a] * x[b]};
  }
  double dot(const Vector& c, uint32_t i) const noexcept { return (c.x * x[i] + c.y * y[i]) + c.z * z[i]; }
};

/** Asks exactly about the facets that the filter left open. */
template <class Tally>
DSW_COLD uint32_t decide_pyramid(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t sure,
                                 uint32_t outside, Tally& tally) noexcept {
  outside &= sure;
  const Shape shape = standard_shape(Form::kPyramid, w[0] & kShapeMask);
  for (uint32_t unsure = 0x1fu & ~sure; unsure != 0; unsure &= unsure - 1) {
    const uint32_t f = lowest_bit(unsure);
    const uint16_t* local = shape.simplices() + 3 * shape.simplex_first(f);
    const double* facet[3];
    for (uint32_t k = 0; k < 3; ++k) facet[k] = env.point(w[kUnitWords<3> + local[k]]);
    outside |= (plane_side<3>(facet, q, tally).sign > 0 ? 1u : 0u) << f;
  }
  return outside;
}

/** Facets with q outside, a bit each, but for those in `known`, which have it inside. */
template <class Tally>
inline uint32_t outside_flat_pyramid(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t known,
                                     Tally& tally) noexcept {
  RelativePyramid v;
  double mx = 0, my = 0, mz = 0;
  for (uint32_t i = 0; i < 5; ++i) {
    const double* point = env.point(w[kUnitWords<3> + i]);
    v.x[i] = point[0] - q[0];
    v.y[i] = point[1] - q[1];
    v.z[i] = point[2] - q[2];
    mx = std::max(mx, std::fabs(v.x[i]));
    my = std::max(my, std::fabs(v.y[i]));
    mz = std::max(mz, std::fabs(v.z[i]));
  }
  const bool in_range = std::min(std::min(mx, my), mz) >= kFilterMin && std::max(std::max(mx, my), mz) <= kFilterMax;
  const double bound = kPlaneFilter3 * mx * my * mz;
  uint32_t outside = 0, inside = 0;
  // No array of determinants: what compilers make of it waits for its own stores.
  const auto test = [&](uint32_t f, double det) {
    outside |= (det > bound ? 1u : 0u) << f;
    inside |= (det < -bound ? 1u : 0u) << f;
  };
  const Vector base = v.cross(2, 3), first = v.cross(0, 4), second = v.cross(4, 2);
  test(0, v.dot(base, 0));
  test(1, v.dot(first, 1));
  test(2, v.dot(second, 1));
  test(3, -v.dot(second, 3));
  test(4, -v.dot(first, 3));
  outside &= ~known;
  const uint32_t sure = (in_range ? outside | inside : 0) | known;
  return DSW_LIKELY(sure == 0x1fu) ? outside : decide_pyramid(env, w, q, sure, outside, tally);
}

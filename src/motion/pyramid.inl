// Pyramids that are convex with a flat base: five planes from the vertices relative to the target, one filter bound.

struct RelativePyramid {
  double x[5], y[5], z[5];

  /** Minus the determinant of three vertices: positive where the target is outside of their plane. */
  double outside(uint32_t a, uint32_t b, uint32_t c) const noexcept {
    const double cx = y[a] * z[b] - z[a] * y[b], cy = z[a] * x[b] - x[a] * z[b], cz = x[a] * y[b] - y[a] * x[b];
    return -((cx * x[c] + cy * y[c]) + cz * z[c]);
  }
};

/** Asks exactly about the facets that the filter left open. */
template <class Tally>
DSW_COLD uint32_t settle_pyramid(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t sure,
                                 uint32_t outside, Tally& tally) noexcept {
  outside &= sure;
  const Shape shape = standard_shape(Form::kPyramid, w[0] & kShapeMask);
  for (uint32_t unsure = 0x1fu & ~sure; unsure != 0; unsure &= unsure - 1) {
    const uint32_t f = static_cast<uint32_t>(__builtin_ctz(unsure));
    const uint16_t* local = shape.simplices() + 3 * shape.simplex_first(f);
    const double* facet[3];
    for (uint32_t k = 0; k < 3; ++k) facet[k] = env.point(w[kUnitWords + local[k]]);
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
    const double* point = env.point(w[kUnitWords + i]);
    v.x[i] = point[0] - q[0];
    v.y[i] = point[1] - q[1];
    v.z[i] = point[2] - q[2];
    mx = std::max(mx, std::fabs(v.x[i]));
    my = std::max(my, std::fabs(v.y[i]));
    mz = std::max(mz, std::fabs(v.z[i]));
  }
  const bool in_range = std::min(std::min(mx, my), mz) >= kFilterMin && std::max(std::max(mx, my), mz) <= kFilterMax;
  const double bound = kPlaneFilter3 * mx * my * mz;
  const double det[5] = {v.outside(0, 3, 2), v.outside(0, 1, 4), v.outside(1, 2, 4), v.outside(2, 3, 4),
                         v.outside(3, 0, 4)};
  uint32_t outside = 0, inside = 0;
  for (uint32_t f = 0; f < 5; ++f) {
    outside |= (det[f] > bound ? 1u : 0u) << f;
    inside |= (det[f] < -bound ? 1u : 0u) << f;
  }
  outside &= ~known;
  const uint32_t sure = (in_range ? outside | inside : 0) | known;
  return __builtin_expect(sure == 0x1fu, 1) ? outside : settle_pyramid(env, w, q, sure, outside, tally);
}

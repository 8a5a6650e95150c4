// Tetrahedra: the four planes from the vertices relative to the target, two cross products serving all of them, one
// filter bound for the cell.

constexpr uint32_t kFar = 0x10;  // beside a set of facets
#if defined(DSW_FAR_EDGES)
constexpr double kFarEdges = DSW_FAR_EDGES;  // a test compares lines with planes
#else
constexpr double kFarEdges = 2.5;
#endif

struct RelativeTetrahedron {
  double x[4], y[4], z[4];
};

struct Vector {
  double x, y, z;
};

inline Vector cross(const RelativeTetrahedron& v, uint32_t a, uint32_t b) noexcept {
  return {v.y[a] * v.z[b] - v.z[a] * v.y[b], v.z[a] * v.x[b] - v.x[a] * v.z[b], v.x[a] * v.y[b] - v.y[a] * v.x[b]};
}
inline double dot(const Vector& c, const RelativeTetrahedron& v, uint32_t i) noexcept {
  return (c.x * v.x[i] + c.y * v.y[i]) + c.z * v.z[i];
}

/** Asks exactly about the facets that the filter left open. */
template <class Tally>
DSW_COLD uint32_t decide_tetrahedron(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t sure,
                                     uint32_t outside, Tally& tally) noexcept {
  outside &= sure;
  for (uint32_t unsure = 0xfu & ~sure; unsure != 0; unsure &= unsure - 1) {
    const uint32_t f = lowest_bit(unsure);
    const double* facet[3];
    for (uint32_t k = 0; k < 3; ++k) facet[k] = env.point(w[kTetrahedronFacets[f][k]] & kVertexMask);
    outside |= (plane_side<3>(facet, q, tally).sign > 0 ? 1u : 0u) << f;
  }
  return outside;
}

/** Facets with q outside, a bit each, but for those in `known`, which have it inside; and kFar if q is several edges
 * away, so that it pays to follow a line that goes there. */
template <class Tally>
inline uint32_t look_at_tetrahedron(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t known,
                                    Tally& tally) noexcept {
  RelativeTetrahedron v;
  double mx = 0, my = 0, mz = 0;
  for (uint32_t i = 0; i < 4; ++i) {
    const double* point = env.point(w[i] & kVertexMask);
    v.x[i] = point[0] - q[0];
    v.y[i] = point[1] - q[1];
    v.z[i] = point[2] - q[2];
    mx = std::max(mx, std::fabs(v.x[i]));
    my = std::max(my, std::fabs(v.y[i]));
    mz = std::max(mz, std::fabs(v.z[i]));
  }
  const bool in_range = std::min(std::min(mx, my), mz) >= kFilterMin && std::max(std::max(mx, my), mz) <= kFilterMax;
  const double bound = kPlaneFilter3 * mx * my * mz;
  const Vector c01 = cross(v, 0, 1), c23 = cross(v, 2, 3);
  // Minus the determinants of facets 0 1 3, 1 2 3, 2 0 3, 0 2 1 in that order: positive outside.
  const double det[4] = {-dot(c01, v, 3), -dot(c23, v, 1), dot(c23, v, 0), dot(c01, v, 2)};
  uint32_t outside = 0, inside = 0;
  for (uint32_t f = 0; f < 4; ++f) {
    outside |= (det[f] > bound ? 1u : 0u) << f;
    inside |= (det[f] < -bound ? 1u : 0u) << f;
  }
  outside &= ~known;
  const double edge =
      std::max(std::max(std::fabs(v.x[0] - v.x[1]), std::fabs(v.y[0] - v.y[1])), std::fabs(v.z[0] - v.z[1]));
  const double away = std::max(std::max(std::fabs(v.x[0]), std::fabs(v.y[0])), std::fabs(v.z[0]));
  const uint32_t far = away > kFarEdges * edge ? kFar : 0;
  const uint32_t sure = (in_range ? outside | inside : 0) | known;
  return (DSW_LIKELY(sure == 0xfu) ? outside : decide_tetrahedron(env, w, q, sure, outside, tally)) | far;
}

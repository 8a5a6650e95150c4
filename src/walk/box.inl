// Hexahedra: all planes of a cell at once, a lane for each facet. Vertices are taken relative to the target q, so that
// with a, b, c relative
//   plane test of q against triangle a b c  = -det(a, b, c) = b . (a x c)
//   line test of p -> q against edge a -> b = -(p - q) . (a x b)
// and the two triangles of a facet share the cross product of its diagonal.

/** Three coordinates of several points. */
template <class Values>
struct PointsOf {
  Values x, y, z;
};
using Points = PointsOf<Lanes>;

template <class Values>
inline PointsOf<Values> cross(const PointsOf<Values>& a, const PointsOf<Values>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Values>
inline Values dot(const PointsOf<Values>& a, const PointsOf<Values>& b) noexcept {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class Values>
inline PointsOf<Values> select(typename Values::Mask m, const PointsOf<Values>& yes,
                               const PointsOf<Values>& no) noexcept {
  return {Values::select(m, yes.x, no.x), Values::select(m, yes.y, no.y), Values::select(m, yes.z, no.z)};
}

template <int K, class Vertices>
inline Points corner(const Vertices& v) noexcept {
  return {v.template corner<K>(0), v.template corner<K>(1), v.template corner<K>(2)};
}

constexpr uint32_t kAllFacets = 0x3f;
constexpr uint8_t kNotDecided = 0xc0;  // in the place of a set of facets: it is not known. No single bit

/** Asks exactly about the facets that the filter left open. */
template <class Tally>
DSW_COLD uint32_t decide_flat_box(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t sure,
                                  uint32_t outside, Tally& tally) noexcept {
  outside &= sure;
  for (uint32_t unsure = kAllFacets & ~sure; unsure != 0; unsure &= unsure - 1) {
    const uint32_t f = lowest_bit(unsure);
    const double* facet[3];
    box_triangle(env, w, f, 0, facet);  // its star is positive; any other three vertices may lie in a row
    outside |= (plane_side<3>(facet, q, tally).sign > 0 ? 1u : 0u) << f;
  }
  return outside;
}

/** Convex hexahedron with flat facets: facets with q outside, but for those in `known`, which have it inside. */
template <class Tally>
inline uint32_t outside_flat_box(const Environment<3>& env, const uint32_t* w, const double* q, uint32_t known,
                                 Tally& tally) noexcept {
  const FlatBoxVertices v(env.points, w + kUnitWords<3>, q);
  const Points a = corner<0>(v), b = corner<1>(v), c = corner<2>(v);
  const Lanes det = dot(cross(a, c), b), bound = Lanes::all(v.extent.bound());
  const uint32_t outside = Lanes::bits(Lanes::greater(det, bound)) & ~known;
  const uint32_t inside = Lanes::bits(Lanes::greater(Lanes::all(0) - bound, det));
  const uint32_t sure = (v.extent.in_range() ? outside | inside : 0) | known;
  return DSW_LIKELY(sure == kAllFacets) ? outside : decide_flat_box(env, w, q, sure, outside, tally);
}

/** Facets with four corners in lanes: those of one hexahedron, or one facet of each of several. */
template <class Values>
struct Quads {
  PointsOf<Values> a, b, c, d;  // the loop turned so that the diagonal joins a and c
  PointsOf<Values> diagonal;    // a x c
  Values first, second;         // q outside of the triangles a b c and c d a, where positive
};

/** `cut`: where the diagonal joins the second and fourth corners. */
template <class Values>
DSW_HOT Quads<Values> make_quads(const PointsOf<Values>& c0, const PointsOf<Values>& c1, const PointsOf<Values>& c2,
                                 const PointsOf<Values>& c3, typename Values::Mask cut) noexcept {
  Quads<Values> quads;
  quads.a = select(cut, c1, c0), quads.b = select(cut, c2, c1);
  quads.c = select(cut, c3, c2), quads.d = select(cut, c0, c3);
  quads.diagonal = cross(quads.a, quads.c);
  quads.first = dot(quads.diagonal, quads.b);
  quads.second = Values::all(0) - dot(quads.diagonal, quads.d);
  return quads;
}

/** How p -> q passes quads, by lane. */
template <class Values>
struct Piercings {
  typename Values::Mask pierced;  // outwards
  typename Values::Mask second;   // on the side of the second triangle
  typename Values::Mask decided;  // the filter answers for those with q outside of a triangle
};

/** `out1`, `out2`: quads with q outside of their triangles. `back`: p -> q. The diagonal decides between a quad's
 * triangles, two more edges whether that one is pierced. */
template <class Values>
DSW_HOT Piercings<Values> pierce(const Quads<Values>& quads, typename Values::Mask out1, typename Values::Mask out2,
                                 const PointsOf<Values>& back, Values bound) noexcept {
  using Mask = typename Values::Mask;
  const Values minus_bound = Values::all(0) - bound;
  const Values over = dot(quads.diagonal, back);  // > 0: on the side of the second triangle
  const Mask on_second = Values::greater(over, bound), on_first = Values::greater(minus_bound, over);
  const PointsOf<Values> from = select(on_second, quads.c, quads.a), tip = select(on_second, quads.d, quads.b),
                         to = select(on_second, quads.a, quads.c);
  const Values edge1 = dot(cross(from, tip), back), edge2 = dot(cross(tip, to), back);
  const Mask inside = Values::both(Values::greater(edge1, bound), Values::greater(edge2, bound));
  const Mask beside = Values::either(Values::greater(minus_bound, edge1), Values::greater(minus_bound, edge2));
  const Mask q_outside = Values::either(Values::both(on_second, out2), Values::both(on_first, out1));
  const Mask hit = Values::both(q_outside, inside);
  // p against the triangle: minus that of q plus the three line tests is minus the volume seen from p.
  const Values of_q = Values::select(on_second, quads.second, quads.first);
  const Values magnitude = Values::absolute(over);
  const Values of_p = ((of_q - edge1) - edge2) - magnitude;
  const Values p_bound = Values::all(6) * bound;
  const Mask p_inside = Values::greater(Values::all(0) - p_bound, of_p), p_outside = Values::greater(of_p, p_bound);
  const Mask missed = Values::without(Values::either(on_first, on_second), Values::without(q_outside, beside));
  return {Values::both(hit, p_inside), on_second,
          Values::either(missed, Values::both(hit, Values::either(p_inside, p_outside)))};
}

/** What the lanes say about the exits of a hexahedron that need not be convex. */
struct BoxExits {
  uint32_t pierced = 0;     // facets that p -> q pierces outwards
  uint32_t second = 0;      // where a facet is pierced: through its second triangle
  uint32_t candidates = 0;  // facets with q outside of one triangle or both
  bool sure = false;        // false: the filter could not decide all that matters, ask again exactly
};

inline BoxExits box_exits(const Environment<3>& env, const uint32_t* w, const double* p, const double* q) noexcept {
  BoxExits exits;
  const BoxVertices v(env.points, w + kUnitWords<3>, q);
  const Points c0 = corner<0>(v), c1 = corner<1>(v), c2 = corner<2>(v), c3 = corner<3>(v);
  if (DSW_UNLIKELY(!v.extent.in_range())) return exits;
  const Quads<Lanes> quads = make_quads(c0, c1, c2, c3, Lanes::spread(w[0] & kShapeMask));
  const Lanes bound = Lanes::all(v.extent.bound()), minus_bound = Lanes::all(0) - bound;
  const Lanes::Mask out1 = Lanes::greater(quads.first, bound), out2 = Lanes::greater(quads.second, bound);
  const Lanes::Mask decided1 = Lanes::either(out1, Lanes::greater(minus_bound, quads.first)),
                    decided2 = Lanes::either(out2, Lanes::greater(minus_bound, quads.second));
  if (DSW_UNLIKELY((Lanes::bits(Lanes::both(decided1, decided2)) & kAllFacets) != kAllFacets)) return exits;
  exits.sure = true;
  exits.candidates = Lanes::bits(Lanes::either(out1, out2));
  if (exits.candidates == 0) return exits;

  const double u[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  const Extent reach = {std::max(v.extent.x, std::fabs(u[0])), std::max(v.extent.y, std::fabs(u[1])),
                        std::max(v.extent.z, std::fabs(u[2]))};
  const Piercings<Lanes> lines = pierce(quads, out1, out2, Points{Lanes::all(u[0]), Lanes::all(u[1]), Lanes::all(u[2])},
                                        Lanes::all(reach.bound()));
  exits.pierced = Lanes::bits(lines.pierced);
  exits.second = Lanes::bits(lines.second);
  exits.sure = reach.in_range() && (exits.candidates & ~Lanes::bits(lines.decided)) == 0;
  return exits;
}

/** Whether a hexahedron with this centre is so clearly valid that the filter sees it, as is_plainly_valid in
 * environment/validity.cpp asks. */
inline bool is_plainly_valid(const Environment<3>& env, const uint32_t* w, const double* apex) noexcept {
  const BoxVertices v(env.points, w + kUnitWords<3>, apex);
  const Points c0 = corner<0>(v), c1 = corner<1>(v), c2 = corner<2>(v), c3 = corner<3>(v);
  const Points across02 = cross(c0, c2), across13 = cross(c1, c3);
  const Lanes bound = Lanes::all(v.extent.bound()), minus_bound = Lanes::all(0) - bound;
  const uint32_t positive =
      Lanes::bits(Lanes::greater(dot(across02, c3), bound)) & Lanes::bits(Lanes::greater(dot(across13, c0), bound));
  const uint32_t negative = Lanes::bits(Lanes::greater(minus_bound, dot(across02, c1))) &
                            Lanes::bits(Lanes::greater(minus_bound, dot(across13, c2)));
  return v.extent.in_range() && (positive & negative & kAllFacets) == kAllFacets;
}

#include "motion/sequence.h"

#include <algorithm>

#include "base/slot_pool.h"
#include "motion/shear.h"
#include "motion/standard_facets.h"

namespace dsw {
namespace {

const PassTriangles kPassTriangles = choose_pass_triangles();

bool is_of_tetrahedron(const Map<3>& map, uint32_t facet) noexcept {
  return form_of(map.words[facet / kUnitWords * kUnitWords]) == Form::kSimplex;
}

Triangle triangle(const Map<3>& map, uint32_t facet) noexcept {
  const uint32_t* const w = map.words.data() + facet / kUnitWords * size_t{kUnitWords};
  const uint8_t(&local)[3] = kTetrahedronFacets[facet % kUnitWords - (kUnitWords - 4)];
  return {{w[local[0]] & kVertexMask, w[local[1]] & kVertexMask, w[local[2]] & kVertexMask}};
}

/** Of tetrahedra: whether all are, and the cells valid. */
bool are_passable(const Environment<3>& env, const Array<uint32_t>& facets) noexcept {
  const Map<3>& map = env.map;
  uint32_t marks = 0;
  for (const uint32_t f : facets) marks |= map.words[f / kUnitWords * kUnitWords] | map.words[f];
  if ((marks & kMarkBit) != 0) return false;
  return !env.checked.active() ||
         std::all_of(facets.begin(), facets.end(), [&](uint32_t f) { return admits(env, map.cell_of({f})); });
}

/** Facets of any form. Whether all are passable, and their cells exactly convex. */
bool pass(const Environment<3>& env, Shear& shear, const Array<uint32_t>& facets) noexcept {
  const Map<3>& map = env.map;
  uint32_t marks = 0;
  for (const uint32_t f : facets) {
    const Cell c = map.cell_of({f});
    if (!map.convex(c) || !admits(env, c)) return false;
    const uint32_t* const w = map.record(c);
    const uint32_t facet = map.local_of({f}, c);
    marks |= w[0] | map.words[f];
    if (form_of(w[0]) == Form::kBox) {
      const uint8_t(&local)[4] = kBoxFacets[facet];
      Shear::Point corners[4];
      for (int i = 0; i < 4; ++i) corners[i] = shear(env.point(w[kUnitWords + local[i]]));
      for (int i = 0; i < 4; ++i) shear.pass(corners[i], corners[(i + 1) % 4]);
      continue;
    }
    const Shape shape = map.shape(c);
    for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
      shear.pass(shear(env.point(c, shape.dart_vertex(d))), shear(env.point(c, shape.dart_vertex(shape.beta1(d)))));
    }
  }
  return (marks & kMarkBit) == 0;
}

bool is_same_point(const double* a, const double* b) noexcept { return std::equal(a, a + 3, b); }

}  // namespace

void EdgeSequence::assign(const Map<3>& map, const Array<uint32_t>& passed) {
  const bool all = std::all_of(passed.begin(), passed.end(), [&](uint32_t f) { return is_of_tetrahedron(map, f); });
  facets.reserve(passed.size());
  if (all) triangles.reserve(passed.size());
  clear();
  facets.assign(passed.begin(), passed.end());
  of_tetrahedra = all;
  if (!all) return;
  for (const uint32_t f : facets) triangles.push_back(triangle(map, f));
}

void EdgeSequence::add(const Map<3>& map, HalfFacet facet, bool first) {
  of_tetrahedra = of_tetrahedra && is_of_tetrahedron(map, facet.word);
  placed = false;
  if (of_tetrahedra) {
    reserve_more(facets, 1);
    triangles.insert(first ? triangles.begin() : triangles.end(), triangle(map, facet.word));
  }
  facets.insert(first ? facets.begin() : facets.end(), facet.word);
}

void EdgeSequence::remove(bool first) noexcept {
  facets.erase(first ? facets.begin() : facets.end() - 1);
  if (of_tetrahedra) triangles.erase(first ? triangles.begin() : triangles.end() - 1);
  placed = false;
}

bool follows(const Environment<3>& env, EdgeSequence& sequence, const double* from, const double* to, Cell first,
             Cell last) noexcept {
  const Map<3>& map = env.map;
  const Array<uint32_t>& facets = sequence.facets;
  if (facets.empty()) return first == last && map.convex(first);
  if (!sequence.known() || map.cell_of({facets.front()}) != first) return false;
  if (map.cell_of(map.opposite({facets.back()})) != last) return false;
  if (!map.convex(last) || is_closed(env, last)) return false;
  Shear shear(from, to);
  if (!sequence.of_tetrahedra) return pass(env, shear, facets) && shear.passed_all();
  if (sequence.version != env.obstacle_version) {
    if (!are_passable(env, facets)) return false;
    sequence.version = env.obstacle_version;
    sequence.placed = false;
  }
  if (sequence.placed && is_same_point(from, sequence.from) && is_same_point(to, sequence.to)) return true;
  kPassTriangles(shear, env.points, sequence.triangles.data(), sequence.triangles.size());
  if (!shear.passed_all()) return false;
  std::copy_n(from, 3, sequence.from);
  std::copy_n(to, 3, sequence.to);
  sequence.placed = true;
  return true;
}

bool turn(const Environment<3>& env, EdgeSequence& sequence, const double* from, const double* to, VertexPair& edge) {
  constexpr size_t kMost = 64;  // facets at an edge
  const Map<3>& map = env.map;
  const Array<uint32_t>& old = sequence.facets;
  if (!sequence.of_tetrahedra || !sequence.known()) return false;
  Shear shear(from, to);
  size_t begin = 0;
  const auto find_edge = [&] {
    for (; begin < old.size(); ++begin) {
      const uint32_t(&corners)[3] = sequence.triangles[begin].corners;
      for (int i = 0; i < 3; ++i) {
        edge = {corners[i], corners[(i + 1) % 3]};
        if (!(shear.side(shear(env.point(edge.a)), shear(env.point(edge.b))) > 0)) return true;
      }
    }
    return false;
  };
  if (!find_edge()) return false;
  const auto has = [](const uint32_t(&corners)[3], uint32_t vertex) {
    return corners[0] == vertex || corners[1] == vertex || corners[2] == vertex;
  };
  const auto is_at_edge = [&](const Triangle& t) { return has(t.corners, edge.a) && has(t.corners, edge.b); };
  size_t end = begin + 1;
  while (end < old.size() && is_at_edge(sequence.triangles[end])) ++end;

  const Cell last = map.cell_of(map.opposite({old[end - 1]}));
  Array<uint32_t> turned(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(begin), old.get_allocator());
  HalfFacet entered{old[begin]};
  for (Cell c = map.cell_of(entered); c != last; c = map.cell_of(entered)) {
    if (map.form(c) != Form::kSimplex || turned.size() == begin + kMost) return false;
    HalfFacet next;
    for (uint32_t f = 0; f < 4; ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (h != entered && is_at_edge(triangle(map, h.word))) next = h;
    }
    turned.push_back(next.word);
    entered = map.opposite(next);
    if (!entered.valid()) return false;
  }
  turned.insert(turned.end(), old.begin() + static_cast<std::ptrdiff_t>(end), old.end());
  sequence.assign(map, turned);
  sequence.version = EdgeSequence::kNever;
  return true;
}

bool share_strip(const Map<3>& map, SequenceView ab, SequenceView bc, SequenceView ca) noexcept {
  // Facet i of a sequence in the direction of the view.
  const auto at = [&](const SequenceView& s, size_t i) {
    return s.turned ? map.opposite({s.facets[s.count - 1 - i]}).word : s.facets[i];
  };
  const auto is_sum = [&](const SequenceView& whole, const SequenceView& first, const SequenceView& second) {
    if (whole.count != first.count + second.count) return false;
    for (size_t i = 0; i < whole.count; ++i) {
      if (at(whole, i) != (i < first.count ? at(first, i) : at(second, i - first.count))) return false;
    }
    return true;
  };
  const auto turn = [](SequenceView s) { return SequenceView{s.facets, s.count, !s.turned}; };
  return is_sum(turn(ca), ab, bc) || is_sum(turn(ab), bc, ca) || is_sum(turn(bc), ca, ab);
}

void SequenceWriter::finish(EdgeSequence& sequence) {
  if (passed_ == facets_.size()) {
    sequence.assign(env_->map, facets_);
    sequence.version = env_->obstacle_version;
    return;
  }
  sequence.clear();
  sequence.facets.assign(1, kNoFacet);
  facets_.reserve(2 * passed_);
}

void SequenceWriter::write(void* user, Cell from, uint32_t simplex, Cell) noexcept {
  SequenceWriter& w = *static_cast<SequenceWriter*>(user);
  ++w.passed_;
  if (w.facets_.size() == w.facets_.capacity()) return;
  const Map<3>& map = w.env_->map;
  const uint32_t facet = map.form(from) == Form::kSimplex ? simplex : map.shape(from).simplex_facets(3)[simplex];
  w.facets_.push_back(map.half_facet(from, facet).word);
}

}  // namespace dsw

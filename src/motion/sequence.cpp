#include "motion/sequence.h"

#include <algorithm>

#include "motion/shear.h"
#include "motion/standard_facets.h"

namespace dsw {
namespace {

const PassTriangles kPassTriangles = choose_pass_triangles();

Passage passage(const Map<3>& map, HalfFacet h) noexcept {
  Passage p{h.word, {}};
  const uint32_t* const w = map.words.data() + size_t{h.word / kUnitWords} * kUnitWords;
  if (form_of(w[0]) != Form::kSimplex) return p;
  const uint8_t(&local)[3] = kTetrahedronFacets[h.word % kUnitWords - (kUnitWords - 4)];
  for (int i = 0; i < 3; ++i) p.corners[i] = w[local[i]] & kVertexMask;
  return p;
}

bool is_triangle(const Map<3>& map, HalfFacet h) noexcept {
  return form_of(map.words[h.word / kUnitWords * kUnitWords]) == Form::kSimplex;
}

/** Whether passages and the last cell are passable, and the cells valid and exactly convex. */
bool are_open(const Environment<3>& env, const Array<Passage>& passages, Cell last) noexcept {
  const Map<3>& map = env.map;
  uint32_t marks = map.record(last)[0];
  bool convex = map.convex(last) && admits(env, last);
  for (const Passage& p : passages) {
    const Cell c = map.cell_of({p.facet});
    marks |= map.record(c)[0] | map.words[p.facet];
    convex = convex && map.convex(c) && admits(env, c);
  }
  return convex && (marks & kMarkBit) == 0;
}

/** Facets of any form. */
void pass(const Environment<3>& env, Shear& shear, const Array<Passage>& passages) noexcept {
  const Map<3>& map = env.map;
  for (const Passage& p : passages) {
    const Cell c = map.cell_of({p.facet});
    const uint32_t* const w = map.record(c);
    if (form_of(w[0]) == Form::kBox) {
      const uint8_t(&local)[4] = kBoxFacets[map.local_of({p.facet}, c)];
      Shear::Point corners[4];
      for (int i = 0; i < 4; ++i) corners[i] = shear(env.point(w[kUnitWords + local[i]]));
      for (int i = 0; i < 4; ++i) shear.pass(corners[i], corners[(i + 1) % 4]);
      continue;
    }
    const Shape shape = map.shape(c);
    const uint32_t facet = map.local_of({p.facet}, c);
    for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
      shear.pass(shear(env.point(c, shape.dart_vertex(d))), shear(env.point(c, shape.dart_vertex(shape.beta1(d)))));
    }
  }
}

bool is_same_point(const double* a, const double* b) noexcept { return std::equal(a, a + 3, b); }

}  // namespace

void EdgeSequence::add(const Map<3>& map, HalfFacet facet, bool first) {
  passages.insert(first ? passages.begin() : passages.end(), passage(map, facet));
  placed = false;
  if (is_triangle(map, facet)) return;
  triangles = false;
  version = kNever;  // whether the cell is convex has not been asked
}

bool follows(const Environment<3>& env, EdgeSequence& sequence, const double* from, const double* to, Cell first,
             Cell last) noexcept {
  const Map<3>& map = env.map;
  const Array<Passage>& passages = sequence.passages;
  if (passages.empty()) return first == last && map.convex(first);
  if (!sequence.known() || map.cell_of({passages.front().facet}) != first) return false;
  if (map.cell_of(map.opposite({passages.back().facet})) != last) return false;
  if (sequence.version != env.obstacle_version) {
    if (!are_open(env, passages, last)) return false;
    sequence.version = env.obstacle_version;
    sequence.placed = false;
  }
  if (!map.convex(last)) return false;
  if (sequence.placed && is_same_point(from, sequence.from) && is_same_point(to, sequence.to)) return true;
  Shear shear(from, to);
  if (sequence.triangles) {
    kPassTriangles(shear, env.points, passages.data(), passages.size());
  } else {
    pass(env, shear, passages);
  }
  if (!shear.passed_all()) return false;
  std::copy_n(from, 3, sequence.from);
  std::copy_n(to, 3, sequence.to);
  sequence.placed = true;
  return true;
}

bool turn(const Environment<3>& env, EdgeSequence& sequence, const double* from, const double* to, VertexPair& edge) {
  constexpr size_t kMost = 64;  // facets at an edge
  const Map<3>& map = env.map;
  const Array<Passage>& old = sequence.passages;
  if (!sequence.triangles || !sequence.known()) return false;
  Shear shear(from, to);
  size_t begin = 0;
  const auto find_edge = [&] {
    for (; begin < old.size(); ++begin) {
      const uint32_t(&corners)[3] = old[begin].corners;
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
  const auto is_at_edge = [&](const Passage& p) { return has(p.corners, edge.a) && has(p.corners, edge.b); };
  size_t end = begin + 1;
  while (end < old.size() && is_at_edge(old[end])) ++end;

  const Cell last = map.cell_of(map.opposite({old[end - 1].facet}));
  Array<Passage> turned(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(begin), old.get_allocator());
  HalfFacet entered{old[begin].facet};
  for (Cell c = map.cell_of(entered); c != last; c = map.cell_of(entered)) {
    if (map.form(c) != Form::kSimplex || turned.size() == begin + kMost) return false;
    Passage next;
    for (uint32_t f = 0; f < 4; ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (h != entered && is_at_edge(passage(map, h))) next = passage(map, h);
    }
    turned.push_back(next);
    entered = map.opposite({next.facet});
    if (!entered.valid()) return false;
  }
  turned.insert(turned.end(), old.begin() + static_cast<std::ptrdiff_t>(end), old.end());
  std::swap(sequence.passages, turned);
  sequence.version = EdgeSequence::kNever;
  sequence.placed = false;
  return true;
}

bool share_strip(const Map<3>& map, SequenceView ab, SequenceView bc, SequenceView ca) noexcept {
  // Facet i of a sequence in the direction of the view.
  const auto at = [&](const SequenceView& s, size_t i) {
    return s.turned ? map.opposite({s.passages[s.count - 1 - i].facet}).word : s.passages[i].facet;
  };
  const auto is_sum = [&](const SequenceView& whole, const SequenceView& first, const SequenceView& second) {
    if (whole.count != first.count + second.count) return false;
    for (size_t i = 0; i < whole.count; ++i) {
      if (at(whole, i) != (i < first.count ? at(first, i) : at(second, i - first.count))) return false;
    }
    return true;
  };
  const auto turn = [](SequenceView s) { return SequenceView{s.passages, s.count, !s.turned}; };
  return is_sum(turn(ca), ab, bc) || is_sum(turn(ab), bc, ca) || is_sum(turn(bc), ca, ab);
}

void SequenceWriter::finish(EdgeSequence& sequence) {
  sequence.clear();
  if (passed_ != facets_.size()) {
    sequence.passages.assign(1, Passage{});
    facets_.reserve(2 * passed_);
    return;
  }
  sequence.passages.reserve(facets_.size());
  sequence.version = env_->obstacle_version;
  for (const uint32_t facet : facets_) sequence.add(env_->map, {facet}, false);
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

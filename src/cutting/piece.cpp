// The other side of a crack has the same vertices, so it is looked for among cells that share some with the crack: from
// the piece on through facets, round the crack's rim. What that can't reach (a piece that is cut out all round) is told
// by the number of cells that a vertex has; only then all cells are looked at.

#include "cutting/piece.h"

#include "base/error.h"
#include "base/key_table.h"
#include "base/sort.h"

namespace dsw {
namespace {

/** Lets `visit` see every dart of a facet. */
template <class Visit>
void for_each_dart(const Map<3>& map, HalfFacet h, Visit visit) {
  const Cell c = map.cell_of(h);
  const Shape shape = map.shape(c);
  const uint32_t facet = map.local_of(h, c);
  for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) visit(Dart{c, d});
}

/** Facets without another side at the vertices of those that a piece has, and which of them lie in one place. */
class Cracks {
 public:
  Cracks(const Environment<3>& env, const CellQueue& piece) : env_(env), map_(env.map), piece_(piece) {}

  void find(Array<FacetPair>& pairs) {
    for (size_t i = 0; i < piece_.size(); ++i) note_vertices(piece_[i]);
    if (vertices_.size() == 0) return;
    cells_at_.resize(vertices_.size(), 0);
    for (size_t i = 0; i < piece_.size(); ++i) around_.insert(piece_[i]);
    look_around();
    if (pair_up(pairs)) return;
    for_each_cell(map_, [&](Cell c) {
      if (touches(c)) around_.insert(c);
    });
    look_around();
    pairs.clear();
    pair_up(pairs);
  }

 private:
  /** What lies in one place has the same key. */
  struct Open {
    uint64_t key;
    uint32_t word;
    bool operator<(const Open& o) const { return key != o.key ? key < o.key : word < o.word; }
  };

  void note_vertices(Cell c) {
    for (uint32_t f = 0, facets = map_.facets_of(c); f < facets; ++f) {
      const HalfFacet h = map_.half_facet(c, f);
      if (map_.opposite(h).valid()) continue;
      for_each_dart(map_, h, [&](Dart d) { vertices_.insert(dart_vertex(map_, d)); });
    }
  }
  bool touches(Cell c) const {
    bool found = false;
    for (uint32_t k = 0, n = map_.vertices_of(c); k < n && !found; ++k) {
      found = vertices_.find(map_.vertex(c, k)) != KeyTable::kNone;
    }
    return found;
  }

  /** Goes on from the cells that are there through those that touch a crack. */
  void look_around() {
    for (; looked_at_ < around_.size(); ++looked_at_) {
      const Cell c = around_[looked_at_];
      if (!touches(c)) continue;
      for (uint32_t k = 0, n = map_.vertices_of(c); k < n; ++k) {
        const uint32_t v = vertices_.find(map_.vertex(c, k));
        if (v != KeyTable::kNone) ++cells_at_[v];
      }
      for (uint32_t f = 0, facets = map_.facets_of(c); f < facets; ++f) {
        const HalfFacet h = map_.half_facet(c, f), o = map_.opposite(h);
        if (o.valid()) {
          around_.insert(map_.cell_of(o));
        } else {
          note_open(h);
        }
      }
    }
  }
  void note_open(HalfFacet h) {
    uint32_t least = kNoCell, most = 0;
    bool all = true;
    for_each_dart(map_, h, [&](Dart d) {
      const uint32_t v = dart_vertex(map_, d);
      all = all && vertices_.find(v) != KeyTable::kNone;
      least = std::min(least, v);
      most = std::max(most, v);
    });
    if (all) open_.push_back({pair_key(least, most), h.word});
  }

  /** False: the other side of a crack can lie where nothing has led to yet. */
  bool pair_up(Array<FacetPair>& pairs) {
    dsw::sort(open_.begin(), open_.end());
    Array<bool> paired(open_.size(), false, env_.memory);
    bool all_seen = true;
    for (size_t i = 0; i < open_.size(); ++i) {
      const HalfFacet h{open_[i].word};
      if (paired[i] || !piece_.contains(map_.cell_of(h))) continue;
      size_t at =
          static_cast<size_t>(std::lower_bound(open_.begin(), open_.end(), Open{open_[i].key, 0}) - open_.begin());
      while (at < open_.size() && open_[at].key == open_[i].key && (paired[at] || !fit(h, {open_[at].word}))) ++at;
      if (at == open_.size() || open_[at].key != open_[i].key) {
        all_seen = all_seen && is_all_seen(h);
        continue;
      }
      paired[i] = paired[at] = true;
      pairs.push_back({h, {open_[at].word}});
    }
    return all_seen;
  }
  bool fit(HalfFacet a, HalfFacet b) const {
    if (map_.cell_of(a) == map_.cell_of(b)) return false;
    const FacetDraft of_a = draft_of(env_, a), of_b = draft_of(env_, b);
    return face_each_other(of_a, of_b) && cut_alike(of_a, of_b);
  }
  /** Whether a vertex of a facet has no cells but those that were looked at. */
  bool is_all_seen(HalfFacet h) const {
    bool seen = false;
    for_each_dart(map_, h, [&](Dart d) {
      const uint32_t v = dart_vertex(map_, d);
      seen = seen || cells_at_[vertices_.find(v)] == map_.vertex_uses[v];
    });
    return seen;
  }

  const Environment<3>& env_;
  const Map<3>& map_;
  const CellQueue& piece_;
  CellQueue around_{env_.memory};
  size_t looked_at_ = 0;
  KeyTable vertices_{env_.memory};         // of the piece's facets without another side
  Array<uint32_t> cells_at_{env_.memory};  // by vertex, how many have been looked at
  Array<Open> open_{env_.memory};
};

}  // namespace

Piece::Piece(const Environment<3>& env, Cell start, size_t most) : env_(env) {
  find_cells(start, most);
  find_cracks();
}

void Piece::find_cells(Cell start, size_t most) {
  const Map<3>& map = env_.map;
  if (!map.marked(start)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "volume %u is passable: a piece consists of impassable volumes", map.index(start));
  }
  cells_.insert(start);
  for (size_t i = 0; i < cells_.size(); ++i) {
    const Cell c = cells_[i];
    if (!admits(env_, c)) {
      fail(DSW_STATUS_INVALID_CELL, "volume %u of the piece is flat, folded or turned inside out", map.index(c));
    }
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet o = map.opposite(map.half_facet(c, f));
      if (o.valid() && map.marked(map.cell_of(o))) cells_.insert(map.cell_of(o));
    }
    if (cells_.size() > most) {
      fail(DSW_STATUS_TOO_LARGE, "more than %zu impassable volumes are connected to volume %u", most, map.index(start));
    }
  }
}

void Piece::find_cracks() {
  Cracks(env_, cells_).find(cracks_);
  for (const FacetPair& each : cracks_) {
    sewn_.push_back(each);
    if (contains(env_.map.cell_of(each.b))) sewn_.push_back({each.b, each.a});
  }
  dsw::sort(sewn_.begin(), sewn_.end(), [](const FacetPair& x, const FacetPair& y) { return x.a.word < y.a.word; });
}

HalfFacet Piece::behind(HalfFacet h) const {
  const HalfFacet o = env_.map.opposite(h);
  if (o.valid()) return o;
  const auto at = std::lower_bound(sewn_.begin(), sewn_.end(), h,
                                   [](const FacetPair& pair, HalfFacet of) { return pair.a.word < of.word; });
  return at != sewn_.end() && at->a == h ? at->b : HalfFacet{};
}

}  // namespace dsw

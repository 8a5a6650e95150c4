#include "cutting/opening.h"

#include "base/error.h"
#include "base/sort.h"
#include "base/vec.h"
#include "cutting/fold.h"
#include "environment/marking.h"
#include "environment/recut.h"

namespace dsw {
namespace {

constexpr double kLeastShare = 1.0 / 4096;  // below a copy does not move

/** Cuts the facets of drafts into triangles that are positive seen from the cells on both sides. */
template <int D>
class FacetCutter {
 public:
  /** Cuts the facets of the first `drafts` drafts of an edit. */
  FacetCutter(const Environment<D>& env, Edit<D>& edit, size_t drafts);

  /** A facet of draft i: what it needs. False: it has no triangles and there are none for it. */
  bool cut(FacetDraft& facet, size_t i);

 private:
  struct Key {
    uint32_t word;
    size_t draft;
    uint32_t facet;
    bool operator<(const Key& o) const {
      if (word != o.word) return word < o.word;
      return draft != o.draft ? draft < o.draft : facet < o.facet;
    }
  };
  /** What a facet and the one on its other side have in common, seen from one of its half-facets. */
  static uint32_t word_of(const FacetDraft& facet, HalfFacet h) {
    return facet.pair != kNoPair ? kNoPair - 1 - facet.pair : h.word;
  }
  FacetDraft& facet_of(const Key& key) { return edit_.draft(key.draft).facets[key.facet]; }
  const Key* find_other_side(const FacetDraft& facet);

  const Environment<D>& env_;
  Edit<D>& edit_;
  Array<double> apices_{env_.memory};  // by draft: a point inside of the cell
  Array<Key> keys_{env_.memory};
};

template <int D>
FacetCutter<D>::FacetCutter(const Environment<D>& env, Edit<D>& edit, size_t drafts) : env_(env), edit_(edit) {
  apices_.resize(3 * drafts);
  for (size_t i = 0; i < drafts; ++i) {
    centre(env_, edit.draft(i), &apices_[3 * i]);
    for (uint32_t f = 0; f < edit.draft(i).facets.size(); ++f) {
      const FacetDraft& facet = edit.draft(i).facets[f];
      keys_.push_back({word_of(facet, facet.near), i, f});
    }
  }
  dsw::sort(keys_.begin(), keys_.end());
}

/** Null where there is none among the drafts. */
template <int D>
auto FacetCutter<D>::find_other_side(const FacetDraft& facet) -> const Key* {
  if (facet.pair == kNoPair && !facet.far.valid()) return nullptr;
  const uint32_t word = word_of(facet, facet.far);
  for (auto at = std::lower_bound(keys_.begin(), keys_.end(), Key{word, 0, 0}); at != keys_.end() && at->word == word;
       ++at) {
    const FacetDraft& other = facet_of(*at);
    if (&other != &facet && face_each_other(facet, other)) return &*at;
  }
  return nullptr;
}

template <int D>
bool FacetCutter<D>::cut(FacetDraft& facet, size_t i) {
  const bool is_new = facet.triangles.empty();
  if (!is_new && facet.loop.size() == 3) return true;
  const Key* const other = find_other_side(facet);
  const double *const apex = &apices_[3 * i], *const beyond = other == nullptr ? nullptr : &apices_[3 * other->draft];
  // The outer boundary, and what lies at cells that stay, keep their triangles.
  if (!is_new && (other == nullptr || is_cut_well(env_, facet, apex, beyond))) return true;
  FacetDraft anew = facet;
  anew.triangles.clear();
  if (anew.loop.size() > kMostTriangulated || !cut_anew(env_, anew, anew.loop, apex, beyond)) return !is_new;
  facet.triangles = anew.triangles;
  if (other != nullptr) cut_like(facet_of(*other), facet);
  return true;
}

}  // namespace

template <int D>
Opening<D>::Opening(Environment<D>& env, const Crack<D>& crack, const OpenSettings& settings)
    : env_(env),
      map_(env.map),
      crack_(crack),
      settings_(settings),
      ways_(crack.partings().size(), Way{}, env.memory),
      record_(env.memory) {}

template <int D>
void Opening<D>::Way::shorten(int k) {
  shares[k] *= 0.5;
  if (shares[k] < kLeastShare) shares[k] = 0;
  stays = shares[0] == 0 && shares[1] == 0;
}

/** Vertices of cells that come out invalid go half as far, and all is written anew: as often as the shares allow. */
template <int D>
void Opening<D>::prepare(std::optional<Edit<D>>& edit) {
  Array<uint32_t> bad{env_.memory};
  for (;;) {
    edit.emplace(env_);
    bad.clear();
    write(*edit, bad);
    if (bad.empty()) edit->prepare(&bad);
    if (bad.empty()) find_folds(*edit, bad);
    if (bad.empty()) break;
    shorten(*edit, bad);
  }
  write_record(*edit);
}

template <int D>
void Opening<D>::write(Edit<D>& edit, Array<uint32_t>& bad) {
  changed_ = KeyTable(env_.memory);
  gaps_.clear();
  sides_.clear();
  pairs_ = 0;
  add_vertices(edit);
  write_cells(edit);
  add_mouths(edit);
  add_gaps(edit);
  join_sides(edit);
  if constexpr (D == 3) cut_facets(edit, bad);
}

template <int D>
void Opening<D>::add_vertices(Edit<D>& edit) {
  fresh_ = KeyTable(env_.memory);
  of_fresh_.clear();
  for (uint32_t i = 0; i < ways_.size(); ++i) {
    Way& way = ways_[i];
    const typename Crack<D>::Parting& parting = crack_.partings()[i];
    double places[2][D];
    while (!way.stays && !place_copies(parting, way, places)) {
      way.shorten(0);
      way.shorten(1);
    }
    if (way.stays) continue;
    for (int k = 0; k < 2; ++k) {
      way.copies[k] = edit.add_vertex(places[k]);
      fresh_.insert(way.copies[k]);
      of_fresh_.push_back(2 * i + static_cast<uint32_t>(k));
      if (vertex_marked(env_, parting.vertex)) edit.set_mark(way.copies[k], true);
    }
  }
}

/** False: they are too far away for a double. */
template <int D>
bool Opening<D>::place_copies(const typename Crack<D>::Parting& parting, const Way& way, double (&places)[2][D]) const {
  const double* const p = env_.point(parting.vertex);
  const Vec normal = to_vec<D>(parting.normal);
  store<D>(to_vec<D>(p) - way.length(0) * settings_.width * normal, places[0]);
  store<D>(to_vec<D>(p) + way.length(1) * settings_.width * normal, places[1]);
  return is_finite<D>(places[0]) && is_finite<D>(places[1]);
}

template <int D>
uint32_t Opening<D>::vertex_of(uint32_t copy, uint32_t before) const {
  return copy == Crack<D>::kNone || ways_[copy / 2].stays ? before : ways_[copy / 2].copies[copy % 2];
}

/** All cells at vertices that come apart. */
template <int D>
void Opening<D>::write_cells(Edit<D>& edit) {
  for (uint32_t i = 0; i < ways_.size(); ++i) {
    if (ways_[i].stays) continue;
    const typename Crack<D>::Parting& parting = crack_.partings()[i];
    for (uint32_t k = parting.first_cell; k < parting.end_cell; ++k) changed_.insert(crack_.cell(k).unit);
  }
  for (uint32_t i = 0; i < changed_.size(); ++i) {
    const Cell c{static_cast<uint32_t>(changed_[i])};
    CellDraft& draft = edit.draft(edit.replace(c));
    const Shape shape = map_.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) write_facet(draft.facets[f], {c, shape.facet_first(f)});
    move_marks(edit, c);
  }
}

/** Puts copies in the places of vertices; both, where the line from rim to rim crosses the facet: to be cut anew. */
template <int D>
void Opening<D>::write_facet(FacetDraft& facet, Dart first) const {
  if constexpr (D == 2) {
    facet.loop[0] = at_start(first);
    facet.loop[1] = at_end(first);
  } else {
    const FacetDraft before = facet;
    const auto n = static_cast<uint32_t>(before.loop.size());
    facet.loop.clear();
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t in = at_end({first.cell, first.local + (k + n - 1) % n}),
                     out = at_start({first.cell, first.local + k});
      facet.loop.push_back(in);
      if (out != in) facet.loop.push_back(out);
    }
    if (facet.loop.size() != n) {
      facet.triangles.clear();
      return;
    }
    for (uint32_t& v : facet.triangles) v = facet.loop[before.place_of(v)];
  }
}

template <int D>
void Opening<D>::move_marks(Edit<D>& edit, Cell c) const {
  if (env_.edge_marks.size() == 0) return;
  for (uint32_t d = 0, n = map_.shape(c).dart_count(); d < n; ++d) {
    const uint32_t a = dart_vertex(map_, {c, d}), b = dart_target(map_, {c, d});
    const uint32_t from = at_start({c, d}), to = at_end({c, d});
    if ((from != a || to != b) && edge_marked(env_, a, b)) edit.set_mark(from, to, true);
  }
}

/** Cells of the space get a facet in the place of a ridge of the rim. */
template <int D>
void Opening<D>::add_mouths(Edit<D>& edit) {
  for (const Mouth& mouth : crack_.mouths()) {
    const Dart d = mouth.dart, e = across_ridge(map_, d);
    const uint32_t number = changed_.find(d.cell.unit);
    if (number == KeyTable::kNone) continue;
    FacetDraft facet(env_.scratch.memory());
    if constexpr (D == 2) {
      facet.loop.assign({at_end(e), at_start(d)});
    } else {
      const uint32_t loop[4] = {at_end(d), at_start(d), at_end(e), at_start(e)};
      for (int k = 0; k < 4; ++k) {
        if (loop[k] != loop[(k + 3) % 4]) facet.loop.push_back(loop[k]);
      }
    }
    add_side(edit, number, std::move(facet), ridge_key(dart_vertex(map_, d), dart_target(map_, d)));
  }
}

template <int D>
void Opening<D>::add_gaps(Edit<D>& edit) {
  for (uint32_t i = 0; i < crack_.pair_count(); ++i) add_gap(edit, crack_.pair(i));
}

/** The cell between two lips, if these come apart. */
template <int D>
void Opening<D>::add_gap(Edit<D>& edit, const FacetPair& pair) {
  Gap gap;
  FacetDraft before[2] = {draft_of(env_, pair.a), draft_of(env_, pair.b)};
  for (int k = 0; k < 2; ++k) {
    const Cell c = map_.cell_of(before[k].near);
    const uint32_t number = changed_.find(c.unit);
    if (number == KeyTable::kNone) return;
    gap.lips[k] = {number, map_.local_of(before[k].near, c)};
  }
  const auto lip = [&](int k) -> FacetDraft& { return edit.draft(gap.lips[k].draft).facets[gap.lips[k].facet]; };
  const auto n = static_cast<uint32_t>(before[0].loop.size());
  Vertices front = lip(0).loop, back(front);
  for (uint32_t k = 0; k < n; ++k) back[k] = lip(1).loop[before[1].place_of(before[0].loop[k])];
  if (front == back) return;
  CellDraft cell(env_.scratch.memory());
  cell.region = settings_.region;
  cell.tag = settings_.tag;
  for (int k = 0; k < 2; ++k) {
    lip(k).far = {};
    lip(k).pair = pairs_++;
    cell.facets.push_back(turned(lip(k)));
    cell.facets.back().far = {};
  }
  const size_t number = edit.add(std::move(cell));
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t next = (k + 1) % n;
    FacetDraft side(env_.scratch.memory());
    if constexpr (D == 2) {
      side.loop.assign({(k == 0 ? front : back)[k], (k == 0 ? back : front)[k]});
    } else {
      side.loop.push_back(front[k]);
      if (front[next] != front[k]) side.loop.push_back(front[next]);
      if (back[next] != front[next]) side.loop.push_back(back[next]);
      if (back[k] != front[k]) side.loop.push_back(back[k]);
    }
    add_side(edit, number, std::move(side), ridge_key(before[0].loop[k], before[0].loop[next]));
  }
  gaps_.push_back(gap);
}

/** A facet across the gap, unless vertices that stay one leave nothing of it. */
template <int D>
void Opening<D>::add_side(Edit<D>& edit, size_t draft, FacetDraft&& facet, uint64_t ridge) {
  if (D == 3 ? facet.loop.size() < 3 : facet.loop[0] == facet.loop[1]) return;
  Array<FacetDraft>& facets = edit.draft(draft).facets;
  sides_.push_back({ridge, {draft, static_cast<uint32_t>(facets.size())}});
  facets.push_back(std::move(facet));
}

/** Facets across the gap over the same ridge are joined; what is left of them is on the outer boundary. */
template <int D>
void Opening<D>::join_sides(Edit<D>& edit) {
  dsw::sort(sides_.begin(), sides_.end(), [](const Side& x, const Side& y) {
    if (x.ridge != y.ridge) return x.ridge < y.ridge;
    return x.at.draft != y.at.draft ? x.at.draft < y.at.draft : x.at.facet < y.at.facet;
  });
  const auto facet = [&](const Side& side) -> FacetDraft& { return edit.draft(side.at.draft).facets[side.at.facet]; };
  for (size_t i = 0; i < sides_.size(); ++i) {
    FacetDraft& here = facet(sides_[i]);
    for (size_t j = i + 1; here.pair == kNoPair && j < sides_.size() && sides_[j].ridge == sides_[i].ridge; ++j) {
      FacetDraft& there = facet(sides_[j]);
      if (there.pair == kNoPair && face_each_other(here, there)) here.pair = there.pair = pairs_++;
    }
  }
}

/** Triangles for new facets, and others for those that are not positive any more seen from the cells on both sides.
 * Drafts with a facet for which there are none go to `bad`. */
template <int D>
void Opening<D>::cut_facets(Edit<D>& edit, Array<uint32_t>& bad) const {
  const size_t drafts = changed_.size() + gaps_.size();
  FacetCutter<D> cutter(env_, edit, drafts);
  for (size_t i = 0; i < drafts; ++i) {
    for (FacetDraft& facet : edit.draft(i).facets) {
      if (!cutter.cut(facet, i)) bad.push_back(static_cast<uint32_t>(i));
    }
  }
}

/** Drafts at which the outer boundary would fold. Links are needed to see that, so the edit is tried. */
template <int D>
void Opening<D>::find_folds(Edit<D>& edit, Array<uint32_t>& bad) const {
  edit.apply();
  for (uint32_t i = 0; i < edit.cell_count(); ++i) {
    const Cell c = edit.cell(i);
    const Shape shape = map_.shape(c);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (!is_folded(env_, {c, d})) continue;
      bad.push_back(i);
      break;
    }
  }
  edit.revert();
}

/** The copies in these drafts go half as far; where none of them moves any more, their vertices stay one. */
template <int D>
void Opening<D>::shorten(Edit<D>& edit, const Array<uint32_t>& drafts) {
  KeyTable copies(env_.memory);
  for (const uint32_t i : drafts) {
    for (const FacetDraft& facet : edit.draft(i).facets) {
      for (const uint32_t v : facet.loop) {
        const uint32_t fresh = fresh_.find(v);
        if (fresh != KeyTable::kNone) copies.insert(of_fresh_[fresh]);
      }
    }
  }
  if (copies.size() == 0) fail(DSW_STATUS_INVALID_CELL, "a volume at the crack is invalid already");
  bool moved = false;
  for (uint32_t i = 0; i < copies.size(); ++i) {
    const auto copy = static_cast<uint32_t>(copies[i]);
    Way& way = ways_[copy / 2];
    moved = moved || way.shares[copy % 2] != 0;
    way.shorten(static_cast<int>(copy % 2));
  }
  for (uint32_t i = 0; !moved && i < copies.size(); ++i) ways_[static_cast<uint32_t>(copies[i]) / 2].stays = true;
}

template <int D>
void Opening<D>::write_record(Edit<D>& edit) {
  for (uint32_t i = 0; i < ways_.size(); ++i) {
    const Way& way = ways_[i];
    if (way.stays) continue;
    const uint32_t v = crack_.partings()[i].vertex;
    for (const uint32_t copy : way.copies) record_.vertices.push_back({copy, v, v, 0.5});
    const double width = length(difference<D>(env_.point(way.copies[1]), env_.point(way.copies[0])));
    record_.smallest = record_.vertices.size() == 2 ? width : std::min(record_.smallest, width);
    record_.largest = std::max(record_.largest, width);
    record_.shortened += way.shares[0] < 1 && way.shares[1] < 1 ? 1u : 0u;
  }
  for (const Gap& gap : gaps_) {
    record_.faces.push_back(
        {edit.half_facet(gap.lips[0].draft, gap.lips[0].facet), edit.half_facet(gap.lips[1].draft, gap.lips[1].facet)});
  }
  record_.changed = changed_.size();
}

template Opening<2>::Opening(Environment<2>& env, const Crack<2>& crack, const OpenSettings& settings);
template Opening<3>::Opening(Environment<3>& env, const Crack<3>& crack, const OpenSettings& settings);
template void Opening<2>::prepare(std::optional<Edit<2>>& edit);
template void Opening<3>::prepare(std::optional<Edit<3>>& edit);

}  // namespace dsw

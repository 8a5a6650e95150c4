// A patch starts with an invalid cell and grows by the neighbour that leaves the fewest triangles to be seen from their
// wrong side. Where a vertex has gone too far that takes in the cells round it one after the other, until it is inside
// and vanishes.

#include "topology/repair.h"

#include "base/points.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/marking.h"
#include "environment/validity.h"
#include "map/records.h"

namespace dsw {
namespace {

constexpr uint32_t kNoCount = 0xffffffffu;
constexpr uint32_t kPatience = 8;  // steps of a patch that bring it no nearer

/** Lets an environment read other positions for a while. */
class OtherPoints {
 public:
  OtherPoints(Environment<3>& env, const double* points) : env_(env), before_(env.points) { env.points = points; }
  ~OtherPoints() { env_.points = before_; }
  OtherPoints(const OtherPoints&) = delete;
  OtherPoints& operator=(const OtherPoints&) = delete;

 private:
  Environment<3>& env_;
  const double* before_;
};

bool has_finite_points(const Environment<3>& env, const double* points, Cell c) {
  for (uint32_t k = 0, n = env.map.vertices_of(c); k < n; ++k) {
    if (!is_finite<3>(points + size_t{env.map.vertex(c, k)} * 3)) return false;
  }
  return true;
}

void add_facets(const Map<3>& map, Cell c, Rim& rim) {
  for (uint32_t f = 0, n = map.facets_of(c); f < n; ++f) rim.push_back(map.half_facet(c, f));
}

}  // namespace

bool is_valid_with(Environment<3>& env, const double* points, Cell c) noexcept {
  if (!has_finite_points(env, points, c)) return false;
  const OtherPoints reads(env, points);
  const CellState state = check_cell(env, c);
  return state == CellState::kValid || state == CellState::kValidConvex;
}

Repair::Repair(Environment<3>& env, const double* next, const RepairSettings& settings)
    : env_(env),
      geometry_{env.points, next},
      settings_(settings),
      record_(env.memory),
      surface_(env),
      around_(env.memory),
      grown_(env.memory),
      trial_(env.memory),
      best_(env.memory) {
  make_ready(env.map);
}

void Repair::want(Cell c) {
  const bool valid_now = is_valid_with(env_, geometry_.now, c);
  if (settings_.only_valid && !valid_now) return;
  if (valid_now && (geometry_.next == nullptr || is_valid_with(env_, geometry_.next, c))) return;
  wanted_.push_back(c);
}

void Repair::want_all() {
  for_each_cell(env_.map, [&](Cell c) { want(c); });
}

/** The cells that a patch may grow over. */
void Repair::find_ring(Cell seed) {
  KeyTable seen(env_.memory);
  ring_.clear();
  ring_.insert(seed);
  for (uint32_t r = 0; r < settings_.radius; ++r) {
    for (size_t i = 0, size = ring_.size(); i < size; ++i) {
      const Cell c = ring_[i];
      for (uint32_t k = 0, n = env_.map.vertices_of(c); k < n; ++k) {
        const uint32_t v = env_.map.vertex(c, k), known = seen.size();
        if (seen.insert(v) != known) continue;
        around_.clear();
        around_.insert(c);
        for_each_cell_at_vertex(env_.map, v, around_, [&](Cell at) { ring_.insert(at); });
      }
    }
  }
}

/** Walls stay where they are, with all that is at a marked edge or vertex. */
bool Repair::is_kept(HalfFacet h) const {
  if (env_.map.facet_marked(h)) return true;
  if (env_.marked_edges == 0 && env_.marked_vertices == 0) return false;
  const Cell c = env_.map.cell_of(h);
  const Shape shape = env_.map.shape(c);
  const uint32_t f = env_.map.local_of(h, c);
  for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
    const uint32_t a = env_.map.vertex(c, shape.dart_vertex(d));
    const uint32_t b = env_.map.vertex(c, shape.dart_vertex(shape.beta1(d)));
    if (edge_marked(env_, a, b) || vertex_marked(env_, a)) return true;
  }
  return false;
}

/** Its index has to last, so that none is needed that no cell has had. */
bool Repair::may_go(Cell c, Cell seed) {
  const Map<3>& map = env_.map;
  if (!ring_.contains(c) || map.marked(c) != map.marked(seed) || env_.region(c) != env_.region(seed) ||
      env_.tag(c) != env_.tag(seed) || !map.cell_slots.can_renew(map.index(c))) {
    return false;
  }
  if (settings_.only_valid && !is_valid_with(env_, geometry_.now, c)) return false;
  return has_finite_points(env_, geometry_.now, c) &&
         (geometry_.next == nullptr || has_finite_points(env_, geometry_.next, c));
}

uint32_t Repair::patch_of(Cell c) const {
  const uint32_t i = repaired_.find(c.unit);
  return i == KeyTable::kNone || patches_[patch_[i]].filling == Patch::Filling::kNothing ? kNoPatch : patch_[i];
}

/** Puts into trial_ what grows out of a patch by a cell, with the whole patch that this is in; false if it may not. */
bool Repair::extend(const Patch& patch, Cell seed, Cell by) {
  const uint32_t other = patch_of(by);
  trial_.cells = patch.cells;
  if (other != kNoPatch) {
    const Array<Cell>& cells = patches_[other].cells;
    trial_.cells.insert(trial_.cells.end(), cells.begin(), cells.end());
  } else {
    if (!may_go(by, seed)) return false;
    trial_.cells.push_back(by);
  }
  const auto added = trial_.cells.begin() + static_cast<ptrdiff_t>(patch.cells.size());
  const auto is_in = [&](auto first, auto last, HalfFacet h) {
    const HalfFacet o = env_.map.opposite(h);
    return o.valid() && dsw::find(first, last, env_.map.cell_of(o)) != last;
  };
  trial_.rim.clear();
  bool kept = false;
  for (const HalfFacet h : patch.rim) {
    if (is_in(added, trial_.cells.end(), h)) {
      kept = kept || is_kept(h);
    } else {
      trial_.rim.push_back(h);
    }
  }
  const size_t before = trial_.rim.size();
  if (other != kNoPatch) {
    trial_.rim.insert(trial_.rim.end(), patches_[other].rim.begin(), patches_[other].rim.end());
  } else {
    add_facets(env_.map, by, trial_.rim);
  }
  const auto is_inner = [&](HalfFacet h) { return is_in(trial_.cells.begin(), added, h); };
  const auto rest = trial_.rim.begin() + static_cast<ptrdiff_t>(before);
  trial_.rim.erase(std::remove_if(rest, trial_.rim.end(), is_inner), trial_.rim.end());
  return !kept && surface_.read(trial_.rim, settings_.most_faces);
}

/** What can be put in place of a patch that the surface has been read of. */
Patch::Filling Repair::find_filling(Patch& patch) {
  patch.apex = surface_.find_apex(geometry_, patch.cells.size());
  if (patch.apex != RimSurface::kNoVertex && surface_.is_sphere()) return Patch::Filling::kTetrahedra;
  if (surface_.is_valid_cell(geometry_) && surface_.is_sphere()) return Patch::Filling::kOneCell;
  return Patch::Filling::kNothing;
}

/** Neither way is right always: all are tried. */
bool Repair::repair(Cell seed) {
  find_ring(seed);
  if (!may_go(seed, seed)) return false;
  if (!grow(seed, 0) && !surround(seed)) {
    uint32_t first = 1;
    while (first <= env_.map.facets_of(seed) && !grow(seed, first)) ++first;
    if (first > env_.map.facets_of(seed)) return false;
  }
  keep_grown();
  return true;
}

/** Makes grown_ a seed alone. */
bool Repair::start(Cell seed) {
  grown_.cells.assign(1, seed);
  grown_.rim.clear();
  add_facets(env_.map, seed, grown_.rim);
  return surface_.read(grown_.rim, settings_.most_faces);
}

/** Makes grown_ all cells at one vertex of the seed, if that can be filled. */
bool Repair::surround(Cell seed) {
  for (uint32_t k = 0, n = env_.map.vertices_of(seed); k < n; ++k) {
    around_.clear();
    around_.insert(seed);
    for_each_cell_at_vertex(env_.map, env_.map.vertex(seed, k), around_, [](Cell) {});
    bool fine = start(seed);
    for (size_t i = 1; fine && i < around_.size(); ++i) {
      if (dsw::find(grown_.cells.begin(), grown_.cells.end(), around_[i]) != grown_.cells.end()) continue;
      fine = extend(grown_, seed, around_[i]);
      std::swap(grown_, trial_);
    }
    if (!fine) continue;
    grown_.filling = find_filling(grown_);
    if (grown_.filling != Patch::Filling::kNothing) return true;
  }
  return false;
}

bool Repair::grow(Cell seed, uint32_t first) {
  return grow(seed, first, Aim::kTetrahedra) || grow(seed, first, Aim::kOneCell);
}

/** Makes grown_ a patch that can be filled. It grows by the neighbour that is best for an aim; `first`: across this
 * facet of the seed to begin with, counted from 1, or 0. */
bool Repair::grow(Cell seed, uint32_t first, Aim aim) {
  if (!start(seed)) return false;
  for (uint32_t least = kNoCount, since = 0;;) {
    grown_.filling = find_filling(grown_);
    if (grown_.filling != Patch::Filling::kNothing) return true;
    around_.clear();
    uint32_t wrong = kNoCount;
    for (uint32_t f = 0; f < grown_.rim.size(); ++f) {
      const HalfFacet o = env_.map.opposite(grown_.rim[f]);
      if (!o.valid() || around_.contains(env_.map.cell_of(o))) continue;
      if (first != 0 && grown_.cells.size() == 1 && f + 1 != first) continue;
      around_.insert(env_.map.cell_of(o));
      if (!extend(grown_, seed, env_.map.cell_of(o))) continue;
      uint32_t count = surface_.count_wrong(geometry_);
      if (aim == Aim::kTetrahedra) count = surface_.count_wrong_from_vertex(geometry_, count);
      if (wrong != kNoCount && (count > wrong || (count == wrong && trial_.rim.size() >= best_.rim.size()))) continue;
      wrong = count;
      std::swap(best_, trial_);
    }
    since = wrong < least ? 0 : since + 1;
    if (wrong == kNoCount || since > kPatience) return false;
    least = std::min(least, wrong);
    std::swap(grown_, best_);
    surface_.read(grown_.rim, settings_.most_faces);
  }
}

/** Patches that it has taken in are no more. */
void Repair::keep_grown() {
  for (const Cell c : grown_.cells) {
    const uint32_t absorbed = patch_of(c);
    if (absorbed != kNoPatch) patches_[absorbed].filling = Patch::Filling::kNothing;
    const uint32_t i = repaired_.insert(c.unit);
    if (i == patch_.size()) patch_.push_back(0);
    patch_[i] = static_cast<uint32_t>(patches_.size());
  }
  patches_.push_back(grown_);
}

/** False: some patches had to be given up, and it is to be written anew. */
bool Repair::write(Edit<3>& edit) {
  Array<uint32_t> patch_of_draft{env_.memory}, invalid(patch_of_draft);
  uint32_t pairs = 0;
  for (uint32_t p = 0; p < patches_.size(); ++p) {
    if (patches_[p].filling == Patch::Filling::kNothing) continue;
    patch_of_draft.resize(patch_of_draft.size() + fill(edit, patches_[p], pairs), p);
  }
  edit.prepare(&invalid);
  if (invalid.empty() && geometry_.next != nullptr) {
    for (uint32_t i = 0; i < edit.cell_count(); ++i) {
      if (!is_valid_with(env_, geometry_.next, edit.cell(i))) invalid.push_back(i);
    }
  }
  for (const uint32_t i : invalid) patches_[patch_of_draft[i]].filling = Patch::Filling::kNothing;
  if (!invalid.empty()) return false;
  for (uint32_t i = 0; i < edit.cell_count(); ++i) {
    record_.most_faces = std::max(record_.most_faces, env_.map.facets_of(edit.cell(i)));
  }
  record_.gone = static_cast<uint32_t>(edit.removed().size());
  record_.made = static_cast<uint32_t>(edit.cell_count());
  return true;
}

void Repair::prepare(std::optional<Edit<3>>& edit) {
  dsw::sort(wanted_.begin(), wanted_.end(), [&](Cell a, Cell b) { return env_.map.index(a) < env_.map.index(b); });
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  for (const Cell c : wanted_) {
    if (patch_of(c) == kNoPatch) repair(c);
  }
  const auto is_filled = [](const Patch& patch) { return patch.filling != Patch::Filling::kNothing; };
  const auto count = [&] { return std::count_if(patches_.begin(), patches_.end(), is_filled); };
  do {
    edit.reset();
    if (count() == 0) break;
    edit.emplace(env_);
  } while (!write(*edit));
  record_.patches = static_cast<uint32_t>(count());
  record_.wanted = static_cast<uint32_t>(wanted_.size());
  for (const Cell c : wanted_) {
    if (patch_of(c) == kNoPatch) record_.left.push_back(c);
  }
}

}  // namespace dsw

// [JCD10] 3.2 asks for large convex cells. Unions of two convex cells that are convex are rare among tetrahedra in
// general position (README.md has figures), since two cells that
// share more than one triangle are never among them. So a union counts that is a valid cell: the star of its centre.
// The value of a merge is the share of the smaller cell's surface that goes: small cells disappear into those around.

#include "topology/merging.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/position.h"
#include "base/search.h"
#include "environment/marking.h"

namespace dsw {
namespace {

constexpr uint32_t kNoSlot = 0xffffffffu;

/** Coordinates that are larger than 2^200, or all smaller than 2^-200, are scaled: their fourth powers are summed. */
double scale_for_areas(const Environment<3>& env) noexcept {
  return scale_to_one(largest_coordinate<3>(env.lower, env.upper), 200);
}

}  // namespace

double scaled_area(const double* const* corners, double scale) noexcept {
  double u[3], v[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = corners[1][k] * scale - corners[0][k] * scale;
    v[k] = corners[2][k] * scale - corners[0][k] * scale;
  }
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return 0.5 * std::sqrt((x * x + y * y) + z * z);
}

bool Merging::Pair::operator<(const Pair& o) const noexcept {
  if (value != o.value) return value < o.value;
  if (a != o.a) return a > o.a;
  if (b != o.b) return b > o.b;
  return version_a + version_b < o.version_a + o.version_b;
}

Merging::Merging(const Environment<3>& env)
    : env_(env),
      scale_(scale_for_areas(env)),
      parent_(env.map.index_count(), 0u, env.memory),
      version_(parent_.size(), 0u, parent_.get_allocator()),
      slot_(parent_.size(), kNoSlot, parent_.get_allocator()),
      surface_(parent_.size(), 0.0, env.memory),
      free_slots_(parent_.get_allocator()) {
  for (uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = i;
}

uint32_t Merging::root(uint32_t cell) noexcept {
  while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
  return cell;
}

double Merging::area_of(HalfFacet h) const noexcept {
  uint32_t vertices[3];
  corners_of(env_, h, vertices);
  const double* const corners[3] = {env_.point(vertices[0]), env_.point(vertices[1]), env_.point(vertices[2])};
  return scaled_area(corners, scale_);
}

const Polyhedron* Merging::polyhedron(uint32_t root) const noexcept {
  return slot_[root] == kNoSlot ? nullptr : &polyhedra_[slot_[root]];
}

uint32_t Merging::facets_of(uint32_t root, uint32_t (&out)[kMostFacets]) const noexcept {
  if (const Polyhedron* const p = polyhedron(root)) {
    std::copy_n(p->facets, p->facet_count, out);
    return p->facet_count;
  }
  const Cell c = env_.map.cell(root);
  for (uint32_t f = 0; f < 4; ++f) out[f] = env_.map.half_facet(c, f).word;
  return 4;
}

uint32_t Merging::root_beyond(HalfFacet h) noexcept {
  const HalfFacet o = env_.map.opposite(h);
  return o.valid() ? root(env_.map.index(env_.map.cell_of(o))) : kNoCell;
}

/** Whether a facet stays: nothing is merged across it. Facets at marked edges and vertices stay with these. */
bool Merging::is_kept(HalfFacet h) const noexcept {
  const Map<3>& map = env_.map;
  if (is_impassable(map, h)) return true;
  const Cell near = map.cell_of(h), far = map.cell_of(map.opposite(h));
  if (map.form(far) != Form::kSimplex || env_.region(near) != env_.region(far) || env_.tag(near) != env_.tag(far)) {
    return true;
  }
  if (env_.marked_edges == 0 && env_.marked_vertices == 0) return false;
  uint32_t corners[3];
  corners_of(env_, h, corners);
  for (uint32_t k = 0; k < 3; ++k) {
    if (edge_marked(env_, corners[k], corners[(k + 1) % 3]) || vertex_marked(env_, corners[k])) return true;
  }
  return false;
}

/** Offers a union and each of its neighbours; `higher_only`: each of those with a higher index. */
void Merging::offer(uint32_t a, bool higher_only) {
  uint32_t facets[kMostFacets];
  const uint32_t count = facets_of(a, facets);
  Neighbour neighbours[kMostFacets];
  uint32_t found = 0;
  for (uint32_t f = 0; f < count; ++f) {
    const uint32_t b = root_beyond({facets[f]});
    if (b == kNoCell || (higher_only && b < a)) continue;
    Neighbour* const at =
        dsw::find_if(neighbours, neighbours + found, [&](const Neighbour& neighbour) { return neighbour.root == b; });
    if (at == neighbours + found) neighbours[found++] = {b, 0, false};
    at->shared += area_of({facets[f]});
    at->kept |= is_kept({facets[f]});
  }
  for (uint32_t n = 0; n < found; ++n) {
    if (neighbours[n].kept) continue;
    const uint32_t low = std::min(a, neighbours[n].root), high = std::max(a, neighbours[n].root);
    const double smaller = std::min(surface_[low], surface_[high]);  // 0: too small for a double
    const double value = smaller > 0 ? neighbours[n].shared / smaller : 0;
    heap_.push_back({value, low, high, version_[low], version_[high]});
    std::push_heap(heap_.begin(), heap_.end());
  }
}

/** Merges a pair if that gives a valid cell. */
void Merging::merge(const Pair& pair) {
  uint32_t facets[2][kMostFacets], outer[2 * kMostFacets], count = 0;
  const uint32_t sides[2] = {pair.a, pair.b};
  for (uint32_t s = 0; s < 2; ++s) {
    for (uint32_t f = 0, n = facets_of(sides[s], facets[s]); f < n; ++f) {
      if (root_beyond({facets[s][f]}) != sides[1 - s]) outer[count++] = facets[s][f];
    }
  }
  if (count > options_.max_facets) return;
  ++trials_;
  Polyhedron merged;
  if (!make_polyhedron(env_, outer, count, merged)) return;
  if (slot_[pair.a] == kNoSlot) std::swap(slot_[pair.a], slot_[pair.b]);
  if (slot_[pair.a] == kNoSlot) {
    if (free_slots_.empty()) {
      polyhedra_.emplace_back();
      free_slots_.push_back(static_cast<uint32_t>(polyhedra_.size() - 1));
    }
    slot_[pair.a] = free_slots_.back();
    free_slots_.pop_back();
  }
  if (slot_[pair.b] != kNoSlot) free_slots_.push_back(std::exchange(slot_[pair.b], kNoSlot));
  polyhedra_[slot_[pair.a]] = merged;
  parent_[pair.b] = pair.a;
  ++version_[pair.a];
  surface_[pair.a] = 0;
  for (uint32_t f = 0; f < count; ++f) surface_[pair.a] += area_of({outer[f]});
  offer(pair.a, false);
}

void Merging::run(const CoarsenOptions& options) {
  options_ = options;
  const Map<3>& map = env_.map;
  const auto for_each_candidate = [&](auto visit) {
    for_each_cell(map, [&](Cell c) {
      if (map.form(c) == Form::kSimplex && !map.marked(c)) visit(c);
    });
  };
  for_each_candidate([&](Cell c) {
    for (uint32_t f = 0; f < 4; ++f) surface_[map.index(c)] += area_of(map.half_facet(c, f));
  });
  for_each_candidate([&](Cell c) { offer(map.index(c), true); });
  while (!heap_.empty()) {
    if (options_.max_trials != 0 && trials_ == options_.max_trials) {
      complete_ = false;
      return;
    }
    std::pop_heap(heap_.begin(), heap_.end());
    const Pair pair = heap_.back();
    heap_.pop_back();
    const bool is_current = parent_[pair.a] == pair.a && parent_[pair.b] == pair.b &&
                            version_[pair.a] == pair.version_a && version_[pair.b] == pair.version_b;
    if (is_current) merge(pair);
  }
}

}  // namespace dsw

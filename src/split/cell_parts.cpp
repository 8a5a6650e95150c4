#include "split/cell_parts.h"

#include "base/search.h"
#include "base/sort.h"
#include "environment/validity.h"
#include "predicates/turn.h"
#include "split/ears.h"
#include "split/inner_point.h"
#include "split/peeling.h"

namespace dsw {
namespace {

constexpr size_t kMostTriangles = 1024;  // filling takes cubic time
constexpr uint32_t kAttempts = 16;       // at other ways to cut the facets of a cell

/** A side of a cell and the part that has it. */
struct SideOwner {
  PartSide<3> side;
  uint32_t part;
  bool operator<(const SideOwner& o) const { return side < o.side; }
};

Array<SideOwner> owners_of(const Array<PartHull<3>>& parts) {
  Array<SideOwner> owners(parts.get_allocator());
  for (uint32_t p = 0; p < parts.size(); ++p) {
    for (const PartSide<3>& side : parts[p]) owners.push_back({side, p});
  }
  dsw::sort(owners.begin(), owners.end());
  return owners;
}

uint32_t owner_of(const Array<SideOwner>& owners, const PartSide<3>& side) {
  return std::lower_bound(owners.begin(), owners.end(), SideOwner{side, 0})->part;
}

void add_loop(const PartSide<3>& side, Loops& out) {
  out.vertices.insert(out.vertices.end(), side.v, side.v + 3);
  out.end_loop();
}

void add_loop(const Environment<3>& env, Cell c, uint32_t f, Loops& out) {
  for_each_facet_vertex<3>(env.map.shape(c), f,
                           [&](uint32_t local) { out.vertices.push_back(env.map.vertex(c, local)); });
  out.end_loop();
}

}  // namespace

const char* text_of(SplitDefect defect) {
  switch (defect) {
    case SplitDefect::kInsideOut:
      return "it is turned inside out";
    case SplitDefect::kBadFacet:
      return "one of its faces meets itself";
    case SplitDefect::kMeetsItself:
      return "its boundary touches itself or passes through itself";
    case SplitDefect::kTooLarge:
      return "its faces have more than 1024 triangles";
    case SplitDefect::kNeedsPoint:
      return "that takes a new point, and points are borrowed (DSW_ENVIRONMENT_BORROW_POINTS)";
    case SplitDefect::kNotFilled:
      return "no tetrahedra between its points fill it, nor any round one point inside of what is left";
    case SplitDefect::kNone:
      break;
  }
  return "";
}

SplitDefect CellParts<2>::split(size_t cell, Cell c) {
  Array<uint32_t> loop(env_.memory), ears(env_.memory);
  env_.map.for_each_vertex(c, [&](uint32_t v) { loop.push_back(v); });
  const auto turn = [&](uint32_t u, uint32_t v, uint32_t w) {
    return turn_sign<2>(env_.point(u), env_.point(v), env_.point(w));
  };
  if (!clip_ears(loop, turn, ears)) {
    return rounded_volume(env_, c) < 0 ? SplitDefect::kInsideOut : SplitDefect::kMeetsItself;
  }
  Array<PartHull<2>> parts(env_.memory);
  for (size_t k = 0; k < ears.size(); k += 3) {
    const uint32_t* const v = &ears[k];
    parts.push_back(
        PartHull<2>({make_simplex(v[0], v[1]), make_simplex(v[1], v[2]), make_simplex(v[2], v[0])}, env_.memory));
  }
  join_parts<2>(at_, parts);
  parts_[cell] = std::move(parts);
  return SplitDefect::kNone;
}

void CellParts<2>::append(size_t cell, Cell, uint32_t part, Loops& out) const {
  const PartHull<2>& sides = parts_[cell][part];
  uint32_t v = sides[0].v[0];
  do {
    out.vertices.push_back(v);
    v = dsw::find_if(sides.begin(), sides.end(), [v](const PartSide<2>& s) { return s.v[0] == v; })->v[1];
  } while (v != sides[0].v[0]);
  out.end_loop();
}

PartHull<3> CellParts<3>::surface_of(Cell c) const {
  PartHull<3> surface(env_.memory);
  for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) {
    const HalfFacet h = env_.map.half_facet(c, f);
    cuts_.for_each_triangle(cuts_.find(h), h, [&](const PartSide<3>& triangle) { surface.push_back(triangle); });
  }
  return surface;
}

SplitDefect CellParts<3>::split(size_t cell, Cell c) {
  for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) {
    if (!cuts_.is_sound(cuts_.find(env_.map.half_facet(c, f)))) return SplitDefect::kBadFacet;
  }
  Array<PartHull<3>> parts(env_.memory);
  const SplitDefect defect = fill(c, parts);
  if (defect != SplitDefect::kNone) return defect;
  cuts_.keep(c);
  join_parts<3>(at_, parts);
  break_facets(c, parts);
  parts_[cell] = std::move(parts);
  return SplitDefect::kNone;
}

SplitDefect CellParts<3>::fill(Cell c, Array<PartHull<3>>& parts) {
  const PartHull<3> surface = surface_of(c);
  if (surface.size() > kMostTriangles) return SplitDefect::kTooLarge;
  if (fill_between_points(surface, parts)) return SplitDefect::kNone;
  if (rounded_volume(env_, c) < 0) return SplitDefect::kInsideOut;
  for (uint32_t attempt = 1; attempt <= kAttempts; ++attempt) {
    cuts_.vary(c, attempt);
    if (fill_between_points(surface_of(c), parts)) return SplitDefect::kNone;
  }
  const uint32_t points_before = at_.end();
  bool is_filled = fill_round_points(surface_of(c), parts);
  for (uint32_t attempt = 1; attempt <= kAttempts && !is_filled; ++attempt) {
    cuts_.vary(c, attempt);
    is_filled = fill_round_points(surface_of(c), parts);
  }
  if (!is_filled) {
    return meets_itself(at_, surface) ? SplitDefect::kMeetsItself : SplitDefect::kNotFilled;
  }
  if (may_add_) return SplitDefect::kNone;
  at_.take_back(points_before);
  return SplitDefect::kNeedsPoint;
}

bool CellParts<3>::fill_between_points(const PartHull<3>& surface, Array<PartHull<3>>& parts) {
  for (uint32_t order = 0; order < kPeelOrders; ++order) {
    if (peel(at_, surface, order, false, parts)) return true;
  }
  return false;
}

bool CellParts<3>::fill_round_points(const PartHull<3>& surface, Array<PartHull<3>>& parts) {
  if (fill_round_point(at_, surface, parts)) return true;
  for (uint32_t order = 0; order < kPeelOrders; ++order) {
    if (peel(at_, surface, order, true, parts)) return true;
  }
  return false;
}

/** Facets whose triangles come to several parts, and all of a part that would have fewer than four facets. */
void CellParts<3>::break_facets(Cell c, const Array<PartHull<3>>& parts) {
  const Array<SideOwner> owners = owners_of(parts);
  Array<uint32_t> facets_of(env_.memory);
  for (const PartHull<3>& part : parts) facets_of.push_back(static_cast<uint32_t>(part.size()));
  const auto for_each_facet = [&](const auto& visit) {  // (number, part of its first triangle, triangles, in one part)
    for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) {
      const HalfFacet h = env_.map.half_facet(c, f);
      const uint32_t i = cuts_.find(h);
      uint32_t only = kNoCell, count = 0;
      bool is_whole = true;
      cuts_.for_each_triangle(i, h, [&](const PartSide<3>& triangle) {
        const uint32_t owner = owner_of(owners, triangle);
        is_whole = is_whole && (count == 0 || owner == only);
        only = owner;
        ++count;
      });
      visit(i, only, count, is_whole);
    }
  };
  for_each_facet([&](uint32_t i, uint32_t part, uint32_t count, bool is_whole) {
    if (!is_whole) cuts_.break_up(i);
    if (is_whole) facets_of[part] -= count - 1;
  });
  for_each_facet([&](uint32_t i, uint32_t part, uint32_t, bool is_whole) {
    if (is_whole && facets_of[part] < 4) cuts_.break_up(i);
  });
}

void CellParts<3>::append(size_t cell, Cell c, uint32_t part, Loops& out) const {
  const Array<SideOwner> owners = owners_of(parts_[cell]);
  PartHull<3> outer(env_.memory);
  for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) {
    const HalfFacet h = env_.map.half_facet(c, f);
    const uint32_t i = cuts_.find(h);
    bool has_part = false;
    cuts_.for_each_triangle(i, h, [&](const PartSide<3>& triangle) {
      outer.push_back(triangle);
      if (owner_of(owners, triangle) != part) return;
      if (cuts_.is_broken(i)) {
        add_loop(triangle, out);
      } else {
        has_part = true;
      }
    });
    if (has_part) add_loop(env_, c, f, out);
  }
  dsw::sort(outer.begin(), outer.end());
  for (const PartSide<3>& side : parts_[cell][part]) {
    if (!std::binary_search(outer.begin(), outer.end(), side)) add_loop(side, out);
  }
}

bool CellParts<3>::append_other(Cell c, Loops& out) const {
  const uint32_t facets = env_.map.facets_of(c);
  const auto broken = [&](uint32_t f) {
    const uint32_t i = cuts_.find(env_.map.half_facet(c, f));
    return i != FacetCuts::kNone && cuts_.is_broken(i) ? i : FacetCuts::kNone;
  };
  uint32_t first = 0;
  while (first < facets && broken(first) == FacetCuts::kNone) ++first;
  if (first == facets) return false;
  for (uint32_t f = 0; f < facets; ++f) {
    const uint32_t i = broken(f);
    if (i == FacetCuts::kNone) {
      add_loop(env_, c, f, out);
    } else {
      cuts_.for_each_triangle(i, env_.map.half_facet(c, f), [&](const PartSide<3>& side) { add_loop(side, out); });
    }
  }
  return true;
}

}  // namespace dsw

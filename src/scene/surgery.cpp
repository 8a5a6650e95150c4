#include "scene/surgery.h"

#include "base/vec.h"
#include "contact/names.h"
#include "cutting/refine.h"
#include "cutting/start.h"
#include "scene/deformation.h"
#include "topology/operations.h"

namespace dsw {
namespace {

/** Carries out a cut that is prepared. `visited`: cells that were looked at. */
template <int D>
void carry_out_cut(const Site<D>& site, Edit<D>& edit, const CutRecord& record, uint32_t visited,
                   const Array<Cell>* carved, bool is_closed) {
  Told told{{}, &record.vertices, &record.faces, &record.whole, carved};
  told.numbers.is_closed = is_closed ? 1 : 0;
  told.numbers.distance = record.distance;
  told.numbers.volumes_visited = visited;
  told.numbers.volumes_crossed = record.met;
  told.numbers.volumes_split = record.split;
  told.numbers.volumes_changed = record.changed;
  site.change(edit, told);
}

/** What a ligature spans: a loop's points and their mean; in the plane a line. `points` are kept for the blade. */
template <int D>
Blade<D> span_loop(const Memory* memory, PointArray loop, uint32_t count, Array<double>& points) {
  if constexpr (D == 2) {
    return Blade<2>::of_grid(memory, loop, count, 1);
  } else {
    points.resize(3 * size_t{count} + 3);
    for (uint32_t i = 0; i < count; ++i) std::copy_n(loop[i], 3, &points[3 * size_t{i}]);
    mean_point<3>(
        count, [&](uint32_t i) { return loop[i]; }, &points[3 * size_t{count}]);
    return Blade<3>::fan(memory, {points.data(), 3}, count + 1);
  }
}

}  // namespace

template <int D>
void cut_along(const Site<D>& site, const Blade<D>& blade, Cell hint, const CutSettings& settings) {
  uint32_t visited = 0;
  const BladeTree<D> tree(site.env.memory, blade);
  const Cell start = find_start(site.env, blade, tree, hint, &visited);
  Crossings<D> crossings(site.env, blade);
  if (start.valid()) crossings.flood(start);
  Cut<D> cut(site.env, blade, settings, crossings);
  std::optional<Edit<D>> edit;
  cut.prepare(edit);
  carry_out_cut(site, *edit, cut.record(), cut.record().met + visited, nullptr, false);
}

template <int D>
void carve_out(const Site<D>& site, const Blade<D>& shape, Cell start, const CutSettings& settings) {
  Crossings<D> crossings(site.env, shape);
  Inside<D> inside(site.env, shape, settings.covers || settings.finest > 0, crossings);
  uint32_t visited = 0;
  if (start.valid()) {
    inside.flood_from(start, &visited);
  } else {
    inside.flood_all();
  }
  std::optional<Edit<D>> edit;
  Array<Cell> carved{Allocator<Cell>(site.env.memory)};
  const auto carve = [&](auto& changes) {
    changes.prepare(edit);
    inside.carve(*edit, settings.covers, carved);
    carry_out_cut(site, *edit, changes.record(), visited + inside.cell_count(), &carved, false);
  };
  if constexpr (D == 3) {
    if (settings.finest > 0) {
      Refinement halves(site.env, shape, crossings, settings.finest);
      return carve(halves);
    }
  }
  Cut<D> cut(site.env, shape, settings, crossings, &inside);
  carve(cut);
}

template <int D>
void tie_off(const Site<D>& site, PointArray loop, uint32_t count, Cell start, double snap) {
  Array<double> points{Allocator<double>(site.env.memory)};
  const Blade<D> disc = span_loop<D>(site.env.memory, loop, count, points);
  const BladeTree<D> tree(site.env.memory, disc);
  Crossings<D> crossings(site.env, disc);
  uint32_t visited = 0;
  if (start.valid()) {
    const Cell first = find_start(site.env, disc, tree, start, &visited);
    if (first.valid()) crossings.flood(first);
  } else {
    find_all(site.env, tree, crossings);
  }
  Cut<D> cut(site.env, disc, {snap, true, Splits::kPassable, true}, crossings);
  std::optional<Edit<D>> edit;
  cut.prepare(edit);
  const bool is_closed = closes(site.env, crossings);
  carry_out_cut(site, *edit, cut.record(), visited + cut.record().met, nullptr, is_closed);
}

template <int D>
void open_crack(const Site<D>& site, Crack<D>& crack, const OpenSettings& settings) {
  crack.part();
  Opening<D> opening(site.env, crack, settings);
  std::optional<Edit<D>> edit;
  opening.prepare(edit);
  const OpenRecord& record = opening.record();
  Told told{{}, &record.vertices, &record.faces};
  told.numbers.smallest_width = record.smallest;
  told.numbers.largest_width = record.largest;
  told.numbers.vertices_parted = static_cast<uint32_t>(record.vertices.size() / 2);
  told.numbers.vertices_shortened = record.shortened;
  told.numbers.volumes_changed = record.changed;
  site.change(*edit, told);
}

template <int D>
void tear_facets(const Site<D>& site, const Array<HalfFacet>& facets) {
  Edit<D> edit(site.env);
  Array<CutFace> torn{Allocator<CutFace>(site.env.memory)};
  KeyTable seen(site.env.memory);
  for (const HalfFacet h : facets) {
    const HalfFacet o = site.env.map.opposite(h);
    const uint32_t known = seen.size();
    if (!o.valid() || seen.insert(std::min(h.word, o.word)) != known) continue;
    unsew(edit, h);
    torn.push_back({h, o});
  }
  edit.prepare();
  site.change(edit, {{}, nullptr, &torn});
}

void repair_cells(const Site<3>& site, Repair& repair, const Meanwhile* meanwhile) {
  std::optional<Edit<3>> edit;
  repair.prepare(edit);
  const RepairRecord& record = repair.record();
  Array<dsw_volume_id> left(site.env.memory);
  for (const Cell c : record.left) left.push_back(volume_id(site.env.map, c));
  Told told;
  dsw_change& numbers = told.numbers;
  numbers.volumes_invalid = record.wanted;
  numbers.volumes_removed = record.gone;
  numbers.volumes_added = record.made;
  numbers.patch_count = record.patches;
  numbers.most_faces = record.most_faces;
  if (edit) {
    if (!site.change(*edit, told, meanwhile)) return;
  } else {
    if (meanwhile != nullptr) meanwhile->run(meanwhile->user);
    site.results = ChangeResults(site.env.memory);
    site.results.numbers = numbers;
  }
  site.results.unrepaired.swap(left);
}

uint32_t repair_and_deform(const Site<3>& site, double* next, const WallSettings& settings,
                           RepairSettings repair_settings) {
  Deformation<3>& of = *site.scene->deformation.get();
  repair_settings.only_valid = true;
  Repair repair(site.env, next, repair_settings);
  want_near(*site.scene, repair);
  auto bend = [&] {
    deform(*site.scene, next, settings);
    return of.record.outcome != DSW_DEFORM_REFUSED;
  };
  const Meanwhile meanwhile{[](void* user) { return (*static_cast<decltype(bend)*>(user))(); }, &bend};
  repair_cells(site, repair, &meanwhile);
  renew_ids(of);
  return site.results.numbers.volumes_removed;
}

#define DSW_SURGERY(D)                                                                \
  template void cut_along(const Site<D>&, const Blade<D>&, Cell, const CutSettings&); \
  template void carve_out(const Site<D>&, const Blade<D>&, Cell, const CutSettings&); \
  template void tie_off(const Site<D>&, PointArray, uint32_t, Cell, double);          \
  template void open_crack(const Site<D>&, Crack<D>&, const OpenSettings&);           \
  template void tear_facets(const Site<D>&, const Array<HalfFacet>&)
DSW_SURGERY(2);
DSW_SURGERY(3);
#undef DSW_SURGERY

}  // namespace dsw

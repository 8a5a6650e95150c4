#include "scene/surgery.h"

#include "base/vec.h"
#include "contact/names.h"
#include "cutting/start.h"
#include "topology/operations.h"

namespace dsw {
namespace {

/** Carries out a cut that is prepared. `visited`: cells that were looked at. */
template <int D>
dsw_cut_report carry_out_cut(const Site<D>& site, Edit<D>& edit, const CutRecord& record, uint32_t visited,
                             const Array<Cell>* carved) {
  site.change(edit, {&record.vertices, &record.faces, &record.whole, carved});
  const auto count = [](const auto& all) { return static_cast<uint32_t>(all.size()); };
  return {record.distance,        record.met,          record.split,
          count(record.whole),    record.changed,      visited,
          count(record.vertices), count(record.faces), 0};
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
dsw_cut_report cut_along(const Site<D>& site, const Blade<D>& blade, Cell hint, const CutSettings& settings) {
  uint32_t visited = 0;
  const Cell start = find_start(site.env, blade, hint, &visited);
  Crossings<D> crossings(site.env, blade);
  if (start.valid()) crossings.flood(start);
  Cut<D> cut(site.env, blade, settings, crossings);
  std::optional<Edit<D>> edit;
  cut.prepare(edit);
  return carry_out_cut(site, *edit, cut.record(), cut.record().met + visited, nullptr);
}

template <int D>
dsw_carve_report carve_out(const Site<D>& site, const Blade<D>& shape, Cell start, const CutSettings& settings) {
  Crossings<D> crossings(site.env, shape);
  Inside<D> inside(site.env, shape, crossings);
  uint32_t visited = 0;
  if (start.valid()) {
    inside.flood_from(start, &visited);
  } else {
    inside.flood_all();
  }
  Cut<D> cut(site.env, shape, settings, crossings, &inside);
  std::optional<Edit<D>> edit;
  cut.prepare(edit);
  Array<Cell> carved{Allocator<Cell>(site.env.memory)};
  inside.carve(*edit, carved);
  const dsw_cut_report report = carry_out_cut(site, *edit, cut.record(), visited + inside.cell_count(), &carved);
  return {report, static_cast<uint32_t>(carved.size()), 0};
}

template <int D>
dsw_tie_report tie_off(const Site<D>& site, PointArray loop, uint32_t count, Cell start, double snap) {
  Array<double> points{Allocator<double>(site.env.memory)};
  const Blade<D> disc = span_loop<D>(site.env.memory, loop, count, points);
  Crossings<D> crossings(site.env, disc);
  uint32_t visited = 0;
  if (start.valid()) {
    const Cell first = find_start(site.env, disc, start, &visited);
    if (first.valid()) crossings.flood(first);
  } else {
    find_all(site.env, disc, crossings);
  }
  Cut<D> cut(site.env, disc, {snap, true, Splits::kPassable, true}, crossings);
  std::optional<Edit<D>> edit;
  cut.prepare(edit);
  const bool is_closed = closes(site.env, crossings);
  return {carry_out_cut(site, *edit, cut.record(), visited + cut.record().met, nullptr), is_closed ? 1u : 0u, 0};
}

template <int D>
dsw_open_report open_crack(const Site<D>& site, Crack<D>& crack, const OpenSettings& settings) {
  crack.part();
  Opening<D> opening(site.env, crack, settings);
  std::optional<Edit<D>> edit;
  opening.prepare(edit);
  const OpenRecord& record = opening.record();
  site.change(*edit, {&record.vertices, &record.faces});
  const auto parted = static_cast<uint32_t>(record.vertices.size() / 2);
  const auto opened = static_cast<uint32_t>(record.faces.size());
  return {record.smallest, record.largest, parted, record.shortened, opened, record.changed};
}

template <int D>
size_t tear_facets(const Site<D>& site, const Array<HalfFacet>& facets) {
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
  site.change(edit, {nullptr, &torn});
  return torn.size();
}

dsw_remesh_report mend_cells(const Site<3>& site, Mending& mending, const Meanwhile* meanwhile) {
  std::optional<Edit<3>> edit;
  mending.prepare(edit);
  const MendRecord& record = mending.record();
  Array<dsw_volume_id> left{Allocator<dsw_volume_id>(site.env.memory)};
  for (const Cell c : record.left) left.push_back(volume_id(site.env.map, c));
  uint32_t gone = record.gone;
  if (edit) {
    if (!site.change(*edit, {}, meanwhile)) gone = 0;
  } else {
    if (meanwhile != nullptr) meanwhile->run(meanwhile->user);
    site.results.volumes.clear();
  }
  site.results.unmended.swap(left);
  const auto count = static_cast<uint32_t>(record.left.size());
  return {record.wanted, record.wanted - count, count, record.patches, gone, record.made, record.most_faces, 0};
}

uint32_t mend_and_deform(const Site<3>& site, double* next, const WallSettings& settings, MendSettings mend) {
  Deformation<3>& of = *site.scene->deformation.get();
  mend.only_valid = true;
  Mending mending(site.env, next, mend);
  want_near(*site.scene, mending);
  auto bend = [&] {
    deform(*site.scene, next, settings);
    return of.record.outcome != DSW_DEFORM_REFUSED;
  };
  const Meanwhile meanwhile{[](void* user) { return (*static_cast<decltype(bend)*>(user))(); }, &bend};
  const dsw_remesh_report report = mend_cells(site, mending, &meanwhile);
  renew_ids(of);
  return report.volumes_removed;
}

#define DSW_SURGERY(D)                                                                            \
  template dsw_cut_report cut_along(const Site<D>&, const Blade<D>&, Cell, const CutSettings&);   \
  template dsw_carve_report carve_out(const Site<D>&, const Blade<D>&, Cell, const CutSettings&); \
  template dsw_tie_report tie_off(const Site<D>&, PointArray, uint32_t, Cell, double);            \
  template dsw_open_report open_crack(const Site<D>&, Crack<D>&, const OpenSettings&);            \
  template size_t tear_facets(const Site<D>&, const Array<HalfFacet>&)
DSW_SURGERY(2);
DSW_SURGERY(3);
#undef DSW_SURGERY

}  // namespace dsw

#pragma once
// Cuts, and what else replaces many cells at once: each is one change of the topology. Each function throws what its
// parts throw, before anything has changed. The results of the site say what was done.

#include "cutting/opening.h"
#include "scene/change.h"
#include "topology/repair.h"
#include "walls/settings.h"

namespace dsw {

/** Cuts along a blade, which is looked for from `hint` if that is a cell. */
template <int D>
void cut_along(const Site<D>& site, const Blade<D>& blade, Cell hint, const CutSettings& settings);
/** Makes passable what is inside of a shape; with `start` only what hangs together with that cell. */
template <int D>
void carve_out(const Site<D>& site, const Blade<D>& shape, Cell start, const CutSettings& settings);
/** Closes what a loop of points, in the plane a line, goes round; with `start` only what hangs together there. */
template <int D>
void tie_off(const Site<D>& site, PointArray loop, uint32_t count, Cell start, double snap);
/** Opens a crack. */
template <int D>
void open_crack(const Site<D>& site, Crack<D>& crack, const OpenSettings& settings);
/** Parts cells at facets between them; each counts once. */
template <int D>
void tear_facets(const Site<D>& site, const Array<HalfFacet>& facets);
/** Repairs what is wanted, and does something meanwhile unless that is null. */
void repair_cells(const Site<3>& site, Repair& repair, const Meanwhile* meanwhile = nullptr);
/** Repairs cells near occupants that would become invalid, and deforms the environment. Returns how many cells went. */
uint32_t repair_and_deform(const Site<3>& site, double* next, const WallSettings& settings,
                           RepairSettings repair_settings);

}  // namespace dsw

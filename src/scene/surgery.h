#pragma once
// Cuts, and what else replaces many cells at once: each is one change of the topology. Each function throws what its
// parts throw, before anything has changed.

#include "cutting/opening.h"
#include "dartsweep/remesh.h"
#include "remesh/mending.h"
#include "scene/change.h"

namespace dsw {

/** Cuts along a blade, which is looked for from `hint` if that is a cell. */
template <int D>
dsw_cut_report cut_along(const Site<D>& site, const Blade<D>& blade, Cell hint, const CutSettings& settings);
/** Makes passable what is inside of a shape; with `start` only what hangs together with that cell. */
template <int D>
dsw_carve_report carve_out(const Site<D>& site, const Blade<D>& shape, Cell start, const CutSettings& settings);
/** Closes what a loop of points, in the plane a line, goes round; with `start` only what hangs together there. */
template <int D>
dsw_tie_report tie_off(const Site<D>& site, PointArray loop, uint32_t count, Cell start, double snap);
/** Opens a crack. */
template <int D>
dsw_open_report open_crack(const Site<D>& site, Crack<D>& crack, const OpenSettings& settings);
/** Parts cells at facets between them. Returns how many facets those are: each counts once. */
template <int D>
size_t tear_facets(const Site<D>& site, const Array<HalfFacet>& facets);
/** Mends what is wanted, and does something meanwhile unless that is null. */
dsw_remesh_report mend_cells(const Site<3>& site, Mending& mending, const Meanwhile* meanwhile = nullptr);
/** Mends what would become invalid near what the scene holds, and deforms the environment. Returns how many cells went.
 * */
uint32_t mend_and_deform(const Site<3>& site, double* next, const WallSettings& settings, MendSettings mend);

}  // namespace dsw

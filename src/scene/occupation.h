#pragma once
// Marking while a scene lives in the environment: what its particles and bodies occupy does not become impassable.
//
// `scene` is the only one that uses the environment, or null. All functions throw std::bad_alloc, and OCCUPIED unless
// what is occupied may be skipped, and have then changed nothing; they leave in the scene who was in the way.

#include "environment/marking.h"
#include "scene/scene.h"

namespace dsw {

template <int D>
class BodyProbe;
template <int D>
class NearBodies;

/** Appends to scene.occupant_bodies those that are not free. Throws std::bad_alloc. */
template <int D>
void find_occupant_bodies(Scene<D>& scene, const NearBodies<D>& near, BodyProbe<D>& probe);
/** Particles and parts of bodies that a change which has succeeded has looked at. */
template <int D>
void count_looked_at(Scene<D>& scene, uint64_t count) noexcept;

/** Forgets who was in the way of the last marking call; comes before each. */
template <int D>
void clear_occupants(Scene<D>* scene) noexcept;

/** Throws OCCUPIED with a message about who is in the way: some are. */
template <int D>
[[noreturn]] void refuse(const Scene<D>& scene);

/** Sets the marks of cells; returns how many were left out. */
template <int D>
size_t mark_cells(Environment<D>& env, Scene<D>* scene, const Cell* cells, size_t count, bool marked,
                  bool skip_occupied);
template <int D>
void mark_facets(Environment<D>& env, Scene<D>* scene, const HalfFacet* facets, size_t count, bool marked);
/** Edges, each named by one of its darts. */
template <int D>
void mark_edges(Environment<D>& env, Scene<D>* scene, const Dart* edges, size_t count, bool marked);

template <int D>
void mark_vertices(Environment<D>& env, Scene<D>* scene, const uint32_t* vertices, size_t count, bool marked);

/** Marks every cell with a region label; returns how many have it, those left out included. */
template <int D>
size_t mark_region(Environment<D>& env, Scene<D>* scene, int32_t region, bool marked, bool skip_occupied,
                   size_t* left_out);
/** Marks every facet between a cell of region `a` and one of region `b`; returns how many there are. */
template <int D>
size_t mark_between(Environment<D>& env, Scene<D>* scene, int32_t a, int32_t b, bool marked);

}  // namespace dsw

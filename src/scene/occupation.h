#pragma once
// Marking while a scene lives in the environment: what its particles and bodies occupy does not become impassable.
//
// `scene` is the only one that uses the environment, or null. All functions throw std::bad_alloc, and OCCUPIED unless what is
// occupied may be skipped, and have then changed nothing; they leave in the scene who was in the way.

#include "environment/marking.h"
#include "scene/scene.h"

namespace dsw {

class BodyProbe;
class NearBodies;

/** Appends to scene.occupant_bodies those that are not free. Throws std::bad_alloc. */
void find_occupant_bodies(Scene<3>& scene, const NearBodies& near, BodyProbe& probe);
/** Particles and parts of bodies that a change which has succeeded has looked at. */
void count_looked_at(Scene<3>& scene, uint64_t count) noexcept;

/** Forgets who was in the way of the last marking call; comes before each. */
void clear_occupants(Scene<3>* scene) noexcept;

/** Throws OCCUPIED with a message about who is in the way: some are. */
[[noreturn]] void refuse(const Scene<3>& scene);

/** Sets the marks of cells; returns how many were left out. */
size_t mark_cells(Environment<3>& env, Scene<3>* scene, const Cell* cells, size_t count, bool marked,
                  bool skip_occupied);
void mark_facets(Environment<3>& env, Scene<3>* scene, const HalfFacet* facets, size_t count, bool marked);
/** Edges, each named by one of its darts. */
void mark_edges(Environment<3>& env, Scene<3>* scene, const Dart* edges, size_t count, bool marked);

/** Marks every cell with a region label; returns how many have it, those left out included. */
size_t mark_region(Environment<3>& env, Scene<3>* scene, int32_t region, bool marked, bool skip_occupied,
                   size_t* left_out);
/** Marks every facet between a cell of region `a` and one of region `b`; returns how many there are. */
size_t mark_between(Environment<3>& env, Scene<3>* scene, int32_t a, int32_t b, bool marked);

}  // namespace dsw

#pragma once
// How large a common part of the steps of bodies, and of the environment's points, is free. Nothing moves.

#include "scene/bodies.h"
#include "together/settings.h"

namespace dsw {

/** The steps of a call. Each leads to finite places. */
struct StepsOfAll {
  PointArray of_bodies;                    // one for each vertex slot, body after body
  const double* of_environment = nullptr;  // one for each of its points; null: these stand still
};

struct StepAnswer {
  double fraction = 1;
  Array<double> fractions;           // by body, of its island
  Array<double> places;              // of the vertex slots, D numbers each; 0 where there is no vertex
  Array<double> environment_places;  // of the points; empty if these stand still

  explicit StepAnswer(const Memory* memory) : fractions(memory), places(memory), environment_places(memory) {}
};

/** Bodies are distinct. With STOP_ISLAND places are those of the islands' fractions, else of the common one. At the work limit
 * a fraction is 0. Throws std::bad_alloc and UNSUPPORTED. */
template <int D>
void find_step_fraction(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, const StepsOfAll& steps,
                        const TogetherSettings& settings, StepAnswer& answer);

}  // namespace dsw

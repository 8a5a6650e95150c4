#pragma once
// The vertices of polyhedra once more, side by side: a walk that looks at ten vertices of every cell waits for ten places of
// memory otherwise. A walk's filter reads them; what it leaves open is decided by the points themselves.

#include "environment/environment.h"

namespace dsw {

constexpr uint32_t kMostLocalPoints = 16;

/** Where those of a cell with this record are: all x relative to its vertex 0, then all y, all z, rounded. As long as its record, which
 * is enough for a sphere of triangles; what does not fit begins with infinity. */
inline const float* local_points(const Environment<3>& env, const uint32_t* record) noexcept {
  return env.local_points.data() + (record - env.map.words.data());
}

/** Fills env.local_points. Throws std::bad_alloc. */
void keep_local_points(Environment<3>& env);

/** Before cells change or points move. */
template <int D>
void drop_local_points(Environment<D>& env) noexcept {
  Array<float>(env.local_points.get_allocator()).swap(env.local_points);
}

}  // namespace dsw

#pragma once
// The vertices of polyhedra once more, side by side: a walk that looks at ten vertices of every cell waits for ten
// places of memory otherwise. A walk's filter reads them; what it leaves open is decided by the points themselves.

#include <cstring>

#include "environment/environment.h"

namespace dsw {

constexpr uint32_t kMostLocalPoints = 16;
constexpr uint32_t kOriginWords = 6;  // three doubles

/** Where those of a cell with this record are: its vertex 0, then of the others all x relative to that, all y, all z,
 * rounded. In as many words as its record, which is enough for a sphere of eight triangles or more; what does not fit
 * begins with infinity. */
inline const float* local_points(const Environment<3>& env, const uint32_t* record) noexcept {
  return env.local_points.data() + (record - env.map.words.data());
}

/** Vertex 0 of a cell. */
struct LocalOrigin {
  double at[3];

  explicit LocalOrigin(const float* local) noexcept { std::memcpy(at, local, sizeof at); }
};

/** Fills env.local_points. Throws std::bad_alloc. */
void keep_local_points(Environment<3>& env);

/** Before cells change or points move. */
template <int D>
void drop_local_points(Environment<D>& env) noexcept {
  Array<float>(env.local_points.get_allocator()).swap(env.local_points);
}

}  // namespace dsw

#pragma once
// Which parts of a body on its course are apart from all obstacles, where these are known beforehand.

#include "body/box.h"
#include "proximity/near_list.h"
#include "response/course.h"

namespace dsw {

/** All obstacles that a body can meet in a box. Their vertices are those of the environment. */
template <int D>
struct KnownObstacles {
  const NearList<D>& list;
  const Box<D>& box;
};

/** Notes in a course that has just started which edges and faces are apart from all obstacles on their ways. Nothing, if it
 * leaves the box. Throws std::bad_alloc.
 * @param beyond scratch. */
template <int D>
void find_clear_parts(const Environment<D>& env, const KnownObstacles<D>& known, Course<D>& course,
                      Array<uint16_t>& beyond);

}  // namespace dsw

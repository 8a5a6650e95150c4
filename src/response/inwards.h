#pragma once
// Which vertices of a closed surface go towards its inside [JCD10] 6.2.

#include "base/compiler.h"
#include "response/course.h"

namespace dsw {

/** Faces and vertices of a body, and where the vertices go. */
struct MovingSurface {
  const BodyFace* faces;
  size_t face_count;
  const BodyVertex<3>* vertices;
  size_t vertex_count;
  PointArray targets;
};

/** A function of this type notes which vertices move and go against the normals of all faces at them, where the faces were when
 * the move began. A face none of whose corners can go inwards any more is not looked at. In doubles, without a filter.
 * @param ways scratch, four doubles for each vertex; of a vertex that stays any finite numbers. */
using FindInwards = void (*)(const MovingSurface& surface, double* ways, Course<3>::Vertex* turns);

/** The fastest of this processor; all give the same bits. */
extern const FindInwards kFindInwards;

void find_inwards(const MovingSurface& surface, double* ways, Course<3>::Vertex* turns);
#if DSW_X86_64
void find_inwards_avx2(const MovingSurface& surface, double* ways, Course<3>::Vertex* turns);
#endif

}  // namespace dsw

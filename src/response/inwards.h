#pragma once
// Which vertices of a closed surface go towards its inside [JCD10] 6.2.

#include "base/compiler.h"
#include "response/course.h"

namespace dsw {

/** A function of this type clears `inwards` of each corner of some faces that does not go against the normal of its face, where
 * the face was when the move began. A face none of whose corners can go inwards any more is not looked at. In doubles, without a
 * filter.
 * @param ways four doubles for each vertex: the way that it goes, and 0. A vertex that stays keeps its turn as it is. */
using KeepInwards = void (*)(const BodyFace* faces, size_t count, const BodyVertex<3>* vertices, const double* ways,
                             Course<3>::Vertex* turns);

/** The fastest of this processor; all give the same bits. */
extern const KeepInwards kKeepInwards;

void keep_inwards(const BodyFace* faces, size_t count, const BodyVertex<3>* vertices, const double* ways,
                  Course<3>::Vertex* turns);
#if DSW_X86_64
void keep_inwards_avx2(const BodyFace* faces, size_t count, const BodyVertex<3>* vertices, const double* ways,
                       Course<3>::Vertex* turns);
#endif

}  // namespace dsw

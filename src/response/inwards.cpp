#include "response/inwards.h"

#include "base/compiler.h"
#include "base/processor.h"
#include "base/vec.h"

namespace dsw {

void find_inwards(const MovingSurface& surface, double* ways, Course<3>::Vertex* turns) {
  const BodyVertex<3>* const vertices = surface.vertices;
  for (size_t v = 0; v < surface.vertex_count; ++v) {
    turns[v].inwards = turns[v].rank != kNone;
    if (turns[v].inwards) store<3>(difference<3>(surface.targets[v], vertices[v].position), ways + 4 * v);
  }
  for (size_t f = 0; f < surface.face_count; ++f) {
    const uint32_t(&corners)[3] = surface.faces[f].corners;
    const uint32_t a = corners[0], b = corners[1], c = corners[2];
    if (a == kNone || !(turns[a].inwards || turns[b].inwards || turns[c].inwards)) continue;
    const double* const p = vertices[a].position;
    const Vec normal = difference<3>(vertices[b].position, p).cross(difference<3>(vertices[c].position, p));
    for (const uint32_t v : corners) turns[v].inwards &= dot(to_vec<3>(ways + 4 * size_t{v}), normal) < 0;
  }
}

const FindInwards kFindInwards = DSW_WITH_AVX2(find_inwards);

}  // namespace dsw

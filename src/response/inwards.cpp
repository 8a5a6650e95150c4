#include "response/inwards.h"

#include "base/compiler.h"
#include "base/processor.h"
#include "base/vec.h"

namespace dsw {

void keep_inwards(const BodyFace* faces, size_t count, const BodyVertex<3>* vertices, const double* ways,
                  Course<3>::Vertex* turns) {
  for (size_t f = 0; f < count; ++f) {
    const uint32_t a = faces[f].corners[0], b = faces[f].corners[1], c = faces[f].corners[2];
    if (a == kNone || !(turns[a].inwards || turns[b].inwards || turns[c].inwards)) continue;
    const double* const p = vertices[a].position;
    const Vec normal = difference<3>(vertices[b].position, p).cross(difference<3>(vertices[c].position, p));
    for (const uint32_t v : {a, b, c}) turns[v].inwards &= dot(to_vec<3>(ways + 4 * size_t{v}), normal) < 0;
  }
}

const KeepInwards kKeepInwards = DSW_WITH_AVX2(keep_inwards);

}  // namespace dsw

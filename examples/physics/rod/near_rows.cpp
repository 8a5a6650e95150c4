#include "near_rows.h"

#include <algorithm>
#include <utility>

namespace physics {

void find_near_rows(dsw_scene* scene, dsw_body_id body, const NearRowOptions& options, NearRows* rows) {
  dsw_near_options near;
  dsw_near_options_init(&near, sizeof near);
  near.margin = options.margin;
  near.radius = options.radius;
  const dsw_near_row* found = nullptr;
  std::size_t count = 0;
  check(dsw_body_find_near_rows(scene, body, &near, nullptr), "finding what is near");
  check(dsw_body_get_near_rows(scene, body, &found, &count), "reading near rows");
  rows->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    NearRow& row = (*rows)[i];
    row = NearRow();
    row.count = found[i].vertices[1] == UINT32_MAX ? 1 : 2;
    std::copy_n(found[i].vertices, row.count, row.vertices);
    std::copy_n(found[i].weights, row.count, row.weights);
    if (row.count == 2 && row.vertices[0] > row.vertices[1]) {
      std::swap(row.vertices[0], row.vertices[1]);
      std::swap(row.weights[0], row.weights[1]);
    }
    row.normal = Eigen::Map<const Vector3>(found[i].normal);
    row.gap = found[i].gap;
    row.previous = found[i].previous;
  }
}

}  // namespace physics

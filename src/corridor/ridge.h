#pragma once
// What a line passes on one side or the other.

#include <cstdint>

namespace dsw {

/** An edge of the environment by its vertices, the lower one first; in the plane a vertex, twice. In space both are the same
 * where none is known. */
struct RidgeName {
  uint32_t vertices[2] = {};

  bool operator==(const RidgeName& o) const noexcept {
    return vertices[0] == o.vertices[0] && vertices[1] == o.vertices[1];
  }
  bool is_known() const noexcept { return vertices[0] != vertices[1]; }
};

}  // namespace dsw

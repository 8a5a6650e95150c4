// Descriptions and options as the library writes them.
#pragma once

#include <cstddef>

namespace dsw::oracle {

/// What `init` writes: defaults(dsw_body_desc_init).
template <class Struct>
Struct defaults(void (*init)(Struct*, std::size_t)) {
  Struct all;
  init(&all, sizeof all);
  return all;
}

}  // namespace dsw::oracle

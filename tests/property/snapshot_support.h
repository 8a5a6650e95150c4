// What is saved, as bytes.
#pragma once

#include "support.h"

namespace dsw::oracle {

using Bytes = std::vector<unsigned char>;

template <class Object>
Bytes saved_by(dsw_status (*save)(const Object*, void*, size_t, size_t*), const Object* object) {
  size_t size = 0, again = 0;
  EXPECT_EQ(save(object, nullptr, 0, &size), DSW_STATUS_OK) << dsw_last_error_message();
  Bytes block(size);
  EXPECT_EQ(save(object, block.data(), block.size(), &again), DSW_STATUS_OK);
  EXPECT_EQ(again, size);
  return block;
}
inline Bytes saved(const dsw_environment* environment) { return saved_by(dsw_environment_save, environment); }
inline Bytes saved(const dsw_scene* scene) { return saved_by(dsw_scene_save, scene); }

}  // namespace dsw::oracle

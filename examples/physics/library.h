// The C interface in C++ programs: statuses become exceptions, handles are given back.
#ifndef DARTSWEEP_PHYSICS_LIBRARY_H
#define DARTSWEEP_PHYSICS_LIBRARY_H

#include <dartsweep/dartsweep.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace physics {

// A call answered something else than OK. The library promises that nothing has changed then.
class LibraryError : public std::runtime_error {
 public:
  LibraryError(dsw_status status, const char* what)
      : std::runtime_error(std::string(what) + ": " + dsw_status_string(status) + ": " + dsw_last_error_message()),
        status_(status) {}
  dsw_status status() const { return status_; }

 private:
  dsw_status status_;
};

inline void check(dsw_status status, const char* what) {
  if (status != DSW_STATUS_OK) {
    throw LibraryError(status, what);
  }
}

struct DestroyEnvironment {
  void operator()(dsw_environment* environment) const { dsw_environment_destroy(environment); }
};
struct DestroyScene {
  void operator()(dsw_scene* scene) const { dsw_scene_destroy(scene); }
};
using Environment = std::unique_ptr<dsw_environment, DestroyEnvironment>;
using Scene = std::unique_ptr<dsw_scene, DestroyScene>;

}  // namespace physics

#endif

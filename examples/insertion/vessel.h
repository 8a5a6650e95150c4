// Where the catheter goes: a mesh as an environment, the way through its lumen, and its wall for viewers.
#ifndef DARTSWEEP_INSERTION_VESSEL_H
#define DARTSWEEP_INSERTION_VESSEL_H

#include <memory>
#include <optional>
#include <stdexcept>

#include "flow.h"
#include "options.h"
#include "route.h"

namespace insertion {

// What was given can't be used; the text says why, or is empty where that has been printed.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Vessel {
 public:
  // The host tag of every volume becomes its region, so that contacts tell which tissue was touched. Throws BadInput, LibraryError;
  // ends the program with a message and exit code 2 where cells are no environment.
  explicit Vessel(const Options& options);

  dsw_environment* environment() const { return environment_.get(); }
  const demo_flow& flow() const { return *flow_; }
  const physics::Route& route() const { return *route_; }
  const dsw_environment_info& info() const { return info_; }
  // The radius of the lumen, as the demo estimates it.
  double radius() const { return flow_->radius; }

 private:
  physics::Environment environment_;
  std::unique_ptr<demo_flow, void (*)(demo_flow*)> flow_;
  std::optional<physics::Route> route_;
  dsw_environment_info info_ = {};
};

// The surface of the lumen: triangles, counter-clockwise seen from outside of it.
struct Wall {
  std::vector<double> positions;  // 3 each
  std::vector<std::uint32_t> triangles;
};

// O(volumes of the lumen). Throws LibraryError.
Wall wall_of(const Vessel& vessel);

}  // namespace insertion

#endif

// Environments made from seeds, in space and in the plane, and places in them.
#pragma once

#include "environments.h"
#include "places.h"
#include "rng.h"
#include "scenes.h"

#include <string>
#include <vector>

namespace dsw::portable {

using oracle::Rng;
using oracle::Vec;

struct Ground {
  size_t dimension = 3;
  std::vector<Vec> points;              // in the plane the third coordinate is 0
  std::vector<oracle::Loop> facets;     // faces, in the plane sides
  std::vector<std::vector<int>> cells;  // their vertices, some of them twice
  Vec lower = {0, 0, 0}, upper = {0, 0, 0};
  double size = 0;                     // largest extent
  dsw_status status = DSW_STATUS_OK;   // of its creation
  oracle::EnvironmentPtr environment;  // null if it was refused

  std::vector<double> positions() const;  // of all points, `dimension` doubles each
};

/// A kind of the oracle's scenes, of both dimensions.
struct Kind {
  const char* name;
  size_t dimension;
};
std::vector<Kind> kinds();
/// Some of the sizes that a kind comes in; 0 is its own.
size_t transform_count(const Kind& kind);
Ground make_ground(const Kind& kind, size_t transform, uint64_t seed, dsw_context* context);
/// Cells of about the size `unit`, with the lower corner at the origin and regions; a kind, or "hall" or "tube", which
/// are larger.
Ground make_even_ground(const Kind& kind, double unit, uint64_t seed, dsw_context* context);

/// Some volumes, faces, edges and vertices become impassable.
void mark_some(const Ground& ground, double share, Rng& rng);

class GroundPlaces : public oracle::Places {
 public:
  GroundPlaces(const Ground& ground, Rng& rng) : Places(ground.dimension, ground.size, rng), ground_(ground) {}
  /// Mostly inside of a cell.
  Vec start() override;
  /// Often exactly on something.
  Vec site() override;

 private:
  Vec vertex() override;
  std::array<Vec, 2> ends() override;
  const Vec& corner(const oracle::Loop& of, size_t i) const {
    return ground_.points[static_cast<size_t>(of[i % of.size()])];
  }

  const Ground& ground_;
};

}  // namespace dsw::portable

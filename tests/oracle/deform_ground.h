// What is deformed under the oracle's eyes, of either dimension.
#pragma once

#include "arena.h"
#include "places.h"

namespace dsw::oracle {

/// An environment with its points where they are now.
class Picture {
 public:
  virtual ~Picture() = default;
  /// Whether anything can be said of it.
  virtual bool is_sound() const { return true; }
  virtual bool contains(int cell, const Vec& at) = 0;
  virtual Arena& arena() = 0;
};

/// What a deformation was to do, and what the library says of it.
struct Deformed {
  std::vector<Vec> start, target, now;  // vertices of the environment
  dsw_deform_options options;
  dsw_deform_report report;
  std::vector<dsw_wall_contact> contacts;
  std::vector<dsw_vertex_id> held;
  bool whole = false;  // the environment was valid before and is now
};

/// What lay in the environment before: a particle, a vertex (one point) or an edge (two) of a body.
struct Part {
  dsw_particle_id particle = {0, 0};
  dsw_body_id body = {0, 0};
  dsw_body_edge_id edge = {0, 0};
  dsw_level level = DSW_LEVEL_POINTS;
  std::vector<Vec> at;
  bool at_rest = true;  // no wall has touched it, or what belongs to it, and it is where it was
};

struct Validation {
  std::vector<std::string> faults;
  uint64_t parts = 0, contacts = 0;  // that were validated
};

/// Where `fraction` of the way is, in the words of dsw_deform_report.
Vec point_on_way(const Vec& from, const Vec& to, double fraction);

class Ground {
 public:
  virtual ~Ground() = default;
  virtual dsw_environment* environment() const = 0;
  /// The environment as it was made; its marks stay.
  virtual Arena& arena() = 0;
  virtual Places& places() = 0;
  virtual const std::vector<Vec>& points() const = 0;
  /// Pairs of cells with something passable between them.
  virtual std::vector<std::array<int, 2>> passages() const = 0;
  /// A vertex of a cell.
  virtual int corner(int cell, Rng& rng) const = 0;
  virtual std::unique_ptr<Picture> picture(const std::vector<Vec>& points) const = 0;
  /// Validates what was passed, and contacts that are none.
  virtual Validation validate(const Deformed&, const std::vector<Part>&) { return {}; }
};

}  // namespace dsw::oracle

// What happens in a scene: random calls of one kind, all from a seed.
#pragma once

#include "ground.h"

#include "../fuzz/calls.h"

#include <optional>

namespace dsw::portable {

class Life;

/// An act, and how often it is chosen beside others.
struct Act {
  dsw_status (Life::*make)();
  uint32_t weight;
};

enum class Shape { kNone, kWire, kRing, kCloth, kSolid };

struct BodyKind {
  Shape shape = Shape::kNone;
  uint32_t count = 0;  // wanted
  int level = 0;       // 0: any
  uint32_t flags = 0;
  double radius = 0;  // in units
};

struct LifeKind {
  const char* name;
  Kind ground;
  double unit;        // size of cells
  double marked;      // share of cells
  uint32_t features;  // of the scene
  BodyKind bodies;
  const std::vector<Act>* acts;
  uint32_t calls;  // acts in its recordings
  // Life::call makes calls of the fuzzer from the first to before the last one.
  uint32_t first_call = 0, last_call = 56;
};
/// All kinds, of both dimensions.
const std::vector<LifeKind>& life_kinds();

class Life {
 public:
  Life(const LifeKind& kind, uint64_t seed, dsw_context* context);
  Life(const Life&) = delete;
  Life& operator=(const Life&) = delete;

  bool began() const { return scene_ != nullptr; }
  dsw_scene* scene() const { return scene_.get(); }
  /// One call as a rule; what it answered.
  dsw_status act();
  /// There are many more volumes than in the beginning, or hardly any.
  bool is_over() const;

  dsw_status create_particles();
  dsw_status move_particles();
  dsw_status move_particle();
  dsw_status cast_from_particles();
  dsw_status destroy_particle();
  dsw_status create_body();
  dsw_status destroy_body();
  dsw_status move_body();
  dsw_status move_bodies();
  dsw_status move_together();
  dsw_status move_rigidly();
  dsw_status change_radius();
  dsw_status bend();
  /// The environment bends while all bodies move.
  dsw_status bend_together();
  dsw_status mark();
  dsw_status cut();
  dsw_status open();
  dsw_status carve();
  dsw_status tie();
  dsw_status detach();
  dsw_status sew();
  /// An edge gets a vertex and loses it again.
  dsw_status split_edge();
  /// A hexahedron becomes two wedges.
  dsw_status split_volume();
  /// A call of the fuzzer's.
  dsw_status call();

 private:
  struct Mover {
    dsw_body_id body;
    Vec velocity;
  };

  double unit() const { return kind_.unit; }
  size_t dimension() const { return ground_.dimension; }
  dsw_environment* environment() const { return ground_.environment.get(); }
  Vec some_way(double length);
  dsw_volume_id some_volume();
  /// Finds the centre of a volume; false: there is no such volume.
  bool centre_of(dsw_volume_id volume, Vec& centre);
  void append(std::vector<double>& list, const Vec& p) const;
  Mover* some_mover();
  std::vector<double> targets_of(Mover& mover);
  /// All bodies, and their targets one after the other.
  std::vector<dsw_body_id> all_movers(std::vector<double>& targets);
  /// Bent points, in the array that the environment does not read, with room for more. How many there are.
  size_t bend_points(std::vector<double>*& next);
  dsw_move_options move_options();
  void add_parts(std::vector<Vec>& at, std::vector<uint32_t>& edges, std::vector<uint32_t>& corners);

  const LifeKind& kind_;
  Rng rng_;
  // The environment reads points from these.
  std::vector<double> lent_[2];
  std::optional<dsw_fuzz::Calls> calls_;
  Ground ground_;
  GroundPlaces places_;
  oracle::ScenePtr scene_;
  std::vector<double> first_points_;
  uint32_t first_volumes_ = 0, bends_ = 0;
  std::vector<dsw_particle_id> particles_;
  std::vector<Mover> movers_;
  std::vector<uint8_t> program_;
  dsw_fuzz::Bytes bytes_{nullptr, 0};
};

}  // namespace dsw::portable

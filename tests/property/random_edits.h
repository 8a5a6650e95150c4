// Random changes of an environment's topology with particles and bodies inside, and what has to hold after each.
#pragma once

#include "edit_ground.h"

#include "capi/scene_handle.h"

namespace dsw::oracle {

enum class Operation {
  kSew,
  kUnsew,
  kRemove,
  kAdd,
  kMergeVolumes,
  kSplitVolume,
  kMergeFaces,
  kSplitFace,
  kSplitEdge,
  kMergeEdges,
  kCollapse,
  kCut,
  kCarve,
  kTie,
  kOpen,
  kDetach,
  kRemesh,
  kCount
};
const char* name_of(Operation operation);

/// How often an operation was tried, done, and refused because of what was in the way.
struct EditTally {
  size_t tried = 0, done = 0, occupied = 0;
};

/// A host's memory that refuses one allocation.
struct FailingMemory {
  size_t countdown = 0;  // to the one that is refused; 0: none is
  ContextPtr make_context();
};

/// In space, or in the plane: then without what this has not.
template <int D>
class RandomEdits {
 public:
  using Point = std::array<double, D>;

  /// With `memory`, every call is first made with each of its allocations refused in turn. `features`: of the scene,
  /// beside those that it has anyhow.
  RandomEdits(const std::string& scene, uint64_t seed, FailingMemory* memory = nullptr, uint32_t features = 0);

  /// One call with random arguments, then all checks that do not need exact integers. What is wrong; empty: nothing.
  std::string step();
  /// Marks or unmarks some volumes, faces or edges, skipping what is occupied or not. What was answered.
  std::string mark();
  /// Particles and bodies that were in the way of the last call.
  std::string occupants() const;
  /// Moves all particles and bodies a little: what they keep from move to move must fit what has changed.
  std::string move_all();
  /// Environment and scene as their snapshots.
  std::string saved() const;
  /// Goes on with what is loaded from these.
  std::string reload();
  /// Particles, bodies and volumes against brute force in exact integers.
  std::string check_exactly();

  size_t refusals = 0;  // of memory
  const dsw_environment* environment() const { return place_.get(); }
  dsw_scene* handle() const { return scene_.get(); }
  size_t volume_count() const { return env().map.cell_count; }
  size_t exact_checks = 0;  // of a partition; others look at volumes and particles only
  EditTally tallies[static_cast<size_t>(Operation::kCount)];

 private:
  const Environment<D>& env() const { return std::get<Environment<D>>(place_.get()->engine); }
  const Scene<D>& scene() const { return std::get<Scene<D>>(scene_->engine); }

  std::string bend();
  std::string bend_to(const double* from, uint32_t vertex, double by);
  void mark_exit(dsw_face_id face);
  void mark_some();
  void add_particles();
  void add_bodies();
  Operation choose();
  dsw_status call(Operation operation);
  dsw_status call_in_space(Operation operation);
  dsw_status call_without_memory(Operation operation, const std::string& before, std::string& wrong);
  dsw_status sew();
  dsw_status remove();
  dsw_status add();
  dsw_status split_volume();
  dsw_status split_face();
  dsw_status cut();
  dsw_status carve();
  dsw_status tie();
  dsw_status open();
  std::vector<dsw_cut_face> some_crack();
  dsw_status detach();
  void drop_pieces();
  dsw_status remesh();
  std::vector<double> some_blade(uint32_t rows, uint32_t columns);
  dsw::Cell some_cell();
  dsw_face_id some_face();
  dsw_edge_id some_edge();
  dsw_vertex_id vertex_of(dsw_edge_id edge);
  std::string state() const;
  std::string check() const;
  std::string check_counts() const;
  double volume() const;

  /// A volume that is gone, to be put back.
  struct Gone {
    std::vector<std::vector<size_t>> faces;  // places in `vertices`
    std::vector<dsw_vertex_id> vertices;
    std::vector<Point> positions;
  };
  /// What a call with the same arguments needs again.
  struct Choices {
    Rng rng;
    std::vector<std::array<dsw_face_id, 2>> unsewn;
    std::vector<Gone> gone;
  };

  FailingMemory* memory_;
  ContextPtr context_;
  Ground<D> place_;
  ScenePtr scene_;
  std::vector<double> lent_[2];  // points of an environment that bends
  Choices choices_;
  Rng& rng_ = choices_.rng;
  std::vector<std::array<dsw_face_id, 2>>& unsewn_ = choices_.unsewn;
  size_t first_count_ = 0, first_bodies_ = 0;
  double volume_ = 0;
  bool may_change_ = false;  // the last call: the space that all volumes fill
};

template <>
dsw_status RandomEdits<3>::call_in_space(Operation operation);
template <>
dsw_status RandomEdits<3>::split_volume();
template <>
dsw_status RandomEdits<2>::split_volume();
template <>
dsw_status RandomEdits<3>::split_face();
template <>
dsw_status RandomEdits<3>::remesh();
template <>
dsw_status RandomEdits<3>::cut();
template <>
dsw_status RandomEdits<3>::carve();
template <>
dsw_status RandomEdits<3>::tie();
template <>
dsw_status RandomEdits<3>::open();
template <>
dsw_status RandomEdits<3>::detach();
template <>
void RandomEdits<3>::drop_pieces();
template <>
std::string RandomEdits<3>::check_exactly();
template <>
std::string RandomEdits<2>::check_exactly();

}  // namespace dsw::oracle

// Random cuts, tears, openings, shapes carved out and ties in random environments of the plane with particles and
// bodies inside, and what has to hold after each.
#pragma once

#include "support.h"

#include "capi/scene_handle.h"
#include "plane_scenes.h"
#include "run.h"

#include <set>

namespace dsw::oracle {

inline plane::Vec mix(const plane::Vec& a, const plane::Vec& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

inline std::vector<dsw_cut_face> cut_faces(const EnvironmentPtr& environment) {
  const dsw_cut_face* faces = change_of(environment.get()).faces;
  const size_t count = change_of(environment.get()).face_count;
  return {faces, faces + count};
}

/// Calls use(turn, seed) for all kinds of meshes in all sizes, so many rounds.
template <class Use>
void for_each_turn(uint64_t rounds, const Use& use) {
  const std::vector<plane::Turn> turns = plane::turns("");
  const int count = effort_of(static_cast<int>(rounds * turns.size()));
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(count) && !testing::Test::HasFailure(); ++seed) {
    const plane::Turn& turn = turns[(seed - 1) % turns.size()];
    SCOPED_TRACE(turn.name() + ", seed " + std::to_string(seed));
    use(turn, seed);
  }
}

class PlaneCuts {
 public:
  enum Operation { kCut, kTear, kOpen, kCarve, kTie, kMark, kOperations };

  PlaneCuts(const plane::Turn& turn, uint64_t seed, bool inhabited);
  /// False: the library has refused the environment.
  bool is_made() const { return environment_ != nullptr; }

  /// One call with random arguments, then all checks. What is wrong; empty: nothing.
  std::string step();
  /// A cut along a straight line through everything, again for each part that it meets. What is wrong.
  std::string cut_all(uint64_t seed);

  size_t done[kOperations] = {}, occupied[kOperations] = {};
  size_t split = 0, whole = 0, opened = 0, parted = 0, into_space = 0, sides_checked = 0, points_checked = 0,
         crossed = 0;

 private:
  using Path = std::vector<plane::Vec>;

  const Environment<2>& env() const { return std::get<Environment<2>>(environment_->engine); }
  const Scene<2>& scene() const { return std::get<Scene<2>>(scene_->engine); }
  void add_inhabitants();
  void read();
  std::string saved() const;

  dsw::Cell some_cell();
  plane::Vec some_point();
  plane::Vec vertex_near(dsw::Cell c);
  Path some_path();
  dsw_status call(Operation operation);
  dsw_status cut(const Path& path, const dsw_cut_desc& given);
  dsw_status tear();
  dsw_status open();
  dsw_status carve();
  dsw_status tie();
  dsw_status mark();

  std::string check(bool was_cut);
  std::string check_cells() const;
  std::set<int> folded_vertices() const;
  std::string check_folds(bool was_cut);
  std::string check_inhabitants();
  std::string check_cut(const Path& path, const plane::World& before, const std::vector<uint32_t>& numbers,
                        const dsw_change& report, bool unsewn);
  std::string check_sides(const Path& path) const;
  std::string check_opening(const dsw_change& report, double width);
  double distance(const plane::Vec& p, const plane::Vec& a, const plane::Vec& b) const;
  double rounding(const plane::Vec& p) const;

  Rng rng_;
  plane::World world_;             // as the environment is now
  std::vector<uint32_t> numbers_;  // indices of its cells
  double unit_ = 1;  // a power of two: positions over it are neither too large nor too small to be squared
  double size_ = 0;
  EnvironmentPtr environment_;
  ScenePtr scene_;
  std::vector<std::array<dsw_face_id, 2>> unsewn_;
  std::string wrong_;         // of the last call
  std::set<int> folded_;      // vertices of the outer boundary, by roundings
  bool coarse_;               // doubles are as coarse as the cells
  bool through_all_ = false;  // the path is a line through everything
  bool crosses_ = false;      // the outer boundary has been moved through itself
};

}  // namespace dsw::oracle

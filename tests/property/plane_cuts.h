// Random cuts, tears, openings, shapes carved out and ties in random environments of the plane with particles and bodies inside, and what has
// to hold after each.
#pragma once

#include "support.h"

#include "capi/handle.h"
#include "plane_scenes.h"
#include "run.h"

namespace dsw::oracle {

inline plane::Vec mix(const plane::Vec& a, const plane::Vec& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

inline std::vector<dsw_cut_face> cut_faces(const EnvironmentPtr& environment) {
  const dsw_cut_face* faces = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_cut_faces(environment.get(), &faces, &count), DSW_STATUS_OK);
  return {faces, faces + count};
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

  std::string check();
  std::string check_cells() const;
  std::string check_turns() const;
  std::string check_inhabitants();
  std::string check_cut(const Path& path, const plane::World& before, const std::vector<uint32_t>& numbers,
                        const dsw_cut_report& report, bool unsewn);
  std::string check_opening(const dsw_open_report& report, double width);
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
  bool coarse_;               // doubles are as coarse as the cells
  bool through_all_ = false;  // the path is a line through everything
  bool crosses_ = false;      // the outer boundary has been moved through itself
};

}  // namespace dsw::oracle

// An arena in the plane, and where bodies are put and sent there.
#pragma once

#include "arena.h"
#include "places.h"
#include "plane_sweeps.h"

namespace dsw::oracle {

class PlaneArena : public Arena {
 public:
  /// Marks must be set. `world` must outlive this.
  explicit PlaneArena(const plane::World& world, const std::vector<int>& marked_vertices = {});

  double size() const override { return size_; }
  bool lattice() const override { return world_.lattice; }
  const std::vector<dsw_volume_id>& ids() const override { return ids_; }
  bool marked(int cell) const override { return world_.cell_marked[static_cast<size_t>(cell)] != 0; }
  std::string second_normal(const Sweep& sweep) override;

 private:
  Wall wall(int face) const override;
  const std::vector<int>& faces_of(int cell) const override { return sides_of_[static_cast<size_t>(cell)]; }
  uint32_t tag(int cell) const override { return world_.tags[static_cast<size_t>(cell)]; }
  int face_of(const SweepEvent& event) const override { return event.triangle; }
  Wall met(const SweepEvent& event) const override { return wall(event.triangle); }
  bool normal_fits(const SweepEvent& event, const double* normal) const override;
  std::vector<int> faces_round(const SweepEvent& event) const override;
  std::array<Vec, 2> ends_of(const SweepEvent& event) const override;
  std::string wrong_name(const SweepEvent& event, const dsw_sweep& got) const override;

  const plane::World& world_;
  std::vector<int> obstacles_;  // vertices of what is impassable
  double size_;
  std::vector<dsw_volume_id> ids_;
  std::vector<std::vector<int>> sides_of_;
};

class PlanePlaces : public Places {
 public:
  PlanePlaces(const plane::World& world, const Arena& arena, const std::vector<int>& marked_vertices, Rng& rng);
  Vec start() override;
  Vec site() override;
  Vec obstacle(double exactly) override;
  bool round_obstacle(Vec& site, std::array<Vec, 2>& span) override;
  Vec anchor() override;

 private:
  Vec vertex() override { return point(static_cast<int>(rng_.below(world_.points.size()))); }
  std::array<Vec, 2> ends() override;
  Vec point(int v) const { return raised(world_.points[static_cast<size_t>(v)]); }
  std::array<Vec, 2> ends_of(int side) const;

  const plane::World& world_;
  std::vector<int> spikes_;         // vertices of something impassable that is no closed wall
  std::vector<int> free_standing_;  // marked sides
  std::vector<int> impassable_;     // all that are
};

}  // namespace dsw::oracle

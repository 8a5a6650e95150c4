// An arena in space.
#pragma once

#include "arena.h"
#include "world.h"

#include <map>

namespace dsw::oracle {

class SpaceArena : public Arena {
 public:
  /// Marks must be set; `marked_edges` are pairs of vertices. `world` must outlive this.
  explicit SpaceArena(World& world, const std::vector<std::array<int, 2>>& marked_edges = {},
                      const std::vector<int>& marked_vertices = {});

  double size() const override { return world_.size; }
  bool lattice() const override { return world_.lattice; }
  const std::vector<dsw_volume_id>& ids() const override { return world_.ids; }
  bool marked(int cell) const override { return world_.cell_marked[static_cast<size_t>(cell)] != 0; }
  std::string second_normal(const Sweep& sweep) override;

 private:
  Wall wall(int face) const override;
  const std::vector<int>& faces_of(int cell) const override { return world_.cell_faces[static_cast<size_t>(cell)]; }
  uint32_t tag(int cell) const override { return world_.mesh.tags[static_cast<size_t>(cell)]; }
  int face_of(const SweepEvent& event) const override;
  Wall met(const SweepEvent& event) const override;
  bool normal_fits(const SweepEvent& event, const double* normal) const override;
  std::vector<int> faces_round(const SweepEvent& event) const override;
  std::array<Vec, 2> ends_of(const SweepEvent& event) const override;
  std::string wrong_name(const SweepEvent& event, const dsw_sweep& got) const override;
  std::string wrong_at_face(const VertexMove& flight, const SweepEvent& event, const dsw_body_contact& contact,
                            const dsw_sweep& wall) const override;

  World& world_;
  std::map<std::pair<int, int>, dsw_edge_id> edges_;          // canonical names
  std::map<std::pair<int, int>, std::vector<int>> faces_at_;  // of edges and diagonals
  std::map<int, std::vector<int>> faces_at_vertex_;
};

}  // namespace dsw::oracle

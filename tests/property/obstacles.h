// What is impassable in a place, for questions for the nearest of it.
#pragma once

#include "exact_places.h"
#include "support.h"

#include <tuple>
#include <vector>

namespace dsw::oracle {

/// A tenth of all faces, edges, vertices and volumes of a place, marked impassable.
class Obstacles {
 public:
  Obstacles(Place& place, Rng& rng)
      : place_(place),
        edges_(*place.world),
        edge_marked_(edges_.edges.size()),
        vertex_marked_(place.mesh.points.size()) {
    World& world = *place.world;
    const auto chosen = [&] { return rng.chance(0.1); };
    for (Face& f : world.faces) {
      if (!chosen()) continue;
      f.marked = true;
      const dsw_face_id id = face_id(world, static_cast<int>(&f - world.faces.data()));
      EXPECT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    for (size_t e = 0; e < edge_marked_.size(); ++e) {
      if (!chosen()) continue;
      edge_marked_[e] = true;
      const dsw_edge_id id = edges_.id(world, static_cast<int>(e));
      EXPECT_EQ(dsw_environment_mark_edges(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    for (size_t v = 0; v < vertex_marked_.size(); ++v) {
      if (!chosen()) continue;
      vertex_marked_[v] = true;
      const dsw_vertex_id id = vertex_id(v);
      EXPECT_EQ(dsw_environment_mark_vertices(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    for (size_t c = 0; c < world.ids.size(); ++c) {
      if (!chosen()) continue;
      world.cell_marked[c] = 1;
      EXPECT_EQ(dsw_environment_mark_volumes(place.get(), &world.ids[c], 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                DSW_STATUS_OK);
    }
    std::vector<bool> used(vertex_marked_.size());
    for (const Face& f : world.faces) {
      for (const int v : f.loop) used[static_cast<size_t>(v)] = true;
    }
    for (size_t v = 0; v < used.size(); ++v) vertex_marked_[v] = vertex_marked_[v] && used[v];
  }

  /// Calls visit(cell, vertices) for impassable triangles, which have the cell of their face, edges and vertices.
  template <class Visit>
  void for_each_simplex(Visit visit) const {
    const World& world = *place_.world;
    for (const Triangle& t : world.triangles) {
      if (!world.impassable(t.face)) continue;
      visit(cell_of(face_id(world, t.face)), std::vector<int>{t.v[0], t.v[1], t.v[2]});
    }
    for (size_t e = 0; e < edge_marked_.size(); ++e) {
      if (!edge_marked_[e]) continue;
      const auto& ends = edges_.edges[e].ends;
      visit(cell_of(edges_.id(world, static_cast<int>(e))), std::vector<int>{ends[0], ends[1]});
    }
    for (size_t v = 0; v < vertex_marked_.size(); ++v) {
      if (vertex_marked_[v]) visit(cell_of(vertex_id(v)), std::vector<int>{static_cast<int>(v)});
    }
  }
  /// Calls visit(cell, corners) for the obstacles of for_each_simplex, with their points.
  template <class Visit>
  void for_each(Visit visit) const {
    for_each_simplex([&](const dsw_cell& cell, const std::vector<int>& vertices) {
      std::vector<Vec> corners;
      for (const int v : vertices) corners.push_back(place_.world->mesh.points[static_cast<size_t>(v)]);
      visit(cell, corners);
    });
  }

  /// The obstacle at a passable cell on which a point lies exactly: the lowest dimension, then the lowest cell. None: NONE.
  dsw_cell touched(const Vec& p) const {
    const World& world = *place_.world;
    dsw_cell best{};
    const auto offer = [&](const dsw_cell& next) {
      const auto rank = [](const dsw_cell& c) { return std::make_tuple(c.kind, c.index, c.local); };
      if (best.kind == DSW_CELL_NONE || rank(next) < rank(best)) best = next;
    };
    const auto at = [&](int v) -> const Vec& { return world.mesh.points[static_cast<size_t>(v)]; };
    for (size_t c = 0; c < world.ids.size(); ++c) {
      if (world.cell_marked[c] != 0) continue;
      for (const int t : world.cell_triangles[c]) {
        const Triangle& triangle = world.triangles[static_cast<size_t>(t)];
        const auto& v = triangle.v;
        for (const int corner : v) {
          if (vertex_marked_[static_cast<size_t>(corner)] && at(corner) == p)
            offer(cell_of(vertex_id(static_cast<size_t>(corner))));
        }
        if (world.impassable(triangle.face) && exact::on_triangle(p, at(v[0]), at(v[1]), at(v[2])))
          offer(cell_of(face_id(world, triangle.face)));
      }
      for (const int e : edges_.of_cell[c]) {
        const auto& ends = edges_.edges[static_cast<size_t>(e)].ends;
        if (edge_marked_[static_cast<size_t>(e)] && exact::on_segment(p, at(ends[0]), at(ends[1])))
          offer(cell_of(edges_.id(world, e)));
      }
    }
    return best;
  }

 private:
  dsw_vertex_id vertex_id(size_t v) const {
    dsw_vertex_id id{};
    EXPECT_EQ(dsw_environment_get_vertex_id(place_.get(), static_cast<uint32_t>(v), &id), DSW_STATUS_OK);
    return id;
  }

  const Place& place_;
  Edges edges_;
  std::vector<bool> edge_marked_, vertex_marked_;
};

}  // namespace dsw::oracle

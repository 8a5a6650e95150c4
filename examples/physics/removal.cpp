#include "removal.h"

#include <algorithm>

namespace physics {
namespace {

// The edges of a body, and their ends by vertex index.
struct Mesh {
  std::vector<dsw_body_edge_id> edges;
  std::vector<std::uint32_t> ends;
};

Mesh read_mesh(const dsw_scene* scene, dsw_body_id body) {
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  check(dsw_body_get_counts(scene, body, &counts), "reading a body");
  Mesh mesh;
  mesh.edges.resize(counts.edge_count);
  std::vector<std::uint32_t> slots(std::size_t{2} * counts.edge_slots);
  std::size_t count = 0;
  check(dsw_body_get_edge_ids(scene, body, mesh.edges.data(), mesh.edges.size(), &count), "reading edges");
  check(dsw_body_get_edge_indices(scene, body, slots.data(), counts.edge_slots, &count), "reading edges");
  for (const dsw_body_edge_id& edge : mesh.edges) {
    mesh.ends.insert(mesh.ends.end(), {slots[2 * edge.index], slots[2 * edge.index + 1]});
  }
  return mesh;
}

bool is_pulled(std::size_t i, const Mesh& mesh, const std::vector<double>& pulls, double negligible) {
  if (!(pulls[i] <= negligible)) {
    return true;
  }
  for (std::size_t k = 0; k < mesh.ends.size(); ++k) {
    if (mesh.ends[k] == i && !(pulls[mesh.ends[k ^ 1]] <= negligible)) {
      return true;
    }
  }
  return false;
}

}  // namespace

void InsertedVertices::split(std::size_t a, std::size_t b, std::size_t added) {
  for (const auto& pair : {std::make_pair(a, b), std::make_pair(b, a)}) {
    if (contains(pair.first)) {
      std::replace(ends_[pair.first].end, ends_[pair.first].end + 2, pair.second, added);
    }
  }
  if (added >= ends_.size()) {
    ends_.resize(added + 1);
  }
  ends_[added] = {2, {a, b}};
  ++count_;
}

void InsertedVertices::merge(std::size_t gone, std::size_t kept) {
  const Ends line = contains(gone) ? ends_[gone] : Ends();
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (i != gone && contains(i)) {
      const std::size_t* const on_line = std::find(line.end, line.end + line.count, i);
      const bool is_next = on_line != line.end + line.count;
      std::replace(ends_[i].end, ends_[i].end + 2, gone, is_next ? line.end[1 - (on_line - line.end)] : kept);
    }
  }
  if (contains(gone)) {
    ends_[gone] = Ends();
    --count_;
  }
}

bool remove_one(dsw_scene* scene, dsw_body_id body, const InsertedVertices& inserted, const std::vector<double>& pulls,
                double negligible, const std::vector<char>& colliding, dsw_body_edit* edit) {
  const Mesh mesh = read_mesh(scene, body);
  for (std::size_t i = 0; i < inserted.slots(); ++i) {
    if (!inserted.contains(i) || colliding[i] || is_pulled(i, mesh, pulls, negligible)) {
      continue;
    }
    dsw_body_vertex_id vertex;
    check(dsw_body_get_vertex_id(scene, body, static_cast<std::uint32_t>(i), &vertex), "reading a vertex");
    for (const std::size_t* end = inserted.ends(i); end != inserted.ends(i) + 2; ++end) {
      for (std::size_t k = 0; k < mesh.ends.size(); ++k) {
        if (mesh.ends[k] != i || mesh.ends[k ^ 1] != *end) {
          continue;
        }
        const dsw_status status = dsw_body_collapse_edge(scene, body, mesh.edges[k / 2], vertex, edit);
        if (status == DSW_STATUS_OK) {
          return true;
        }
        if (status != DSW_STATUS_OCCUPIED && status != DSW_STATUS_NOT_MANIFOLD) {
          check(status, "removing a vertex");
        }
      }
    }
  }
  return false;
}

}  // namespace physics

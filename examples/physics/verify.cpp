#include "verify.h"

#include <vector>

namespace physics {

Verdict verify(const dsw_scene* scene, dsw_body_id body) {
  const dsw_environment* environment = dsw_scene_get_environment(scene);
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  check(dsw_body_get_counts(scene, body, &counts), "reading a body");
  std::vector<double> positions(std::size_t{3} * counts.vertex_slots), from, to;
  std::vector<dsw_volume_id> volumes(counts.vertex_slots), start, end;
  std::vector<dsw_body_vertex_id> vertices(counts.vertex_count);
  std::vector<dsw_body_edge_id> edges(counts.edge_count);
  std::size_t count = 0;
  check(dsw_body_get_positions(scene, body, positions.data(), counts.vertex_slots, 0, volumes.data(), &count),
        "reading positions");
  check(dsw_body_get_vertices(scene, body, vertices.data(), vertices.size(), &count), "reading vertices");
  check(dsw_body_get_edges(scene, body, edges.data(), edges.size(), &count), "reading edges");

  Verdict verdict;
  for (const dsw_body_vertex_id& vertex : vertices) {
    const dsw_volume_id anywhere = {0, 0}, reported = volumes[vertex.index];
    dsw_volume_id found;
    dsw_place place = DSW_PLACE_NONE;
    check(dsw_environment_locate(environment, &positions[std::size_t{3} * vertex.index], anywhere, &found, &place),
          "finding a vertex");
    verdict.lost += place != DSW_PLACE_PASSABLE || found.index != reported.index ? 1 : 0;
  }
  verdict.vertices = vertices.size();

  for (const dsw_body_edge_id& edge : edges) {
    dsw_body_vertex_id ends[2];
    check(dsw_body_get_edge(scene, body, edge, ends), "reading an edge");
    const double *p = &positions[std::size_t{3} * ends[0].index], *q = &positions[std::size_t{3} * ends[1].index];
    from.insert(from.end(), p, p + 3);
    to.insert(to.end(), q, q + 3);
    start.push_back(volumes[ends[0].index]);
    end.push_back(volumes[ends[1].index]);
  }
  std::vector<dsw_flight> flights(edges.size());
  if (!edges.empty()) {
    check(dsw_environment_cast_segments(environment, edges.size(), start.data(), from.data(), to.data(), 0, nullptr,
                                        flights.data()),
          "casting the edges");
  }
  for (std::size_t i = 0; i < flights.size(); ++i) {
    verdict.not_free += flights[i].outcome != DSW_OUTCOME_REACHED || flights[i].volume.index != end[i].index ? 1 : 0;
  }
  verdict.edges = edges.size();
  return verdict;
}

}  // namespace physics

// Near rows by two queries of the environment: what is nearest to each vertex and to each edge. A vertex or edge that
// is near two walls has a row for the nearer one only.
#include <algorithm>

#include "near_rows.h"

namespace physics {
namespace {

// A point of an edge that is so close to an end, as a share of the edge, belongs to the row of that end.
constexpr double kEnd = 0.02;

void add_row(const dsw_nearest& nearest, std::uint32_t key, const NearRowOptions& options, KeyedRows* found) {
  NearRow row;
  row.vertices[0] = key / 2;
  row.vertices[1] = row.vertices[0] + 1;
  row.normal = Eigen::Map<const Vector3>(nearest.normal);
  row.gap = nearest.distance - options.radius;
  found->rows.push_back(row);
  found->keys.push_back(key);
}

bool is_near(const dsw_nearest& nearest) { return nearest.cell.kind != DSW_CELL_NONE && nearest.distance > 0; }

}  // namespace

void find_near_rows(const dsw_environment* environment, const Positions& line,
                    const std::vector<dsw_volume_id>& volumes, const NearRowOptions& options, KeyedRows* found) {
  const KeyedRows before = std::move(*found);
  *found = KeyedRows();
  const std::size_t edges = line.size() - 1;
  const double reach = options.radius + options.margin;
  std::vector<dsw_nearest> at_vertex(line.size());
  std::vector<dsw_segment_nearest> on_edge(edges);
  check(dsw_environment_find_nearest_to_points(environment, line.front().data(), line.size(), sizeof(Vector3),
                                               volumes.data(), reach, at_vertex.data(), nullptr, nullptr),
        "finding what is near vertices");
  check(dsw_environment_find_nearest_to_segments(environment, edges, volumes.data(), line[0].data(), line[1].data(),
                                                 sizeof(Vector3), reach, on_edge.data(), nullptr, nullptr),
        "finding what is near edges");
  for (std::uint32_t i = 0; i < line.size(); ++i) {
    if (is_near(at_vertex[i])) {
      add_row(at_vertex[i], 2 * i, options, found);
    }
    if (i < edges && is_near(on_edge[i].nearest)) {
      const double along = on_edge[i].segment_parameter;
      if (along > kEnd && along < 1 - kEnd) {
        add_row(on_edge[i].nearest, 2 * i + 1, options, found);
        NearRow& row = found->rows.back();
        row.count = 2;
        row.weights[0] = 1 - along;
        row.weights[1] = along;
      }
    }
  }
  for (std::size_t i = 0; i < found->rows.size(); ++i) {  // keys ascend
    const auto same = std::lower_bound(before.keys.begin(), before.keys.end(), found->keys[i]);
    if (same != before.keys.end() && *same == found->keys[i]) {
      found->rows[i].previous = static_cast<std::uint32_t>(same - before.keys.begin());
    }
  }
}

}  // namespace physics

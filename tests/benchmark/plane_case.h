// Triangles of the plane that ours and CGAL share.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PLANE_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_PLANE_CASE_H

#include "dartsweep/dartsweep.h"
#include "scenes/random.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dsw::bench::plane {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Storage = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>,
                                                     CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Storage>;

inline void check(dsw_status status) {
  if (status != DSW_STATUS_OK) throw std::runtime_error(dsw_last_error_message());
}

/** Triangles that both libraries get. */
struct Triangles {
  Delaunay delaunay;
  dsw_environment* environment = nullptr;

  explicit Triangles(std::size_t count) {
    scenes::Random random(11);
    std::vector<double> points;
    std::vector<std::pair<Kernel::Point_2, std::int32_t>> numbered;
    for (std::size_t i = 0; i < count / 2; ++i) {
      const double x = random.uniform(), y = random.uniform();
      points.insert(points.end(), {x, y});
      numbered.emplace_back(Kernel::Point_2(x, y), static_cast<std::int32_t>(i));
    }
    delaunay.insert(numbered.begin(), numbered.end());
    std::vector<std::int32_t> corners;
    for (const auto& face : delaunay.finite_face_handles()) {
      face->info() = static_cast<std::uint32_t>(corners.size() / 3);
      for (int k = 0; k < 3; ++k) corners.push_back(face->vertex(k)->info());
    }
    dsw_environment_desc desc;
    dsw_environment_desc_init(&desc, sizeof desc);
    desc.dimension = 2;
    desc.points = points.data();
    desc.point_count = points.size() / 2;
    desc.uniform_cell_type = DSW_CELL_TYPE_TRIANGLE;
    desc.volume_count = corners.size() / 3;
    desc.index_bytes = 4;
    desc.connectivity = corners.data();
    desc.connectivity_count = corners.size();
    check(dsw_environment_create(nullptr, &desc, &environment, nullptr));
  }
  ~Triangles() { dsw_environment_destroy(environment); }
  Triangles(const Triangles&) = delete;
  Triangles& operator=(const Triangles&) = delete;
};

/** Edge of triangles that fill the unit square and are all alike. */
inline double edge_of(std::size_t count) { return std::sqrt(4 / (std::sqrt(3.0) * static_cast<double>(count))); }

}  // namespace dsw::bench::plane

#endif

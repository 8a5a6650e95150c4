#include "scenes/delaunay.h"

#include "scenes/random.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

namespace dsw::scenes {

VolumeMesh make_delaunay(std::size_t tets, std::uint64_t seed) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Storage = CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Storage>;

  Random random(seed);
  Delaunay delaunay;
  VolumeMesh mesh;
  mesh.points_per_cell = 4;
  // A random point adds about 6.7 tetrahedra; the last few points decide the count.
  while (delaunay.number_of_finite_cells() < tets) {
    const std::size_t missing = tets - delaunay.number_of_finite_cells();
    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> batch(missing / 8 + 5);
    for (auto& [point, index] : batch) {
      const double xyz[3] = {random.uniform(), random.uniform(), random.uniform()};
      point = Kernel::Point_3(xyz[0], xyz[1], xyz[2]);
      index = static_cast<std::uint32_t>(mesh.point_count());
      mesh.points.insert(mesh.points.end(), xyz, xyz + 3);
    }
    delaunay.insert(batch.begin(), batch.end());
  }
  // A finite cell of a three-dimensional triangulation is never flat: CGAL decides with exact predicates.
  mesh.connectivity.reserve(4 * delaunay.number_of_finite_cells());
  for (const auto& cell : delaunay.finite_cell_handles()) {
    for (int i = 0; i < 4; ++i) mesh.connectivity.push_back(static_cast<std::int32_t>(cell->vertex(i)->info()));
  }
  return mesh;
}

}  // namespace dsw::scenes

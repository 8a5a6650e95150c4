#include "together/far_edges.h"

namespace dsw {
namespace {

template <int D>
bool is_far(const CellTree<D>& tree, const Box<D>& box) {
  return tree.visit_box(box.lower, box.upper, [](uint32_t) { return false; });
}

}  // namespace

template <int D>
uint32_t FarEdges<D>::leave_out(const Trajectory<D>& of, Array<uint32_t>& edges) {
  const CellTree<D>* const tree = find_tree(edges.size());
  if (tree == nullptr) return 0;
  group_edges(of, edges);
  is_far_.resize(group_boxes_.size());
  for (size_t g = 0; g < group_boxes_.size(); ++g) is_far_[g] = is_far(*tree, group_boxes_[g]) ? 1 : 0;
  const size_t count = edges.size();
  size_t kept = 0;
  for (const uint32_t e : edges) {
    const uint32_t(&ends)[2] = of.motion.body->edges[e].ends;
    if (is_far_[vertices_[ends[0]].group] != 0) continue;
    Box<D> box = vertices_[ends[0]].way;
    box.add(vertices_[ends[1]].way);
    if (!is_far(*tree, box)) edges[kept++] = e;
  }
  edges.resize(kept);
  return static_cast<uint32_t>(count - kept);
}

/** The tree, if it has all obstacles and is worth it for so many edges; else null. */
template <int D>
const CellTree<D>* FarEdges<D>::find_tree(size_t edges) const {
  constexpr size_t kFewest = 24,
                   kCellsOfAnEdge = 8;  // an edge takes as long without a tree as so many cells of a flood
  if (edges < kFewest || env_.has_moved()) return nullptr;
  const CellTree<D>* const tree = env_.obstacles.find(env_);
  bool is_whole = tree != nullptr;
  if (is_whole) env_.obstacles.for_each_beside(*tree, [&](uint32_t) { is_whole = false; });
  if (is_whole) return tree;
  env_.obstacles.note_flood(env_, kCellsOfAnEdge * edges);
  return nullptr;
}

/** The side of a cube of the lattice: a few times the mean side of the boxes of some edges. */
template <int D>
double FarEdges<D>::size_of_cubes(const Trajectory<D>& of, const Array<uint32_t>& edges) {
  constexpr double kSizes = 4;
  constexpr size_t kLooked = 64;
  const size_t step = edges.size() / kLooked + 1;
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < edges.size(); i += step, ++count) {
    const Box<D> box = box_of_way(of, {Simplex::kEdge, edges[i]});
    for (int k = 0; k < D; ++k) sum += (box.upper[k] - box.lower[k]) / D;
  }
  return kSizes * sum / static_cast<double>(count);
}

/** Finds the box of a vertex's way, and its group. Vertices that start in the same cube of the lattice make a group. */
template <int D>
const typename FarEdges<D>::Vertex& FarEdges<D>::find_vertex(const Trajectory<D>& of, uint32_t v, const double* origin,
                                                             double cubes) {
  constexpr double kMostCubes = 1 << 20;  // to either side of the origin; those farther out share the last ones
  constexpr uint32_t kBits = 21;
  Vertex& vertex = vertices_[v];
  if (vertex.group != kNone) return vertex;
  const double *const from = of.start(v), *const to = of.end(v);
  uint64_t key = 0;
  for (int k = 0; k < D; ++k) {
    vertex.way.lower[k] = std::min(from[k], to[k]);
    vertex.way.upper[k] = std::max(from[k], to[k]);
    const double at = (from[k] - origin[k]) * cubes + kMostCubes;
    key = key << kBits | (at > 0 ? static_cast<uint64_t>(std::min(at, 2 * kMostCubes - 1)) : 0);
  }
  vertex.group = keys_.insert(key);
  if (vertex.group == group_boxes_.size()) group_boxes_.emplace_back();
  group_boxes_[vertex.group].add(vertex.way);
  return vertex;
}

/** Groups edges by their first ends. The box of a group contains the ways of its edges. */
template <int D>
void FarEdges<D>::group_edges(const Trajectory<D>& of, const Array<uint32_t>& edges) {
  const double* const origin = of.start(of.motion.body->edges[edges[0]].ends[0]);
  const double cubes = 1 / size_of_cubes(of, edges);
  keys_.clear();
  group_boxes_.clear();
  vertices_.assign(of.motion.ways.size(), Vertex{});
  for (const uint32_t e : edges) {
    const uint32_t(&ends)[2] = of.motion.body->edges[e].ends;
    const Vertex &first = find_vertex(of, ends[0], origin, cubes), &last = find_vertex(of, ends[1], origin, cubes);
    if (first.group != last.group) group_boxes_[first.group].add(last.way);
  }
}

template class FarEdges<2>;
template class FarEdges<3>;

}  // namespace dsw

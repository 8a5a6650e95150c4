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
  box_ways(of, edges);
  group_ways();
  is_far_.resize(group_boxes_.size());
  for (size_t g = 0; g < group_boxes_.size(); ++g) is_far_[g] = is_far(*tree, group_boxes_[g]) ? 1 : 0;
  size_t kept = 0;
  for (size_t i = 0; i < boxes_.size(); ++i) {
    if (is_far_[groups_[i]] == 0 && !is_far(*tree, boxes_[i])) edges[kept++] = edges[i];
  }
  edges.resize(kept);
  return static_cast<uint32_t>(boxes_.size() - kept);
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

template <int D>
void FarEdges<D>::box_ways(const Trajectory<D>& of, const Array<uint32_t>& edges) {
  boxes_.assign(edges.size(), Box<D>());
  for (size_t i = 0; i < edges.size(); ++i) {
    for (const uint32_t v : of.motion.body->edges[edges[i]].ends) {
      boxes_[i].add(of.start(v));
      boxes_[i].add(of.end(v));
    }
  }
}

/** Edges of which the boxes begin in the same cube of a lattice make a group. */
template <int D>
void FarEdges<D>::group_ways() {
  constexpr double kSizes = 4, kMostCubes = 1024;  // sides of boxes for a cube, on the average; cubes along an axis
  constexpr uint32_t kBits = 10;
  Box<D> all;
  double sum = 0, extent = 0;
  for (const Box<D>& box : boxes_) {
    all.add(box);
    for (int k = 0; k < D; ++k) sum += (box.upper[k] - box.lower[k]) / D;
  }
  for (int k = 0; k < D; ++k) extent = std::max(extent, all.upper[k] - all.lower[k]);
  const double cube = std::max(kSizes * sum / static_cast<double>(boxes_.size()), extent / kMostCubes);
  keys_.clear();
  group_boxes_.clear();
  groups_.resize(boxes_.size());
  for (size_t i = 0; i < boxes_.size(); ++i) {
    uint64_t key = 0;
    for (int k = 0; k < D; ++k) {
      const double at = (boxes_[i].lower[k] - all.lower[k]) / cube;
      key = key << kBits | (at > 0 ? static_cast<uint64_t>(std::min(at, kMostCubes - 1)) : 0);
    }
    groups_[i] = keys_.insert(key);
    if (groups_[i] == group_boxes_.size()) group_boxes_.emplace_back();
    group_boxes_[groups_[i]].add(boxes_[i]);
  }
}

template class FarEdges<2>;
template class FarEdges<3>;

}  // namespace dsw

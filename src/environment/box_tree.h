#pragma once
// Boxes in a balanced binary tree, stored in the order of a heap.

#include <algorithm>

#include "base/memory.h"

namespace dsw {

/** A closed box with sides along the axes; empty at first. */
template <int D>
struct ClosedBox {
  double lower[D], upper[D];
  bool is_empty = true;

  void add(const double* p) noexcept {
    for (int k = 0; k < D; ++k) {
      lower[k] = is_empty ? p[k] : std::min(lower[k], p[k]);
      upper[k] = is_empty ? p[k] : std::max(upper[k], p[k]);
    }
    is_empty = false;
  }
  void widen(double room) noexcept {
    for (int k = 0; k < D; ++k) {
      lower[k] -= room;
      upper[k] += room;
    }
  }
  /** Whether both have a length in common along so many axes, or more. */
  bool overlaps(const ClosedBox& other, int axes) const noexcept {
    int count = 0;
    for (int k = 0; k < D; ++k)
      count += std::max(lower[k], other.lower[k]) < std::min(upper[k], other.upper[k]) ? 1 : 0;
    return count >= axes;
  }
  bool meets(const double* other_lower, const double* other_upper) const noexcept {
    for (int k = 0; k < D; ++k) {
      if (upper[k] < other_lower[k] || lower[k] > other_upper[k]) return false;
    }
    return true;
  }
};

template <int D>
class BoxTree {
 public:
  /** Takes `count` boxes; box_of(i) gives that of number i. Throws std::bad_alloc. */
  template <class BoxOf>
  BoxTree(uint32_t count, BoxOf box_of, const Memory* memory) : nodes_(memory), order_(count, 0, memory) {
    for (uint32_t i = 0; i < count; ++i) order_[i] = i;
    if (count != 0) nodes_.push_back({{}, 0, count});
    for (size_t at = 0; at < nodes_.size(); ++at) {  // nodes are appended behind while they are split
      enclose(nodes_[at], box_of);
      if (nodes_[at].count > kLeaf) split(at, box_of);
    }
  }

  /** Calls visit(i) for every number whose box meets a closed box, in an order that no result may depend on. */
  template <class Visit>
  void for_each(const double* lower, const double* upper, Visit visit) const {
    uint32_t stack[64];
    uint32_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth != 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!node.box.meets(lower, upper)) continue;
      if (node.count != 0) {
        for (uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
      } else {
        stack[depth++] = node.first;
        stack[depth++] = node.first + 1;
      }
    }
  }

 private:
  static constexpr uint32_t kLeaf = 4;
  struct Node {
    ClosedBox<D> box;
    uint32_t first;  // of `count` numbers; of two nodes if count is 0
    uint32_t count;
  };

  template <class BoxOf>
  void enclose(Node& node, const BoxOf& box_of) const {
    for (uint32_t i = 0; i < node.count; ++i) {
      const ClosedBox<D> box = box_of(order_[node.first + i]);
      node.box.add(box.lower);
      node.box.add(box.upper);
    }
  }

  /** Which numbers are in each half is certain, in what order is not. */
  template <class BoxOf>
  void split(size_t at, const BoxOf& box_of) {
    const Node node = nodes_[at];
    int axis = 0;
    for (int k = 1; k < D; ++k) {
      if (width(node, k) > width(node, axis)) axis = k;
    }
    uint32_t* const begin = order_.data() + node.first;
    const uint32_t half = node.count / 2;
    std::nth_element(begin, begin + half, begin + node.count, [&](uint32_t a, uint32_t b) {
      const double of_a = box_of(a).lower[axis], of_b = box_of(b).lower[axis];
      return of_a != of_b ? of_a < of_b : a < b;
    });
    const auto child = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({{}, node.first, half});
    nodes_.push_back({{}, node.first + half, node.count - half});
    nodes_[at].first = child;
    nodes_[at].count = 0;
  }
  static double width(const Node& node, int axis) noexcept {
    return node.box.upper[axis] / 2 - node.box.lower[axis] / 2;
  }

  Array<Node> nodes_;
  Array<uint32_t> order_;
};

}  // namespace dsw

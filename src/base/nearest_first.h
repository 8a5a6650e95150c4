#pragma once
// Trees of groups of eight boxes, looked at from near to far.

#include <cstdint>

namespace dsw {

constexpr uint32_t kBoxesInGroup = 8;

/**
 * Looks at the leaves of a tree that come within a limit, near ones first as a rule.
 * @param levels of groups: the root is group 0 of level `levels` - 1, and the boxes of group i of a level are groups 8 i to
 *               8 i + 7 of the level below. Those of level 0 are leaves. No more than kMostLevels.
 * @param measure measure(level, group, distances) writes how far the eight boxes of a group are.
 * @param look    look(leaf, limit) returns the limit from then on.
 */
template <uint32_t kMostLevels, class Measure, class Look>
inline void visit_nearest_first(uint32_t levels, float limit, const Measure& measure, const Look& look) {
  struct Node {
    float distance;
    uint32_t level, place;  // a group, or below level 0 a leaf
  } nodes[kBoxesInGroup * (kMostLevels + 1)];
  uint32_t count = 0;
  nodes[count++] = {0, levels, 0};
  while (count != 0) {
    const Node node = nodes[--count];
    if (node.distance > limit) continue;
    if (node.level == 0) {
      limit = look(node.place, limit);
      continue;
    }
    const uint32_t level = node.level - 1;
    float distances[kBoxesInGroup];
    measure(level, node.place, distances);
    const uint32_t first = count;
    for (uint32_t i = 0; i < kBoxesInGroup; ++i) {
      if (!(distances[i] <= limit)) continue;
      const Node child{distances[i], level, node.place * kBoxesInGroup + i};
      uint32_t to = count++;
      for (; to != first && nodes[to - 1].distance < child.distance; --to) nodes[to] = nodes[to - 1];
      nodes[to] = child;
    }
  }
}

}  // namespace dsw

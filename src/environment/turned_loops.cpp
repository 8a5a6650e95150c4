#include "environment/turned_loops.h"

#include <algorithm>

#include "base/search.h"
#include "base/sort.h"

namespace dsw {
namespace {

/** An edge as one loop runs along it. */
struct LoopSide {
  uint16_t low, high;
  uint32_t loop;
  bool is_forward;  // from `low` to `high`

  bool operator<(const LoopSide& o) const {
    if (low != o.low) return low < o.low;
    return high != o.high ? high < o.high : loop < o.loop;
  }
  bool has_edge_of(const LoopSide& o) const { return low == o.low && high == o.high; }
};

std::vector<LoopSide> sides_of(const std::vector<uint16_t>& vertices, const std::vector<uint16_t>& first) {
  std::vector<LoopSide> sides;
  for (uint32_t f = 0; f + 1 < first.size(); ++f) {
    for (uint32_t k = first[f]; k < first[f + 1]; ++k) {
      const uint16_t u = vertices[k], v = vertices[k + 1 == first[f + 1] ? first[f] : k + 1];
      sides.push_back({std::min(u, v), std::max(u, v), f, u < v});
    }
  }
  dsw::sort(sides.begin(), sides.end());
  return sides;
}

/** Two loops at an edge, and whether they have to be turned against each other. */
struct Link {
  uint32_t loop, other;
  bool is_turned;
  bool operator<(const Link& o) const { return loop < o.loop; }
};

/** Empty where an edge has not two loops. */
std::vector<Link> links_of(const std::vector<LoopSide>& sides) {
  std::vector<Link> links;
  for (size_t i = 0; i < sides.size(); i += 2) {
    const bool is_pair = i + 1 < sides.size() && sides[i].has_edge_of(sides[i + 1]);
    if (!is_pair || (i + 2 < sides.size() && sides[i].has_edge_of(sides[i + 2]))) return {};
    const bool is_turned = sides[i].is_forward == sides[i + 1].is_forward;
    links.push_back({sides[i].loop, sides[i + 1].loop, is_turned});
    links.push_back({sides[i + 1].loop, sides[i].loop, is_turned});
  }
  dsw::sort(links.begin(), links.end());
  return links;
}

constexpr uint8_t kNotReached = 2;

/** For each loop whether it is turned against loop 0; empty where that is not certain of all. */
std::vector<uint8_t> turns_of(const std::vector<Link>& links, uint32_t loops) {
  std::vector<uint8_t> turned(loops, kNotReached);
  std::vector<uint32_t> reached{0};
  turned[0] = 0;
  for (size_t at = 0; at < reached.size(); ++at) {
    const uint32_t loop = reached[at];
    for (auto link = std::lower_bound(links.begin(), links.end(), Link{loop, 0, false});
         link != links.end() && link->loop == loop; ++link) {
      const uint8_t wanted = turned[loop] ^ static_cast<uint8_t>(link->is_turned);
      if (turned[link->other] == kNotReached) {
        turned[link->other] = wanted;
        reached.push_back(link->other);
      } else if (turned[link->other] != wanted) {
        return {};
      }
    }
  }
  return reached.size() == loops ? turned : std::vector<uint8_t>{};
}

}  // namespace

uint32_t turn_loops(std::vector<uint16_t>& vertices, const std::vector<uint16_t>& first) {
  const std::vector<Link> links = links_of(sides_of(vertices, first));
  if (dsw::none_of(links.begin(), links.end(), [](const Link& link) { return link.is_turned; })) return 0;
  const auto loops = static_cast<uint32_t>(first.size() - 1);
  const std::vector<uint8_t> turned = turns_of(links, loops);
  if (turned.empty()) return 0;
  const auto count = static_cast<uint32_t>(std::count(turned.begin(), turned.end(), 1));
  const uint8_t wrong = 2 * count > loops ? 0 : 1;  // the fewer ones are turned
  for (uint32_t f = 0; f < loops; ++f) {
    if (turned[f] == wrong) std::reverse(vertices.begin() + first[f], vertices.begin() + first[f + 1]);
  }
  return wrong == 1 ? count : loops - count;
}

}  // namespace dsw

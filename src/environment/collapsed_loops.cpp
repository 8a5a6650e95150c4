#include "environment/collapsed_loops.h"

#include <algorithm>

#include "base/search.h"

namespace dsw {
namespace {

template <class Vertex>
void clean(std::vector<Vertex>& loop) {
  size_t calm = 0;  // places in a row at which there was nothing to leave out
  for (size_t k = 0; loop.size() > 1 && calm < loop.size();) {
    const size_t n = loop.size(), next = (k + 1) % n, second = (k + 2) % n;
    if (loop[k] == loop[next]) {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(next));
    } else if (loop[k] == loop[second]) {
      for (const size_t gone : {std::max(next, second), std::min(next, second)}) {
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(gone));
      }
    } else {
      ++calm;
      k = next;
      continue;
    }
    calm = 0;
    k = 0;
  }
}

/** From its lowest vertex, so that equal cycles are equal lists. */
void begin_lowest(std::vector<uint16_t>& loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
}

std::vector<uint16_t> turned(std::vector<uint16_t> loop) {
  std::reverse(loop.begin(), loop.end());
  begin_lowest(loop);
  return loop;
}

}  // namespace

void clean_loop(std::vector<uint32_t>& loop) { clean(loop); }

void clean_loops(std::vector<uint16_t>& vertices, std::vector<uint16_t>& first) {
  std::vector<std::vector<uint16_t>> loops, cycles;
  for (size_t f = 0; f + 1 < first.size(); ++f) {
    loops.emplace_back(vertices.begin() + first[f], vertices.begin() + first[f + 1]);
    clean(loops.back());
    if (loops.back().size() < 3) {
      loops.pop_back();
      continue;
    }
    cycles.push_back(loops.back());
    begin_lowest(cycles.back());
    const auto other = dsw::find(cycles.begin(), cycles.end() - 1, turned(cycles.back()));
    if (other == cycles.end() - 1) continue;
    loops.pop_back();
    cycles.pop_back();
    loops.erase(loops.begin() + (other - cycles.begin()));
    cycles.erase(other);
  }
  vertices.clear();
  first.assign(1, 0);
  for (const std::vector<uint16_t>& loop : loops) {
    vertices.insert(vertices.end(), loop.begin(), loop.end());
    first.push_back(static_cast<uint16_t>(vertices.size()));
  }
}

}  // namespace dsw

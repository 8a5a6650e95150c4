#include "scene/cell_particles.h"

#include <algorithm>

namespace dsw {

void CellParticles::reserve(size_t count) {
  if (count <= nodes_.size()) return;
  reserve_more(nodes_, count - nodes_.size());
  size_t heads = std::max<size_t>(heads_.size(), 8);
  while (heads < count) heads *= 2;
  if (heads != heads_.size()) {
    Array<uint32_t> fresh(heads, kEnd, heads_.get_allocator());
    heads_.swap(fresh);
    for (uint32_t slot = 0; slot < nodes_.size(); ++slot) link(slot);
  }
  nodes_.resize(count);
}

void CellParticles::link(uint32_t slot) noexcept {
  Node& node = nodes_[slot];
  if (!node.cell.valid()) return;
  uint32_t& head = heads_[place_of(node.cell)];
  node.next = head;
  node.previous = kEnd;
  if (head != kEnd) nodes_[head].previous = slot;
  head = slot;
}

void CellParticles::unlink(uint32_t slot) noexcept {
  const Node& node = nodes_[slot];
  if (!node.cell.valid()) return;
  (node.previous == kEnd ? heads_[place_of(node.cell)] : nodes_[node.previous].next) = node.next;
  if (node.next != kEnd) nodes_[node.next].previous = node.previous;
}

}  // namespace dsw

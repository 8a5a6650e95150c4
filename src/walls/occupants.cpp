#include "walls/occupants.h"

namespace dsw {

template <int D>
void Occupants<D>::save(bool whole) {
  saved_ = false;
  saved_vertices_.clear();
  saved_bodies_.clear();
  saved_shapes_.clear();
  saved_particles_.assign(particles, particles + particle_count);
  for (const Owner& owner : bodies) {
    if (owner.body == nullptr) continue;
    if (whole) {
      saved_bodies_.push_back(*owner.body);
    } else {
      saved_vertices_.insert(saved_vertices_.end(), owner.body->vertices.begin(), owner.body->vertices.end());
      saved_shapes_.insert(saved_shapes_.end(), owner.body->shape.begin(), owner.body->shape.end());
    }
  }
  saved_ = true;
}

template <int D>
void Occupants<D>::restore() noexcept {
  if (!saved_) return;
  saved_ = false;
  std::copy(saved_particles_.begin(), saved_particles_.end(), particles);
  auto body = saved_bodies_.begin();
  auto vertex = saved_vertices_.begin();
  auto shape = saved_shapes_.begin();
  for (const Owner& owner : bodies) {
    if (owner.body == nullptr) continue;
    owner.record->edits.clear();
    if (!saved_bodies_.empty()) {
      std::swap(*owner.body, *body++);
    } else if (!saved_vertices_.empty()) {
      put_vertices(*owner.body, &*vertex);
      vertex += static_cast<std::ptrdiff_t>(owner.body->vertices.size());
      if (owner.body->is_rigid()) std::swap(owner.body->shape[0], *shape++);
    }
  }
}

template <int D>
const double* Occupants<D>::saved_position(uint32_t owner, uint32_t vertex) const noexcept {
  size_t place = 0, first = 0;  // of the body among those that there are, of its first vertex
  for (uint32_t i = 0; i < owner; ++i) {
    if (bodies[i].body == nullptr) continue;
    ++place;
    first += bodies[i].body->vertices.size();
  }
  if (!saved_bodies_.empty()) {
    const Array<BodyVertex<D>>& vertices = saved_bodies_[place].vertices;
    return vertex < vertices.size() && vertices[vertex].cell.valid() ? vertices[vertex].position : nullptr;
  }
  return first + vertex < saved_vertices_.size() ? saved_vertices_[first + vertex].position : nullptr;
}

template <int D>
uint64_t Occupants<D>::memory_bytes() const noexcept {
  uint64_t of_bodies = array_bytes(saved_bodies_);
  for (const Body<D>& each : saved_bodies_) of_bodies += each.memory_bytes();
  for (const RigidShape<D>& each : saved_shapes_) of_bodies += sizeof each + each.memory_bytes();
  return of_bodies + array_bytes(bodies) + array_bytes(saved_particles_) + array_bytes(saved_vertices_);
}

template struct Occupants<2>;
template struct Occupants<3>;

}  // namespace dsw

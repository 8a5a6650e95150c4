#include "surface_bodies.h"

namespace dsw::bench {

Flock::Flock(dsw_environment* environment, const Variant& variant, const BodyShape& shape,
             const std::vector<double>& positions, std::uint32_t features)
    : variant_(variant), vertices_(shape.vertices), reports_(positions.size() / 3 / shape.vertices) {
  dsw_scene_desc scene_desc;
  dsw_scene_desc_init(&scene_desc, sizeof scene_desc);
  scene_desc.features = features;
  check(dsw_scene_create(environment, &scene_desc, &scene_));

  std::vector<std::uint32_t> offsets(shape.corners.size() / 3 + 1);
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = static_cast<std::uint32_t>(3 * i);
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.flags = variant.flags;
  desc.level = variant.level;
  desc.vertex_count = vertices_;
  desc.edges = shape.edges.data();
  desc.edge_count = shape.edges.size() / 2;
  desc.face_offsets = offsets.data();
  desc.face_corners = shape.corners.data();
  desc.face_corner_count = shape.corners.size();
  desc.face_count = offsets.size() - 1;
  for (std::size_t i = 0; i < reports_.size(); ++i) {
    desc.positions = &positions[3 * vertices_ * i];
    bodies_.emplace_back();
    const dsw_status status = dsw_body_create(scene_, &desc, &bodies_.back());
    if (status != DSW_STATUS_OK) dsw_scene_destroy(scene_);
    check(status);
  }
}

Flock::~Flock() { dsw_scene_destroy(scene_); }

void Flock::move(const double* targets, const dsw_move_options* options) {
  if (bodies_.size() == 1) {
    check(dsw_body_move(scene_, bodies_.front(), targets, vertices_, 0, options, reports_.data()));
    return;
  }
  check(dsw_scene_move_bodies(scene_, bodies_.data(), bodies_.size(), targets, bodies_.size() * vertices_, 0, options,
                              reports_.data()));
}

void Flock::move_together(const double* targets, dsw_together_stop stop) {
  dsw_together_options options;
  dsw_together_options_init(&options, sizeof options);
  options.stop = stop;
  check(dsw_scene_move_together(scene_, bodies_.data(), bodies_.size(), targets, bodies_.size() * vertices_, 0,
                                &options, reports_.data()));
}

void Flock::places(std::vector<double>& positions, std::vector<dsw_volume_id>& volumes) const {
  positions.resize(3 * vertices_ * bodies_.size());
  volumes.resize(vertices_ * bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    std::size_t count = 0;
    check(dsw_body_get_positions(scene_, bodies_[i], &positions[3 * vertices_ * i], vertices_, 0,
                                 &volumes[vertices_ * i], &count));
  }
}

std::size_t Flock::swept() const {
  std::size_t sum = 0;
  for (const dsw_move_report& report : reports_) sum += report.edges_swept;
  return sum;
}

std::size_t Flock::skipped() const {
  std::size_t sum = 0;
  for (const dsw_move_report& report : reports_) sum += report.edges_skipped;
  return sum;
}

std::size_t Flock::stopped() const {
  std::size_t sum = 0;
  for (const dsw_move_report& report : reports_) sum += report.vertices_stopped;
  return sum;
}

}  // namespace dsw::bench

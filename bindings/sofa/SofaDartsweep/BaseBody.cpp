#include "SofaDartsweep/BaseBody.h"

#include <sofa/helper/ScopedAdvancedTimer.h>
#include <sofa/helper/logging/Messaging.h>

#include <algorithm>
#include <cstring>

namespace sofadartsweep {

using sofa::core::objectmodel::ComponentState;

BaseBody::BaseBody()
    : l_environment(initLink("environment", "DartsweepEnvironment that the body is in")),
      l_topology(initLink("topology", "topology with edges or triangles; by default that of the node")),
      d_edges(initData(&d_edges, "edges", "edges of a wire; by default those of the topology, or from point to point")),
      d_triangles(initData(&d_triangles, "triangles", "triangles of a surface; by default those of the topology")),
      d_shape(initData(&d_shape, "shape", "points of a rigid tool in the frame of the first point of a Rigid3 state")),
      d_radius(initData(&d_radius, 0.0, "radius", "distance from walls that the body keeps for certain")),
      d_selfContacts(initData(&d_selfContacts, false, "selfContacts", "the body meets itself")),
      d_slide(initData(&d_slide, true, "slide", "what meets a wall goes on along it; a rigid tool also turns")),
      d_passes(initData(&d_passes, 2u, "passes", "further attempts for vertices that stop")),
      d_stopped(
          initData(&d_stopped, 0u, "stopped", "OUTPUT: vertices that did not reach their state in the last step")),
      d_stops(initData(&d_stops, 0u, "stops", "OUTPUT: steps in which a vertex did not")),
      d_notFree(initData(&d_notFree, 0u, "notFree", "OUTPUT: steps after which the proxy could not be made or moved")),
      d_position(initData(&d_position, "position", "OUTPUT: vertices of the proxy")) {
  for (auto* data : {&d_stopped, &d_stops, &d_notFree}) data->setReadOnly(true);
  d_position.setReadOnly(true);
}

void BaseBody::init() {
  BaseComponent::init();
  if (!l_topology) l_topology.set(getContext()->getMeshTopology());
  const bool good = l_environment && has_state();
  if (!l_environment) msg_error() << "the link environment is not set";
  if (!has_state()) msg_error() << "no mechanical state of the type of this body";
  if (l_environment) l_environment->add(this);
  d_componentState.setValue(good ? ComponentState::Valid : ComponentState::Invalid);
}

void BaseBody::forget() {
  m_scene = nullptr;
  m_body = {};
  m_forces.clear();
}

void BaseBody::read_parts(std::vector<std::uint32_t>& edges, std::vector<std::uint32_t>& corners) {
  const auto add = [](const auto& parts, std::vector<std::uint32_t>& to) {
    for (const auto& part : parts) to.insert(to.end(), part.begin(), part.end());
  };
  if (d_edges.isSet() || d_triangles.isSet()) {
    add(d_edges.getValue(), edges);
    add(d_triangles.getValue(), corners);
  } else if (l_topology && !is_rigid()) {
    add(l_topology->getTriangles(), corners);
    if (corners.empty()) add(l_topology->getEdges(), edges);
  }
  if (!edges.empty() || !corners.empty()) return;
  for (std::uint32_t i = 0; i + 1 < vertex_count(); ++i) edges.insert(edges.end(), {i, i + 1});
}

bool BaseBody::make(dsw_scene* scene, bool contacts, bool meets_others) {
  if (d_componentState.getValue() == ComponentState::Invalid && !has_state()) return false;
  std::vector<std::uint32_t> edges, corners, offsets;
  read_parts(edges, corners);
  for (std::size_t corner = 0; corner <= corners.size(); corner += 3)
    offsets.push_back(static_cast<std::uint32_t>(corner));
  read_positions(sofa::core::vec_id::read_access::position, m_positions);
  auto desc = defaults<dsw_body_desc>(dsw_body_desc_init);
  desc.level = corners.empty() ? DSW_LEVEL_EDGES_SWEPT : DSW_LEVEL_FACES;
  if (d_selfContacts.getValue()) desc.flags |= DSW_BODY_SELF_CONTACTS;
  if (is_rigid()) desc.flags |= DSW_BODY_RIGID;
  desc.positions = m_positions.data();
  desc.vertex_count = m_positions.size() / 3;
  desc.edges = edges.data();
  desc.edge_count = edges.size() / 2;
  desc.face_offsets = offsets.data();
  desc.face_corners = corners.data();
  desc.face_count = corners.size() / 3;
  desc.face_corner_count = corners.size();
  desc.radius = d_radius.getValue();
  if (contacts && !meets_others) {
    const auto& all = l_environment->bodies();
    desc.category = 1u << ((std::find(all.begin(), all.end(), this) - all.begin()) % 32);
    desc.mask = desc.category;
  }
  m_scene = scene;
  const dsw_status status = dsw_body_create(scene, &desc, &m_body);
  const bool good = succeeded(*this, "the body where its state is", status);
  if (status == DSW_STATUS_OCCUPIED) show_offenders();
  if (!good) m_scene = nullptr;
  d_componentState.setValue(good ? ComponentState::Valid : ComponentState::Invalid);
  if (!good) return false;
  keep_pose();
  d_stops.setValue(0);
  publish();
  return true;
}

void BaseBody::show_offenders() const {
  const std::uint32_t* vertices = nullptr;
  std::size_t count = 0;
  if (dsw_scene_get_offending_edges(m_scene, &vertices, &count) != DSW_STATUS_OK) return;
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 8); ++i)
    msg_error() << "  not free between the points " << vertices[2 * i] << " and " << vertices[2 * i + 1];
}

bool BaseBody::read_proxy() {
  std::size_t count = 0;
  return succeeded(*this, "positions",
                   dsw_body_get_positions(m_scene, m_body, m_positions.data(), m_positions.size() / 3,
                                          3 * sizeof(double), nullptr, &count));
}

void BaseBody::publish() {
  auto to = sofa::helper::getWriteOnlyAccessor(d_position);
  to.resize(m_positions.size() / 3);
  for (std::size_t i = 0; i < to.size(); ++i)
    to[i] = Vec3(m_positions[3 * i], m_positions[3 * i + 1], m_positions[3 * i + 2]);
}

bool BaseBody::move(double dt) {
  if (!m_scene) return false;
  if (is_rigid()) return move_rigid(dt);
  read_positions(sofa::core::vec_id::read_access::position, m_targets);
  auto options = defaults<dsw_move_options>(dsw_move_options_init);
  options.flags = DSW_MOVE_KEEP_WALLS;
  if (d_slide.getValue()) options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
  options.passes = d_passes.getValue();
  dsw_move_report report = {};
  bool good = m_targets.size() == m_positions.size();
  if (!good) msg_error() << "the state has another number of points than the body";
  good = good && succeeded(*this, "move",
                           dsw_body_move(m_scene, m_body, m_targets.data(), m_targets.size() / 3, 3 * sizeof(double),
                                         &options, &report));
  good = read_proxy() && good;
  if (!good) d_notFree.setValue(d_notFree.getValue() + 1);
  d_stopped.setValue(report.vertices_stopped);
  publish();
  if (std::memcmp(m_targets.data(), m_positions.data(), m_positions.size() * sizeof(double)) == 0) return false;
  d_stops.setValue(d_stops.getValue() + 1);
  write(m_targets, dt);
  return true;
}

// The tool goes on its arc to the pose of its state, and may slide as a whole. The state gets the pose that was taken.
bool BaseBody::move_rigid(double dt) {
  const dsw_rigid_motion motion = motion_to_state();
  auto options = defaults<dsw_move_options>(dsw_move_options_init);
  if (d_slide.getValue()) options.flags = DSW_MOVE_SLIDE_WHOLE;
  dsw_move_report report = {};
  dsw_rigid_motion left = {};
  bool good = succeeded(*this, "rigid move", dsw_body_move_rigid(m_scene, m_body, &motion, &options, &report)) &&
              succeeded(*this, "rigid move", dsw_body_get_motion_left(m_scene, m_body, &left));
  if (!good) left = motion;
  good = read_proxy() && good;
  if (!good) d_notFree.setValue(d_notFree.getValue() + 1);
  const bool stopped = !good || report.fraction < 1;
  d_stopped.setValue(stopped ? std::max(report.vertices_stopped, 1u) : 0u);
  publish();
  if (stopped) {
    d_stops.setValue(d_stops.getValue() + 1);
    write_pose(left, dt);
  }
  keep_pose();
  return stopped;
}

}  // namespace sofadartsweep

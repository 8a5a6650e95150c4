#include "SofaDartsweep/DartsweepEnvironment.h"

#include <sofa/core/ObjectFactory.h>
#include <sofa/core/topology/TopologyChange.h>
#include <sofa/helper/ScopedAdvancedTimer.h>
#include <sofa/simulation/AnimateBeginEvent.h>
#include <sofa/simulation/AnimateEndEvent.h>
#include <sofa/simulation/Node.h>
#include <sofa/simulation/events/SimulationInitDoneEvent.h>
#include <sofa/simulation/mechanicalvisitor/MechanicalPropagateOnlyPositionAndVelocityVisitor.h>

#include <algorithm>
#include <cstring>

#include "SofaDartsweep/BaseBody.h"

namespace sofadartsweep {
namespace {

using sofa::core::objectmodel::ComponentState;

// The entries of `cells`, an ROI's indices, are impassable.
bool mark_cells(const DartsweepEnvironment& owner, const sofa::Data<DartsweepEnvironment::Indices>& cells,
                std::size_t first, std::size_t count, std::vector<std::uint8_t>& marks) {
  for (const sofa::Index cell : cells.getValue()) {
    if (cell >= count) {
      msg_error(&owner) << cells.getName() << " names " << cell << " of " << count;
      return false;
    }
    marks[first + cell] = 1;
  }
  return true;
}

template <class Faces>
void add_faces(const Faces& faces, Walls& walls) {
  for (const auto& face : faces) {
    walls.face_corners.insert(walls.face_corners.end(), face.begin(), face.end());
    walls.face_offsets.push_back(walls.face_corners.size());
  }
}

}  // namespace

DartsweepEnvironment::DartsweepEnvironment()
    : l_topology(initLink("topology", "container with the volumes; by default that of the node")),
      l_state(
          initLink("state", "mechanical state of the vertices, which may move; by default that of the node, if any")),
      d_position(initData(&d_position, "position", "vertices that do not move, where there is no mechanical state")),
      d_tetrahedra(
          initData(&d_tetrahedra, "impassableTetrahedra", "indices of tetrahedra that nothing passes, as of an ROI")),
      d_hexahedra(initData(&d_hexahedra, "impassableHexahedra", "indices of hexahedra that nothing passes")),
      d_prisms(initData(&d_prisms, "impassablePrisms", "indices of prisms that nothing passes")),
      d_pyramids(initData(&d_pyramids, "impassablePyramids", "indices of pyramids that nothing passes")),
      d_triangles(
          initData(&d_triangles, "impassableTriangles", "patch of triangles between volumes that nothing passes")),
      d_quads(initData(&d_quads, "impassableQuads", "patch of quads between volumes that nothing passes")),
      d_tags(initData(&d_tags, "volumeTags",
                      "numbers that contacts report: one for each tetrahedron, hexahedron, prism, pyramid")),
      d_held(initData(&d_held, 0u, "held", "OUTPUT: vertices that did not follow their state in the last step")),
      d_removed(initData(&d_removed, 0u, "removed", "OUTPUT: volumes that changes of the topology have made passable")),
      d_bodyContacts(initData(&d_bodyContacts, false, "bodyContacts", "bodies of this environment meet each other")) {
  d_held.setReadOnly(true);
  d_removed.setReadOnly(true);
  f_listening.setValue(true);
}

DartsweepEnvironment::~DartsweepEnvironment() { clear(); }

void DartsweepEnvironment::add(BaseBody* body) {
  if (std::find(m_bodies.begin(), m_bodies.end(), body) == m_bodies.end()) m_bodies.push_back(body);
}

void DartsweepEnvironment::init() {
  BaseComponent::init();
  if (!l_topology) l_topology.set(getContext()->getMeshTopology());
  if (!l_state && !d_position.isSet()) l_state.set(dynamic_cast<State*>(getContext()->getMechanicalState()));
  if (!l_topology) msg_error() << "no topology container with volumes";
  d_componentState.setValue(l_topology ? ComponentState::Valid : ComponentState::Invalid);
}

// States are reset after this component or before it: the environment is made again when the next step begins.
void DartsweepEnvironment::reset() { clear(); }

void DartsweepEnvironment::clear() {
  for (BaseBody* body : m_bodies) body->forget();
  if (m_scene) dsw_scene_destroy(m_scene);
  if (m_environment) dsw_environment_destroy(m_environment);
  if (m_context) dsw_context_destroy(m_context);
  m_scene = nullptr;
  m_environment = nullptr;
  m_context = nullptr;
  m_built = false;
}

bool DartsweepEnvironment::read_points(std::vector<double>& points) const {
  if (l_state) {
    const auto& from = l_state->read(sofa::core::vec_id::read_access::position)->getValue();
    for (std::size_t vertex = 0; vertex < m_point_of.size(); ++vertex) {
      const sofa::Index point = m_point_of[vertex];
      if (point == sofa::InvalidID || point >= from.size()) continue;  // removed: it stays where it was
      std::copy_n(from[point].data(), 3, points.data() + 3 * vertex);
    }
    return true;
  }
  const auto& from = d_position.getValue();
  for (std::size_t vertex = 0; vertex < m_point_of.size(); ++vertex) {
    if (d_position.isSet()) {
      std::copy_n(from[vertex].data(), 3, points.data() + 3 * vertex);
    } else {
      points[3 * vertex] = l_topology->getPX(static_cast<sofa::Index>(vertex));
      points[3 * vertex + 1] = l_topology->getPY(static_cast<sofa::Index>(vertex));
      points[3 * vertex + 2] = l_topology->getPZ(static_cast<sofa::Index>(vertex));
    }
  }
  return true;
}

bool DartsweepEnvironment::read_walls() {
  m_walls = Walls();
  m_walls.volumes.assign(m_mesh.size(), 0);
  std::size_t first = 0;
  if (!mark_cells(*this, d_tetrahedra, first, m_mesh.tetrahedra, m_walls.volumes)) return false;
  if (!mark_cells(*this, d_hexahedra, first += m_mesh.tetrahedra, m_mesh.hexahedra, m_walls.volumes)) return false;
  if (!mark_cells(*this, d_prisms, first += m_mesh.hexahedra, m_mesh.prisms, m_walls.volumes)) return false;
  if (!mark_cells(*this, d_pyramids, first += m_mesh.prisms, m_mesh.pyramids, m_walls.volumes)) return false;
  add_faces(d_triangles.getValue(), m_walls);
  add_faces(d_quads.getValue(), m_walls);
  const auto& tags = d_tags.getValue();
  if (!tags.empty() && tags.size() != m_mesh.size()) {
    msg_error() << "volumeTags has " << tags.size() << " entries for " << m_mesh.size() << " volumes";
    return false;
  }
  m_mesh.tags.assign(tags.begin(), tags.end());
  return true;
}

void DartsweepEnvironment::build() {
  if (d_componentState.getValue() != ComponentState::Valid) return;
  d_componentState.setValue(ComponentState::Invalid);
  m_mesh.read(*l_topology);
  if (m_mesh.size() == 0) {
    msg_error() << "the topology container " << l_topology->getPathName() << " has no volumes";
    return;
  }
  const std::size_t count = l_state              ? l_state->getSize()
                            : d_position.isSet() ? d_position.getValue().size()
                                                 : l_topology->getNbPoints();
  m_point_of.resize(count);
  for (std::size_t i = 0; i < count; ++i) m_point_of[i] = static_cast<sofa::Index>(i);
  m_tetrahedra.resize(m_mesh.tetrahedra);
  m_hexahedra.resize(m_mesh.hexahedra);
  for (std::size_t i = 0; i < m_tetrahedra.size(); ++i) m_tetrahedra[i] = static_cast<sofa::Index>(i);
  for (std::size_t i = 0; i < m_hexahedra.size(); ++i) m_hexahedra[i] = static_cast<sofa::Index>(m_mesh.tetrahedra + i);
  m_current = 0;
  for (auto& points : m_points) points.assign(3 * count, 0.0);
  d_removed.setValue(0);
  if (!read_walls() || !read_points(m_points[0])) return;
  auto options = defaults<dsw_context_desc>(dsw_context_desc_init);
  options.thread_count = 1;
  if (!succeeded(*this, "context", dsw_context_create(&options, &m_context))) return;
  m_environment = create_environment(*this, m_context, m_mesh, m_walls, m_points[0]);
  if (!m_environment) return;
  auto desc = defaults<dsw_scene_desc>(dsw_scene_desc_init);
  desc.features = DSW_FEATURE_LIVE_CHANGES;
  if (l_state) desc.features |= DSW_FEATURE_DEFORMING;
  bool meet = d_bodyContacts.getValue();
  for (const BaseBody* body : m_bodies) meet |= body->d_selfContacts.getValue();
  if (meet) desc.features |= DSW_FEATURE_BODY_CONTACTS;
  if (!succeeded(*this, "scene", dsw_scene_create(m_environment, &desc, &m_scene))) return;
  ++m_version;
  m_built = true;
  d_componentState.setValue(ComponentState::Valid);
  for (BaseBody* body : m_bodies) body->make(m_scene, meet, d_bodyContacts.getValue());
  auto info = sized<dsw_environment_info>();
  if (dsw_environment_get_info(m_environment, &info) == DSW_STATUS_OK)
    msg_info() << info.volume_count << " volumes in " << info.part_count << " parts, " << info.boundary_face_count
               << " faces of the outer boundary, " << m_bodies.size() << " bodies";
}

void DartsweepEnvironment::handleEvent(sofa::core::objectmodel::Event* event) {
  if (sofa::simulation::SimulationInitDoneEvent::checkEventType(event) ||
      sofa::simulation::AnimateBeginEvent::checkEventType(event)) {
    if (!m_built) build();
  } else if (sofa::simulation::AnimateEndEvent::checkEventType(event)) {
    if (m_built && !m_bodies.empty()) finish_step();
  }
}

void DartsweepEnvironment::finish_step() {
  SCOPED_TIMER("Dartsweep move");
  for (BaseBody* body : m_bodies) body->begin_move();
  bool written = follow_state();
  const double dt = getContext()->getDt();
  for (BaseBody* body : m_bodies) written |= body->move(dt);
  if (!written) return;
  auto* root = getContext()->getRootContext();
  sofa::simulation::mechanicalvisitor::MechanicalPropagateOnlyPositionAndVelocityVisitor visitor(
      sofa::core::mechanicalparams::defaultInstance(), getContext()->getTime());
  root->executeVisitor(&visitor);
}

// The environment goes where its state is. Returns whether the state was written, since vertices were held.
bool DartsweepEnvironment::follow_state() {
  if (!l_state) return false;
  std::vector<double>& next = m_points[1 - m_current];
  next = m_points[m_current];
  if (!read_points(next) || std::memcmp(next.data(), m_points[m_current].data(), next.size() * sizeof(double)) == 0) {
    d_held.setValue(0);
    return false;
  }
  dsw_deform_report report = {};
  const dsw_status status = dsw_environment_deform(m_environment, next.data(), next.size() / 3, nullptr, &report);
  if (!succeeded(*this, "deformation", status)) {
    hold_state();
    return true;
  }
  ++m_version;
  const bool refused = report.outcome == DSW_DEFORM_REFUSED;
  if (!refused) m_current = 1 - m_current;
  d_held.setValue(refused ? static_cast<unsigned>(next.size() / 3) : report.held_count);
  if (report.outcome == DSW_DEFORM_DONE) return false;
  hold_state();
  return true;
}

// The state takes the vertices of the library: a vertex that was held is where it is free.
void DartsweepEnvironment::hold_state() {
  auto to = sofa::helper::getWriteAccessor(*l_state->write(sofa::core::vec_id::write_access::position));
  const std::vector<double>& from = m_points[m_current];
  for (std::size_t vertex = 0; vertex < m_point_of.size(); ++vertex) {
    const sofa::Index point = m_point_of[vertex];
    if (point == sofa::InvalidID || point >= to.size()) continue;
    to[point] = sofa::type::Vec3(from[3 * vertex], from[3 * vertex + 1], from[3 * vertex + 2]);
  }
}

void DartsweepEnvironment::handleTopologyChange(sofa::core::topology::Topology* topology) {
  if (!m_built || topology != l_topology.get()) return;
  for (auto change = l_topology->beginChange(); change != l_topology->endChange(); ++change) {
    const auto* base = *change;
    switch (base->getChangeType()) {
      case sofa::core::topology::TETRAHEDRAREMOVED:
        open(m_tetrahedra, static_cast<const sofa::core::topology::TetrahedraRemoved*>(base)->getArray());
        break;
      case sofa::core::topology::HEXAHEDRAREMOVED:
        open(m_hexahedra, static_cast<const sofa::core::topology::HexahedraRemoved*>(base)->getArray());
        break;
      case sofa::core::topology::POINTSREMOVED:
        forget_points(static_cast<const sofa::core::topology::PointsRemoved*>(base)->getArray());
        break;
      case sofa::core::topology::TETRAHEDRAADDED:
      case sofa::core::topology::HEXAHEDRAADDED:
      case sofa::core::topology::POINTSADDED:
      case sofa::core::topology::POINTSRENUMBERING:
        msg_error() << "volumes or points were added or renumbered, which the environment does not follow";
        break;
      default:
        break;
    }
  }
}

// A removed volume is space that bodies may enter. SOFA closes the gap in its list with the last volume.
void DartsweepEnvironment::open(std::vector<sofa::Index>& cells, const sofa::type::vector<sofa::Index>& removed) {
  std::vector<dsw_volume_id> volumes;
  for (const sofa::Index item : removed) {
    if (item >= cells.size()) continue;
    const sofa::Index cell = cells[item];
    m_walls.volumes[cell] = 0;
    volumes.emplace_back();
    if (!succeeded(*this, "removed volume", dsw_environment_get_volume_id(m_environment, cell, &volumes.back())))
      return;
    cells[item] = cells.back();
    cells.pop_back();
  }
  ++m_version;
  d_removed.setValue(d_removed.getValue() + static_cast<unsigned>(volumes.size()));
  succeeded(*this, "removed volumes",
            dsw_environment_mark_volumes(m_environment, volumes.data(), volumes.size(), DSW_MARK_PASSABLE, 0, nullptr));
}

sofa::Index DartsweepEnvironment::tetrahedron_of(std::uint32_t volume) const {
  const auto found = std::find(m_tetrahedra.begin(), m_tetrahedra.end(), volume);
  return found == m_tetrahedra.end() ? sofa::InvalidID : static_cast<sofa::Index>(found - m_tetrahedra.begin());
}

// SOFA closes the gap in its list with the last point.
void DartsweepEnvironment::forget_points(const sofa::type::vector<sofa::Index>& removed) {
  std::vector<std::size_t> vertex_of;
  for (std::size_t vertex = 0; vertex < m_point_of.size(); ++vertex) {
    const sofa::Index point = m_point_of[vertex];
    if (point == sofa::InvalidID) continue;
    if (point >= vertex_of.size()) vertex_of.resize(point + 1);
    vertex_of[point] = vertex;
  }
  for (const sofa::Index point : removed) {
    if (point >= vertex_of.size()) continue;
    m_point_of[vertex_of[point]] = sofa::InvalidID;
    if (point + 1 < vertex_of.size()) {
      vertex_of[point] = vertex_of.back();
      m_point_of[vertex_of[point]] = point;
    }
    vertex_of.pop_back();
  }
}

void register_environment(sofa::core::ObjectFactory* factory) {
  factory->registerObjects(sofa::core::ObjectRegistrationData(
                               "Volumes that bodies of Dartsweep walk through, and walls that they never pass.")
                               .add<DartsweepEnvironment>());
}

}  // namespace sofadartsweep

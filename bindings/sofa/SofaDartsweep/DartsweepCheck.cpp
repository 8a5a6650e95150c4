#include "SofaDartsweep/DartsweepCheck.h"

#include <sofa/core/ObjectFactory.h>
#include <sofa/simulation/AnimateEndEvent.h>

#include <algorithm>
#include <cmath>

namespace sofadartsweep {
namespace {

constexpr int kSamples = 8;  // points of an edge at which its depth is measured

}  // namespace

DartsweepCheck::DartsweepCheck()
    : l_environment(initLink("environment", "DartsweepEnvironment whose volumes and walls count")),
      l_state(initLink("state", "points or frames of the wire; by default those of the node")),
      d_touch(initData(&d_touch, 0.0, "touch", "nearer than this to a wall, the wire touches it")),
      d_steps(initData(&d_steps, 0u, "steps", "OUTPUT: steps looked at")),
      d_notFree(initData(&d_notFree, 0u, "notFree", "OUTPUT: steps after which a point or an edge met a wall")),
      d_touching(initData(&d_touching, 0u, "touching", "OUTPUT: steps after which the wire touched a wall")),
      d_deepest(initData(&d_deepest, 0.0, "deepest", "OUTPUT: largest distance of a point of the wire beyond a wall")),
      d_length(initData(&d_length, 0.0, "length", "OUTPUT: length of the wire after the last step")) {
  f_listening.setValue(true);
}

DartsweepCheck::~DartsweepCheck() { clear(); }

void DartsweepCheck::clear() {
  if (m_scene) dsw_scene_destroy(m_scene);
  if (m_environment) dsw_environment_destroy(m_environment);
  if (m_context) dsw_context_destroy(m_context);
  m_scene = nullptr;
  m_environment = nullptr;
  m_context = nullptr;
}

void DartsweepCheck::init() {
  BaseComponent::init();
  if (!l_state) l_state.set(getContext()->getMechanicalState());
  if (!l_environment || !l_state) msg_error() << "the links environment and state are needed";
}

void DartsweepCheck::reset() {
  for (auto* data : {&d_steps, &d_notFree, &d_touching}) data->setValue(0);
  d_deepest.setValue(0);
  clear();
}

void DartsweepCheck::handleEvent(sofa::core::objectmodel::Event* event) {
  if (sofa::simulation::AnimateEndEvent::checkEventType(event)) check();
}

// An environment that is as the other one is now. Where nothing bends and nothing is cut, it stays.
bool DartsweepCheck::prepare() {
  if (m_scene && m_version == l_environment->version()) return true;
  if (l_environment->points().empty()) return false;
  clear();
  if (!succeeded(*this, "context", dsw_context_create(nullptr, &m_context))) return false;
  m_environment =
      create_environment(*this, m_context, l_environment->mesh(), l_environment->walls(), l_environment->points());
  if (!m_environment || !succeeded(*this, "scene", dsw_scene_create(m_environment, nullptr, &m_scene))) return false;
  m_version = l_environment->version();
  m_volumes.clear();
  return true;
}

void DartsweepCheck::check() {
  if (!l_environment || !l_state || !prepare()) return;
  const std::size_t count = l_state->getSize();
  if (count == 0) return;
  m_points.resize(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    m_points[3 * i] = l_state->getPX(static_cast<sofa::Index>(i));
    m_points[3 * i + 1] = l_state->getPY(static_cast<sofa::Index>(i));
    m_points[3 * i + 2] = l_state->getPZ(static_cast<sofa::Index>(i));
  }
  double length = 0;
  for (std::size_t i = 3; i < m_points.size(); i += 3)
    length +=
        std::hypot(m_points[i] - m_points[i - 3], m_points[i + 1] - m_points[i - 2], m_points[i + 2] - m_points[i - 1]);
  d_length.setValue(length);
  d_steps.setValue(d_steps.getValue() + 1);
  if (!is_free()) {
    d_notFree.setValue(d_notFree.getValue() + 1);
    measure_depth();
  }
  if (d_touch.getValue() > 0) measure_touch();
}

// Whether a body can be made of the wire: the library refuses one that meets a wall.
bool DartsweepCheck::is_free() {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i + 1 < m_points.size() / 3; ++i) edges.insert(edges.end(), {i, i + 1});
  auto desc = defaults<dsw_body_desc>(dsw_body_desc_init);
  desc.positions = m_points.data();
  desc.vertex_count = m_points.size() / 3;
  desc.edges = edges.data();
  desc.edge_count = edges.size() / 2;
  if (m_volumes.size() == desc.vertex_count) desc.hints = m_volumes.data();
  dsw_body_id body = {};
  const dsw_status status = dsw_body_create(m_scene, &desc, &body);
  if (status == DSW_STATUS_OK) {
    std::size_t count = 0;
    std::vector<double> positions(m_points.size());
    m_volumes.resize(desc.vertex_count);
    dsw_body_get_positions(m_scene, body, positions.data(), desc.vertex_count, 3 * sizeof(double), m_volumes.data(),
                           &count);
    dsw_body_destroy(m_scene, body);
    return true;
  }
  if (status != DSW_STATUS_OCCUPIED && status != DSW_STATUS_OUTSIDE && status != DSW_STATUS_IMPASSABLE)
    succeeded(*this, "exact test", status);
  return false;
}

void DartsweepCheck::measure_depth() {
  std::vector<double> samples, inside;
  for (std::size_t i = 0; i + 3 < m_points.size(); i += 3)
    for (int k = 0; k < kSamples; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        samples.push_back(m_points[i + axis] + (m_points[i + 3 + axis] - m_points[i + axis]) * k / kSamples);
  samples.insert(samples.end(), m_points.end() - 3, m_points.end());
  inside.resize(samples.size());
  if (!succeeded(*this, "depth",
                 dsw_environment_find_inside(m_environment, samples.data(), samples.size() / 3, 3 * sizeof(double),
                                             nullptr, 0, inside.data(), nullptr)))
    return;
  double deepest = d_deepest.getValue();
  for (std::size_t i = 0; i < samples.size(); i += 3)
    deepest = std::max(
        deepest, std::hypot(inside[i] - samples[i], inside[i + 1] - samples[i + 1], inside[i + 2] - samples[i + 2]));
  d_deepest.setValue(deepest);
}

void DartsweepCheck::measure_touch() {
  const std::size_t count = m_points.size() / 3 - 1;
  std::vector<dsw_segment_nearest> nearest(count);
  const dsw_volume_id* hints = m_volumes.size() == count + 1 ? m_volumes.data() : nullptr;
  if (!succeeded(*this, "distance",
                 dsw_environment_find_nearest_to_segments(m_environment, count, hints, m_points.data(),
                                                          m_points.data() + 3, 3 * sizeof(double), d_touch.getValue(),
                                                          nearest.data(), nullptr, nullptr)))
    return;
  const bool touches = std::any_of(nearest.begin(), nearest.end(), [&](const dsw_segment_nearest& one) {
    return one.nearest.distance <= d_touch.getValue();
  });
  if (touches) d_touching.setValue(d_touching.getValue() + 1);
}

void register_check(sofa::core::ObjectFactory* factory) {
  factory->registerObjects(
      sofa::core::ObjectRegistrationData(
          "Counts the steps of any scene after which a wire is not free, by Dartsweep's exact test.")
          .add<DartsweepCheck>());
}

}  // namespace sofadartsweep

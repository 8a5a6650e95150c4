#include "SofaDartsweep/DartsweepBody.h"

#include <sofa/core/ObjectFactory.h>
#include <sofa/helper/accessor.h>

#include <algorithm>
#include <type_traits>

namespace sofadartsweep {
namespace {

using sofa::defaulttype::Rigid3Types;
using sofa::defaulttype::Vec3Types;
using sofa::type::Quat;
using sofa::type::Vec3;
namespace vec_id = sofa::core::vec_id;

template <class DataTypes>
constexpr bool has_frames = std::is_same_v<DataTypes, Rigid3Types>;

Vec3 at(const std::vector<double>& points, std::size_t vertex) {
  return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
}

void put(std::vector<double>& points, std::size_t vertex, const Vec3& point) {
  std::copy_n(point.data(), 3, points.data() + 3 * vertex);
}

}  // namespace

template <class DataTypes>
DartsweepBody<DataTypes>::DartsweepBody()
    : l_state(initLink("state", "mechanical state of the body; by default that of the node")) {}

template <class DataTypes>
void DartsweepBody<DataTypes>::init() {
  if (!l_state) l_state.set(dynamic_cast<State*>(getContext()->getMechanicalState()));
  if (is_rigid() && !has_frames<DataTypes>) msg_error() << "shape needs a mechanical state of Rigid3";
  BaseBody::init();
}

template <class DataTypes>
void DartsweepBody<DataTypes>::read_positions(sofa::core::ConstMultiVecCoordId from, std::vector<double>& to) {
  const auto& x = from[l_state.get()].read()->getValue();
  to.resize(3 * vertex_count());
  if constexpr (has_frames<DataTypes>) {
    if (is_rigid()) {
      const auto& shape = d_shape.getValue();
      for (std::size_t i = 0; i < shape.size(); ++i)
        put(to, i, x[0].getCenter() + x[0].getOrientation().rotate(shape[i]));
      return;
    }
  }
  for (std::size_t i = 0; i < to.size() / 3; ++i) put(to, i, Vec3(DataTypes::getCPos(x[i])));
}

template <class DataTypes>
void DartsweepBody<DataTypes>::read_velocities(sofa::core::ConstMultiVecDerivId from, std::vector<double>& to) {
  const auto& v = from[l_state.get()].read()->getValue();
  to.resize(3 * vertex_count());
  if constexpr (has_frames<DataTypes>) {
    if (is_rigid()) {
      for (std::size_t i = 0; i < to.size() / 3; ++i)
        put(to, i, getVCenter(v[0]) + cross(getVOrientation(v[0]), at(m_positions, i) - m_pose.getCenter()));
      return;
    }
  }
  for (std::size_t i = 0; i < to.size() / 3; ++i) put(to, i, Vec3(DataTypes::getDPos(v[i])));
}

template <class DataTypes>
void DartsweepBody<DataTypes>::add_line(sofa::core::MultiMatrixDerivId to, unsigned line, const Part& part,
                                        const Vec3& direction) {
  auto matrix = sofa::helper::getWriteAccessor(*to[l_state.get()].write());
  auto row = matrix->writeLine(line);
  if constexpr (has_frames<DataTypes>) {
    if (is_rigid()) {
      Vec3 way, turn;
      part.each([&](std::uint32_t vertex, double weight) {
        way += direction * weight;
        turn += cross(at(m_positions, vertex) - m_pose.getCenter(), direction) * weight;
      });
      row.addCol(0, typename DataTypes::Deriv(way, turn));
      return;
    }
  }
  part.each([&](std::uint32_t vertex, double weight) {
    typename DataTypes::Deriv entry;
    DataTypes::setDPos(entry, direction * weight);
    row.addCol(vertex, entry);
  });
}

template <class DataTypes>
void DartsweepBody<DataTypes>::add_force(sofa::core::MultiVecDerivId to, const Part& part, const Vec3& force) {
  auto forces = sofa::helper::getWriteAccessor(*to[l_state.get()].write());
  part.each([&](std::uint32_t vertex, double weight) {
    typename DataTypes::Deriv entry;
    if constexpr (has_frames<DataTypes>) {
      if (is_rigid()) {
        const Vec3 arm = at(m_positions, vertex) - m_pose.getCenter();
        forces[0] += typename DataTypes::Deriv(force * weight, cross(arm, force * weight));
        return;
      }
    }
    DataTypes::setDPos(entry, force * weight);
    forces[vertex] += entry;
  });
}

template <class DataTypes>
void DartsweepBody<DataTypes>::write(const std::vector<double>& targets, double dt) {
  auto x = sofa::helper::getWriteAccessor(*l_state->write(vec_id::write_access::position));
  auto v = sofa::helper::getWriteAccessor(*l_state->write(vec_id::write_access::velocity));
  for (std::size_t i = 0; i < targets.size() / 3; ++i) {
    const Vec3 taken = at(m_positions, i);
    if (taken == at(targets, i)) continue;
    DataTypes::setCPos(x[i], taken);
    if (dt > 0 && i < v.size()) DataTypes::setDPos(v[i], (taken - at(m_before, i)) / dt);
  }
}

template <class DataTypes>
void DartsweepBody<DataTypes>::keep_pose() {
  if (is_rigid()) m_pose = l_state->read(vec_id::read_access::position)->getValue()[0];
}

template <class DataTypes>
dsw_rigid_motion DartsweepBody<DataTypes>::motion_to_state() const {
  dsw_rigid_motion motion = {{0, 0, 0, 1}, {}, {}};
  if constexpr (has_frames<DataTypes>) {
    const auto& wanted = l_state->read(vec_id::read_access::position)->getValue()[0];
    const auto turn = wanted.getOrientation() * m_pose.getOrientation().inverse();
    const Vec3 way = wanted.getCenter() - m_pose.getCenter();
    for (int i = 0; i < 4; ++i) motion.rotation[i] = turn[i];
    std::copy_n(m_pose.getCenter().data(), 3, motion.centre);
    std::copy_n(way.data(), 3, motion.translation);
  }
  return motion;
}

// `left` takes the proxy to the state: the pose of the proxy is that of the state, taken back by it.
template <class DataTypes>
void DartsweepBody<DataTypes>::write_pose(const dsw_rigid_motion& left, double dt) {
  if constexpr (has_frames<DataTypes>) {
    auto x = sofa::helper::getWriteAccessor(*l_state->write(vec_id::write_access::position));
    auto v = sofa::helper::getWriteAccessor(*l_state->write(vec_id::write_access::velocity));
    const Quat<double> back =
        Quat<double>(left.rotation[0], left.rotation[1], left.rotation[2], left.rotation[3]).inverse();
    const Vec3 centre(left.centre[0], left.centre[1], left.centre[2]);
    const Vec3 way(left.translation[0], left.translation[1], left.translation[2]);
    typename DataTypes::Coord pose;
    pose.getCenter() = back.rotate(x[0].getCenter() - centre - way) + centre;
    pose.getOrientation() = back * x[0].getOrientation();
    pose.getOrientation().normalize();
    x[0] = pose;
    if (dt <= 0 || v.size() == 0) return;
    const Vec3 turn = (pose.getOrientation() * m_pose.getOrientation().inverse()).quatToRotationVector();
    v[0] = typename DataTypes::Deriv((pose.getCenter() - m_pose.getCenter()) / dt, turn / dt);
  } else {
    (void)left;
    (void)dt;
  }
}

template class DartsweepBody<Vec3Types>;
template class DartsweepBody<Rigid3Types>;

void register_body(sofa::core::ObjectFactory* factory) {
  factory->registerObjects(sofa::core::ObjectRegistrationData(
                               "Wire, surface or rigid tool that never passes the walls of a DartsweepEnvironment.")
                               .add<DartsweepBody<Vec3Types>>(true)
                               .add<DartsweepBody<Rigid3Types>>());
}

}  // namespace sofadartsweep

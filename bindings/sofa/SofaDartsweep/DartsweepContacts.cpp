#include "SofaDartsweep/DartsweepContacts.h"

#include <sofa/core/ConstraintParams.h>
#include <sofa/core/ObjectFactory.h>
#include <sofa/core/behavior/ConstraintResolution.h>
#include <sofa/helper/ScopedAdvancedTimer.h>
#include <sofa/linearalgebra/BaseVector.h>

#include <algorithm>
#include <cmath>

namespace sofadartsweep {
namespace {

using sofa::core::objectmodel::ComponentState;
using sofa::type::Vec3;
namespace vec_id = sofa::core::vec_id;

// A row in block Gauss-Seidel: the force along the normal pulls nothing, and that across it is at most the coefficient
// of friction times as large (Coulomb's cone).
class RowResolution : public sofa::core::behavior::ConstraintResolution {
 public:
  RowResolution(DartsweepContacts& owner, std::size_t row, double friction, const std::array<double, 3>& start)
      : ConstraintResolution(friction > 0 ? 3 : 1), m_owner(owner), m_row(row), m_friction(friction), m_start(start) {}

  void init(int line, SReal** /*compliance*/, SReal* force) override {
    for (unsigned i = 0; i < getNbLines(); ++i) force[line + static_cast<int>(i)] = m_start[i];
  }

  void resolution(int line, SReal** compliance, SReal* gap, SReal* force, SReal* /*free*/) override {
    const SReal own = compliance[line][line];
    if (own <= 0) {  // nothing of the row can move
      std::fill_n(force + line, getNbLines(), SReal(0));
      return;
    }
    const SReal before = force[line];
    force[line] = std::max<SReal>(0, before - gap[line] / own);
    if (getNbLines() == 1) return;
    SReal* across = force + line + 1;
    const SReal limit = m_friction * force[line];
    const SReal mean = (compliance[line + 1][line + 1] + compliance[line + 2][line + 2]) / 2;
    for (int i = 0; i < 2; ++i) {
      const SReal slip = gap[line + 1 + i] + compliance[line + 1 + i][line] * (force[line] - before);
      across[i] = mean > 0 ? across[i] - slip / mean : 0;
    }
    const SReal size = std::hypot(across[0], across[1]);
    if (size <= limit) return;
    for (int i = 0; i < 2; ++i) across[i] *= limit / size;
  }

  void store(int line, SReal* force, bool /*converged*/) override {
    SReal all[3] = {force[line], 0, 0};
    for (unsigned i = 1; i < getNbLines(); ++i) all[i] = force[line + static_cast<int>(i)];
    m_owner.keep(m_row, all);
  }

 private:
  DartsweepContacts& m_owner;
  std::size_t m_row;
  double m_friction;
  std::array<double, 3> m_start;
};

Vec3 sum(const Part& part, const std::vector<double>& ways) {
  Vec3 total;
  part.each([&](std::uint32_t vertex, double weight) {
    for (int axis = 0; axis < 3; ++axis) total[axis] += weight * ways[3 * vertex + axis];
  });
  return total;
}

Part near_part(const dsw_near_row& row) { return {row.vertices, row.weights}; }
Part obstacle_part(const dsw_near_row& row) { return {row.obstacle_vertices, row.obstacle_weights}; }

}  // namespace

DartsweepContacts::DartsweepContacts()
    : l_environment(
          initLink("environment", "DartsweepEnvironment whose bodies are kept from walls and from each other")),
      d_margin(initData(&d_margin, 0.0, "margin", "largest gap of a constraint: more than a point moves in a step")),
      d_radius(
          initData(&d_radius, 0.0, "radius", "distance from walls that the solver keeps, beside the radius of a body")),
      d_friction(initData(&d_friction, 0.0, "mu", "coefficient of friction; LCPConstraintSolver has its own")),
      d_tolerance(
          initData(&d_tolerance, 0.0, "customTolerance", "tolerance of these constraints; 0: that of the solver")),
      d_warmStart(initData(&d_warmStart, true, "warmStart", "begin with the force of the row that a row continues")),
      d_wallsMove(
          initData(&d_wallsMove, false, "wallsMove", "walls get the opposite forces, by their mechanical state")),
      d_rows(initData(&d_rows, 0u, "rows", "OUTPUT: rows of the last step")),
      d_active(initData(&d_active, 0u, "active", "OUTPUT: rows with a force in the last step")) {
  d_rows.setReadOnly(true);
  d_active.setReadOnly(true);
}

void DartsweepContacts::init() {
  BaseLagrangianConstraint::init();
  if (!l_environment) l_environment.set(getContext()->get<DartsweepEnvironment>());
  if (!l_environment) msg_error() << "the link environment is not set";
  if (!(d_margin.getValue() > 0)) msg_error() << "margin must be above 0";
  d_componentState.setValue(l_environment ? ComponentState::Valid : ComponentState::Invalid);
}

void DartsweepContacts::find_rows(BaseBody* body) {
  auto options = defaults<dsw_near_options>(dsw_near_options_init);
  options.margin = d_margin.getValue();
  options.radius = d_radius.getValue();
  dsw_scene* scene = l_environment->scene();
  std::size_t count = 0;
  const dsw_near_row* rows = nullptr;
  if (!succeeded(*this, "near rows", dsw_body_find_near_rows(scene, body->id(), &options, &count)) ||
      !succeeded(*this, "near rows", dsw_body_get_near_rows(scene, body->id(), &rows, &count)))
    return;
  auto& forces = body->forces();
  std::vector<std::array<double, 3>> next(count);
  const auto& bodies = l_environment->bodies();
  for (std::size_t i = 0; i < count; ++i) {
    Row row = {body, nullptr, i, rows[i], {}, 0, {}};
    if (rows[i].body.generation != 0) {
      const auto other = std::find_if(bodies.begin(), bodies.end(), [&](const BaseBody* one) {
        return one->exists() && one->id().index == rows[i].body.index;
      });
      if (other == bodies.end()) continue;
      // Both bodies have the row. That of the later one is left out.
      if (std::find(bodies.begin(), bodies.end(), body) > other) continue;
      row.other = *other;
    }
    if (d_warmStart.getValue() && rows[i].previous < forces.size()) next[i] = forces[rows[i].previous];
    row.force = next[i];
    const Vec3 normal(rows[i].normal[0], rows[i].normal[1], rows[i].normal[2]);
    // The tangents depend on the normal alone, so they turn little from step to step.
    Vec3 axis;
    axis[std::abs(normal[0]) < 0.6 ? 0 : 1] = 1;
    row.directions[0] = normal;
    row.directions[1] = cross(normal, axis).normalized();
    row.directions[2] = cross(normal, row.directions[1]);
    m_rows.push_back(row);
  }
  forces = next;
}

void DartsweepContacts::add_row(sofa::core::MultiMatrixDerivId to, const Row& row, int axis, unsigned line) {
  row.body->add_line(to, line, near_part(row.near), row.directions[axis]);
  if (row.other) {
    row.other->add_line(to, line, obstacle_part(row.near), -row.directions[axis]);
  } else if (d_wallsMove.getValue() && l_environment->state()) {
    auto matrix = sofa::helper::getWriteAccessor(*to[l_environment->state()].write());
    auto entries = matrix->writeLine(line);
    obstacle_part(row.near).each([&](std::uint32_t vertex, double weight) {
      const sofa::Index point = l_environment->point_of(vertex);
      if (point != sofa::InvalidID) entries.addCol(point, -row.directions[axis] * weight);
    });
  }
}

void DartsweepContacts::buildConstraintMatrix(const sofa::core::ConstraintParams* /*params*/,
                                              sofa::core::MultiMatrixDerivId to, unsigned& line) {
  m_rows.clear();
  if (!l_environment || !l_environment->scene()) return;
  {
    SCOPED_TIMER("Dartsweep near rows");
    for (BaseBody* body : l_environment->bodies())
      if (body->exists()) find_rows(body);
  }
  const int axes = has_friction() ? 3 : 1;
  for (Row& row : m_rows) {
    row.line = line;
    for (int axis = 0; axis < axes; ++axis) add_row(to, row, axis, line++);
  }
  d_rows.setValue(static_cast<unsigned>(m_rows.size()));
  d_active.setValue(0);
}

// How far vertices would go in this step without forces of rows, from where the proxies are.
void DartsweepContacts::read_ways(const sofa::core::ConstraintParams* params) {
  const auto& bodies = l_environment->bodies();
  const bool velocities = params->constOrder() == sofa::core::ConstraintOrder::VEL;
  const double dt = getContext()->getDt();
  m_ways.resize(bodies.size() + 1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]->exists()) continue;
    std::vector<double>& ways = m_ways[i];
    if (velocities) {
      bodies[i]->read_velocities(params->v(), ways);
      for (double& value : ways) value *= dt;
    } else {
      bodies[i]->read_positions(params->x(), ways);
      const std::vector<double>& from = bodies[i]->positions();
      for (std::size_t k = 0; k < ways.size(); ++k) ways[k] -= from[k];
    }
  }
  std::vector<double>& ways = m_ways.back();
  const std::vector<double>& from = l_environment->points();
  ways.assign(from.size(), 0.0);
  const auto* state = l_environment->state();
  if (!state) return;
  // A wall that takes no forces is where its state already is: something else moves it, before the step.
  const bool free = d_wallsMove.getValue() && !velocities;
  const auto& to = (free ? params->readX(state) : state->read(vec_id::read_access::position))->getValue();
  for (const Row& row : m_rows) {
    if (row.other) continue;
    obstacle_part(row.near).each([&](std::uint32_t vertex, double) {
      const sofa::Index point = l_environment->point_of(vertex);
      if (point == sofa::InvalidID || point >= to.size()) return;
      for (int axis = 0; axis < 3; ++axis) ways[3 * vertex + axis] = to[point][axis] - from[3 * vertex + axis];
    });
  }
}

Vec3 DartsweepContacts::way(const Row& row, const sofa::core::ConstraintParams* /*params*/) const {
  const auto& bodies = l_environment->bodies();
  const auto ways_of = [&](const BaseBody* body) -> const std::vector<double>& {
    return m_ways[static_cast<std::size_t>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin())];
  };
  return sum(near_part(row.near), ways_of(row.body)) -
         sum(obstacle_part(row.near), row.other ? ways_of(row.other) : m_ways.back());
}

void DartsweepContacts::getConstraintViolation(const sofa::core::ConstraintParams* params,
                                               sofa::linearalgebra::BaseVector* to) {
  if (m_rows.empty()) return;
  read_ways(params);
  const int axes = has_friction() ? 3 : 1;
  // Velocity constraints ask for velocities: the gap may close within the step.
  const double scale = params->constOrder() == sofa::core::ConstraintOrder::VEL ? 1 / getContext()->getDt() : 1;
  for (const Row& row : m_rows) {
    const Vec3 move = way(row, params);
    for (int axis = 0; axis < axes; ++axis)
      to->set(static_cast<int>(row.line) + axis,
              ((axis == 0 ? row.near.gap : 0) + move * row.directions[axis]) * scale);
  }
}

void DartsweepContacts::getConstraintResolution(const sofa::core::ConstraintParams* /*params*/,
                                                std::vector<sofa::core::behavior::ConstraintResolution*>& to,
                                                unsigned& offset) {
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    auto* resolution = new RowResolution(*this, i, d_friction.getValue(), m_rows[i].force);
    resolution->setTolerance(d_tolerance.getValue());
    to[offset] = resolution;
    offset += resolution->getNbLines();
  }
}

void DartsweepContacts::getConstraintInfo(const sofa::core::ConstraintParams* /*params*/,
                                          VecConstraintBlockInfo& blocks, VecPersistentID& ids) {
  if (m_rows.empty()) return;
  ConstraintBlockInfo info;
  info.parent = this;
  info.const0 = static_cast<int>(m_rows.front().line);
  info.nbLines = has_friction() ? 3 : 1;
  info.nbGroups = static_cast<int>(m_rows.size());
  info.hasId = d_warmStart.getValue();
  info.offsetId = static_cast<int>(ids.size());
  blocks.push_back(info);
  for (const Row& row : m_rows) {
    std::uint64_t id = row.body->id().index + 1;
    for (const std::uint32_t word : row.near.key) id = (id ^ word) * 0x9e3779b97f4a7c15u;
    ids.push_back(static_cast<PersistentID>(id >> 1));
  }
}

void DartsweepContacts::keep(std::size_t row, const double* force) {
  if (row >= m_rows.size()) return;
  Row& kept = m_rows[row];
  std::copy_n(force, 3, kept.force.begin());
  kept.body->forces()[kept.number] = kept.force;
}

void DartsweepContacts::storeLambda(const sofa::core::ConstraintParams* /*params*/, sofa::core::MultiVecDerivId to,
                                    const sofa::linearalgebra::BaseVector* lambda) {
  const int axes = has_friction() ? 3 : 1;
  unsigned active = 0;
  for (const Row& row : m_rows) {
    Vec3 force;
    for (int axis = 0; axis < axes; ++axis)
      force += row.directions[axis] * lambda->element(static_cast<int>(row.line) + axis);
    if (force == Vec3()) continue;
    ++active;
    row.body->add_force(to, near_part(row.near), force);
    if (row.other) {
      row.other->add_force(to, obstacle_part(row.near), -force);
    } else if (d_wallsMove.getValue() && l_environment->state()) {
      auto forces = sofa::helper::getWriteAccessor(*to[l_environment->state()].write());
      obstacle_part(row.near).each([&](std::uint32_t vertex, double weight) {
        const sofa::Index point = l_environment->point_of(vertex);
        if (point != sofa::InvalidID) forces[point] -= force * weight;
      });
    }
  }
  d_active.setValue(active);
}

void register_contacts(sofa::core::ObjectFactory* factory) {
  factory->registerObjects(sofa::core::ObjectRegistrationData(
                               "Constraints, with friction, where bodies of a DartsweepEnvironment are near walls.")
                               .add<DartsweepContacts>());
}

}  // namespace sofadartsweep

// Near rows as constraints of SOFA's Lagrangian solvers.
#pragma once

#include <sofa/core/behavior/BaseLagrangianConstraint.h>
#include <sofa/core/objectmodel/Data.h>
#include <sofa/core/objectmodel/Link.h>

#include <vector>

#include "SofaDartsweep/BaseBody.h"

namespace sofadartsweep {

/** Each near row of the bodies of an environment is a unilateral constraint with friction. The rows are found where the
 * proxies are at the beginning of the step. */
class DartsweepContacts : public sofa::core::behavior::BaseLagrangianConstraint {
 public:
  SOFA_CLASS(DartsweepContacts, sofa::core::behavior::BaseLagrangianConstraint);
  using Vec3 = sofa::type::Vec3;

  sofa::core::objectmodel::SingleLink<DartsweepContacts, DartsweepEnvironment,
                                      sofa::core::objectmodel::BaseLink::FLAG_STOREPATH |
                                          sofa::core::objectmodel::BaseLink::FLAG_STRONGLINK>
      l_environment;
  sofa::Data<double> d_margin, d_radius, d_friction, d_tolerance;
  sofa::Data<bool> d_warmStart, d_wallsMove;
  sofa::Data<unsigned> d_rows, d_active;

  void init() override;
  void buildConstraintMatrix(const sofa::core::ConstraintParams* params, sofa::core::MultiMatrixDerivId to,
                             unsigned& line) override;
  using BaseConstraintSet::getConstraintViolation;
  void getConstraintViolation(const sofa::core::ConstraintParams* params, sofa::linearalgebra::BaseVector* to) override;
  void getConstraintResolution(const sofa::core::ConstraintParams* params,
                               std::vector<sofa::core::behavior::ConstraintResolution*>& to, unsigned& offset) override;
  void getConstraintInfo(const sofa::core::ConstraintParams* params, VecConstraintBlockInfo& blocks,
                         VecPersistentID& ids) override;
  void storeLambda(const sofa::core::ConstraintParams* params, sofa::core::MultiVecDerivId to,
                   const sofa::linearalgebra::BaseVector* lambda) override;
  sofa::type::vector<std::string> getBaseConstraintIdentifiers() override { return {"Dartsweep"}; }

  /** Keeps the force of a row for the next step. */
  void keep(std::size_t row, const double* force);

 protected:
  DartsweepContacts();

 private:
  struct Row {
    BaseBody* body;
    BaseBody* other;     ///< Null: a wall.
    std::size_t number;  ///< Among the rows of its body.
    dsw_near_row near;
    Vec3 directions[3];  ///< The normal and two tangents.
    unsigned line;
    std::array<double, 3> force;
  };
  bool has_friction() const { return d_friction.getValue() > 0; }
  void find_rows(BaseBody* body);
  void add_row(sofa::core::MultiMatrixDerivId to, const Row& row, int axis, unsigned line);
  Vec3 way(const Row& row, const sofa::core::ConstraintParams* params) const;
  void read_ways(const sofa::core::ConstraintParams* params);

  std::vector<Row> m_rows;
  std::vector<std::vector<double>> m_ways;  ///< For each body, how far its vertices would go; the last is the wall's.
};

}  // namespace sofadartsweep

// libccd's cross-checks of the normals of contacts: how many there are, and how far both normals are apart.
#pragma once

#include "mesh.h"

#include "dartsweep/cross_check.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dsw::oracle {

struct CrossChecks {
  static constexpr double kLeastShare = 0.95;   // of all contacts that get a cross-check
  static constexpr double kMostDegrees = 0.01;  // 99 of 100 angles are not above

  uint64_t contacts = 0, reasons[8] = {};  // by dsw_no_cross_check
  std::vector<double> degrees;
  bool built = true;  // with libccd

  /// False where the answer cannot be right.
  bool ask(const dsw_environment* environment, const dsw_body_contact& contact);
  void add(const CrossChecks& other);
  /// 1 without contacts.
  double share() const;
  /// 0 without cross-checks.
  double quantile(double part) const;
  std::string text() const;
};

/// The report of a sweep as that of a body would be.
dsw_body_contact to_contact(const Vec& from, const Vec& to, const Vec& fixed, const dsw_sweep& sweep);

}  // namespace dsw::oracle

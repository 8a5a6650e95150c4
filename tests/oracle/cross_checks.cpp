#include "cross_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dsw::oracle {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr double kUnit = 1e-9;  // more than rounding makes of the square of a unit normal

dsw_cross_check_kind cross_check_of(const dsw_body_contact& contact) {
  if (contact.contact.kind == DSW_CONTACT_VERTEX) return DSW_CROSS_CHECK_VERTEX;
  return contact.edge.generation != 0 ? DSW_CROSS_CHECK_EDGE : DSW_CROSS_CHECK_PLANE;
}

}  // namespace

bool CrossChecks::ask(const dsw_environment* environment, const dsw_body_contact& contact) {
  dsw_cross_check check{};
  const dsw_status status = dsw_environment_cross_check(environment, &contact, &check);
  built = built && status != DSW_STATUS_NOT_BUILT;
  if (status != DSW_STATUS_OK) return status == DSW_STATUS_NOT_BUILT;
  ++contacts;
  if (check.kind == DSW_CROSS_CHECK_NONE) {
    ++reasons[check.reason & 7];
    return check.reason != DSW_NO_CROSS_CHECK_NONE;
  }
  degrees.push_back(check.angle_rad * kDegrees);
  const double* const n = check.normal;
  return check.kind == cross_check_of(contact) && std::fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < kUnit;
}

void CrossChecks::add(const CrossChecks& other) {
  contacts += other.contacts;
  for (size_t i = 0; i < 8; ++i) reasons[i] += other.reasons[i];
  degrees.insert(degrees.end(), other.degrees.begin(), other.degrees.end());
  built = built && other.built;
}

double CrossChecks::share() const {
  return contacts == 0 ? 1 : static_cast<double>(degrees.size()) / static_cast<double>(contacts);
}

double CrossChecks::quantile(double part) const {
  if (degrees.empty()) return 0;
  std::vector<double> sorted = degrees;
  const auto at = sorted.begin() + static_cast<ptrdiff_t>(part * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

std::string CrossChecks::text() const {
  const auto none = [this](dsw_no_cross_check why) { return static_cast<unsigned long long>(reasons[why]); };
  char line[320];
  std::snprintf(
      line, sizeof line,
      "%6llu contacts, cross-check of %8.4f %%, angle p50 %.1e p99 %.1e most %.1e degrees; none: marked %llu, "
      "parallel %llu, outside cone %llu, not converged %llu, not unique %llu",
      static_cast<unsigned long long>(contacts), 100 * share(), quantile(0.5), quantile(0.99), quantile(1),
      none(DSW_NO_CROSS_CHECK_MARKED), none(DSW_NO_CROSS_CHECK_PARALLEL), none(DSW_NO_CROSS_CHECK_OUTSIDE_CONE),
      none(DSW_NO_CROSS_CHECK_NOT_CONVERGED), none(DSW_NO_CROSS_CHECK_NOT_UNIQUE));
  return line;
}

dsw_body_contact to_contact(const Vec& from, const Vec& to, const Vec& fixed, const dsw_sweep& sweep) {
  dsw_body_contact c{};
  std::copy_n(from.data(), 3, c.from);
  std::copy_n(to.data(), 3, c.to);
  std::copy_n(fixed.data(), 3, c.fixed[0]);
  std::copy_n(sweep.position, 3, c.position);
  std::copy_n(sweep.point, 3, c.point);
  c.time = sweep.time;
  c.edge_parameter = sweep.edge_parameter;
  c.vertex = {0, 1};
  if (sweep.contact.kind == DSW_CONTACT_EDGE || sweep.edge_parameter > 0) c.edge = {0, 1};
  c.contact = sweep.contact;
  c.contact.kind = sweep.contact.kind;
  c.contact.marked_kind = sweep.contact.marked_kind;
  c.contact.tag = sweep.contact.tag;
  return c;
}

}  // namespace dsw::oracle

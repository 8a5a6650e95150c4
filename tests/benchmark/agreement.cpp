#include "agreement.h"

#include <algorithm>
#include <cmath>

namespace dsw::bench {

namespace {

std::string first_word(const std::string& text) { return text.substr(0, text.find_first_of(" ,")); }

double segment_length(const Segments& segments, std::size_t cast) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = segments.to[3 * cast + k] - segments.from[3 * cast + k];
    sum += d * d;
  }
  return std::sqrt(sum);
}

/** Longest edge of a wall. */
double wall_size(const WallMesh& walls, std::uint32_t wall) {
  double most = 0.0;
  for (std::uint32_t part = 0; part < walls.walls[wall].triangle_count(); ++part) {
    const auto triangle = walls.walls[wall].triangle(part);
    for (std::size_t i = 0; i < 3; ++i) {
      const double *a = walls.point(triangle[i]), *b = walls.point(triangle[(i + 1) % 3]);
      most = std::max(most, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  return most;
}

/** Sine of the angle between the segment and the wall's plane (the flattest of its triangles). */
double steepness(const WallMesh& walls, std::uint32_t wall, const Segments& segments, std::size_t cast) {
  double least = 1.0;
  for (std::uint32_t part = 0; part < walls.walls[wall].triangle_count(); ++part) {
    const auto t = walls.walls[wall].triangle(part);
    double e[3], f[3], u[3];
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = walls.point(t[1])[k] - walls.point(t[0])[k];
      f[k] = walls.point(t[2])[k] - walls.point(t[0])[k];
      u[k] = segments.to[3 * cast + k] - segments.from[3 * cast + k];
    }
    const double n[3] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
    least = std::min(least, std::fabs(n[0] * u[0] + n[1] * u[1] + n[2] * u[2]) /
                                (std::hypot(n[0], n[1], n[2]) * std::hypot(u[0], u[1], u[2])));
  }
  return least;
}

}  // namespace

Tolerance tolerance_of(const std::string& peer, const WallMesh& walls) {
  const std::string name = first_word(peer);
  const double float_rounding = 8 * 0x1p-24 * walls.extent;
  if (name == "bullet") return {float_rounding, 2e-4};
  if (name == "embree") return {float_rounding, 0.0};
  return {64 * 0x1p-53 * walls.extent + 1e-8, 0.0};
}

bool Agreement::ours_is_right(const Exact& exact, const Segments& segments, std::size_t cast,
                              const Answer& ours) const {
  const auto truth = exact.first(&segments.from[3 * cast], &segments.to[3 * cast]);
  if (truth.walls.empty()) return ours.wall == kNone;
  // Ours is the largest double not later than the exact time.
  const double later = std::nextafter(ours.time, 2.0);
  return std::find(truth.walls.begin(), truth.walls.end(), ours.wall) != truth.walls.end() &&
         mpq_class(ours.time) <= truth.time && (ours.time == 1.0 || mpq_class(later) > truth.time);
}

void Agreement::judge(const Exact& exact, const WallMesh& walls, const Segments& segments, std::size_t cast,
                      const Answer& ours, const Answer& theirs, const std::string& name) {
  const Tolerance tolerance = tolerance_of(name, walls);
  Peer& peer = peers_[first_word(name)];
  const double *from = &segments.from[3 * cast], *to = &segments.to[3 * cast];
  const auto allowed = [&](std::uint32_t wall) {
    return tolerance.absolute + tolerance.relative * wall_size(walls, wall);
  };
  if (ours.wall == theirs.wall) {
    if (ours.wall == kNone) return;
    const double off = std::fabs(ours.time - theirs.time) * segment_length(segments, cast) *
                       steepness(walls, ours.wall, segments, cast);
    if (off <= tolerance.absolute) return;
    ++peer.different;
    ++peer.unexplained;
    peer.largest_slack = std::max(peer.largest_slack, off);
    return;
  }
  ++peer.different;
  ++checked_;
  if (!ours_is_right(exact, segments, cast, ours)) {
    ++wrong_;
    ++peer.unexplained;
    return;
  }
  // How little must change for theirs to be right? A wall of theirs that the segment misses must nearly be met; one
  // that it meets, but later than ours, must be met at nearly the same time, or ours must nearly be missed.
  double slack = 0.0, limit = tolerance.absolute;
  if (theirs.wall == kNone) {
    slack = exact.slack(ours.wall, from, to);
    limit = allowed(ours.wall);
  } else {
    const auto when = exact.time(theirs.wall, from, to);
    if (!when) {
      slack = exact.slack(theirs.wall, from, to);
      limit = allowed(theirs.wall);
    } else if (ours.wall != kNone) {
      const double between = (when->get_d() - ours.time) * segment_length(segments, cast);
      slack = std::min(std::fabs(between), exact.slack(ours.wall, from, to));
      limit = allowed(ours.wall);
    }
  }
  peer.largest_slack = std::max(peer.largest_slack, slack);
  if (slack <= limit) {
    ++peer.explained;
  } else {
    ++peer.unexplained;
    if (peer.unexplained <= 3) {
      std::printf("    unexplained: %s, cast %zu, wall %d against our %d, times %.17g and %.17g, slack %g of %g\n",
                  name.c_str(), cast, static_cast<int>(theirs.wall), static_cast<int>(ours.wall), theirs.time,
                  ours.time, slack, limit);
    }
  }
}

void Agreement::compare(const Segments& segments, const std::vector<Engine*>& engines, const WallMesh& walls,
                        std::size_t sample) {
  const Exact exact(walls);
  const std::size_t every = std::max<std::size_t>(1, segments.count() / std::max<std::size_t>(1, sample));
  for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
    const std::size_t count = std::min(segments.batch, segments.count() - first);
    for (Engine* engine : engines) engine->run(first, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Answer ours = engines.front()->answer(i);
      ++casts_;
      hits_ += ours.wall != kNone ? 1 : 0;
      if (sample > 0 && (first + i) % every == 0) {
        ++checked_;
        wrong_ += ours_is_right(exact, segments, first + i, ours) ? 0 : 1;
      }
      for (std::size_t e = 1; e < engines.size(); ++e) {
        ++peers_[first_word(engines[e]->name())].compared;
        judge(exact, walls, segments, first + i, ours, engines[e]->answer(i), engines[e]->name());
      }
    }
  }
}

void Agreement::write(Report& report) const {
  for (const auto& [name, peer] : peers_) {
    report.set("agree." + name + ".compared", static_cast<double>(peer.compared));
    report.set("agree." + name + ".different", static_cast<double>(peer.different));
    report.set("agree." + name + ".explained", static_cast<double>(peer.explained));
    report.set("agree." + name + ".unexplained", static_cast<double>(peer.unexplained));
    report.set("agree." + name + ".largest_slack", peer.largest_slack);
  }
  report.set("agree.exact.checked", static_cast<double>(checked_));
  report.set("agree.exact.wrong", static_cast<double>(wrong_));
}

}  // namespace dsw::bench

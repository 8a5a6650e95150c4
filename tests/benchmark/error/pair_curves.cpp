// Continuous detection of single pairs, beside peers that do nothing else: times of contact, and who misses what.
#include "curves.h"
#include "pairs.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace dsw::curves {

namespace {

/** The double next to a rational. */
double nearest(const mpq_class& x) {
  const double below = x.get_d();  // towards zero
  const double above = std::nextafter(below, 2);
  return mpq_class(above) - x < x - mpq_class(below) ? above : below;
}

/** For methods that only another language has: doubles in hexadecimal, the truth last. */
void write_pairs(const std::string& path, const Pairs& pairs) {
  std::ofstream file(path);
  const bool faces = pairs.kind == PairKind::kVertexFace;
  file << (faces ? "p p' a b c time" : "p p' q a b time") << "\n";
  const auto put = [&](const Vec& p) { file << text("%a,%a,%a,", p[0], p[1], p[2]); };
  for (const Pair& pair : pairs.list) {
    put(pair.from);
    put(pair.to);
    if (!faces) put(pair.fixed);
    for (std::size_t k = 0; k < (faces ? 3u : 2u); ++k) put(pair.corners[k]);
    file << (pair.time ? text("%a", nearest(*pair.time)) : "") << "\n";
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

struct Judged {
  Errors time;
  std::size_t missed = 0, invented = 0, late = 0;
  std::string note() const {
    return time.spread() + text("; missed %zu, invented %zu, later than true %zu", missed, invented, late);
  }
};

Judged judge(const Pairs& pairs, const std::vector<PairAnswer>& answers) {
  Judged judged;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto& truth = pairs.list[i].time;
    const bool hit = answers[i].time >= 0;
    judged.missed += truth && !hit ? 1 : 0;
    judged.invented += hit && !truth ? 1 : 0;
    if (!truth) continue;
    // Whoever sees nothing goes to the end.
    const double time = hit ? answers[i].time : 1;
    judged.time.values.push_back(difference(time, *truth));
    judged.late += mpq_class(time) > *truth ? 1 : 0;
  }
  return judged;
}

PairMethods methods_for(const Pairs& pairs) {
  PairMethods methods(pairs);
  add_dartsweep(methods);
  add_bullet(methods);
  add_fcl(methods);
  return methods;
}

std::string compare(const Curve& curve, const char* what) {
  const Point &ours = curve.points[0], *exact = nullptr, *fast = nullptr;
  for (const Point& p : curve.points) {
    if (&p == &ours) continue;
    if (exact == nullptr || p.error < exact->error) exact = &p;
    if (fast == nullptr || p.seconds < fast->seconds) fast = &p;
  }
  if (exact == nullptr) return "";
  // "FCL cubic (Newton) 1e-16 at 50 ns (missed 0, ...)"
  const auto tell = [](const Point& p) {
    const std::string name = p.method + (p.setting.empty() ? "" : " (" + p.setting + ")");
    return text("%s %.2g at %.0f ns (%s)", name.c_str(), p.error, 1e9 * p.seconds,
                p.note.substr(p.note.find("; ") + 2).c_str());
  };
  std::string advice = text(
      "Take the exact test where it matters that nothing is missed or late: %s %.2g at %.0f ns. The most exact peer "
      "here: %s",
      what, ours.error, 1e9 * ours.seconds, tell(*exact).c_str());
  if (fast != exact) advice += text("; the fastest: %s", tell(*fast).c_str());
  return advice + ".";
}

void measure_times(const Options& options, PairKind kind, const std::string& name) {
  Place place(Kind::kFaces, 12, options.seed);
  Rng rng(options.seed + 300);
  const Pairs pairs = random_pairs(place, rng, kind, options.count(1000, 20000));
  write_pairs(options.out + "/pairs_" + name + ".csv", pairs);
  const PairMethods methods = methods_for(pairs);
  const auto seconds = time_methods(methods.methods(), pairs.list.size(), options.rounds());
  Curve curve{name, "pair, half of which touch", "time of contact", "of the move", {}, ""};
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const Judged judged = judge(pairs, methods.answers(i));
    const Method& m = methods.methods()[i];
    curve.points.push_back(
        {m.name, m.setting, m.unit, seconds[i], judged.time.mean(), judged.time.values.size(), judged.note()});
  }
  curve.advice = compare(curve, "its mean error is");
  curve.write(options.out);
}

void measure_degenerate(const Options& options, PairKind kind, const std::string& name) {
  Rng rng(options.seed + 400);
  const Pairs pairs = degenerate_pairs(rng, kind, options.count(1000, 20000));
  write_pairs(options.out + "/pairs_" + name + ".csv", pairs);
  const PairMethods methods = methods_for(pairs);
  const auto seconds = time_methods(methods.methods(), pairs.list.size(), options.rounds());
  Curve curve{name, "degenerate pair", "share of pairs answered wrongly", "", {}, ""};
  std::size_t safe = seconds.size();  // the fastest peer that misses none
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const Judged judged = judge(pairs, methods.answers(i));
    const Method& m = methods.methods()[i];
    if (i > 0 && judged.missed == 0 && (safe == seconds.size() || seconds[i] < seconds[safe])) safe = i;
    const auto wrong = static_cast<double>(judged.missed + judged.invented);
    curve.points.push_back({m.name, m.setting, m.unit, seconds[i], wrong / static_cast<double>(pairs.list.size()),
                            pairs.list.size(), judged.note()});
  }
  curve.advice = compare(curve, "the share that it answers wrongly is");
  curve.advice += safe == seconds.size()
                      ? " Each of them misses some."
                      : text(" Where contacts a rounding away may be invented: %s (%s) misses none, at %.0f ns.",
                             curve.points[safe].method.c_str(), curve.points[safe].setting.c_str(),
                             1e9 * curve.points[safe].seconds);
  curve.write(options.out);
}

/** Contacts alone, as casts in their scene. */
class SceneCasts {
 public:
  SceneCasts(Place& place, const Pairs& pairs) : environment_(place.environment()), flights_(pairs.list.size()) {
    for (const Pair& pair : pairs.list) {
      from_.insert(from_.end(), pair.from.begin(), pair.from.end());
      to_.insert(to_.end(), pair.to.begin(), pair.to.end());
    }
    starts_.resize(flights_.size());
    check(
        dsw_environment_locate_points(environment_, from_.data(), starts_.size(), 0, nullptr, starts_.data(), nullptr));
    dsw_cast_options_init(&options_, sizeof options_);
    options_.flags = DSW_CAST_START_KNOWN;
  }
  void run() {
    check(dsw_environment_cast_segments(environment_, starts_.size(), starts_.data(), from_.data(), to_.data(), 0,
                                        &options_, flights_.data()));
  }
  PairAnswer answer(std::size_t i) const {
    const dsw_flight& f = flights_[i];
    return {f.outcome == DSW_OUTCOME_CONTACT ? f.time : -1,
            true,
            {f.position[0], f.position[1], f.position[2]},
            {f.contact.normal[0], f.contact.normal[1], f.contact.normal[2]}};
  }

 private:
  const dsw_environment* environment_;
  std::vector<double> from_, to_;
  std::vector<dsw_volume_id> starts_;
  std::vector<dsw_flight> flights_;
  dsw_cast_options options_{};
};

/** Degrees between a triangle's normal and a vector, whichever way either points. */
double angle(const Pair& pair, const Vec& normal) {
  std::array<mpq_class, 3> n, r, c;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const auto edge = [&](std::size_t corner, std::size_t axis) {
      return mpq_class(mpq_class(pair.corners[corner][axis]) - mpq_class(pair.corners[0][axis]));
    };
    n[k] = edge(1, i) * edge(2, j) - edge(1, j) * edge(2, i);
    r[k] = mpq_class(normal[k]);
  }
  mpq_class cross = 0, dot = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    c[k] = n[i] * r[j] - n[j] * r[i];
    cross += c[k] * c[k];
    dot += n[k] * r[k];
  }
  return std::atan2(std::sqrt(cross.get_d()), std::fabs(dot.get_d())) * 57.29577951308232;
}

/** Points and normals of contacts that are seen. */
void measure_contacts(const Options& options) {
  Place place(Kind::kFaces, 12, options.seed);
  Rng rng(options.seed + 350);
  const Pairs all = random_pairs(place, rng, PairKind::kVertexFace, options.count(1000, 20000));
  Pairs pairs{all.kind, {}};
  // Every other pair is a contact of the scene.
  for (std::size_t i = 0; i < all.list.size(); i += 2) pairs.list.push_back(all.list[i]);
  SceneCasts casts(place, pairs);
  casts.run();
  PairMethods peers(pairs);
  add_bullet(peers);
  add_fcl(peers);
  std::vector<Method> methods = {{"dartsweep exact", "", "", {}, [&casts] { casts.run(); }}};
  methods.insert(methods.end(), peers.methods().begin(), peers.methods().end());
  const auto seconds = time_methods(methods, pairs.list.size(), options.rounds());
  Curve point{"contact_point",
              "contact of a vertex (of ours: looked for in a whole scene)",
              "where it touches",
              "cells",
              {},
              ""};
  Curve normal{"contact_normal", point.item, "normal", "degrees", {}, ""};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    Errors points, normals;
    std::size_t unseen = 0;
    for (std::size_t k = 0; k < pairs.list.size(); ++k) {
      const PairAnswer answer = i == 0 ? casts.answer(k) : peers.answers(i - 1)[k];
      unseen += answer.time < 0 ? 1 : 0;
      if (answer.time < 0 || !answer.has_contact) continue;
      const Pair& pair = pairs.list[k];
      points.values.push_back(distance_at(pair.from, pair.to, *pair.time, answer.point.data()));
      const bool has_normal = answer.normal != Vec{};
      if (has_normal) normals.values.push_back(angle(pair, answer.normal));
    }
    const Method& m = methods[i];
    const std::string note = text("; %zu contacts not seen", unseen);
    if (!points.values.empty()) {
      point.points.push_back(
          {m.name, m.setting, m.unit, seconds[i], points.mean(), points.values.size(), points.spread() + note});
    }
    if (!normals.values.empty()) {
      normal.points.push_back(
          {m.name, m.setting, m.unit, seconds[i], normals.mean(), normals.values.size(), normals.spread() + note});
    }
  }
  point.advice = compare(point, "its mean error is");
  normal.advice = compare(normal, "its normals are off by");
  point.write(options.out);
  normal.write(options.out);
}

}  // namespace

void pair_curves(const Options& options) {
  measure_times(options, PairKind::kVertexFace, "ccd_vertex_face");
  measure_times(options, PairKind::kEdgeEdge, "ccd_edge_edge");
  measure_contacts(options);
  measure_degenerate(options, PairKind::kVertexFace, "degenerate_vertex_face");
  measure_degenerate(options, PairKind::kEdgeEdge, "degenerate_edge_edge");
}

}  // namespace dsw::curves

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
  const Point& ours = curve.points[0];
  const Point* best = nullptr;
  for (const Point& p : curve.points) {
    if (&p != &ours && (best == nullptr || p.error < best->error)) best = &p;
  }
  if (best == nullptr) return "";
  return text("Take the exact test: %s %.2g at %.0f ns; the most exact peer here, %s %s, has %.2g at %.0f ns.", what,
              ours.error, 1e9 * ours.seconds, best->method.c_str(), best->setting.c_str(), best->error,
              1e9 * best->seconds);
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
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const Judged judged = judge(pairs, methods.answers(i));
    const Method& m = methods.methods()[i];
    const auto wrong = static_cast<double>(judged.missed + judged.invented);
    curve.points.push_back({m.name, m.setting, m.unit, seconds[i], wrong / static_cast<double>(pairs.list.size()),
                            pairs.list.size(), judged.note()});
  }
  curve.advice = compare(curve, "the share that it answers wrongly is");
  curve.write(options.out);
}

}  // namespace

void pair_curves(const Options& options) {
  measure_times(options, PairKind::kVertexFace, "ccd_vertex_face");
  measure_times(options, PairKind::kEdgeEdge, "ccd_edge_edge");
  measure_degenerate(options, PairKind::kVertexFace, "degenerate_vertex_face");
  measure_degenerate(options, PairKind::kEdgeEdge, "degenerate_edge_edge");
}

}  // namespace dsw::curves

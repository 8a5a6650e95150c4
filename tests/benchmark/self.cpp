// A rope that meets itself: a helix whose turns wobble through each other, if nothing stops them. Ours moves it as a
// body; the peer is what a host would build from parts, Bullet's tree of boxes against itself and our own exact times
// for the pairs that it finds.
#include "parts.h"

#include "bullet_casts.h"
#include "rope.h"
#include "timing.h"

#include "predicates/touch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dsw::bench {

namespace {

/** Bullet's tree over what each edge can sweep in a step, then exact times in the order in which vertices move. Where a
 * vertex stops it is told: finding that out is not part of its time. */
class Peer {
 public:
  /** @param margin of the leaves, which stay in place while their edges keep within; 0: every leaf is put anew. */
  Peer(const std::vector<double>& at, double margin)
      : margin_(static_cast<btScalar>(margin)), at_(at), leaves_(at.size() / 3 - 1) {
    for (std::size_t e = 0; e < leaves_.size(); ++e) leaves_[e] = tree_.insert(box_of(e, at), number(e));
    tree_.optimizeTopDown();
  }

  double step(const std::vector<double>& targets, const RopeStep& truth) {
    at_ = truth.before;
    return cpu_time_ns([&] {
      find_pairs(targets);
      meet(targets, truth);
    });
  }

  std::size_t pairs = 0, tests = 0, different = 0;  // sums over all steps

 private:
  struct Collect final : btDbvt::ICollide {
    std::vector<std::array<std::uint32_t, 2>>* found = nullptr;
    void Process(const btDbvtNode* a, const btDbvtNode* b) override {
      if (a == b) return;
      found->push_back({static_cast<std::uint32_t>(a->dataAsInt), static_cast<std::uint32_t>(b->dataAsInt)});
    }
  };

  static void* number(std::size_t e) { return reinterpret_cast<void*>(e); }

  /** In floats, so a little larger. */
  btDbvtVolume box_of(std::size_t e, const std::vector<double>& targets) const {
    double low[3], high[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = at_[3 * e + k], b = at_[3 * e + 3 + k], c = targets[3 * e + k], d = targets[3 * e + 3 + k];
      low[k] = std::min(std::min(a, b), std::min(c, d));
      high[k] = std::max(std::max(a, b), std::max(c, d));
    }
    btDbvtVolume box = btDbvtVolume::FromMM(to_bullet(low), to_bullet(high));
    constexpr btScalar kRounding = 4e-6f;
    box.Expand(btVector3(kRounding, kRounding, kRounding));
    return box;
  }

  void find_pairs(const std::vector<double>& targets) {
    for (std::size_t e = 0; e < leaves_.size(); ++e) {
      btDbvtVolume box = box_of(e, targets);
      if (margin_ > 0) {
        tree_.update(leaves_[e], box, margin_);
      } else {
        tree_.update(leaves_[e], box);
      }
    }
    found_.clear();
    Collect collect;
    collect.found = &found_;
    tree_.collideTT(tree_.m_root, tree_.m_root, collect);
    pairs += found_.size();
    // By edge: those that it may meet.
    first_.assign(leaves_.size() + 1, 0);
    for (const auto& pair : found_) {
      ++first_[pair[0]];
      ++first_[pair[1]];
    }
    for (std::size_t e = 0, sum = 0; e <= leaves_.size(); ++e) {
      sum += first_[e];
      first_[e] = static_cast<std::uint32_t>(sum);
    }
    partners_.resize(2 * found_.size());
    for (const auto& pair : found_) {
      partners_[--first_[pair[0]]] = pair[1];
      partners_[--first_[pair[1]]] = pair[0];
    }
  }

  const double* at(std::size_t v) const { return &at_[3 * v]; }

  double touch(const EdgeMotion& m, const double* a, const double* b) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::max(std::max(m.p[k], m.to[k]), m.q[k]) < std::min(a[k], b[k])) return kNever;
      if (std::min(std::min(m.p[k], m.to[k]), m.q[k]) > std::max(a[k], b[k])) return kNever;
    }
    ++tests;
    return edge_touch(m, a, b).time;
  }

  /** The first time at which the edge from v to q touches edge f, of which it may be a neighbour. */
  double first_touch(const EdgeMotion& m, std::size_t v, std::size_t q, std::size_t f) {
    const bool at_v = f == v || f + 1 == v, at_q = f == q || f + 1 == q;
    if (!at_v && !at_q) return touch(m, at(f), at(f + 1));
    const std::size_t common = at_v ? v : q, far = f == common ? f + 1 : f;
    const double time = touch(m, at(far), at(far));
    return at_v ? time : std::min(time, touch({m.p, m.to, m.p}, at(f), at(f + 1)));
  }

  void meet(const std::vector<double>& targets, const RopeStep& truth) {
    for (std::size_t v = 0; v <= leaves_.size(); ++v) {
      double time = kNever;
      for (std::size_t e = v == 0 ? 0 : v - 1; e < std::min(v + 1, leaves_.size()); ++e) {
        const std::size_t q = e == v ? v + 1 : v - 1;
        const EdgeMotion m{at(v), &targets[3 * v], at(q)};
        for (std::uint32_t i = first_[e]; i < first_[e + 1]; ++i) {
          time = std::min(time, first_touch(m, v, q, partners_[i]));
        }
      }
      different += (time != kNever) != (truth.stopped[v] != 0) ? 1u : 0u;
      std::copy_n(&truth.after[3 * v], 3, &at_[3 * v]);
    }
  }

  btScalar margin_;
  std::vector<double> at_;
  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
  std::vector<std::array<std::uint32_t, 2>> found_;
  std::vector<std::uint32_t> first_, partners_;
};

void run_rope(dsw_environment* environment, std::size_t edges, const Options& options, Report& report) {
  const std::string label = edges == 1000 ? "e1e3" : "e1e4";
  const std::size_t steps = options.quick ? 60 : 300, first_measured = 20;
  std::printf("  self.%s\n", label.c_str());
  const std::vector<std::vector<double>> targets = rope_targets(edges, steps);
  std::vector<RopeStep> script(steps);
  std::vector<double> ours_ns, free_ns;
  double contacts = 0;
  {
    Rope rope(environment, targets[0], true), free_rope(environment, targets[0], false);
    RopeStep ignored;
    for (std::size_t step = 0; step < steps; ++step) {
      ours_ns.push_back(rope.move(targets[step + 1], script[step]));
      free_ns.push_back(free_rope.move(targets[step + 1], ignored));
      contacts += static_cast<double>(script[step].contacts);
    }
  }
  std::vector<double> best;
  std::size_t pairs = 0, tests = 0, different = 0;
  for (const double margin : {0.0, 0.02, 0.05, 0.1}) {
    Peer peer(targets[0], margin);
    std::vector<double> ns;
    for (std::size_t step = 0; step < steps; ++step) ns.push_back(peer.step(targets[step + 1], script[step]));
    std::printf("    bullet, btDbvt, margin %-16g %.0f ns\n", margin, median(ns));
    if (!best.empty() && median(ns) >= median(best)) continue;
    best = std::move(ns);
    pairs = peer.pairs, tests = peer.tests, different = peer.different;
  }
  const auto measured = [&](std::vector<double> ns) {
    ns.erase(ns.begin(), ns.begin() + first_measured);
    return ns;
  };
  const double per_step = 1 / static_cast<double>(steps);
  report.set("self.us." + label, 1e-3 * median(measured(ours_ns)));
  report.set("self.us.no_contacts." + label, 1e-3 * median(measured(free_ns)));
  report.set("self.bullet_us." + label, 1e-3 * median(measured(best)));
  report.set("self.vs_bullet." + label, median_ratio(measured(best), measured(ours_ns)));
  report.set("self.contacts." + label, contacts * per_step);
  report.set("self.bullet_pairs." + label, static_cast<double>(pairs) * per_step);
  report.set("self.bullet_tests." + label, static_cast<double>(tests) * per_step);
  report.set("self.different." + label, static_cast<double>(different));
}

}  // namespace

void run_self(const Options& options, Report& report) {
  const RopeSpace space;
  for (const std::size_t edges : {std::size_t{1000}, std::size_t{10000}}) {
    run_rope(space.environment(), edges, options, report);
  }
}

}  // namespace dsw::bench

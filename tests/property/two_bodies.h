// Two bodies in easy places, in space or in the plane: what their tests share.
#pragma once

#include "host_memory.h"
#include "pairs_crowd.h"

namespace dsw::oracle {

class TwoBodies : public MemoryTest {
 protected:
  /// `level`: of bodies that are created without one.
  explicit TwoBodies(dsw_level level) : level_(level) {}

  BodyAnswer move(dsw_body_id body, const std::vector<Vec>& targets, const dsw_move_options* options = nullptr) {
    BodyAnswer answer;
    EXPECT_EQ(move_body(scene(), body, targets, options, answer), "");
    return answer;
  }
  dsw_contact_partner partner(dsw_body_id body, size_t i = 0) {
    const dsw_contact_partner* partners = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contact_partners(scene(), body, &partners, &count), DSW_STATUS_OK);
    return i < count ? partners[i] : dsw_contact_partner{};
  }
  dsw_status create(const BodyPlan& plan, dsw_level level, uint32_t flags = 0) {
    dsw_body_id body;
    return create_body(scene(), plan, level, flags, {}, &body);
  }
  dsw_status create(const BodyPlan& plan) { return create(plan, level_); }

  /// The other body is a quarter of the way, 2 along x, in front of this one.
  dsw_move_report stop_rigidly(const BodyPlan& other, const BodyPlan& plan) {
    make(other, level_);
    const dsw_body_id body = make(plan, level_);
    dsw_rigid_motion motion = {};
    motion.rotation[3] = 1;
    motion.translation[0] = 2;
    dsw_move_report report;
    const std::string before = bits_of(read(body));
    until_it_succeeds([&] { return dsw_body_move_rigid(scene(), body, &motion, nullptr, &report); },
                      [&] { return bits_of(read(body)) == before; });
    EXPECT_GE(report.fraction, 0.25);
    EXPECT_LT(report.fraction, 0.5);
    EXPECT_NE(partner(body).body.generation, 0u);
    return report;
  }

  /// Creates three bodies, of which one meets itself, and moves them by these ways; every allocation is refused once.
  void run_out_of_memory(const BodyPlan (&plans)[3], int self, const std::array<Vec, 3>& ways) {
    for (int i = 0; i < 3; ++i) {
      const uint32_t flags = i == self ? DSW_BODY_SELF_CONTACTS : 0;
      until_it_succeeds([&] { return create_body(scene(), plans[i], level_, flags, {}, &bodies_[i]); },
                        [&] { return body_count() == static_cast<size_t>(i); });
    }
    const std::string before = state();
    dsw_move_options options = defaults(dsw_move_options_init);
    options.edge_response = DSW_RESPONSE_ADAPTIVE_SLIDE;
    options.vertex_response = DSW_RESPONSE_SLIDE;
    std::vector<Vec> targets;
    for (size_t i = 0; i < 3; ++i) {
      for (const Vec& p : plans[i].at) targets.push_back({p[0] + ways[i][0], p[1] + ways[i][1], p[2] + ways[i][2]});
    }
    until_it_succeeds(
        [&] {
          return dsw_scene_move_bodies(scene(), bodies_, 3, targets[0].data(), targets.size(), sizeof(Vec), &options,
                                       nullptr);
        },
        [&] { return state() == before; });
    EXPECT_NE(state(), before);
  }
  std::string state() {
    std::string text;
    for (dsw_body_id b : bodies_) text += bits_of(read(b));
    return text;
  }

  dsw_level level_;
  dsw_body_id bodies_[3] = {};
};

}  // namespace dsw::oracle

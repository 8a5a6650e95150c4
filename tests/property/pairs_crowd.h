// Many bodies that push each other: the same answers for any number of threads.
#pragma once

#include "pairs_support.h"
#include "threads.h"

namespace dsw::oracle {

/// Bodies of which every other one meets itself, in an environment eight units wide.
class Crowd {
 public:
  Crowd(dsw_environment* environment, size_t dimension, dsw_level level, double radius = 0)
      : dimension_(dimension),
        level_(level),
        radius_(radius),
        scene_(make_scene(environment, DSW_FEATURE_BODY_CONTACTS)) {}

  /// What they answer to some rounds of moves, made together or one after the other. plan(rng, try) makes a body, free
  /// or not.
  template <class Plan>
  std::string answers(size_t least, int rounds, bool together, Plan plan) {
    for (size_t i = 0; i < 400 && bodies_.size() < least * 3 / 2; ++i) {
      dsw_body_id body;
      const uint32_t flags = i % 2 == 0 ? DSW_BODY_SELF_CONTACTS : 0;
      if (create_body(scene_.get(), plan(rng_, i), level_, flags, {}, &body, radius_) == DSW_STATUS_OK)
        bodies_.push_back(body);
    }
    EXPECT_GT(bodies_.size(), least);
    std::string text;
    for (int round = 0; round < rounds; ++round) text += answers_of_round(round, together);
    EXPECT_GT(contacts_, 150u);
    return text;
  }

 private:
  std::string answers_of_round(int round, bool together) {
    dsw_move_options options = defaults(dsw_move_options_init);
    if (round % 2 == 1) options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
    std::vector<Vec> targets;
    std::vector<size_t> first;
    for (dsw_body_id body : bodies_) {
      BodyState state;
      EXPECT_EQ(read_body(scene_.get(), body, state), "");
      first.push_back(targets.size());
      Vec way = {0, 0, 0};
      for (size_t k = 0; k < dimension_; ++k) way[k] = rng_.range(-0.5, 0.5);
      for (Vec p : state.at) {
        for (size_t k = 0; k < dimension_; ++k) p[k] += way[k];
        targets.push_back(p);
      }
    }
    first.push_back(targets.size());
    if (together) {
      EXPECT_EQ(dsw_scene_move_bodies(scene_.get(), bodies_.data(), bodies_.size(), targets[0].data(), targets.size(),
                                      sizeof(Vec), &options, nullptr),
                DSW_STATUS_OK);
    }
    std::string text;
    for (size_t i = 0; i < bodies_.size(); ++i) {
      if (!together) {
        EXPECT_EQ(dsw_body_move(scene_.get(), bodies_[i], targets[first[i]].data(), first[i + 1] - first[i],
                                sizeof(Vec), &options, nullptr),
                  DSW_STATUS_OK);
      }
      BodyAnswer answer;
      const dsw_body_contact* found = nullptr;
      const dsw_contact_partner* partners = nullptr;
      size_t count = 0;
      EXPECT_EQ(dsw_body_get_contacts(scene_.get(), bodies_[i], &found, &count), DSW_STATUS_OK);
      answer.contacts.assign(found, found + count);
      EXPECT_EQ(dsw_body_get_contact_partners(scene_.get(), bodies_[i], &partners, &count), DSW_STATUS_OK);
      contacts_ += count;
      EXPECT_EQ(read_body(scene_.get(), bodies_[i], answer.after), "");
      text += bits_of(answer);
      text += std::string(reinterpret_cast<const char*>(partners), count * sizeof *partners);
    }
    return text;
  }

  size_t dimension_;
  dsw_level level_;
  double radius_;
  ScenePtr scene_;
  Rng rng_{5};
  std::vector<dsw_body_id> bodies_;
  size_t contacts_ = 0;
};

/// answers(context, together) has the same bits for any number of threads.
template <class Answers>
void check_threads(Answers answers) {
  const std::string alone = answers(context_with(1, nullptr).get(), false);
  EXPECT_EQ(answers(context_with(1, nullptr).get(), true), alone);
  EXPECT_EQ(answers(context_with(4, nullptr).get(), true), alone);
  Shuffler shuffler;
  shuffler.threads = 3;
  EXPECT_EQ(answers(context_with(0, &shuffler).get(), true), alone);
}

}  // namespace dsw::oracle

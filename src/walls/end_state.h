#pragma once
// The environment's points go to new places at once [JCD10] 5.1: occupants are looked for where they are then. That tells rightly on which
// side of a wall they are when walls move less than a cell is thick.

#include "motion/sweep.h"
#include "motion/wave.h"
#include "walls/settings.h"

namespace dsw {

class EndState {
 public:
  EndState(Environment<3>& env, Occupants& all);

  /** See WallMotion::run. What has come to lie beyond a wall is put before it. Where that is not enough, or a cell that is met would not
   * be valid, the way is shortened. O(occupants, volumes met). */
  void run(double* next, const WallSettings& settings, WallRecord& record);

 private:
  enum class Went { kThrough, kInvalid, kStopped };

  Went try_seats(const WallSettings& settings, WallRecord& record);
  Went run_seats(const WallSettings& settings, WallRecord& record);
  bool put_before(const CastRequest& request, const CastResult& flight, const Feature& point, dsw_wall_response done,
                  WallRecord& record);
  bool are_edges_free();
  bool are_faces_free();
  template <class Visit>
  bool for_each_body(Visit visit);

  Environment<3>& env_;
  Occupants& all_;
  Wave<3> wave_;
  Array<Feature> points_;  // of the wave
  double centres_[kWave][3];
  SweepFlood flood_;
};

}  // namespace dsw

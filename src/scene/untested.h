#pragma once
// What calls see of bodies that have edges which were left untested [JCD10] 6.2.

#include "scene/scene.h"

namespace dsw {

/** Whether a scene has bodies whose back edges are left. */
template <int D>
bool has_untested(const Scene<D>& scene) noexcept {
  return scene.leaving != 0;
}
/** A call begins that moves no such body, but relies on bodies that are free: the edges that were left are tested where
 * they are. A body with one that is not free counts with its vertices alone until show_edges. Casts; allocates nothing.
 * @param settles whether edges that are free leave the list when it is over: of a call that changes the scene. */
template <int D>
void hide_blocked_edges(Scene<D>& scene, bool settles) noexcept;
/** The call is over.
 * @param changed it was made: edges that were found free leave the list, and all edges that were hidden are untested, since anything can
 * have come into their way. Else the list is as before. */
template <int D>
void show_edges(Scene<D>& scene, bool changed) noexcept;

/** Hides edges while it lives, for a call that changes nothing. */
template <int D>
class FreeBodies {
 public:
  explicit FreeBodies(Scene<D>& scene) noexcept : scene_(scene) {
    if (has_untested(scene)) hide_blocked_edges(scene, false);
  }
  ~FreeBodies() {
    if (has_untested(scene_)) show_edges(scene_, false);
  }
  FreeBodies(const FreeBodies&) = delete;
  FreeBodies& operator=(const FreeBodies&) = delete;

 private:
  Scene<D>& scene_;
};

}  // namespace dsw

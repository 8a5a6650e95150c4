#pragma once
// A piece of what is impassable comes off: its cells become passable, its surface becomes a body.

#include "cutting/inset.h"
#include "scene/change.h"

namespace dsw {

class Detachment {
 public:
  /** Looks at the piece that a cell belongs to; `scene` is the only one that uses the environment. Throws as Piece. */
  Detachment(Environment<3>& env, Scene<3>& scene, Cell start, size_t most);

  /** Carries it out. `like` has the body's level, flags and filter; its vertices are drawn in by `share` as Inset says,
   * each in up to `attempts` places. Throws OCCUPIED if it is not free then, or touches a body, and std::bad_alloc;
   * nothing has changed then. */
  dsw_body_id carry_out(const BodyDescription& like, double share, uint32_t attempts, ChangeResults& results);

 private:
  void write_edit();
  void drop_marks_inside();
  void set_marks(bool marked) noexcept;
  void place(uint32_t vertex);
  [[noreturn]] void give_up(uint32_t a, uint32_t b) const;
  void place_all(const BodyDescription& like);
  void draw_in(Body<3>& body);
  void enter();
  /** The largest distance by which a vertex was drawn in, rounded. */
  double measure() const noexcept;
  void tell(ChangeResults& results) const;
  uint32_t count_unsewn() const noexcept;

  Environment<3>& env_;
  Scene<3>& scene_;
  Edit<3> edit_;  // makes the map ready to change, which the piece needs
  Piece piece_;
  PieceSurface surface_;
  Inset inset_;
  double share_ = 0;
  uint32_t attempts_ = 0;
  Array<uint32_t> tried_;  // places, by vertex
  Array<double> positions_;
  Array<Cell> cells_;
  BodyRecord<3> made_;
  dsw_body_id id_{};
};

}  // namespace dsw

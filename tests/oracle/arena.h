// What bodies and swept edges move in, of either dimension, as those see it who judge what the library says of a
// contact.
#pragma once

#include "exact.h"
#include "names.h"

#include <memory>

namespace dsw::oracle {

struct Sweep {
  Vec from, to, fixed;
  SweepTruth truth;
};

class Arena {
  std::unique_ptr<ExactSweeps> owned_;

 public:
  Arena(size_t d, std::unique_ptr<ExactSweeps> sweeps) : owned_(std::move(sweeps)), dimension(d), exact(*owned_) {}
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  virtual ~Arena() = default;

  const size_t dimension;
  ExactSweeps& exact;

  virtual double size() const = 0;
  /// Whether coordinates are small integers, scaled.
  virtual bool lattice() const = 0;
  virtual const std::vector<dsw_volume_id>& ids() const = 0;  // by cell
  virtual bool marked(int cell) const = 0;
  bool passable(int cell) const { return cell >= 0 && !marked(cell); }
  int locate(const Vec& p) { return exact.locate(p); }
  bool same_volume(dsw_volume_id id, int cell) const;

  /// What is wrong with a reported contact if `event` is the true one; empty if nothing is.
  std::string wrong_event(const Sweep& sweep, const SweepEvent& event, const dsw_sweep& got) const;
  /// What is wrong with a body's reported contact if `event` is the true one. `flight` has the event's own edge or face
  /// alone.
  std::string wrong_contact(const VertexMove& flight, const SweepEvent& event, const dsw_body_contact& contact) const;
  /// What is wrong with a sweep's truth in the eyes of another oracle; empty if nothing is.
  virtual std::string second_normal(const Sweep& sweep) = 0;

 protected:
  struct Wall {
    int cell[2];  // the second < 0: outer boundary
    bool marked;
  };

  /// The walls, faces and tags by number; in the plane faces are sides.
  virtual Wall wall(int face) const = 0;
  virtual const std::vector<int>& faces_of(int cell) const = 0;
  virtual uint32_t tag(int cell) const = 0;
  /// These describe an event at the moving vertex: its face, as seen from cell[0] of what was met, and whether the
  /// normal fits the face.
  virtual int face_of(const SweepEvent& event) const = 0;
  virtual Wall met(const SweepEvent& event) const = 0;
  virtual bool normal_fits(const SweepEvent& event, const double* normal) const = 0;
  /// These describe an event at an edge: the faces round the obstacle, its ends (twice the same: a vertex), its
  /// direction, and what of kind and name is wrong.
  virtual std::vector<int> faces_round(const SweepEvent& event) const = 0;
  virtual std::array<Vec, 2> ends_of(const SweepEvent& event) const = 0;
  virtual std::string wrong_name(const SweepEvent& event, const dsw_sweep& got) const = 0;
  /// An event at a face.
  virtual std::string wrong_at_face(const VertexMove&, const SweepEvent&, const dsw_body_contact&,
                                    const dsw_sweep& /*wall*/) const {
    return " no such event";
  }

  /// Front, face, obstacle and tag alone, at an obstacle round which these faces lie. `alone`: what it may be where
  /// none of them is impassable.
  std::string wrong_wall(const dsw_sweep& got, const std::vector<int>& around,
                         const std::vector<dsw_cell_kind>& alone) const;

 private:
  bool impassable(int face) const;
  int face_named(dsw_face_id id) const;
  std::string wrong_at_path(const SweepEvent& event, const dsw_sweep& got) const;
  std::string wrong_across(const Sweep& sweep, const SweepEvent& event, const dsw_sweep& got) const;
  std::string wrong_place(const Sweep& sweep, const SweepEvent& event, const dsw_sweep& got) const;
};

double dot(const Vec& x, const Vec& y);
double length(const Vec& x);

}  // namespace dsw::oracle

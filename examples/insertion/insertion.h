// One insertion: the catheter is pushed step by step, every step is verified, and what happened is counted.
#ifndef DARTSWEEP_INSERTION_INSERTION_H
#define DARTSWEEP_INSERTION_INSERTION_H

#include "contact_table.h"
#include "verify.h"
#include "vessel.h"
#include "wire.h"

namespace insertion {

// One step.
struct Step {
  std::size_t vertices = 0, contacts = 0, inserted = 0, removed = 0;
  std::uint64_t volumes_visited = 0, orientation_tests = 0;  // 0 without statistics
  double detection_seconds = 0, step_seconds = 0;  // the library's move; all of the step, without the verification
  double reached = 0;                              // along the route
  Wire::RodPart rod;
  bool free = false, all_in = false;  // verified; no link is still to come
};

// Sums over all steps.
struct Totals {
  std::size_t steps = 0, exactly_free = 0, not_free = 0, lost = 0, refused = 0;
  std::size_t edges_verified = 0, vertices_verified = 0;
  std::size_t inserted = 0, removed = 0, most_vertices = 0;
  std::uint64_t most_cells = 0, cells = 0, orientation_tests = 0;
  double detection_seconds = 0, step_seconds = 0, reached = 0, largest_stretch = 0;
  // These count the steps with all links in, or all steps if the links were never all in.
  std::size_t whole_steps = 0, whole_contacts = 0, whole_edges = 0;
  Wire::RodPart rod;                    // sums
  std::vector<double> whole_detection;  // seconds, step by step
};

class Run {
 public:
  // `vessel` has to outlive the run. Throws BadInput where the first link does not fit, LibraryError.
  Run(const Options& options, const Vessel* vessel);

  Step step();
  const Totals& totals() const { return totals_; }
  const ContactTable& table() const { return table_; }
  const Wire& wire() const { return *wire_; }
  const physics::CatheterOptions& made_of() const { return made_of_; }
  // Throws BadInput where not all of it could be written.
  void stop_recording();
  // The contacts of the last step.
  const dsw_body_contact* contacts(std::size_t* count) const;
  bool good() const { return totals_.steps == totals_.exactly_free && totals_.refused == 0; }

 private:
  void start_recording();
  void count_cells(Step* step);
  void add(const Step& step, std::size_t edges);

  const Options options_;
  physics::CatheterOptions made_of_;
  physics::World world_;
  std::unique_ptr<Wire> wire_;
  ContactTable table_;
  Totals totals_;
};

// Inserts the catheter, prints the figures to standard output, and writes what options.out asks for. Whether every step was verified.
// Throws BadInput, std::invalid_argument where there is no route, LibraryError.
bool insert(const Options& options);

// What the catheter is made of: as that of physics/catheter.h in a lumen of 2 mm radius, in one of another radius scaled with it.
physics::CatheterOptions fit_catheter(const Options& options, double radius, double way);

}  // namespace insertion

#endif

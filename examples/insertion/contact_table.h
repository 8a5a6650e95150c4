// Contacts counted: by what of the vessel was touched, by what of the catheter touched it, by the tissue's tag.
#ifndef DARTSWEEP_INSERTION_CONTACT_TABLE_H
#define DARTSWEEP_INSERTION_CONTACT_TABLE_H

#include <dartsweep/dartsweep.h>

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace insertion {

// "plane", "edge" or "vertex".
const char* name_of(dsw_contact_kind kind);

class ContactTable {
 public:
  void add(const dsw_body_contact& contact);

  std::vector<std::string> columns() const;
  // The first cell is the row's name, the others are counts.
  std::vector<std::pair<std::string, std::vector<std::size_t>>> rows() const;
  void print(std::ostream& out) const;
  std::size_t total() const { return all_.total; }

 private:
  struct Counts {
    std::size_t at_vertex = 0, on_edge = 0, total = 0, fresh = 0, lasting = 0;
    void add(const dsw_body_contact& contact);
  };
  Counts all_;
  std::map<dsw_contact_kind, Counts> by_kind_;
  std::map<std::uint32_t, Counts> by_tag_;
};

}  // namespace insertion

#endif

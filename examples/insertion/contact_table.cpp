#include "contact_table.h"

#include <iomanip>

namespace insertion {

const char* name_of(dsw_contact_kind kind) {
  return kind == DSW_CONTACT_PLANE ? "plane" : kind == DSW_CONTACT_EDGE ? "edge" : "vertex";
}

void ContactTable::Counts::add(const dsw_body_contact& contact) {
  ++(contact.edge.generation != 0 ? on_edge : at_vertex);
  ++(contact.history == DSW_HISTORY_LASTING ? lasting : fresh);
  ++total;
}

void ContactTable::add(const dsw_body_contact& contact) {
  all_.add(contact);
  by_kind_[contact.contact.kind].add(contact);
  by_tag_[contact.contact.tag].add(contact);
}

std::vector<std::string> ContactTable::columns() const {
  return {"contacts", "vertex of catheter", "edge of catheter", "all", "new", "lasting"};
}

std::vector<std::pair<std::string, std::vector<std::size_t>>> ContactTable::rows() const {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> rows;
  const auto add = [&rows](const std::string& name, const Counts& c) {
    rows.push_back({name, {c.at_vertex, c.on_edge, c.total, c.fresh, c.lasting}});
  };
  for (const dsw_contact_kind kind : {DSW_CONTACT_PLANE, DSW_CONTACT_EDGE, DSW_CONTACT_VERTEX}) {
    const auto found = by_kind_.find(kind);
    add(name_of(kind), found == by_kind_.end() ? Counts() : found->second);
  }
  for (const auto& [tag, counts] : by_tag_) {
    add("tag " + std::to_string(tag), counts);
  }
  add("all", all_);
  return rows;
}

void ContactTable::print(std::ostream& out) const {
  constexpr int kName = 10;
  const std::vector<std::string> heads = columns();
  out << std::left << std::setw(kName) << heads.front() << std::right;
  for (std::size_t i = 1; i < heads.size(); ++i) {
    out << std::setw(static_cast<int>(heads[i].size()) + 3) << heads[i];
  }
  out << '\n';
  for (const auto& [name, counts] : rows()) {
    out << std::left << std::setw(kName) << name << std::right;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      out << std::setw(static_cast<int>(heads[i + 1].size()) + 3) << counts[i];
    }
    out << '\n';
  }
}

}  // namespace insertion

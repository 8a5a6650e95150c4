#include "response/turns.h"

#include <algorithm>
#include <tuple>

#include "base/search.h"
#include "base/sort.h"
#include "contact/describe.h"

namespace dsw {

template <int D>
void Turns<D>::start(const Body<D>& body) {
  now_ = last_move_ = 0;
  last_.assign(body.vertices.size(), Turn{});
  stopped_.clear();
}

template <int D>
void Turns<D>::note(const Body<D>& body, uint32_t v, const double* before, bool may_go_on, const dsw_body_edit* edits,
                    size_t edit_count) {
  ++now_;
  last_.resize(std::max(last_.size(), body.vertices.size()));
  for (size_t i = 0; i < edit_count; ++i) last_[edits[i].vertex.index] = {now_, now_};
  last_[v].tried = now_;
  if (edit_count != 0 || !std::equal(before, before + D, body.position(v))) last_[v].moved = last_move_ = now_;
  if (may_go_on) stopped_.push_back(v);
}

template <int D>
bool Turns<D>::start_pass(const Body<D>& body, bool meets_bodies) {
  waiting_.clear();
  std::swap(waiting_, stopped_);
  std::reverse(waiting_.begin(), waiting_.end());
  return dsw::any_of(waiting_.begin(), waiting_.end(), [&](uint32_t v) { return may_go_on(body, v, meets_bodies); });
}

template <int D>
bool Turns<D>::may_go_on(const Body<D>& body, uint32_t v, bool meets_bodies) const {
  const Turn& turn = last_[v];
  bool may = turn.moved == turn.tried || (meets_bodies && last_move_ > turn.tried);
  for_each_edge(body, v, [&](uint32_t e) {
    may = may || last_[body.edges[e].other(v)].moved > turn.tried;
    return !may;
  });
  return may;
}

void drop_repeated(MoveRecord& record) {
  const auto key = [&](uint32_t i) {
    const dsw_body_contact& c = record.contacts[i];
    const dsw_contact_partner partner = record.keeps_partners ? record.partners[i] : dsw_contact_partner{};
    const bool of_body = partner.body.generation != 0;
    const uint64_t met = of_body ? part_key(partner) : obstacle_key(c.contact.obstacle);
    return std::make_tuple(c.vertex.index, c.edge.index, c.edge.generation, c.face.index, c.face.generation,
                           partner.body.index, partner.body.generation, met);
  };
  const Memory* const memory = record.contacts.get_allocator().memory;
  const auto count = static_cast<uint32_t>(record.contacts.size());
  Array<uint32_t> latest_first(count, memory);
  for (uint32_t i = 0; i < count; ++i) latest_first[i] = count - 1 - i;
  dsw::sort(latest_first.begin(), latest_first.end(), [&](uint32_t a, uint32_t b) {
    const auto key_a = key(a), key_b = key(b);
    return key_a != key_b ? key_a < key_b : a > b;
  });
  Array<bool> stays(count, true, memory);
  for (uint32_t i = 1; i < count; ++i) {
    stays[latest_first[i]] = key(latest_first[i]) != key(latest_first[i - 1]);
  }
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; ++i) {
    if (!stays[i]) continue;
    record.contacts[kept] = record.contacts[i];
    if (record.keeps_partners) record.partners[kept] = record.partners[i];
    ++kept;
  }
  record.contacts.resize(kept);
  record.previous.resize(kept);
  if (record.keeps_partners) record.partners.resize(kept);
}

template class Turns<2>;
template class Turns<3>;

}  // namespace dsw

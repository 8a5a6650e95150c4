#include "scene/touch_history.h"

#include <algorithm>
#include <tuple>

#include "base/sort.h"
#include "contact/describe.h"

namespace dsw {
namespace {

constexpr uint32_t kMostMoves = 0xffffffffu;

/** One more, but never 0 again. */
uint32_t one_more(uint32_t count) noexcept { return count == kMostMoves ? kMostMoves : count + 1; }

bool is_same(dsw_body_vertex_id a, dsw_body_vertex_id b) noexcept {
  return a.index == b.index && a.generation == b.generation;
}

LastTouch touch_of(const MoveRecord& record, uint32_t i, uint64_t move) noexcept {
  const dsw_body_contact& contact = record.contacts[i];
  LastTouch touch{};
  std::copy_n(contact.point, 3, touch.point);
  std::copy_n(contact.contact.normal, 3, touch.normal);
  touch.move = move;
  touch.obstacle = contact.contact.obstacle;
  if (record.keeps_partners) touch.body = record.partners[i].body;
  touch.vertex = contact.vertex;
  return touch;
}

void fill_in(const LastTouch& touch, uint64_t move, dsw_previous_contact& previous) noexcept {
  std::copy_n(touch.point, 3, previous.point);
  std::copy_n(touch.normal, 3, previous.normal);
  previous.obstacle = touch.obstacle;
  previous.body = touch.body;
  previous.since = static_cast<uint32_t>(std::min<uint64_t>(move - touch.move, kMostMoves));
}

}  // namespace

bool TouchHistory::Stop::operator<(const Stop& other) const noexcept {
  const auto key = [](const Stop& s) {
    return std::make_tuple(s.vertex.index, s.vertex.generation, s.obstacle, s.body.index, s.body.generation, s.contact);
  };
  return key(*this) < key(other);
}

TouchHistory::Stop TouchHistory::to_stop(const MoveRecord& record, uint32_t contact) noexcept {
  const dsw_body_contact& c = record.contacts[contact];
  const dsw_contact_partner partner = record.keeps_partners ? record.partners[contact] : dsw_contact_partner{};
  const uint64_t obstacle = partner.body.generation != 0 ? part_key(partner) : obstacle_key(c.contact.obstacle);
  return {c.vertex, obstacle, partner.body, contact};
}

/** The last contact of a vertex in the move before, with the same obstacle or with any; null without one. */
const TouchHistory::Stop* TouchHistory::find_last(const Stop& wanted, bool same_obstacle) const noexcept {
  Stop first = wanted, end = wanted;
  first.contact = 0;
  end.contact = kMostMoves;
  if (!same_obstacle) {
    first.obstacle = 0;
    first.body = {0, 0};
    end.obstacle = ~uint64_t{0};
    end.body = {kMostMoves, kMostMoves};
  }
  const Stop* last = nullptr;
  for (auto at = std::lower_bound(stops_.begin(), stops_.end(), first); at != stops_.end() && !(end < *at); ++at) {
    if (last == nullptr || at->contact > last->contact) last = &*at;
  }
  return last;
}

void TouchHistory::prepare(const MoveRecord& last) {
  stops_.clear();
  for (uint32_t i = 0; i < last.contacts.size(); ++i) stops_.push_back(to_stop(last, i));
  dsw::sort(stops_.begin(), stops_.end());
  later_.clear();
  later_.reserve(earlier.size() + stops_.size());
}

void TouchHistory::follow(const MoveRecord& last, MoveRecord& next, const SlotPool& vertices) noexcept {
  const auto by_vertex = [](const LastTouch& a, dsw_body_vertex_id b) { return a.vertex.index < b.index; };
  const uint64_t now = moves + 1;  // number of the move that has been made; that of `last` is `moves`
  for (uint32_t i = 0; i < next.contacts.size(); ++i) {
    dsw_previous_contact& previous = next.previous[i];
    const Stop stop = to_stop(next, i);
    const Stop *const same = find_last(stop, true), *const any = same != nullptr ? same : find_last(stop, false);
    next.contacts[i].history = same != nullptr ? DSW_HISTORY_LASTING : DSW_HISTORY_NEW;
    previous.moves = same != nullptr ? one_more(last.previous[same->contact].moves) : 1;
    previous.touching = any != nullptr ? one_more(last.previous[any->contact].touching) : 1;
    if (any != nullptr) {
      fill_in(touch_of(last, any->contact, moves), now, previous);
      continue;
    }
    const auto before = std::lower_bound(earlier.begin(), earlier.end(), stop.vertex, by_vertex);
    if (before != earlier.end() && is_same(before->vertex, stop.vertex)) fill_in(*before, now, previous);
  }
  moves = now;
  if (stops_.empty()) return;
  // The contacts before this move, which take the place of those before them.
  const auto keep = [&](const LastTouch& touch) {
    if (vertices.alive(touch.vertex.index, touch.vertex.generation)) later_.push_back(touch);
  };
  auto old = earlier.begin();
  for (size_t i = 0; i < stops_.size(); ++i) {
    const dsw_body_vertex_id vertex = stops_[i].vertex;
    if (i != 0 && is_same(stops_[i - 1].vertex, vertex)) continue;
    for (; old != earlier.end() && old->vertex.index < vertex.index; ++old) keep(*old);
    if (old != earlier.end() && old->vertex.index == vertex.index) ++old;
    keep(touch_of(last, find_last(stops_[i], false)->contact, now - 1));
  }
  for (; old != earlier.end(); ++old) keep(*old);
  earlier.swap(later_);
}

}  // namespace dsw

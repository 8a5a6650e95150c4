#include "thread.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace knot {
namespace {

constexpr double kRest = 0.3;  // of an edge at the start
constexpr double kShort = 0.1;
constexpr double kOff = 0.02;
constexpr double kFarthest = 0.05;  // in one step
constexpr double kMiddle = 2.1;
constexpr int kIterations = 20;

void must(dsw_status status) {
  if (status != DSW_STATUS_OK) throw std::runtime_error(dsw_last_error_message());
}

using Environment = std::unique_ptr<dsw_environment, dsw_status (*)(dsw_environment*)>;
using Scene = std::unique_ptr<dsw_scene, dsw_status (*)(dsw_scene*)>;

/// A box of unit cubes; those in the middle are the post.
Environment make_environment() {
  constexpr std::int64_t nx = 50, ny = 13, nz = 4;
  std::vector<double> points;
  std::vector<std::int64_t> corners;
  for (std::int64_t z = 0; z <= nz; ++z) {
    for (std::int64_t y = 0; y <= ny; ++y) {
      for (std::int64_t x = 0; x <= nx; ++x) {
        points.push_back(static_cast<double>(x) - 34.5);
        points.push_back(static_cast<double>(y) - 6.5);
        points.push_back(static_cast<double>(z));
      }
    }
  }
  for (std::int64_t z = 0; z < nz; ++z) {
    for (std::int64_t y = 0; y < ny; ++y) {
      for (std::int64_t x = 0; x < nx; ++x) {
        const std::int64_t row = nx + 1, layer = row * (ny + 1), a = x + row * y + layer * z;
        for (const std::int64_t low : {a, a + layer})
          corners.insert(corners.end(), {low, low + 1, low + row + 1, low + row});
      }
    }
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.connectivity = corners.data();
  desc.connectivity_count = corners.size();
  desc.volume_count = corners.size() / 8;
  dsw_environment* raw = nullptr;
  must(dsw_environment_create(nullptr, &desc, &raw, nullptr));
  Environment environment(raw, dsw_environment_destroy);
  for (std::int64_t z = 0; z < nz; ++z) {
    const double inside[3] = {0, 0, static_cast<double>(z) + 0.5};
    dsw_volume_id inside_of;
    must(dsw_environment_locate(raw, inside, dsw_volume_id{0, 0}, &inside_of, nullptr));
    must(dsw_environment_mark_volumes(raw, &inside_of, 1, DSW_MARK_IMPASSABLE, 0, nullptr));
  }
  return environment;
}

/// Where the head is led: past the post, round it, over the thread, under that through the loop, over the loop and away. Before that
/// the thread lies on the first part of this way.
const std::vector<Point>& way_of_head() {
  static const std::vector<Point> way = {
      {-30, -2, kMiddle},   {1.4, -2, kMiddle},   {1.5, -1, kMiddle},  {1.5, 0.8, kMiddle}, {0.9, 1.4, kMiddle},
      {-0.9, 1.4, kMiddle}, {-1.5, 0.8, kMiddle}, {-1.7, -1, 2.5},     {-1.9, -2, 2.9},     {-1.8, -3, kMiddle},
      {-0.9, -3.4, 1.4},    {-0.2, -2.8, 1.2},    {0, -2, 1.2},        {0.2, -1.4, 1.6},    {0.7, -1.2, 2.5},
      {1.5, -1.2, 2.9},     {3, -1.2, 2.5},       {7.5, -1.2, kMiddle}};
  return way;
}
constexpr std::size_t kLaid = 2;       // points of the way that the thread lies on at first
constexpr double kTied = 0.4;          // share of the steps after which the head is at the end of its way
constexpr double kPull = 7;            // then both ends are pulled so far along the first axis, if the thread gives way
constexpr double kMostStretch = 0.02;  // of the thread when it is pulled, as a share of its length

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]); }
Point between(const Point& a, const Point& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

double length_of(const std::vector<Point>& way, std::size_t points) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points; ++i) length += distance(way[i], way[i + 1]);
  return length;
}

/// Where an end is after a part of a way.
Point on_way(const std::vector<Point>& way, double length) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double part = distance(way[i], way[i + 1]);
    if (length < part) return between(way[i], way[i + 1], length / part);
    length -= part;
  }
  return way.back();
}

class Thread {
 public:
  explicit Thread(dsw_scene* scene) : scene_(scene) {
    const double laid = length_of(way_of_head(), kLaid);
    for (int i = 0, count = static_cast<int>(laid / kRest); i <= count; ++i)
      at_.push_back(on_way(way_of_head(), laid * i / count));
    std::vector<std::uint32_t> edges;
    for (std::uint32_t v = 0; v < at_.size(); ++v) {
      along_.push_back({v, v + 1 < at_.size() ? distance(at_[v], at_[v + 1]) : 0, {}, false});
      if (v + 1 < at_.size()) edges.insert(edges.end(), {v, v + 1});
    }
    length_ = 0;
    for (const Link& each : along_) length_ += each.rest;
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    desc.positions = at_[0].data();
    desc.vertex_count = at_.size();
    desc.edges = edges.data();
    desc.edge_count = edges.size() / 2;
    desc.level = DSW_LEVEL_EDGES_SWEPT;
    desc.flags = DSW_BODY_SELF_CONTACTS;
    must(dsw_body_create(scene, &desc, &body_));
    std::vector<dsw_body_edge_id> ids(along_.size());
    std::size_t count = 0;
    must(dsw_body_get_edge_ids(scene, body_, ids.data(), ids.size(), &count));
    for (std::size_t i = 0; i < count; ++i) along_[i].edge = ids[i];
    read();
  }

  /// All of it follows the head, which has gone so far.
  void follow_head(double gone, Figures& figures) {
    std::vector<Point> to = at_;
    double behind = 0;
    for (std::size_t i = along_.size(); i-- > 0;) {
      behind += along_[i].rest;
      to[along_[i].vertex] = on_way(way_of_head(), gone - behind);
    }
    move(to, figures);
    read();
  }

  /// Its ends are pulled to places.
  void pull_ends(const Point& tail, const Point& head, Figures& figures) {
    remesh(figures);
    slip();
    move(pull(tail, head), figures);
  }

  /// How much longer it is than at rest, as a share.
  double stretch() const {
    double length = 0;
    for (std::size_t i = 0; i + 1 < along_.size(); ++i)
      length += distance(at_[along_[i].vertex], at_[along_[i + 1].vertex]);
    return length / length_ - 1;
  }
  const Point& tail() const { return at_[along_.front().vertex]; }
  const Point& head() const { return at_[along_.back().vertex]; }

 private:
  void move(const std::vector<Point>& to, Figures& figures) {
    dsw_move_options options;
    dsw_move_options_init(&options, sizeof options);
    options.vertex_response = DSW_RESPONSE_SLIDE;
    options.edge_response = kAdaptive;
    options.min_part = 0.01;
    options.min_length = 0.02;
    options.noise_share = 0.003;
    options.stand_off = 0.01;
    dsw_move_report report;
    const auto start = std::chrono::steady_clock::now();
    must(dsw_body_move(scene_, body_, to[0].data(), to.size(), 0, &options, &report));
    figures.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    read();
    follow_edits(figures);
    read_contacts(figures);
    figures.most_vertices = std::max(figures.most_vertices, along_.size());
    figures.longest_stretch = std::max(figures.longest_stretch, stretch());
  }

 public:
  View view(std::size_t step) const {
    View view{step, {}, {}};
    for (const Link& each : along_) {
      view.at.push_back(at_[each.vertex]);
      view.inserted.push_back(each.by_response);
    }
    return view;
  }

  /// Whether the library casts every edge without meeting anything, and every two edges without a common vertex are apart.
  bool is_free(const dsw_environment* environment, Figures& figures) const {
    const View now = view(0);
    const std::size_t edges = now.at.size() - 1;
    std::vector<dsw_volume_id> starts;
    std::vector<dsw_flight> flights(edges);
    for (const Link& each : along_) starts.push_back(volumes_[each.vertex]);
    must(dsw_environment_cast_segments(environment, edges, starts.data(), now.at[0].data(), now.at[1].data(), 0,
                                       nullptr, flights.data()));
    figures.edges_cast += edges;
    bool free = std::all_of(flights.begin(), flights.end(),
                            [](const dsw_flight& each) { return each.outcome == DSW_OUTCOME_REACHED; });
    for (std::size_t i = 0; i < edges; ++i) {
      for (std::size_t j = i + 2; j < edges; ++j) {
        free = are_apart(now.at[i], now.at[i + 1], now.at[j], now.at[j + 1]) && free;
        ++figures.pairs_checked;
      }
    }
    return free;
  }

 private:
  struct Link {
    std::uint32_t vertex;
    double rest;            // of the edge to the next one
    dsw_body_edge_id edge;  // that edge
    bool by_response;       // whether the vertex has been inserted by one
  };

  /// A place on the edge between two vertices.
  struct Place {
    std::uint32_t a = 0, b = 0;
    double share = 0;
  };
  /// One place keeps off another in a direction, or off a point.
  struct Contact {
    Place place, other;
    bool of_thread;  // else `point` is what it keeps off
    Point point, normal;
  };

  /// Where all vertices should go: no edge longer than at rest, as far as few passes see to that.
  std::vector<Point> pull(const Point& tail, const Point& head) const {
    std::vector<Point> to = at_;
    const std::size_t last = along_.size() - 1;
    const auto at = [&](std::size_t i) -> Point& { return to[along_[i].vertex]; };
    at(0) = tail;
    at(last) = head;
    const auto shorten = [&](std::size_t i) {
      Point &a = at(i), &b = at(i + 1);
      const double length = distance(a, b), excess = length - along_[i].rest;
      if (excess <= 0) return;
      const double of_a = i == 0 ? 0 : i + 1 == last ? 1 : 0.5, of_b = i + 1 == last ? 0 : 1 - of_a;
      for (std::size_t k = 0; k < 3; ++k) {
        const double way = (b[k] - a[k]) / length * excess;
        a[k] += of_a * way;
        b[k] -= of_b * way;
      }
    };
    const auto at_place = [&](const Place& place) { return between(to[place.a], to[place.b], place.share); };
    const auto shift = [&](const Place& place, double way, const Point& normal) {
      const double of_b = place.share, of_a = 1 - of_b, scale = way / (of_a * of_a + of_b * of_b);
      for (std::size_t k = 0; k < 3; ++k) {
        to[place.a][k] += of_a * scale * normal[k];
        to[place.b][k] += of_b * scale * normal[k];
      }
    };
    const auto hold_off = [&](const Contact& contact) {
      const Point x = at_place(contact.place), y = contact.of_thread ? at_place(contact.other) : contact.point;
      double off = 0;
      for (std::size_t k = 0; k < 3; ++k) off += (x[k] - y[k]) * contact.normal[k];
      if (off >= kOff) return;
      const double share = contact.of_thread ? 0.5 : 1;
      shift(contact.place, share * (kOff - off), contact.normal);
      if (contact.of_thread) shift(contact.other, -share * (kOff - off), contact.normal);
    };
    for (int pass = 0; pass < kIterations; ++pass) {
      for (std::size_t i = last; i-- > 0;) shorten(i);
      for (std::size_t i = 0; i < last; ++i) shorten(i);
      for (const Contact& each : contacts_) {
        if (is_here(each.place) && (!each.of_thread || is_here(each.other))) hold_off(each);
      }
    }
    for (std::size_t i = 1; i < last; ++i) {
      const Point& from = at_[along_[i].vertex];
      const double far = distance(from, at(i));
      if (far > kFarthest) at(i) = between(from, at(i), kFarthest / far);
    }
    return to;
  }

  std::size_t place_of(std::uint32_t vertex) const {
    std::size_t i = 0;
    while (i < along_.size() && along_[i].vertex != vertex) ++i;
    return i;
  }

  void follow_edits(Figures& figures) {
    const dsw_body_edit* edits = nullptr;
    std::size_t count = 0;
    must(dsw_body_get_edits(scene_, body_, &edits, &count));
    for (std::size_t k = 0; k < count; ++k) {
      follow(edits[k], true);
      const Point& at = at_[edits[k].vertex.index];
      const bool at_post = std::max(std::fabs(at[0]), std::fabs(at[1])) < 1.1 * kPostHalf;
      figures.inserted_at_post += edits[k].inserted != 0 && at_post ? 1 : 0;
      ++(edits[k].inserted != 0 ? figures.inserted : figures.removed);
    }
  }

  void follow(const dsw_body_edit& edit, bool by_response) {
    if (edit.inserted != 0) {
      const std::size_t a = place_of(edit.ends[0].index), b = place_of(edit.ends[1].index), i = std::min(a, b);
      const double share = a < b ? edit.edge_parameter : 1 - edit.edge_parameter, rest = along_[i].rest;
      const Link next = {edit.vertex.index, (1 - share) * rest, a < b ? edit.rest : edit.edge, by_response};
      along_[i].rest = share * rest;
      along_[i].edge = a < b ? edit.edge : edit.rest;
      along_.insert(along_.begin() + static_cast<std::ptrdiff_t>(i) + 1, next);
    } else {
      const std::size_t i = place_of(edit.vertex.index);
      along_[i - 1].rest += along_[i].rest;
      if (along_[i - 1].vertex == edit.ends[0].index) along_[i - 1].edge = along_[i].edge;
      along_.erase(along_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  /// The thread slips through a vertex at an obstacle without friction: what is pulled more on one side gives way on the other.
  void slip() {
    for (std::size_t i = 1; i + 1 < along_.size(); ++i) {
      if (!along_[i].by_response) continue;
      const Point& at = at_[along_[i].vertex];
      const double before = distance(at_[along_[i - 1].vertex], at), after = distance(at, at_[along_[i + 1].vertex]);
      const double rest = along_[i - 1].rest + along_[i].rest;
      along_[i - 1].rest = rest * before / (before + after);
      along_[i].rest = rest - along_[i - 1].rest;
    }
  }

  /// So one side gets short and the other long: a vertex that has come to an obstacle is merged, one is put on a long edge.
  void remesh(Figures& figures) {
    for (std::size_t i = 1; i + 2 < along_.size(); ++i) {
      const Link link = along_[i], next = along_[i + 1];
      const double length = distance(at_[link.vertex], at_[next.vertex]);
      dsw_body_edit edit;
      dsw_status status = DSW_STATUS_OCCUPIED;
      if (length < kShort && !(link.by_response && next.by_response)) {
        dsw_body_vertex_id gone;
        must(dsw_body_get_vertex_id(scene_, body_, link.by_response ? next.vertex : link.vertex, &gone));
        status = dsw_body_collapse_edge(scene_, body_, link.edge, gone, &edit);
      } else if (length > 2 * kRest) {
        status = dsw_body_split_edge(scene_, body_, link.edge, 0.5, &edit);
      }
      if (status == DSW_STATUS_OCCUPIED) continue;
      must(status);
      follow(edit, false);
      ++(edit.inserted != 0 ? figures.split : figures.merged);
      if (edit.inserted != 0) ++i;
    }
    read();
  }

  bool is_here(const Place& place) const {
    return place_of(place.a) < along_.size() && place_of(place.b) < along_.size();
  }

  /// The place nearest to a point on the edges from place `first` on the thread to place `last`.
  Place nearest(const Point& point, std::size_t first, std::size_t last) const {
    Place best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < last; ++i) {
      const Point &a = at_[along_[i].vertex], &b = at_[along_[i + 1].vertex];
      double share = 0;
      for (std::size_t k = 0; k < 3; ++k) share += (point[k] - a[k]) * (b[k] - a[k]);
      share = std::max(0.0, std::min(1.0, share / (distance(a, b) * distance(a, b))));
      const double far = distance(between(a, b, share), point);
      if (far >= least) continue;
      least = far;
      best = {along_[i].vertex, along_[i + 1].vertex, share};
    }
    return best;
  }

  /// What has touched keeps off what it has touched in the next step.
  void read_contacts(Figures& figures) {
    const dsw_body_contact* contacts = nullptr;
    const dsw_contact_partner* partners = nullptr;
    std::size_t count = 0;
    must(dsw_body_get_contact_partners(scene_, body_, &partners, &count));
    must(dsw_body_get_contacts(scene_, body_, &contacts, &count));
    contacts_.clear();
    const std::size_t edges = along_.size() - 1;
    for (std::size_t k = 0; k < count; ++k) {
      Contact contact = {{}, {}, partners[k].body.generation != 0, {}, {}};
      ++(contact.of_thread ? figures.at_itself : figures.at_post);
      std::copy_n(contacts[k].point, 3, contact.point.data());
      std::copy_n(contacts[k].contact.normal, 3, contact.normal.data());
      const std::size_t v = place_of(contacts[k].vertex.index);
      if (v > edges) continue;  // it has been removed since
      contact.place = nearest(contact.point, v < 3 ? 0 : v - 3, std::min(v + 3, edges));
      if (contact.of_thread) {
        std::size_t i = 0;
        while (i < edges && along_[i].edge.index != partners[k].edge.index) ++i;
        if (i == edges) continue;
        contact.other = nearest(contact.point, i < 1 ? 0 : i - 1, std::min(i + 2, edges));
      }
      contacts_.push_back(contact);
    }
  }

  void read() {
    dsw_body_counts counts;
    counts.struct_size = sizeof counts;
    must(dsw_body_get_counts(scene_, body_, &counts));
    at_.resize(counts.vertex_slots);
    volumes_.resize(counts.vertex_slots);
    std::size_t count = 0;
    must(dsw_body_get_positions(scene_, body_, at_[0].data(), at_.size(), 0, volumes_.data(), &count));
  }

  dsw_scene* scene_;
  dsw_body_id body_ = {0, 0};
  std::vector<Point> at_;  // by vertex
  std::vector<dsw_volume_id> volumes_;
  std::vector<Contact> contacts_;  // of the last step
  std::vector<Link> along_;        // from the tail to the head
  double length_ = 0;
};

}  // namespace

Figures tie(std::size_t steps, const std::function<void(const View&)>& look) {
  const Environment environment = make_environment();
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_BODY_CONTACTS;
  dsw_scene* raw = nullptr;
  must(dsw_scene_create(environment.get(), &desc, &raw));
  const Scene scene(raw, dsw_scene_destroy);
  Thread thread(scene.get());
  const std::vector<Point>& way = way_of_head();
  const double laid = length_of(way, kLaid), whole = length_of(way, way.size());
  const auto tied = static_cast<std::size_t>(kTied * static_cast<double>(steps));
  Figures figures;
  Point tail = {}, head = {};
  double pulled = 0;
  look(thread.view(0));
  for (std::size_t step = 1; step <= steps; ++step) {
    if (step <= tied) {
      thread.follow_head(laid + (whole - laid) * static_cast<double>(step) / static_cast<double>(tied), figures);
      tail = thread.tail(), head = thread.head();
    } else {
      // Not harder than the thread can bear.
      if (thread.stretch() < kMostStretch) pulled += kPull / static_cast<double>(steps - tied);
      thread.pull_ends({tail[0] - pulled, tail[1], tail[2]}, {head[0] + pulled, head[1], head[2]}, figures);
    }
    ++figures.steps;
    figures.free_steps += thread.is_free(environment.get(), figures) ? 1 : 0;
    look(thread.view(step));
  }
  figures.stretch = thread.stretch();
  return figures;
}

}  // namespace knot

// An environment that bends while bodies move, and what is true of both, over GMP.
#pragma once

#include "together_support.h"

#include <deque>

namespace dsw::oracle {

/// Boxes instead of simplices; in the plane quadrilaterals.
inline Ground make_box_ground(int dimension, int n, double jitter, double marked, Rng& rng) {
  Ground ground;
  ground.dimension = dimension;
  const auto moved = [&](Vec p) {
    bool inner = true;
    for (int k = 0; k < dimension; ++k) inner = inner && p[static_cast<size_t>(k)] > 0 && p[static_cast<size_t>(k)] < n;
    for (int k = 0; inner && k < dimension; ++k) p[static_cast<size_t>(k)] += rng.range(-jitter, jitter);
    return jitter > 0 ? sheared(p, dimension) : p;
  };
  std::map<std::vector<uint32_t>, std::vector<size_t>> sides;
  const auto mark = [&] {
    ground.is_marked.resize(ground.cells.size());
    for (size_t c = 0; c < ground.cells.size(); ++c) {
      ground.is_marked[c] = rng.chance(marked);
      const dsw_volume_id volume = {static_cast<uint32_t>(c), 1};
      if (!ground.is_marked[c]) continue;
      EXPECT_EQ(dsw_environment_mark_volumes(ground.environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                DSW_STATUS_OK);
    }
  };
  const auto is_wall = [&](int a, int b) {
    return b < 0 || ground.is_marked[static_cast<size_t>(a)] || ground.is_marked[static_cast<size_t>(b)];
  };
  if (dimension == 3) {
    std::vector<double> at;
    for (int i = 0; i <= n; ++i) at.push_back(i);
    Mesh mesh = hex_grid(at, at, at);
    for (Vec& p : mesh.points) p = moved(p);
    Place place = place_of(mesh);
    EXPECT_NE(place.environment, nullptr);
    if (place.environment == nullptr) return ground;
    ground.points = mesh.points;
    ground.environment = std::move(place.environment);
    for (const auto& cell : mesh.cells) {
      std::set<uint32_t> corners;
      for (const auto& face : cell.faces) corners.insert(face.begin(), face.end());
      ground.cells.emplace_back(corners.begin(), corners.end());
    }
    mark();
    std::vector<char> face_marked(place.world->faces.size(), 0);
    for (size_t f = 0; f < place.world->faces.size(); ++f) {
      if (place.world->faces[f].cell[1] < 0 || !rng.chance(marked)) continue;
      const dsw_face_id id = face_id(*place.world, static_cast<int>(f));
      EXPECT_EQ(dsw_environment_mark_faces(ground.environment.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
      face_marked[f] = 1;
    }
    for (const Triangle& t : place.world->triangles) {
      std::vector<uint32_t> corners(t.v, t.v + 3);
      std::sort(corners.begin(), corners.end());
      if (is_wall(t.cell[0], t.cell[1]) || face_marked[static_cast<size_t>(t.face)] != 0)
        ground.walls.push_back(corners);
      for (const int cell : t.cell) {
        if (cell >= 0) ground.triangles.push_back({{corners[0], corners[1], corners[2]}, static_cast<uint32_t>(cell)});
      }
    }
    return ground;
  }
  std::vector<double> flat;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      ground.points.push_back(moved({double(x), double(y), 0}));
      flat.insert(flat.end(), ground.points.back().begin(), ground.points.back().begin() + 2);
    }
  }
  std::vector<int32_t> corners;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const auto a = static_cast<uint32_t>(x + (n + 1) * y), d = a + static_cast<uint32_t>(n) + 1;
      ground.cells.push_back({a, a + 1, d + 1, d});
      corners.insert(corners.end(), ground.cells.back().begin(), ground.cells.back().end());
    }
  }
  ground.environment = create_from(uniform_desc(2, DSW_CELL_TYPE_QUAD, 4, flat, corners));
  mark();
  for (size_t c = 0; c < ground.cells.size(); ++c) {
    for (size_t i = 0; i < 4; ++i) {
      std::vector<uint32_t> side = {ground.cells[c][i], ground.cells[c][(i + 1) % 4]};
      std::sort(side.begin(), side.end());
      sides[side].push_back(c);
      ground.triangles.push_back({{side[0], side[1], 0}, static_cast<uint32_t>(c)});
    }
  }
  for (const auto& [side, of] : sides) {
    if (is_wall(static_cast<int>(of[0]), of.size() == 1 ? -1 : static_cast<int>(of[1]))) ground.walls.push_back(side);
  }
  return ground;
}

/// Marks a share of the faces of simplices that are no walls yet.
inline void mark_faces(Ground& ground, double share, Rng& rng) {
  const auto corners = static_cast<size_t>(ground.dimension);
  std::set<std::vector<uint32_t>> walls(ground.walls.begin(), ground.walls.end()), more;
  for (const auto& cell : ground.cells) {
    if (!rng.chance(share)) continue;
    std::vector<uint32_t> side = cell;
    side.erase(side.begin() + static_cast<std::ptrdiff_t>(rng.below(side.size())));
    std::sort(side.begin(), side.end());
    if (walls.count(side) == 0) more.insert(side);
  }
  for (const auto& side : more) {
    const size_t offsets[2] = {0, corners};
    dsw_face_id face;
    ASSERT_EQ(dsw_environment_find_faces(ground.environment.get(), 1, offsets, side.data(), &face, nullptr),
              DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_mark_faces(ground.environment.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    ground.walls.push_back(side);
  }
}

/// Whether the simplices that cells are made of keep their sides on the whole way; all cells, or some.
template <int D>
bool stay_valid(const Ground& ground, bool exact, const std::vector<bool>& some = {}) {
  const auto end = [&](uint32_t v) { return ground.next.empty() ? ground.points[v].data() : ground.next[v].data(); };
  const auto keeps = [&](const MovingPair<D>& pair) { return (exact ? true_kept_side(pair) : kept_side(pair)) != 0; };
  MovingPair<D> pair{};
  if (ground.triangles.empty()) {
    for (size_t c = 0; c < ground.cells.size(); ++c) {
      if (!some.empty() && !some[c]) continue;
      const auto& cell = ground.cells[c];
      for (size_t i = 0; i <= D; ++i) {
        pair.start[i] = ground.points[cell[i]].data();
        pair.end[i] = end(cell[i]);
      }
      if (!keeps(pair)) return false;
    }
    return true;
  }
  for (const auto& triangle : ground.triangles) {
    if (!some.empty() && !some[triangle.cell]) continue;
    const auto& cell = ground.cells[triangle.cell];
    Vec centre[2] = {{0, 0, 0}, {0, 0, 0}};
    for (const uint32_t v : cell) {
      for (size_t k = 0; k < D; ++k) {
        centre[0][k] += ground.points[v][k] / double(cell.size());
        centre[1][k] += end(v)[k] / double(cell.size());
      }
    }
    pair.start[0] = centre[0].data();
    pair.end[0] = centre[1].data();
    for (size_t i = 0; i < D; ++i) {
      pair.start[i + 1] = ground.points[triangle.corners[i]].data();
      pair.end[i + 1] = end(triangle.corners[i]);
    }
    if (!keeps(pair)) return false;
  }
  return true;
}

/// What the library answered, and where all is then.
struct DeformAnswer {
  dsw_status status = DSW_STATUS_OK;
  dsw_deform_report report = {};
  std::vector<dsw_move_report> reports;                 // of the bodies of the call
  std::vector<BodyState> after;                         // of all walkers
  std::vector<std::vector<dsw_body_contact>> contacts;  // of the bodies of the call
  std::vector<dsw_wall_contact> walls;
  std::vector<Vec> points;  // that the environment reads
  double told = 2;          // the least time of a contact
  size_t faults = 0;        // in what it tells
};

inline std::vector<Vec> points_read(const dsw_environment* environment, int dimension, const double** where = nullptr) {
  const double* points = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(environment, &points, &count), DSW_STATUS_OK);
  if (where != nullptr) *where = points;
  std::vector<Vec> all;
  for (size_t v = 0; v < count; ++v) {
    const double* const p = points + v * static_cast<size_t>(dimension);
    all.push_back({p[0], p[1], dimension == 3 ? p[2] : 0});
  }
  return all;
}

inline Walker make_particle(dsw_scene* scene, const Vec& at, bool* made) {
  Walker walker{};
  dsw_particle_id id = {0, 0};
  *made = dsw_particle_create(scene, at.data(), {0, 0}, &id) == DSW_STATUS_OK;
  walker.id = {id.index, id.generation};
  walker.level = DSW_LEVEL_POINTS;
  walker.alone = walker.stands = true;
  walker.state.at = walker.end = {at};
  walker.state.vertices = {{0, 1}};
  walker.state.volumes = {{0, 0}};
  if (!*made) return walker;
  EXPECT_EQ(dsw_particle_get_position(scene, id, nullptr, &walker.state.volumes[0]), DSW_STATUS_OK);
  return walker;
}

inline void read_walker(const dsw_scene* scene, const Walker& of, BodyState& state) {
  if (!of.alone) {
    EXPECT_EQ(read_body(scene, of.id, state), "");
    return;
  }
  state = of.state;
  state.at[0] = {0, 0, 0};
  EXPECT_EQ(dsw_particle_get_position(scene, {of.id.index, of.id.generation}, state.at[0].data(), &state.volumes[0]),
            DSW_STATUS_OK);
}

/// Takes the ground to its next points and those walkers that do not stand to their ends. `array` has to live on.
inline DeformAnswer deform_together(dsw_scene* scene, const Ground& ground, const std::vector<Walker>& walkers,
                                    std::vector<double>& array,
                                    const dsw_scene_deform_options& options = defaults(dsw_scene_deform_options_init)) {
  DeformAnswer answer;
  const auto d = static_cast<size_t>(ground.dimension);
  array.clear();
  for (const Vec& p : ground.next) array.insert(array.end(), p.begin(), p.begin() + ground.dimension);
  const std::vector<double> wanted = array;
  std::vector<dsw_body_id> ids;
  std::vector<Vec> targets;
  std::vector<size_t> called;
  for (size_t i = 0; i < walkers.size(); ++i) {
    if (walkers[i].stands) continue;
    called.push_back(i);
    ids.push_back(walkers[i].id);
    targets.insert(targets.end(), walkers[i].end.begin(), walkers[i].end.end());
  }
  const double* before = nullptr;
  points_read(ground.environment.get(), ground.dimension, &before);
  answer.reports.resize(ids.size());
  answer.status = dsw_scene_deform(scene, array.data(), ground.next.size(), ids.data(), ids.size(),
                                   targets.empty() ? nullptr : targets[0].data(), targets.size(), sizeof(Vec), &options,
                                   &answer.report, answer.reports.data());
  EXPECT_EQ(answer.status, DSW_STATUS_OK) << dsw_last_error_message();
  const auto check = [&](bool ok) { answer.faults += ok ? 0 : 1; };
  const double* where = nullptr;
  answer.points = points_read(ground.environment.get(), ground.dimension, &where);
  const double fraction = answer.report.fraction;
  check(fraction >= 0 && fraction <= 1);
  const bool all_stop = options.stop == DSW_TOGETHER_STOP_ALL;
  check(answer.report.outcome == (answer.report.held_count != 0 ? DSW_DEFORM_HELD
                                  : fraction == 1               ? DSW_DEFORM_DONE
                                  : fraction == 0               ? DSW_DEFORM_REFUSED
                                                                : DSW_DEFORM_FRACTION));
  check(!all_stop || answer.report.held_count == 0);
  check(where == (fraction == 0 ? before : array.data()));
  check((fraction != 0 && fraction != 1) || answer.report.held_count != 0 || array == wanted);
  size_t held = 0;
  for (size_t v = 0; v < ground.points.size(); ++v) {
    for (size_t k = 0; k < d; ++k) {
      const double from = ground.points[v][k], to = ground.next[v][k], at = answer.points[v][k];
      check(!all_stop || std::fabs(from + fraction * (to - from) - at) <= 1e-12);
      check(at >= std::min(from, to) && at <= std::max(from, to));
    }
    held += std::equal(answer.points[v].begin(), answer.points[v].begin() + d, &wanted[v * d]) ? 0 : 1;
  }
  check(fraction != 1 || held == answer.report.held_count);
  size_t called_place = 0;
  for (size_t i = 0; i < walkers.size(); ++i) {
    BodyState& after = answer.after.emplace_back();
    read_walker(scene, walkers[i], after);
    uint32_t not_there = 0;
    for (size_t v = 0; v < after.at.size(); ++v) {
      const Vec &from = walkers[i].state.at[v], &to = walkers[i].end[v];
      not_there += after.at[v] == to ? 0 : 1;
      if (walkers[i].stands) check(after.at[v] == from);
      for (size_t k = 0; all_stop && k < d; ++k) {
        check(std::fabs(from[k] + fraction * (to[k] - from[k]) - after.at[v][k]) <= 1e-12);
      }
    }
    if (walkers[i].stands) continue;
    const dsw_move_report& report = answer.reports[called_place++];
    const dsw_body_contact* contacts = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contacts(scene, walkers[i].id, &contacts, &count), DSW_STATUS_OK);
    answer.contacts.emplace_back(contacts, contacts + count);
    check((!all_stop || report.fraction == fraction) && report.vertices_moved == after.at.size() &&
          report.contact_count == count && report.vertices_stopped == not_there);
    for (size_t k = 0; k < count; ++k) answer.told = std::min(answer.told, contacts[k].time);
  }
  const dsw_wall_contact* walls = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_wall_contacts(ground.environment.get(), &walls, &count), DSW_STATUS_OK);
  check(count == answer.report.contact_count);
  answer.walls.assign(walls, walls + count);
  for (const dsw_wall_contact& wall : answer.walls) {
    answer.told = std::min(answer.told, wall.time);
    check(wall.response == DSW_WALL_STOP && (wall.body.generation != 0) != (wall.particle.generation != 0));
    check(std::equal(wall.from, wall.from + d, ground.points[wall.moving.index].begin()));
    const dsw_volume_id front = wall.contact.front;
    int valid = 0;
    check(dsw_environment_is_valid(ground.environment.get(), front, &valid) == DSW_STATUS_OK && valid == 1);
    const double* const n = wall.contact.normal;
    check(std::fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-9);
    const bool known = std::any_of(walkers.begin(), walkers.end(), [&](const Walker& of) {
      const uint32_t index = of.alone ? wall.particle.index : wall.body.index;
      return of.alone == (wall.particle.generation != 0) && of.id.index == index;
    });
    check(known);
  }
  for (const auto& of : answer.contacts) {
    for (const dsw_body_contact& contact : of) check(!all_stop || contact.time == answer.told);
  }
  for (const dsw_wall_contact& wall : answer.walls) check(!all_stop || wall.time == answer.told);
  return answer;
}

/// How far at most a point goes of what touches first.
inline double way_of_touching(const Ground& ground, const std::vector<Walker>& walkers, const DeformAnswer& answer) {
  double longest = 0;
  const auto add = [&](const double* a, const double* b) {
    for (int k = 0; k < ground.dimension; ++k) longest = std::max(longest, std::fabs(a[k] - b[k]));
  };
  for (const dsw_wall_contact& wall : answer.walls) {
    for (const dsw_vertex_id v : {wall.moving, wall.others[0], wall.others[1]}) {
      if (v.generation != 0) add(ground.points[v.index].data(), ground.next[v.index].data());
    }
    for (const Walker& of : walkers) {
      if (of.alone || of.id.index != wall.body.index) continue;
      const auto add_vertex = [&](uint32_t v) { add(of.state.at[v].data(), of.end[v].data()); };
      if (wall.vertex.generation != 0) add_vertex(wall.vertex.index);
      for (size_t e = 0; e < of.state.edges.size(); ++e) {
        if (wall.edge.generation == 0 || of.state.edge_ids[e].index != wall.edge.index) continue;
        for (const uint32_t v : of.state.edges[e]) add_vertex(v);
      }
      for (size_t f = 0; f < of.state.faces.size(); ++f) {
        if (wall.face.generation == 0 || of.state.face_ids[f].index != wall.face.index) continue;
        for (const uint32_t v : of.state.faces[f]) add_vertex(v);
      }
    }
  }
  for (const auto& of : answer.contacts) {
    for (const dsw_body_contact& contact : of) add(contact.from, contact.to);
  }
  return longest;
}

/// How many vertices do not lie in passable valid volumes that the library locates, too.
inline size_t misplaced(const Ground& ground, const std::vector<BodyState>& all, bool locates) {
  size_t wrong = 0;
  for (const BodyState& state : all) {
    for (size_t v = 0; v < state.at.size(); ++v) {
      dsw_volume_id found = {0, 0};
      int valid = 0, impassable = 1;
      const dsw_volume_id volume = state.volumes[v];
      bool ok = dsw_environment_is_valid(ground.environment.get(), volume, &valid) == DSW_STATUS_OK && valid == 1;
      ok = ok &&
           dsw_environment_is_impassable(ground.environment.get(), cell_of(volume), &impassable) == DSW_STATUS_OK &&
           impassable == 0;
      ok = ok &&
           dsw_environment_locate(ground.environment.get(), state.at[v].data(), volume, &found, nullptr) ==
               DSW_STATUS_OK &&
           same(found, volume);
      if (ok && locates) {
        ok = dsw_environment_locate(ground.environment.get(), state.at[v].data(), {0, 0}, &found, nullptr) ==
                 DSW_STATUS_OK &&
             same(found, volume);
      }
      wrong += ok ? 0 : 1;
    }
  }
  return wrong;
}

/// How many bodies are not free when the library looks anew.
inline size_t not_free(dsw_scene* scene, const std::vector<Walker>& walkers) {
  size_t wrong = 0;
  for (const Walker& each : walkers) {
    if (each.alone || each.level == DSW_LEVEL_POINTS) continue;
    EXPECT_EQ(dsw_body_set_level(scene, each.id, DSW_LEVEL_POINTS), DSW_STATUS_OK);
    wrong += dsw_body_set_level(scene, each.id, each.level) == DSW_STATUS_OK ? 0 : 1;
  }
  return wrong;
}

}  // namespace dsw::oracle

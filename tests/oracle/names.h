// Numbers, points and ids as text, exact enough to be typed in again.
#pragma once

#include "dartsweep/dartsweep.h"

#include <array>
#include <cstdio>
#include <string>

namespace dsw::oracle {

inline std::string number(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

inline std::string hex(const double* v) { return "{" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + "}"; }
inline std::string hex(const std::array<double, 3>& v) { return hex(v.data()); }

template <class Id>
std::string name(Id id) {
  return std::to_string(id.index) + "." + std::to_string(id.generation);
}
template <class Id>
std::string name_in_volume(Id id) {
  return std::to_string(id.volume) + "." + std::to_string(id.generation) + "/" + std::to_string(id.local);
}
inline std::string name(dsw_face_id id) { return name_in_volume(id); }
inline std::string name(dsw_edge_id id) { return name_in_volume(id); }

/// Members of descriptions and reports are compared with null ids.
inline bool none(dsw_face_id id) { return id.volume == 0 && id.generation == 0 && id.local == 0; }
inline bool none(const dsw_cell& c) { return c.kind == 0 && c.index == 0 && c.generation == 0 && c.local == 0; }
/// Whether the obstacle of a contact is its wall.
inline bool names_wall(const dsw_contact& c) {
  return c.obstacle.kind == DSW_CELL_FACE && c.obstacle.index == c.wall.volume &&
         c.obstacle.generation == c.wall.generation && c.obstacle.local == c.wall.local;
}

template <class Id>
bool same_id(Id a, Id b) {
  return a.index == b.index && a.generation == b.generation;
}

}  // namespace dsw::oracle

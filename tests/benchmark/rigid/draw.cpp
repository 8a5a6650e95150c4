// Cases at random. Half of them have something planted beside the arc of one of the body's vertices or edges.
#include "room.h"

namespace dsw::rigid {

namespace {

constexpr double kPi = 3.14159265358979323846;

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

Point point_in(Random& random, int dimension, double low, double high) {
  Point p{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) p[k] = random.uniform(low, high);
  return p;
}

Point direction(Random& random, int dimension) {
  while (true) {
    const Point p = point_in(random, dimension, -1, 1);
    if (length(p) > 0.1 && length(p) < 1) return unit(p);
  }
}

Point turned(const Point& x, const Point& axis, double angle) {
  return std::cos(angle) * x + std::sin(angle) * cross(axis, x) + (1 - std::cos(angle)) * dot(axis, x) * axis;
}

/** Joins points, of which there are enough. In space sheets are fans round the first of them. */
Figure joined(BodyKind kind, int dimension, const std::vector<Point>& points) {
  Figure body;
  body.points = points;
  const auto count = static_cast<std::uint32_t>(points.size());
  if (kind == BodyKind::kRod || dimension == 2) {
    for (std::uint32_t i = 1; i < count; ++i) body.add_edge(i - 1, i);
    if (kind == BodyKind::kClosed && count > 2) body.add_edge(0, count - 1);
  } else if (kind == BodyKind::kSheet) {
    for (std::uint32_t i = 2; i < count; ++i) body.add_face(0, i - 1, i);
  } else {  // two fans
    const std::uint32_t last = count - 1;
    for (std::uint32_t i = 1; i < last; ++i) {
      const std::uint32_t next = i + 1 < last ? i + 1 : 1;
      body.add_face(0, i, next);
      body.add_face(last, next, i);
    }
  }
  return body;
}

std::size_t draw_count(BodyKind kind, int dimension, Random& random) {
  if (kind == BodyKind::kRod) return 2 + random.index(3);
  if (dimension == 2) return 3 + random.index(2);
  return (kind == BodyKind::kSheet ? 3 : 5) + random.index(4);
}

void set_rotation(const Point& axis, double angle, dsw_rigid_motion& motion) {
  for (std::size_t k = 0; k < 3; ++k) motion.rotation[k] = std::sin(0.5 * angle) * axis[k];
  motion.rotation[3] = std::cos(0.5 * angle);
}

void draw_freely(int dimension, Random& random, double angle, Case& c) {
  const std::size_t count = draw_count(c.kind, dimension, random);
  const Point middle = point_in(random, dimension, 0.3, Room::kCells - 0.3);
  const double size = random.uniform(0.05, 0.7);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(middle + size * point_in(random, dimension, -1, 1));
  c.body = joined(c.kind, dimension, points);
  set_rotation(dimension == 3 ? direction(random, 3) : Point{0, 0, 1}, angle, c.motion);
  const Point centre = point_in(random, dimension, 0, Room::kCells);
  std::copy(centre.begin(), centre.end(), c.motion.centre);
  if (random.index(2) == 0) {
    const Point way = random.uniform() * point_in(random, dimension, -1, 1);
    std::copy(way.begin(), way.end(), c.motion.translation);
  }
  if (random.index(2) == 0) {
    Figure other;
    for (int i = 0; i < dimension; ++i) other.points.push_back(point_in(random, dimension, 0.1, Room::kCells - 0.1));
    if (dimension == 3) {
      other.add_face(0, 1, 2);
    } else {
      other.add_edge(0, 1);
    }
    c.others.push_back(other);
  }
}

/** Where what is planted touches: a place, the direction in which the arc comes to it, and the axis of the turn. */
struct Target {
  Point place, out, axis;
};

Target at_wall(const Room& room, Random& random) {
  const Figure& walls = room.walls();
  Target target;
  if (room.dimension() == 2) {
    const Part& wall = walls.edges[random.index(walls.edges.size())];
    const Point &a = walls.points[wall.at[0]], &b = walls.points[wall.at[1]];
    target.place = a + random.uniform(0.05, 0.95) * (b - a);
    target.out = unit({b[1] - a[1], a[0] - b[0], 0});
    target.axis = {0, 0, 1};
  } else {
    const Part& wall = walls.faces[random.index(walls.faces.size())];
    const Point &a = walls.points[wall.at[0]], &b = walls.points[wall.at[1]], &c = walls.points[wall.at[2]];
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    target.place = a + (0.05 + 0.85 * u) * (b - a) + (0.05 + 0.85 * v) * (c - a);
    target.out = unit(cross(b - a, c - a));
    target.axis = unit(cross(target.out, direction(random, 3)));
  }
  if (random.index(2) == 0) target.out = -1 * target.out;
  return target;
}

Target anywhere(int dimension, Random& random) {
  Target target;
  target.place = point_in(random, dimension, 0.4, Room::kCells - 0.4);
  target.out = direction(random, dimension);
  target.axis = dimension == 3 ? unit(cross(target.out, direction(random, 3))) : Point{0, 0, 1};
  return target;
}

/** A body with a corner, an edge or its inside at the place; else it lies beyond, in the direction `away`. */
Figure obstacle_at(const Point& place, const Point& away, int dimension, Random& random) {
  const double size = random.uniform(0.02, 0.2);
  const auto beyond = [&] {
    const Point p = size * (away + 0.9 * direction(random, dimension));
    return place + p + std::max(0.0, 0.05 * size - dot(p, away)) * away;
  };
  Figure other;
  if (dimension == 2) {
    other.points = {place, beyond()};
    other.add_edge(0, 1);
    return other;
  }
  const std::size_t how = random.index(3);
  const Point along = unit(cross(away, direction(random, 3))), across = cross(away, along);
  if (how == 0) {
    other.points = {place, beyond(), beyond()};
  } else if (how == 1) {
    other.points = {place + size * random.uniform(0.1, 1) * along, place - size * random.uniform(0.1, 1) * along,
                    beyond()};
  } else {
    other.points = {place + size * along, place + size * (-0.5 * along + across),
                    place + size * (-0.5 * along - across)};
  }
  other.add_face(0, 1, 2);
  return other;
}

void draw_planted(const Room& room, Random& random, double angle, Case& c) {
  const int dimension = room.dimension();
  const std::size_t drawn = random.index(4);
  const Near near = drawn < 2 ? Near::kVertex : drawn == 2 && dimension == 3 ? Near::kEdgeAlong : Near::kEdgeInside;
  c.near = near;
  const bool is_wall = near != Near::kEdgeInside && random.index(2) == 0;
  const Target target = is_wall ? at_wall(room, random) : anywhere(dimension, random);
  const Point along = cross(target.axis, target.out);
  const double radius = log_uniform(random, 0.05, std::min(3.0, 0.05 + 1.5 / angle));
  const double size = random.uniform(0.05, 0.5) * (near == Near::kEdgeInside ? 1 : std::min(1.0, radius / 0.5));
  const double inside = near == Near::kEdgeInside ? -1 : 1, sagitta = radius * (1 - std::cos(angle / 2000));
  const double ten = std::pow(10, -random.uniform(9, 15));
  // The depth to which the arc, or at the inner side the obstacle, goes into the other.
  c.depth = c.plant == Plant::kHidden   ? inside * random.uniform(0.05, 0.95) * sagitta
            : c.plant == Plant::kMissed ? -ten
                                        : ten;
  const Point centre = target.place - (radius - inside * c.depth) * target.out, apex = centre + radius * target.out;
  std::vector<Point> points{apex};
  if (near == Near::kEdgeAlong) {
    points = {apex + size * random.uniform(0.1, 1) * target.axis, apex - size * random.uniform(0.1, 1) * target.axis};
  } else if (near == Near::kEdgeInside) {
    points = {apex + size * random.uniform(0.1, 1) * along, apex - size * random.uniform(0.1, 1) * along};
  }
  const std::size_t count = std::max(draw_count(c.kind, dimension, random), points.size());
  for (int tries = 0; points.size() < count && tries < 1000; ++tries) {
    const Point p = apex + size * point_in(random, dimension, -1, 1);
    const Point from_axis = (p - centre) - dot(p - centre, target.axis) * target.axis;
    const bool is_right =
        near == Near::kEdgeInside ? dot(p - apex, target.out) > 0.02 * size : length(from_axis) < radius - 0.02 * size;
    if (is_right) points.push_back(p);
  }
  const double before = random.uniform(0.2, 0.8) * angle;
  const double time = std::sin(0.5 * before) / (std::sin(0.5 * before) + std::sin(0.5 * (angle - before)));
  const Point way = (dimension == 3 && random.index(2) == 0 ? random.uniform(-0.5, 0.5) : 0) * target.axis;
  for (Point& p : points) p = centre + turned(p - time * way - centre, target.axis, -before);
  c.body = joined(c.kind, dimension, points);
  set_rotation(target.axis, angle, c.motion);
  for (std::size_t k = 0; k < 3; ++k) {
    c.motion.centre[k] = centre[k];
    c.motion.translation[k] = way[k];
  }
  if (!is_wall) c.others.push_back(obstacle_at(target.place, inside * target.out, dimension, random));
}

}  // namespace

Case draw_case(const Room& room, Random& random) {
  Case c;
  c.kind = static_cast<BodyKind>(random.index(3));
  c.degrees = random.index(16) == 0 ? 180 : log_uniform(random, 1e-6, 180);
  if (random.index(2) == 0) c.degrees = random.uniform(1, 180);
  const double angle = c.degrees * kPi / 180;
  const std::size_t drawn = random.index(8);
  c.plant = drawn < 4 ? Plant::kNone : drawn < 6 ? Plant::kHidden : drawn == 6 ? Plant::kMissed : Plant::kGrazed;
  if (c.plant == Plant::kNone) {
    draw_freely(room.dimension(), random, angle, c);
  } else {
    draw_planted(room, random, angle, c);
  }
  return c;
}

}  // namespace dsw::rigid

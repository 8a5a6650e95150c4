// Tetrahedra as they look along the lines of casts, kAbreast of them at a time. A cast has come into its tetrahedron
// through a triangle, of which the line's shear (shear.h) is known. The one vertex that is new tells by three line tests
// which of the three other facets the line leaves through. That facet shares an edge with the triangle and replaces one
// corner: the weight of the new corner is the line test of that edge, known from before. With the weights W, each the
// line test of the edge opposite, the line pierces a facet at the depth sum(W z) / sum(W), z being the depth of a corner
// behind the target. So its sign tells whether the target comes first.
//   With u and M as in shear.h a weight is at most 8 M^2 and off by 88 u M^2. A depth is at most 2 M, and off by 3 u M
// since it is the difference of two differences. The sum with its three roundings for each term is off by
// (3 * 88 * 2 + 3 * 8 * 3 + 3 * 8 * 2 * 3) u M^3 < 8 * 128 u M^3.

/** Casts by slots. Whoever takes a slot away moves the last one there. */
class Sightlines {
 public:
  /** What a step says of a slot: neither of the first two if the filter left it open, and kCorner times the corner of
   * the triangle that the new vertex replaces. */
  enum : uint32_t { kLeaves = 1, kStays = 2, kCorner = 4 };

  /** Of kAbreast casts: p -> q, and the triangles that they came in through, the corners of each counter-clockwise seen
   * from where the cast comes. `vertex(lane, corner)` is a corner's number. @return which of them pass their triangles for certain.
   */
  template <class From, class To, class Vertex>
  DSW_HOT uint32_t start(uint32_t first, const double* points, From from, To to, Vertex vertex) noexcept {
    const PointsOf<Row> p = load_points(from), q = load_points(to);
    const Row x = q.x - p.x, y = q.y - p.y, z = q.z - p.z;
    const Row ax = Row::absolute(x), ay = Row::absolute(y), az = Row::absolute(z);
    const Row::Mask along_y = Row::greater(ay, ax), along_z = Row::greater(az, largest(ay, ax));
    const Row zero = Row::all(0), one = Row::all(1);
    const Turned d = turn_axes({x, y, z}, along_y, along_z);
    const Row::Mask down = Row::greater(zero, d.k);
    put(kFromX, first, p.x), put(kFromY, first, p.y), put(kFromZ, first, p.z);
    put(kAlongY, first, Row::select(along_y, one, zero)), put(kAlongZ, first, Row::select(along_z, one, zero));
    put(kForward, first, Row::select(down, zero - one, one));
    put(kLength, first, d.k);
    put(kSlopeI, first, divide(d.i, d.k)), put(kSlopeJ, first, divide(d.j, d.k));
    put(kLargest, first, Row::absolute(d.k));
    const uint32_t downs = Row::bits(down);  // there the shear turns the triangle round
    Corner corners[3];
#pragma GCC unroll 3
    for (uint32_t c = 0; c < 3; ++c) {
      const auto number = [&](uint32_t lane) {
        return vertex(lane, c == 0 ? 0 : (downs >> lane & 1u) != 0 ? c : 3 - c);
      };
      for (uint32_t lane = 0; lane < kAbreast; ++lane) vertices_[c][first + lane] = number(lane);
      corners[c] = see(first, load_points([&](uint32_t lane) {
                         return points + size_t{vertices_[c][first + lane]} * 3;
                       }));
      put(kCorners + c, first, corners[c].i), put(kCorners + 3 + c, first, corners[c].j);
      put(kCorners + 6 + c, first, corners[c].z);
    }
    const Row bound = side_bound(get(kLargest, first));
    Row lowest = Row::all(HUGE_VAL);
#pragma GCC unroll 3
    for (uint32_t c = 0; c < 3; ++c) {
      const Row weight = side(corners[(c + 1) % 3], corners[(c + 2) % 3]);
      put(kCorners + 9 + c, first, weight);
      lowest = least(lowest, weight);
    }
    return Row::bits(Row::greater(lowest, bound));
  }

  /** `at(lane)`: where the new vertex lies. */
  template <class At>
  DSW_HOT void step(uint32_t first, At at) noexcept {
    const Corner tip = see(first, load_points(at));
    const Row largest = get(kLargest, first), bound = side_bound(largest), minus_bound = Row::all(0) - bound;
    Corner corners[3];
    Row sides[3], weights[3];
    Row::Mask left[3], right[3];
#pragma GCC unroll 3
    for (uint32_t c = 0; c < 3; ++c) {
      corners[c] = {get(kCorners + c, first), get(kCorners + 3 + c, first), get(kCorners + 6 + c, first)};
      weights[c] = get(kCorners + 9 + c, first);
      sides[c] = side(tip, corners[c]);
      left[c] = Row::greater(sides[c], bound);
      right[c] = Row::greater(minus_bound, sides[c]);
    }
    Row::Mask replaced[3];
#pragma GCC unroll 3
    for (uint32_t c = 0; c < 3; ++c) replaced[c] = both(left[(c + 1) % 3], right[(c + 2) % 3]);
    Row depth = Row::all(0);
#pragma GCC unroll 3
    for (uint32_t c = 0; c < 3; ++c) {
      const uint32_t next = (c + 1) % 3, last = (c + 2) % 3;
      const Row weight = Row::select(replaced[next], sides[last],
                                     Row::select(replaced[last], Row::all(0) - sides[next], weights[c]));
      const Row z = Row::select(replaced[c], tip.z, corners[c].z);
      put(kCorners + c, first, Row::select(replaced[c], tip.i, corners[c].i));
      put(kCorners + 3 + c, first, Row::select(replaced[c], tip.j, corners[c].j));
      put(kCorners + 6 + c, first, z);
      put(kCorners + 9 + c, first, weight);
      depth = c == 0 ? weight * z : depth + weight * z;
    }
    depth = depth * get(kForward, first);
    const Row depth_bound = Row::all(8) * bound * largest;
    const Row::Mask settled = both(either(either(replaced[0], replaced[1]), replaced[2]),
                                   both(Row::greater(largest, Row::all(kLeast)), Row::greater(Row::all(kMost), largest)));
    FacetSets seen;
    seen.add(kLeaves, both(settled, Row::greater(Row::all(0) - depth_bound, depth)));
    seen.add(kStays, both(settled, Row::greater(depth, depth_bound)));
    seen.add(1 * kCorner, replaced[1]);
    seen.add(2 * kCorner, replaced[2]);
    seen.store(seen_[first / kAbreast]);
  }
  uint32_t seen(uint32_t slot) const noexcept { return static_cast<uint32_t>(seen_[slot / kAbreast][slot % kAbreast]); }

  /** Puts a vertex in the place of a corner. @return the one that was there. */
  DSW_HOT uint32_t exchange(uint32_t slot, uint32_t corner, uint32_t vertex) noexcept {
    return std::exchange(vertices_[corner][slot], vertex);
  }

  /** A slot takes over from another. */
  DSW_HOT void move(uint32_t from, uint32_t to) noexcept {
#pragma GCC unroll 1
    for (auto& row : rows_) row[to] = row[from];
    for (auto& corner : vertices_) corner[to] = corner[from];
    seen_[to / kAbreast][to % kAbreast] = seen_[from / kAbreast][from % kAbreast];
  }

 private:
  enum : uint32_t { kFromX, kFromY, kFromZ, kAlongY, kAlongZ, kForward, kLength, kSlopeI, kSlopeJ, kLargest, kCorners };
  static constexpr uint32_t kRows = kCorners + 12;  // i, j, z and the weight of each corner
  static constexpr double kLeast = 1e-90, kMost = 1e100;  // of M: its cube stays normal

  struct Turned {
    Row i, j, k;
  };
  struct Corner {
    Row i, j, z;
  };

  DSW_HOT Row get(uint32_t row, uint32_t first) const noexcept { return load_row(rows_[row] + first); }
  DSW_HOT void put(uint32_t row, uint32_t first, Row values) noexcept { store_row(rows_[row] + first, values); }
  static DSW_HOT Row side_bound(Row largest) noexcept { return Row::all(Shear::bound(1)) * largest * largest; }
  static DSW_HOT Row side(const Corner& a, const Corner& b) noexcept { return a.i * b.j - a.j * b.i; }

  /** Coordinates by axes: k the longest of the line, i and j the next ones round. */
  static DSW_HOT Turned turn_axes(const PointsOf<Row>& v, Row::Mask along_y, Row::Mask along_z) noexcept {
    return {Row::select(along_z, v.x, Row::select(along_y, v.z, v.y)),
            Row::select(along_z, v.y, Row::select(along_y, v.x, v.z)),
            Row::select(along_z, v.z, Row::select(along_y, v.y, v.x))};
  }

  DSW_HOT Corner see(uint32_t first, const PointsOf<Row>& at) noexcept {
    const PointsOf<Row> v = {at.x - get(kFromX, first), at.y - get(kFromY, first), at.z - get(kFromZ, first)};
    const Row most = largest(largest(Row::absolute(v.x), Row::absolute(v.y)), Row::absolute(v.z));
    put(kLargest, first, largest(get(kLargest, first), most));
    const Row half = Row::all(0.5);
    const Turned a =
        turn_axes(v, Row::greater(get(kAlongY, first), half), Row::greater(get(kAlongZ, first), half));
    return {a.i - get(kSlopeI, first) * a.k, a.j - get(kSlopeJ, first) * a.k, a.k - get(kLength, first)};
  }

  alignas(64) double rows_[kRows][kPacket];
  uint32_t vertices_[3][kPacket];
  FacetSet seen_[kPacket / kAbreast][kAbreast];
};

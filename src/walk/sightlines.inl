// Tetrahedra as they look along the lines of casts, kAbreast of them at a time. A cast has come into its tetrahedron
// through a triangle, of which the line's shear (shear.h) is known. The one vertex that is new tells by three line
// tests which of the three other facets the line leaves through. The new vertex replaces the corner that this facet has
// not. The weight of the new corner is known from before: it is the line test of the edge that both triangles have.
// With the weights W, each the line test of the edge opposite, the line pierces a facet at the depth sum(W z) / sum(W),
// z being the depth of a corner behind the target. So its sign tells whether the target comes first.
//   With u and M as in shear.h a weight is at most 8 M^2 and off by 88 u M^2. A depth is the difference of two
// differences: at most 2 M, and off by 4 u M. The sum has three terms of at most 16 M^3, and each meets three
// roundings. So the sum is off by (3 * 88 * 2 + 3 * 8 * 4 + 3 * 16 * 3) u M^3 < 8 * 128 u M^3.

/** Casts by slots: slot s is lane s % kAbreast of group s / kAbreast. The caller keeps slots dense: it moves the last
 * one to one that it frees. All that a group holds lies side by side, so a step finds it by one address. */
class Sightlines {
 public:
  static constexpr uint32_t kGroups = kPacket / kAbreast;

  /** What a step says of a group, a bit for each lane. Neither: the filter left it open. */
  struct Steps {
    uint32_t leaves, stays;
  };

  /** Starts casts p -> q in the lanes of a group from `begin` on, in the triangles that they came in through, whose
   * corners are counter-clockwise seen from where the cast comes. `vertex(lane, corner)` is a corner's number.
   * @return for which of them the filter proves that the line passes the triangle. */
  template <class From, class To, class Vertex>
  DSW_HOT uint32_t start(uint32_t group, uint32_t begin, const double* points, From from, To to,
                         Vertex vertex) noexcept {
    Rows beside;  // lanes below `begin` keep what they have
    Rows& started = begin == 0 ? rows_[group] : beside;
    const uint32_t passing = start(started, points, from, to, vertex);
    if (begin == 0) return passing;
    Rows& rows = rows_[group];
    const Row::Mask from_begin = mask_of(~0u << begin & ((1u << kAbreast) - 1));
    for (uint32_t row = 0; row < kTip; ++row) rows.put(row, Row::select(from_begin, beside.get(row), rows.get(row)));
    return passing;
  }

  /** Names the vertex that the next step of a lane reads. */
  DSW_HOT void aim(uint32_t group, uint32_t lane, uint32_t vertex) noexcept {
    rows_[group].of[kTip][lane] = as_double(vertex);
  }
  /** The corner that the last step has replaced. */
  DSW_HOT uint32_t gone(uint32_t group, uint32_t lane) const noexcept {
    return as_number(rows_[group].of[kGone][lane]);
  }

  /** Reads the vertices that a group has been aimed at. `read` is not part of `step`: a processor does not look far
   * enough ahead to begin the next group's loads while it tests this one. */
  DSW_HOT void read(uint32_t group, const double* points) noexcept {
    Rows& rows = rows_[group];
    const Corner tip =
        see(rows, load_points([&](uint32_t lane) { return points + size_t{as_number(rows.of[kTip][lane])} * 3; }));
    rows.put(kTipI, tip.i), rows.put(kTipJ, tip.j), rows.put(kTipZ, tip.z);
  }

  /** Tells what the new vertices of a group say, after it has read. Then each slot holds the facet that its cast leaves
   * through. */
  DSW_HOT Steps step(uint32_t group) noexcept {
    Rows& rows = rows_[group];
    const Corner tip = {rows.get(kTipI), rows.get(kTipJ), rows.get(kTipZ)};
    const Row largest = rows.get(kLargest), bound = side_bound(largest), minus_bound = Row::all(0) - bound;
    Corner corners[3];
    Row sides[3], weights[3];
    Row::Mask left[3], right[3];
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      corners[c] = {rows.get(kCorners + c), rows.get(kCorners + 3 + c), rows.get(kCorners + 6 + c)};
      weights[c] = rows.get(kCorners + 9 + c);
      sides[c] = side(tip, corners[c]);
      left[c] = Row::greater(sides[c], bound);
      right[c] = Row::greater(minus_bound, sides[c]);
    }
    Row::Mask replaced[3];
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) replaced[c] = both(left[(c + 1) % 3], right[(c + 2) % 3]);
    Row depth = Row::all(0);
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      const uint32_t next = (c + 1) % 3, last = (c + 2) % 3;
      const Row weight =
          Row::select(replaced[next], sides[last], Row::select(replaced[last], Row::all(0) - sides[next], weights[c]));
      const Row z = Row::select(replaced[c], tip.z, corners[c].z);
      rows.put(kCorners + c, Row::select(replaced[c], tip.i, corners[c].i));
      rows.put(kCorners + 3 + c, Row::select(replaced[c], tip.j, corners[c].j));
      rows.put(kCorners + 6 + c, z);
      rows.put(kCorners + 9 + c, weight);
      depth = c == 0 ? weight * z : depth + weight * z;
    }
    depth = depth * rows.get(kForward);
    const Row depth_bound = Row::all(8) * bound * largest;
    const Row::Mask decided = both(either(either(replaced[0], replaced[1]), replaced[2]), is_in_range(largest));
    const Row tips = rows.get(kTip);
    Row gone = rows.get(kVertices);
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      const Row vertices = rows.get(kVertices + c);
      rows.put(kVertices + c, Row::select(replaced[c], tips, vertices));
      if (c != 0) gone = Row::select(replaced[c], vertices, gone);
    }
    rows.put(kGone, gone);
    return {Row::bits(both(decided, Row::greater(Row::all(0) - depth_bound, depth))),
            Row::bits(both(decided, Row::greater(depth, depth_bound)))};
  }

  /** A slot takes over from another. */
  DSW_HOT void move(uint32_t from, uint32_t to) noexcept {
    const double* const old = rows_[from / kAbreast].of[0] + from % kAbreast;
    double* const now = rows_[to / kAbreast].of[0] + to % kAbreast;
    DSW_UNROLL(8)
    for (uint32_t row = 0; row < kMoved; ++row) now[row * kAbreast] = old[row * kAbreast];
  }

 private:
  enum : uint32_t {
    kFromX,
    kFromY,
    kFromZ,
    kAlongY,  // masks, stored as bits
    kAlongZ,
    kForward,
    kLength,
    kSlopeI,
    kSlopeJ,
    kLargest,
    kCorners,                   // i of each, j, z, and the weights
    kVertices = kCorners + 12,  // numbers of the corners, as bits
    kGone = kVertices + 3,      // number of the corner that the last step has replaced
    kTip,                       // number of the tip
    kMoved,                     // rows below it go with a cast; the others hold values within one pass only
    kTipI = kMoved,
    kTipJ,
    kTipZ,
    kRows
  };
  static constexpr double kLeast = 1e-90, kMost = 1e100;  // of M: its cube stays normal

  struct Turned {
    Row i, j, k;
  };
  struct Corner {
    Row i, j, z;
  };
  /** What a group holds. */
  struct alignas(8 * kAbreast) Rows {
    double of[kRows][kAbreast];

    DSW_HOT Row get(uint32_t row) const noexcept { return load_row(of[row]); }
    DSW_HOT void put(uint32_t row, Row values) noexcept { store_row(of[row], values); }
  };

  static DSW_HOT Row::Mask is_in_range(Row largest) noexcept {
    return both(Row::greater(largest, Row::all(kLeast)), Row::greater(Row::all(kMost), largest));
  }

  /** A number as the double with its bits. A store of a double cannot change other members. A store of bytes might, and
   * the compiler would load all again. */
  static DSW_HOT double as_double(uint32_t number) noexcept {
    const uint64_t bits = number;
    double d;
    std::memcpy(&d, &bits, sizeof d);
    return d;
  }
  static DSW_HOT uint32_t as_number(double d) noexcept {
    uint64_t bits;
    std::memcpy(&bits, &d, sizeof bits);
    return static_cast<uint32_t>(bits);
  }
  static DSW_HOT Row side_bound(Row largest) noexcept { return Row::all(Shear::bound(1)) * largest * largest; }
  static DSW_HOT Row side(const Corner& a, const Corner& b) noexcept { return a.i * b.j - a.j * b.i; }

  /** Coordinates by axes: k the longest of the line, i and j the next ones round. */
  static DSW_HOT Turned turn_axes(const PointsOf<Row>& v, Row::Mask along_y, Row::Mask along_z) noexcept {
    return {Row::select(along_z, v.x, Row::select(along_y, v.z, v.y)),
            Row::select(along_z, v.y, Row::select(along_y, v.x, v.z)),
            Row::select(along_z, v.z, Row::select(along_y, v.y, v.x))};
  }

  static DSW_HOT Corner see(Rows& rows, const PointsOf<Row>& at) noexcept {
    const PointsOf<Row> v = {at.x - rows.get(kFromX), at.y - rows.get(kFromY), at.z - rows.get(kFromZ)};
    const Row most = largest(largest(Row::absolute(v.x), Row::absolute(v.y)), Row::absolute(v.z));
    rows.put(kLargest, largest(rows.get(kLargest), most));
    const Turned a = turn_axes(v, mask_in(rows.get(kAlongY)), mask_in(rows.get(kAlongZ)));
    return {a.i - rows.get(kSlopeI) * a.k, a.j - rows.get(kSlopeJ) * a.k, a.k - rows.get(kLength)};
  }

  template <class From, class To, class Vertex>
  static DSW_HOT uint32_t start(Rows& rows, const double* points, From from, To to, Vertex vertex) noexcept {
    const PointsOf<Row> p = load_points(from), q = load_points(to);
    const Row x = q.x - p.x, y = q.y - p.y, z = q.z - p.z;
    const Row ax = Row::absolute(x), ay = Row::absolute(y), az = Row::absolute(z);
    const Row::Mask along_y = Row::greater(ay, ax), along_z = Row::greater(az, largest(ay, ax));
    const Row zero = Row::all(0), one = Row::all(1);
    const Turned d = turn_axes({x, y, z}, along_y, along_z);
    const Row::Mask down = Row::greater(zero, d.k);
    rows.put(kFromX, p.x), rows.put(kFromY, p.y), rows.put(kFromZ, p.z);
    rows.put(kAlongY, row_of(along_y)), rows.put(kAlongZ, row_of(along_z));
    rows.put(kForward, Row::select(down, zero - one, one));
    rows.put(kLength, d.k);
    rows.put(kSlopeI, divide(d.i, d.k)), rows.put(kSlopeJ, divide(d.j, d.k));
    rows.put(kLargest, Row::absolute(d.k));
    rows.put(kGone, zero);
    // Seen from behind the corners go the other way round, unless the line goes down.
    const uint32_t lines_down = Row::bits(down);
    Corner corners[3];
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      uint32_t numbers[kAbreast];
      DSW_UNROLL(8)
      for (uint32_t lane = 0; lane < kAbreast; ++lane) {
        numbers[lane] = vertex(lane, (lines_down >> lane & 1u) != 0 ? c : (3 - c) % 3);
        rows.of[kVertices + c][lane] = as_double(numbers[lane]);
      }
      corners[c] = see(rows, load_points([&](uint32_t lane) { return points + size_t{numbers[lane]} * 3; }));
      rows.put(kCorners + c, corners[c].i), rows.put(kCorners + 3 + c, corners[c].j);
      rows.put(kCorners + 6 + c, corners[c].z);
    }
    const Row bound = side_bound(rows.get(kLargest));
    Row lowest = Row::all(HUGE_VAL);
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      const Row weight = side(corners[(c + 1) % 3], corners[(c + 2) % 3]);
      rows.put(kCorners + 9 + c, weight);
      lowest = least(lowest, weight);
    }
    return Row::bits(both(Row::greater(lowest, bound), is_in_range(rows.get(kLargest))));
  }

  Rows rows_[kGroups];
};

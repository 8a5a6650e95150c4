// Tetrahedra as they look along the lines of casts, kAbreast of them at a time. A cast has come into its tetrahedron
// through a triangle, of which the line's shear (shear.h) is known. The one vertex that is new tells by three line
// tests which of the three other facets the line leaves through. The new vertex replaces the corner that this facet has
// not. The weight of the new corner is known from before: it is the line test of the edge that both triangles have.
// With the weights W, each the line test of the edge opposite, the line pierces a facet at the depth sum(W z) / sum(W),
// z being the depth of a corner behind the target. So its sign tells whether the target comes first.
//   With u and M as in shear.h a weight is at most 8 M^2 and off by 88 u M^2. A depth is the difference of two
// differences: at most 2 M, and off by 4 u M. The sum has three terms of at most 16 M^3, and each meets three
// roundings. So the sum is off by (3 * 88 * 2 + 3 * 8 * 4 + 3 * 16 * 3) u M^3 < 8 * 128 u M^3.

/** Casts by slots. The caller keeps slots dense: it moves the last one to one that it frees. */
class Sightlines {
 public:
  /** What a step says of kAbreast slots, a bit each. Neither: the filter left it open. */
  struct Steps {
    uint32_t leaves, stays;
  };

  /** Starts kAbreast casts p -> q in the triangles that they came in through, whose corners are counter-clockwise seen
   * from where the cast comes. `vertex(lane, corner)` is a corner's number.
   * @return for which of them the filter proves that the line passes the triangle. */
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
    put(kAlongY, first, row_of(along_y)), put(kAlongZ, first, row_of(along_z));
    put(kForward, first, Row::select(down, zero - one, one));
    put(kLength, first, d.k);
    put(kSlopeI, first, divide(d.i, d.k)), put(kSlopeJ, first, divide(d.j, d.k));
    put(kLargest, first, Row::absolute(d.k));
    // Seen from behind the corners go the other way round, unless the line goes down.
    const uint32_t lines_down = Row::bits(down);
    Corner corners[3];
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      uint32_t numbers[kAbreast];
      DSW_UNROLL(8)
      for (uint32_t lane = 0; lane < kAbreast; ++lane) {
        numbers[lane] = vertex(lane, (lines_down >> lane & 1u) != 0 ? c : (3 - c) % 3);
        rows_[kVertices + c][first + lane] = as_double(numbers[lane]);
      }
      corners[c] = see(first, load_points([&](uint32_t lane) { return points + size_t{numbers[lane]} * 3; }));
      put(kCorners + c, first, corners[c].i), put(kCorners + 3 + c, first, corners[c].j);
      put(kCorners + 6 + c, first, corners[c].z);
    }
    const Row bound = side_bound(get(kLargest, first));
    Row lowest = Row::all(HUGE_VAL);
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      const Row weight = side(corners[(c + 1) % 3], corners[(c + 2) % 3]);
      put(kCorners + 9 + c, first, weight);
      lowest = least(lowest, weight);
    }
    return Row::bits(both(Row::greater(lowest, bound), is_in_range(get(kLargest, first))));
  }

  /** Names the vertex that the next step of a slot reads. */
  DSW_HOT void aim(uint32_t slot, uint32_t vertex) noexcept { rows_[kTip][slot] = as_double(vertex); }
  /** The corner that the last step has replaced. */
  DSW_HOT uint32_t gone(uint32_t slot) const noexcept { return as_number(rows_[kGone][slot]); }

  /** Reads the vertices that kAbreast slots have been aimed at. `read` is not part of `step`: a processor does not look
   * far enough ahead to begin the next group's loads while it tests this one. */
  DSW_HOT void read(uint32_t first, const double* points) noexcept {
    const Corner tip = see(
        first, load_points([&](uint32_t lane) { return points + size_t{as_number(rows_[kTip][first + lane])} * 3; }));
    put(kTipI, first, tip.i), put(kTipJ, first, tip.j), put(kTipZ, first, tip.z);
  }

  /** Tells what the new vertices of kAbreast slots say, after the slots have read. Then each slot holds the facet that
   * its cast leaves through. */
  DSW_HOT Steps step(uint32_t first) noexcept {
    const Corner tip = {get(kTipI, first), get(kTipJ, first), get(kTipZ, first)};
    const Row largest = get(kLargest, first), bound = side_bound(largest), minus_bound = Row::all(0) - bound;
    Corner corners[3];
    Row sides[3], weights[3];
    Row::Mask left[3], right[3];
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      corners[c] = {get(kCorners + c, first), get(kCorners + 3 + c, first), get(kCorners + 6 + c, first)};
      weights[c] = get(kCorners + 9 + c, first);
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
      put(kCorners + c, first, Row::select(replaced[c], tip.i, corners[c].i));
      put(kCorners + 3 + c, first, Row::select(replaced[c], tip.j, corners[c].j));
      put(kCorners + 6 + c, first, z);
      put(kCorners + 9 + c, first, weight);
      depth = c == 0 ? weight * z : depth + weight * z;
    }
    depth = depth * get(kForward, first);
    const Row depth_bound = Row::all(8) * bound * largest;
    const Row::Mask decided = both(either(either(replaced[0], replaced[1]), replaced[2]), is_in_range(largest));
    const Row tips = get(kTip, first);
    Row gone = get(kVertices, first);
    DSW_UNROLL(3)
    for (uint32_t c = 0; c < 3; ++c) {
      const Row vertices = get(kVertices + c, first);
      put(kVertices + c, first, Row::select(replaced[c], tips, vertices));
      if (c != 0) gone = Row::select(replaced[c], vertices, gone);
    }
    put(kGone, first, gone);
    return {Row::bits(both(decided, Row::greater(Row::all(0) - depth_bound, depth))),
            Row::bits(both(decided, Row::greater(depth, depth_bound)))};
  }

  /** A slot takes over from another. */
  DSW_HOT void move(uint32_t from, uint32_t to) noexcept {
    DSW_UNROLL(8)
    for (uint32_t row = 0; row < kMoved; ++row) rows_[row][to] = rows_[row][from];
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
    kTip = kVertices + 3,       // number of the tip
    kMoved,                     // rows below it go with a cast; the others hold values within one pass only
    kGone = kMoved,             // number of the corner that the last step has replaced
    kTipI,
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
    const Turned a = turn_axes(v, mask_in(get(kAlongY, first)), mask_in(get(kAlongZ, first)));
    return {a.i - get(kSlopeI, first) * a.k, a.j - get(kSlopeJ, first) * a.k, a.k - get(kLength, first)};
  }

  alignas(64) double rows_[kRows][kPacket + kAbreast];
};

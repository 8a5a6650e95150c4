#pragma once
// The table of the functions that change a scene or its environment. A row has the function's number in recordings, and
// its arguments in the order in which they are recorded. Recording, replay and description follow from the row.

#include "capi/arguments.h"
#include "dartsweep/dartsweep.h"

namespace dsw::capi {

template <class Function>
struct Prototype;
template <class Handle, class... Rest>
struct Prototype<dsw_status (*)(Handle*, Rest...)> {
  using Given = Pack<Handle*, Rest...>;
  using First = Handle;
};

/** A function, and kinds of arguments. */
template <uint32_t kNumber, auto kFunction, class... Kinds>
struct Row {
  using Function = std::integral_constant<decltype(kFunction), kFunction>;
  using Given = typename Prototype<decltype(kFunction)>::Given;
  static constexpr uint32_t number = kNumber;

  const char* name;
  Pack<Kinds...> kinds;

  /** The arguments of a recorded call; what they point at is kept by the replay. */
  Given read(WordReader from, dsw_replay& replay) const {
    Given given{};
    kinds.for_each([&](const auto& each) { each.read(from, given, {nullptr, &replay, from.dimension()}); });
    return given;
  }
  void describe(WordReader from, Text& text) const {
    kinds.for_each([&](const auto& each) {
      text.label(each.label);
      each.template print<Given>(from, text);
    });
  }
};
template <uint32_t kNumber, auto kFunction>
struct RowName {
  const char* name;
  template <class... Kinds>
  constexpr Row<kNumber, kFunction, Kinds...> operator()(Kinds... kinds) const {
    return {name, {{kinds}...}};
  }
};

// How many are in arrays of structs, where no member says it. Sums and products that are too large stay so: a recording
// is not trusted.
constexpr size_t times(size_t a, size_t b) { return b != 0 && a > SIZE_MAX / b ? SIZE_MAX : a * b; }
constexpr size_t one_more(size_t count) { return count == SIZE_MAX ? count : count + 1; }
constexpr size_t index_bytes(const dsw_volumes_desc& d) { return d.index_bytes == 0 ? 8 : d.index_bytes; }
inline constexpr auto offset_bytes = [](const dsw_volumes_desc& d, size_t) {
  return times(one_more(d.volume_count), index_bytes(d));
};
inline constexpr auto connectivity_bytes = [](const dsw_volumes_desc& d, size_t) {
  return times(d.connectivity_count, index_bytes(d));
};
inline constexpr auto blade_points = [](const dsw_cut_desc& d, size_t) { return times(d.rows, d.columns); };
inline constexpr auto corners = [](const dsw_carve_desc& d, size_t dimension) {
  return times(d.triangle_count, dimension);
};
inline constexpr auto edge_ends = [](const dsw_body_desc& d, size_t) { return times(d.edge_count, 2); };
inline constexpr auto face_offsets = [](const dsw_body_desc& d, size_t) {
  return d.face_count == 0 ? 0 : one_more(d.face_count);
};

// The first number of a row is the one in recordings: new rows are appended. Numbers in angle brackets are positions of
// arguments in the declaration, where the handle is at 0; the first is the argument's, the next its count's, then its
// stride's.
#define DSW_ROW(number, function) (RowName<number, function>{#function})
// clang-format off
inline constexpr auto kTable = pack(
    DSW_ROW(1, dsw_environment_mark_volumes)(array<1, 2>("volumes"), value<3>("mark"), value<4>("flags")),
    DSW_ROW(2, dsw_environment_mark_faces)(array<1, 2>("faces"), value<3>("mark")),
    DSW_ROW(3, dsw_environment_mark_edges)(array<1, 2>("edges"), value<3>("mark")),
    DSW_ROW(4, dsw_environment_mark_vertices)(array<1, 2>("vertices"), value<3>("mark")),
    DSW_ROW(5, dsw_environment_mark_region)(value<1>("region"), value<2>("mark"), value<3>("flags")),
    DSW_ROW(6, dsw_environment_mark_between)(value<1>("regions"), value<2>(), value<3>("mark")),
    DSW_ROW(7, dsw_environment_set_tag)(value<1>("volume"), value<2>("tag")),
    DSW_ROW(8, dsw_environment_add_volumes)(structure<1>("desc",
        array("vertices", &dsw_volumes_desc::vertices, &dsw_volumes_desc::vertex_count),
        points("points", &dsw_volumes_desc::points, &dsw_volumes_desc::point_count,
               &dsw_volumes_desc::point_stride_bytes),
        array("types", &dsw_volumes_desc::cell_types, &dsw_volumes_desc::volume_count),
        array("offsets", &dsw_volumes_desc::offsets, offset_bytes),
        array("connectivity", &dsw_volumes_desc::connectivity, connectivity_bytes),
        array("regions", &dsw_volumes_desc::regions, &dsw_volumes_desc::volume_count),
        array("tags", &dsw_volumes_desc::tags, &dsw_volumes_desc::volume_count),
        array("sewn to", &dsw_volumes_desc::sew_to, &dsw_volumes_desc::sew_count))),
    DSW_ROW(9, dsw_environment_remove_volumes)(array<1, 2>("volumes")),
    DSW_ROW(10, dsw_environment_sew_faces)(array<1, 3>("faces"), array<2, 3, kSameCount>("to")),
    DSW_ROW(11, dsw_environment_unsew_face)(value<1>("face")),
    DSW_ROW(12, dsw_environment_merge_volumes)(value<1>("face")),
    DSW_ROW(13, dsw_environment_split_volume)(value<1>("volume"), array<2, 3>("loop")),
    DSW_ROW(14, dsw_environment_merge_faces)(value<1>("edge")),
    DSW_ROW(15, dsw_environment_split_face)(value<1>("face"), value<2>("from"), value<3>("to")),
    DSW_ROW(16, dsw_environment_split_edge)(value<1>("edge"), value<2>("at")),
    DSW_ROW(17, dsw_environment_merge_edges)(value<1>("edge"), value<2>("vertex")),
    DSW_ROW(18, dsw_environment_collapse_edge)(value<1>("edge"), value<2>("vertex")),
    DSW_ROW(19, dsw_environment_cut)(structure<1>("desc",
        points("points", &dsw_cut_desc::points, blade_points, &dsw_cut_desc::point_stride_bytes))),
    DSW_ROW(20, dsw_environment_tear_faces)(array<1, 3>("faces"), array<2, 3, kSameCount>("loads"), value<4>("limit")),
    DSW_ROW(21, dsw_environment_open_crack)(structure<1>("desc",
        array("faces", &dsw_open_crack_desc::faces, &dsw_open_crack_desc::face_count))),
    DSW_ROW(22, dsw_environment_carve)(structure<1>("desc",
        points("points", &dsw_carve_desc::points, &dsw_carve_desc::point_count, &dsw_carve_desc::point_stride_bytes),
        array("triangles", &dsw_carve_desc::triangles, corners))),
    DSW_ROW(23, dsw_environment_tie)(structure<1>("desc",
        points("points", &dsw_tie_desc::points, &dsw_tie_desc::point_count, &dsw_tie_desc::point_stride_bytes))),
    DSW_ROW(24, dsw_environment_detach)(structure<1>("desc"), result<2>()),
    DSW_ROW(25, dsw_environment_remesh)(structure<1>("desc",
        array("volumes", &dsw_remesh_desc::volumes, &dsw_remesh_desc::volume_count),
        points("next", &dsw_remesh_desc::next, &dsw_remesh_desc::point_count))),
    DSW_ROW(26, dsw_environment_deform)(structure<3>("options"), MovedPoints<3>{"vertices"}),
    DSW_ROW(27, dsw_particle_create)(point<1>("position"), value<2>("hint"), result<3>()),
    DSW_ROW(28, dsw_scene_create_particles)(
        points<1, 2, 3>("positions"), array<4, 2, kSameCount>("hints"), results<5, 2>()),
    DSW_ROW(29, dsw_particle_destroy)(value<1>("particle")),
    DSW_ROW(30, dsw_particle_move)(value<1>("particle"), point<2>("target"), structure<3>("options")),
    DSW_ROW(31, dsw_scene_move_particles)(
        array<1, 2>("particles"), points<3, 2, 4, kSameCount>("targets"), structure<5>("options")),
    DSW_ROW(32, dsw_scene_cast_from_particles)(
        array<1, 2>("particles"), points<3, 2, 4, kSameCount>("targets"), structure<5>("options"), results<6, 2>()),
    DSW_ROW(33, dsw_scene_reset_statistics)(),
    DSW_ROW(34, dsw_body_create)(structure<1>("desc",
        points("positions", &dsw_body_desc::positions, &dsw_body_desc::vertex_count, &dsw_body_desc::stride_bytes),
        array("hints", &dsw_body_desc::hints, &dsw_body_desc::vertex_count),
        array("edges", &dsw_body_desc::edges, edge_ends),
        array("face offsets", &dsw_body_desc::face_offsets, face_offsets),
        array("corners", &dsw_body_desc::face_corners, &dsw_body_desc::face_corner_count)), result<2>()),
    DSW_ROW(35, dsw_body_destroy)(value<1>("body")),
    DSW_ROW(36, dsw_body_set_level)(value<1>("body"), value<2>("level")),
    DSW_ROW(37, dsw_body_set_filter)(value<1>("body"), value<2>("category"), value<3>("mask")),
    DSW_ROW(38, dsw_body_add_vertex)(value<1>("body"), point<2>("position"), value<3>("hint"), result<4>()),
    DSW_ROW(39, dsw_body_add_edge)(value<1>("body"), value<2>("vertices"), value<3>(), result<4>()),
    DSW_ROW(40, dsw_body_add_face)(value<1>("body"), value<2>("vertices"), value<3>(), value<4>(), result<5>()),
    DSW_ROW(41, dsw_body_remove_face)(value<1>("body"), value<2>("face")),
    DSW_ROW(42, dsw_body_remove_edge)(value<1>("body"), value<2>("edge")),
    DSW_ROW(43, dsw_body_remove_vertex)(value<1>("body"), value<2>("vertex")),
    DSW_ROW(44, dsw_body_split_edge)(value<1>("body"), value<2>("edge"), value<3>("at")),
    DSW_ROW(45, dsw_body_collapse_edge)(value<1>("body"), value<2>("edge"), value<3>("vertex")),
    DSW_ROW(46, dsw_body_move)(value<1>("body"), points<2, 3, 4>("targets"), structure<5>("options",
        array("order", &dsw_move_options::order, &dsw_move_options::order_count))),
    DSW_ROW(47, dsw_scene_move_bodies)(array<1, 2>("bodies"), points<3, 4, 5>("targets"), structure<6>("options")),
    DSW_ROW(48, dsw_body_move_rigid)(value<1>("body"), value<2>("motion"), structure<3>("options",
        array("order", &dsw_move_options::order, &dsw_move_options::order_count))),
    DSW_ROW(49, dsw_body_set_radius)(value<1>("body"), value<2>("radius")),
    DSW_ROW(50, dsw_scene_move_together)(array<1, 2>("bodies"), points<3, 4, 5>("targets"), structure<6>("options")),
    DSW_ROW(51, dsw_scene_deform)(array<3, 4>("bodies"), points<5, 6, 7>("targets"), structure<8>("options"),
        MovedPoints<8>{"vertices"}),
    DSW_ROW(52, dsw_scene_move_rigid)(array<1, 2>("bodies"), array<3, 2>("motions"), structure<4>("options")),
    DSW_ROW(53, dsw_scene_deform_rigid)(array<3, 4>("bodies"), array<5, 4>("motions"), structure<6>("options"),
        MovedPoints<6>{"vertices"}),
    DSW_ROW(54, dsw_environment_mark_exits)(array<1, 2>("faces"), value<3>("patch")),
    DSW_ROW(55, dsw_scene_cut_bodies)(structure<1>("desc",
        points("points", &dsw_cut_desc::points, blade_points, &dsw_cut_desc::point_stride_bytes)),
        array<2, 3>("bodies")),
    DSW_ROW(56, dsw_body_depenetrate)(value<1>("body"), value<2>("inside"), value<3>("max_distance"),
        result<4>()));
// clang-format on
#undef DSW_ROW
constexpr size_t kCallCount = decltype(kTable)::size;

template <size_t... I, class... Rows>
constexpr bool are_in_order(const Slots<std::index_sequence<I...>, Rows...>&) {
  return ((Rows::number == I + 1) && ...);
}
static_assert(are_in_order(kTable));

/** The row of a function, found by what the table is derived from. */
template <auto kFunction, size_t I, uint32_t kNumber, class... Kinds>
constexpr const Row<kNumber, kFunction, Kinds...>& find_row(const Slot<I, Row<kNumber, kFunction, Kinds...>>& slot) {
  return slot.value;
}
template <auto kFunction>
inline constexpr const auto& row_of = find_row<kFunction>(kTable);

template <class Kind>
constexpr bool moves_points = false;
template <size_t kOptions>
constexpr bool moves_points<MovedPoints<kOptions>> = true;

/** Whether a call changes the environment and not only what is in the scene. */
template <uint32_t kNumber, auto kFunction, class... Kinds>
constexpr bool changes_environment(const Row<kNumber, kFunction, Kinds...>&) {
  return std::is_same_v<typename Prototype<decltype(kFunction)>::First, dsw_environment> ||
         (moves_points<Kinds> || ...);
}

/** Whether a call relies on bodies that are free. Moves of bodies whose back edges are left do not. */
constexpr bool needs_free_bodies(uint32_t number) {
  constexpr uint32_t kFirstOfParticles = row_of<dsw_particle_create>.number,
                     kLastOfParticles = row_of<dsw_scene_reset_statistics>.number;
  constexpr uint32_t kOthers[] = {row_of<dsw_environment_set_tag>.number, row_of<dsw_body_destroy>.number,
                                  row_of<dsw_body_set_level>.number, row_of<dsw_body_move>.number,
                                  row_of<dsw_scene_move_bodies>.number};
  for (const uint32_t other : kOthers) {
    if (number == other) return false;
  }
  return number < kFirstOfParticles || number > kLastOfParticles;
}

/** Calls use(row) with the row that has a number. False: there is none. */
template <class Use>
bool visit_row(uint64_t number, const Use& use) {
  return kTable.apply([&](const auto&... row) { return ((row.number == number ? (use(row), true) : false) || ...); });
}

}  // namespace dsw::capi

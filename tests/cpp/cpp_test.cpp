// dartsweep.hpp: who owns what, spans from containers, an exception for each status.
#include <gtest/gtest.h>
#include <dartsweep/dartsweep.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/** A vector of a program's own, for points. */
struct OwnVector {
  double x, y, z;
};
template <>
struct dartsweep::columns_of<OwnVector> : std::integral_constant<std::size_t, 3> {};

namespace {

using namespace dartsweep;

using Row = std::array<double, 3>;

const std::vector<Row> kCorners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<std::int32_t> kCube = {0, 1, 2, 3, 4, 5, 6, 7};
const Point kMiddle = {0.5, 0.5, 0.5}, kBeyond = {0.5, 0.5, 2.5};

Environment cube() { return Environment::of(DSW_CELL_TYPE_HEXAHEDRON, kCorners, kCube); }

Scene deforming_scene(Environment &environment) {
  auto desc = defaults<dsw_scene_desc>();
  desc.features = DSW_FEATURE_DEFORMING;
  return Scene(environment, &desc);
}

TEST(Cpp, AScenesEnvironmentStaysUntilTheSceneGoes) {
  std::optional<Environment> environment(cube());
  Scene scene(*environment);
  environment.reset();
  EXPECT_EQ(scene.move_particle(scene.create_particle(kMiddle), kBeyond).time, 0.25);
  scene.close();
  scene.close();
  EXPECT_THROW(scene.create_particle(kMiddle), Closed);
}

TEST(Cpp, MovedObjectsHaveTheHandle) {
  Environment environment = cube();
  dsw_environment *const handle = environment.handle();
  const Environment moved = std::move(environment);
  EXPECT_EQ(moved.handle(), handle);
  EXPECT_EQ(moved.info().volume_count, 1u);
}

TEST(Cpp, AContextOutlivesItsObject) {
  std::optional<Context> context(std::in_place, 1u);
  const Environment environment(kCorners, kCube, {}, {}, {}, {}, {}, {}, nullptr, &*context);
  context.reset();
  EXPECT_EQ(environment.cast(kMiddle, kBeyond).time, 0.25);
}

template <class Class>
void expect_class(dsw_status status) {
  static_assert(std::is_base_of_v<Error, Class>, "one handler can catch all of them");
  EXPECT_THROW(raise_status(status), Class);
  EXPECT_EQ(Class("").status(), status);
}

TEST(Cpp, EveryStatusHasItsClass) {
#define DSW_EXPECT_CLASS(status, name) expect_class<name>(DSW_STATUS_##status);
  DSW_EACH_STATUS(DSW_EXPECT_CLASS)
#undef DSW_EXPECT_CLASS
  EXPECT_NO_THROW(raise_status(DSW_STATUS_OK));
  EXPECT_THROW(throw_status(static_cast<dsw_status>(10000), "of a newer library"), Error);
}

TEST(Cpp, ExceptionsHaveTheMessageOfTheLibrary) {
  Environment environment = cube();
  Scene scene(environment);
  try {
    scene.destroy_particle({9, 1});
    FAIL() << "nothing was thrown";
  } catch (const StaleId &error) {
    EXPECT_NE(std::string(error.what()).find("names no particle"), std::string::npos) << error.what();
  }
  EXPECT_THROW(check(dsw_environment_check(nullptr, nullptr)), NullArgument);
}

TEST(Cpp, PointsComeAsNumbersRowsOrVectorsOfAProgram) {
  const Environment environment = cube();
  const std::vector<double> numbers = {0.5, 0.5, 0.5, 0.25, 0.5, 3};
  const std::vector<Row> rows = {{0.5, 0.5, 0.5}, {0.25, 0.5, 3}};
  const OwnVector own[] = {{0.5, 0.5, 0.5}, {0.25, 0.5, 3}};
  const std::array<Vec3, 2> structs = {{{0.5, 0.5, 0.5}, {0.25, 0.5, 3}}};
  std::vector<OwnVector> in_vector(own, own + 2);
  for (const Points points : {Points(numbers), Points(rows), Points(in_vector), Points(structs)}) {
    std::vector<dsw_volume_id> volumes(2, dsw_volume_id{7, 7});
    environment.locate_points(points, {}, volumes);
    EXPECT_FALSE(is_null(volumes[0]));
    EXPECT_TRUE(is_null(volumes[1]));
    EXPECT_TRUE(equal(volumes[0], environment.get_volume_id(0)));
  }
  std::vector<dsw_volume_id> volumes(2);
  EXPECT_THROW(environment.locate_points(std::vector<double>(5), {}, volumes), WrongSize);
  EXPECT_THROW(environment.locate_points(std::vector<std::array<double, 2>>(2), {}, volumes), WrongSize);
}

TEST(Cpp, WhatIsNearestIsFoundInBatches) {
  const Environment environment = cube();
  const std::vector<double> from = {0.5, 0.5, 0.25, 0.25, 0.5, 3}, to = {0.5, 0.5, 0.375, 0.25, 0.5, 4};
  std::vector<dsw_nearest> points(2);
  std::vector<dsw_segment_nearest> segments(2);
  std::vector<dsw_volume_id> volumes(2);
  std::vector<std::int32_t> locations(2);
  environment.find_nearest_to_points(from, 1, {}, points, volumes, locations);
  EXPECT_EQ(points[0].distance, 0.25);
  EXPECT_EQ(locations[1], DSW_LOCATION_OUTSIDE);
  environment.find_nearest_to_segments(from, to, 1, volumes, segments);
  EXPECT_EQ(segments[0].nearest.distance, 0.25);
  EXPECT_EQ(segments[1].nearest.cell.kind, DSW_CELL_NONE);
  EXPECT_THROW(environment.find_nearest_to_segments(from, to, 1, {}, std::vector<dsw_segment_nearest>(1)), WrongSize);
  EXPECT_THROW(environment.find_nearest_to_points(from, -1, {}, points), OutOfRange);
}

TEST(Cpp, RaysMeetBodies) {
  Environment environment = cube();
  Scene scene(environment);
  const std::vector<double> ends = {0.5, 0.25, 0.5, 0.5, 0.75, 0.5};
  const std::vector<std::uint32_t> edges = {0, 1};
  const Body wire(scene, scene.create_body(ends, edges));
  std::vector<dsw_flight> flights(1);
  std::vector<dsw_contact_partner> partners(1);
  const std::vector<double> from = {0.25, 0.5, 0.5}, to = {0.75, 0.5, 0.5};
  scene.cast(from, to, {}, nullptr, flights, partners);
  EXPECT_EQ(flights[0].time, 0.5);
  EXPECT_EQ(partners[0].edge.generation, 1u);
  std::vector<dsw_nearest> nearest(1);
  scene.find_nearest(std::vector<double>{0.375, 0.5, 0.5}, 1, {}, nearest, partners);
  EXPECT_EQ(nearest[0].distance, 0.125);
  std::vector<double> distances(1);
  environment.find_signed_distances(std::vector<double>{0.5, 0.5, 0.75}, distances);
  EXPECT_EQ(distances[0], -0.25);
  EXPECT_THROW(environment.find_signed_distances(from, std::vector<double>(2)), WrongSize);
  EXPECT_THROW(scene.cast(from, std::vector<double>(6), {}, nullptr, flights, partners), WrongSize);
  EXPECT_THROW(scene.find_nearest(from, 1, {}, nearest, std::vector<dsw_contact_partner>(2)), WrongSize);
}

TEST(Cpp, PlacesInsideAreFound) {
  const Environment environment = cube();
  std::vector<double> inside(6);
  std::vector<dsw_volume_id> volumes(2);
  environment.find_inside(std::vector<double>{0.5, 0.5, 1, 0.5, 0.5, 3}, 0.25, {}, inside, volumes);
  EXPECT_EQ(inside, (std::vector<double>{0.5, 0.5, 0.75, 0.5, 0.5, 0.75}));
  EXPECT_EQ(volumes[1].generation, 1u);
  EXPECT_THROW(environment.find_inside(std::vector<double>(3), 0, {}, inside), WrongSize);
}

TEST(Cpp, PairsAreSwept) {
  const std::vector<Row> from = {{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0},  {0, 1, 0},
                                 {-1, 0, 1},      {1, 0, 1}, {0, -1, 0}, {0, 1, 0}};
  std::vector<Row> to = from;
  to[0][2] = -1;
  to[4][2] = to[5][2] = -2;
  const std::vector<std::uint8_t> kinds = {DSW_PAIR_VERTEX_FACE, DSW_PAIR_EDGE_EDGE};
  std::vector<dsw_pair_touch> touches(2);
  const Context context(2);
  sweep_pairs(3, kinds, from, to, touches, DSW_PAIRS_RANK, &context);
  EXPECT_EQ(touches[0].time, 0.5);
  EXPECT_EQ(touches[1].time, 1.0 / 3);
  EXPECT_EQ(touches[0].rank, 1u);
  const std::vector<double> flat_from = {0.5, 1, 0, 0, 1, 0}, flat_to = {0.5, -1, 0, 0, 1, 0};
  const std::array<std::uint8_t, 1> kind = {DSW_PAIR_VERTEX_EDGE};
  std::array<dsw_pair_touch, 1> touch;
  sweep_pairs(2, kind, flat_from, flat_to, touch);
  EXPECT_EQ(touch[0].time, 0.5);
  sweep_pairs(3, {}, {}, {}, {});
  std::vector<double> motion(17);  // half a turn about z
  motion[3] = motion[6] = 1;
  const std::array<std::uint32_t, 2> indices = {0, UINT32_MAX};
  const std::vector<double> wall = {0, -5, 3, -9, 3, 9};
  sweep_rigid_pairs(2, kind, wall, {}, motion, indices, touch);
  EXPECT_EQ(touch[0].time, 0.25);
  EXPECT_THROW(sweep_rigid_pairs(2, kind, wall, {}, wall, indices, touch), WrongSize);
  EXPECT_THROW(sweep_pairs(2, kinds, flat_from, flat_to, touches), WrongSize);
  EXPECT_THROW(sweep_pairs(2, kind, from, to, touch), WrongSize);
  EXPECT_THROW(sweep_pairs(3, kinds, from, to, touch), WrongSize);
  EXPECT_THROW(sweep_pairs(4, kinds, from, to, touches), OutOfRange);
  EXPECT_THROW(sweep_pairs(3, std::vector<std::uint8_t>{0, 2}, from, to, touches), Unsupported);
}

TEST(Cpp, FreeFractionsMoveNothing) {
  const std::array<std::uint32_t, 8> cube = {0, 1, 2, 3, 4, 5, 6, 7};
  Environment environment = Environment::of(DSW_CELL_TYPE_HEXAHEDRON, kCorners, cube);
  Scene scene(environment);
  const std::vector<double> bar = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5};
  Body body(scene, scene.create_body(bar, std::vector<std::uint32_t>{0, 1}));
  const std::vector<double> poses = {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0};
  const std::vector<std::uint32_t> indices = {0, 1, 0, 0, 2, 2}, offsets = {0, 3, 5, 6};
  std::vector<dsw_free_fraction> found(3);
  std::vector<dsw_body_contact> contacts(3);
  body.find_free_fractions({0.5, 0.5, 0.5}, poses, indices, offsets, found, contacts);
  EXPECT_EQ(found[0].fraction, 1);
  EXPECT_EQ(found[0].piece, 2u);
  EXPECT_NEAR(found[1].fraction, 0.25, 1e-12);
  EXPECT_EQ(contacts[1].time, 0.25);
  EXPECT_EQ(found[2].starts_free, 0u);
  body.find_free_fractions({0.5, 0.5, 0.5}, poses, indices, {}, found);
  EXPECT_EQ(found[1].piece, 1u);
  EXPECT_THROW(body.find_free_fractions({0, 0, 0}, poses, indices, offsets, View<dsw_free_fraction>{}), WrongSize);
  EXPECT_THROW(body.find_free_fractions({0, 0, 0}, bar, indices, {}, found), WrongSize);
}

TEST(Cpp, ABarSlidesAlongAWall) {
  const std::array<std::uint32_t, 8> cube = {0, 1, 2, 3, 4, 5, 6, 7};
  Environment environment = Environment::of(DSW_CELL_TYPE_HEXAHEDRON, kCorners, cube);
  Scene scene(environment);
  const std::vector<double> bar = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5};
  Body body(scene, scene.create_body(bar, std::vector<std::uint32_t>{0, 1}));
  dsw_rigid_motion motion = {{0, 0, 0, 1}, {}, {1, 0.25, 0}};
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.flags = DSW_MOVE_SLIDE_WHOLE;
  EXPECT_NEAR(body.move_rigid(motion, &options).fraction, 0.25, 1e-12);
  EXPECT_NEAR(body.get_motion_left().translation[0], 0.75, 1e-9);
  EXPECT_NEAR(body.get_motion_left().translation[1], 0, 1e-9);
}

TEST(Cpp, RigidBodiesMoveAtOnce) {
  Environment environment = cube();
  auto desc = defaults<dsw_scene_desc>();
  desc.features = DSW_FEATURE_BODY_CONTACTS;
  Scene scene(environment, &desc);
  const std::vector<std::uint32_t> edge = {0, 1};
  const std::vector<double> left = {0.125, 0.5, 0.5, 0.25, 0.5, 0.5}, right = {0.75, 0.5, 0.5, 0.875, 0.5, 0.5};
  const std::vector<dsw_body_id> bodies = {scene.create_body(left, edge), scene.create_body(right, edge)};
  std::vector<double> motions(20);
  motions[3] = motions[13] = 1;
  motions[7] = 1;
  motions[17] = -1;
  std::vector<dsw_move_report> reports(2);
  scene.move_rigid(bodies, motions, nullptr, reports);
  EXPECT_NEAR(reports[0].fraction, 0.25, 1e-12);
  EXPECT_EQ(reports[0].fraction, reports[1].fraction);
  EXPECT_THROW(scene.move_rigid(bodies, std::vector<double>(10), nullptr, reports), WrongSize);
}

TEST(Cpp, IndicesHaveAnyWidth) {
  const std::vector<std::int64_t> wide(kCube.begin(), kCube.end());
  const std::array<std::uint32_t, 8> narrow = {0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(Environment::of(DSW_CELL_TYPE_HEXAHEDRON, kCorners, wide).info().volume_count, 1u);
  EXPECT_EQ(Environment::of(DSW_CELL_TYPE_HEXAHEDRON, kCorners, narrow).info().volume_count, 1u);
}

TEST(Cpp, ABodyMovesAndItsContactsAreRead) {
  Environment environment = cube();
  Scene scene(environment);
  std::vector<Row> rod = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}};
  Body body(scene, scene.create_body(rod, std::vector<std::uint32_t>{0, 1}));
  for (Row &at : rod) at[2] = 2;
  const dsw_move_report report = body.move(rod);
  const Array<dsw_body_contact> contacts = body.get_contacts();
  ASSERT_EQ(contacts.size(), report.contact_count);
  ASSERT_EQ(contacts.size(), 2u);
  for (const dsw_body_contact &contact : contacts) EXPECT_EQ(contact.position[2], 1);
  EXPECT_EQ(contacts[1].vertex.index, contacts.get(1).vertex.index);
  EXPECT_THROW(contacts.get(2), OutOfRange);
  std::vector<Row> now(2);
  body.get_positions(now);
  EXPECT_EQ(now[0][0], 0.25);
  EXPECT_LT(now[0][2], 1);
  const dsw_body_contact *lent = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_contacts(scene.handle(), body.id(), &lent, &count));
  EXPECT_EQ(count, contacts.size());
}

TEST(Cpp, WhatLeavesIsRead) {
  Environment environment = cube();
  Scene scene(environment);
  const dsw_face_id top = environment.cast({0.5, 0.5, 0.5}, {0.5, 0.5, 3}).contact.wall;
  environment.mark_exits(View<const dsw_face_id>(&top, 1), 6);
  EXPECT_EQ(environment.get_exit(top), 6u);
  ASSERT_EQ(environment.get_exit_faces().size(), 1u);
  EXPECT_EQ(environment.get_exit_faces()[0].local, top.local);
  const dsw_particle_id particle = scene.create_particle({0.25, 0.25, 0.5});
  dsw_cast_options leave;
  dsw_cast_options_init(&leave, sizeof leave);
  leave.flags = DSW_CAST_LEAVE;
  EXPECT_EQ(scene.move_particle(particle, {0.25, 0.25, 2.5}, &leave).outcome, DSW_OUTCOME_EXIT);
  ASSERT_EQ(scene.get_exits().size(), 1u);
  EXPECT_EQ(scene.get_exits()[0].time, 0.25);
  EXPECT_EQ(scene.get_particle_count(), 0u);
  std::vector<Row> rod = {{0.25, 0.5, 0.25}, {0.25, 0.5, 0.75}};
  Body body(scene, scene.create_body(rod, std::vector<std::uint32_t>{0, 1}));
  for (Row &at : rod) at[2] += 0.5;
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.flags = DSW_MOVE_LEAVE;
  body.move(rod, &options);
  ASSERT_EQ(body.get_exits().size(), 1u);
  EXPECT_EQ(body.get_exits()[0].vertex.index, 1u);
  EXPECT_EQ(body.get_exits()[0].patch, 6u);
}

TEST(Cpp, ABodyThatPenetratesIsFreed) {
  Environment environment = cube();
  Scene scene(environment);
  const std::vector<Row> wire = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {1.25, 0.5, 0.5}};
  const std::vector<std::uint32_t> edges = {0, 1, 1, 2};
  EXPECT_THROW(scene.create_body(wire, edges), Outside);
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.flags = DSW_BODY_START_PENETRATING;
  Body body(scene, scene.create_body(wire, edges, {}, {}, {}, &desc));
  EXPECT_TRUE(body.is_penetrating());
  ASSERT_EQ(body.find_penetrations().size(), 1u);
  EXPECT_EQ(body.find_penetrations()[0].part.edge.index, 1u);
  EXPECT_FALSE(body.depenetrate({}, 0.125).freed);
  const Depenetration made = body.depenetrate();
  EXPECT_TRUE(made.freed);
  EXPECT_GE(made.distance, 0.25);
  EXPECT_LE(made.distance, 0.5);
  EXPECT_FALSE(body.is_penetrating());
}

TEST(Cpp, AThreadIsCut) {
  Environment environment = cube();
  Scene scene(environment);
  const std::vector<Row> thread = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}};
  Body body(scene, scene.create_body(thread, std::vector<std::uint32_t>{0, 1}));
  const std::vector<Row> blade = {{0.375, 0, 0}, {0.375, 0, 1}, {0.375, 1, 0}, {0.375, 1, 1}};
  ASSERT_EQ(scene.cut_bodies(blade, 2, 2), 1u);
  const Array<dsw_body_cut> cuts = scene.get_body_cuts();
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_EQ(cuts[0].edge_parameter, 0.25);
  EXPECT_EQ(cuts[0].body.index, body.id().index);
  EXPECT_EQ(body.get_counts().edge_count, 2u);
  const dsw_body_id id = body.id();
  EXPECT_EQ(scene.cut_bodies(blade, 2, 2, View<const dsw_body_id>(&id, 1)), 0u);
  EXPECT_THROW(scene.cut_bodies(blade, 2, 3), WrongSize);
}

TEST(Cpp, NearRowsAndTheirJacobianAreRead) {
  Environment environment = cube();
  Scene scene(environment);
  const std::vector<Row> rod = {{0.25, 0.5, 0.375}, {0.5, 0.75, 0.4375}};
  Body body(scene, scene.create_body(rod, std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(body.get_near_rows().size(), 0u);
  dsw_near_options options;
  dsw_near_options_init(&options, sizeof options);
  options.margin = 0.25;
  options.flags = DSW_NEAR_JACOBIAN;
  ASSERT_EQ(body.find_near_rows(&options), 2u);
  const Array<dsw_near_row> rows = body.get_near_rows();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].distance, 0.25);
  EXPECT_EQ(rows[0].normal[0], 1);
  EXPECT_EQ(rows[1].normal[1], -1);
  EXPECT_EQ(rows[1].vertices[0], 1u);
  const Array<std::uint32_t> offsets = body.get_near_offsets(), columns = body.get_near_columns();
  const Array<double> values = body.get_near_values();
  ASSERT_EQ(offsets.size(), 3u);
  EXPECT_EQ(offsets[2], 6u);
  ASSERT_EQ(columns.size(), 6u);
  EXPECT_EQ(columns[4], 4u);
  EXPECT_EQ(values[4], -1);
  EXPECT_EQ(body.find_near_rows(), 0u);
  options.margin = -1;
  EXPECT_THROW(body.find_near_rows(&options), OutOfRange);
}

TEST(Cpp, AThickBodyKeepsItsRadius) {
  Environment environment = cube();
  Scene scene(environment);
  const std::vector<Row> rod = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}}, down = {{0.25, 0.5, -0.5}, {0.75, 0.5, -0.5}};
  const std::vector<std::uint32_t> edge = {0, 1};
  auto desc = defaults<dsw_body_desc>();
  desc.radius = 0.1;
  Body body(scene, scene.create_body(rod, edge, {}, {}, {}, &desc));
  EXPECT_EQ(body.get_radius(), 0.1);
  EXPECT_THROW(body.set_radius(-1), OutOfRange);
  EXPECT_THROW(body.find_least_gap(-1), OutOfRange);
  body.set_radius(0.125);
  EXPECT_EQ(body.get_radius(), 0.125);
  EXPECT_EQ(body.find_least_gap(0.0625), 0.0625);
  EXPECT_NEAR(body.find_least_gap(1), 0.125, 1e-8);
  EXPECT_THROW(body.set_radius(0.5), Occupied);
  EXPECT_EQ(scene.get_offending_edges().size(), 2u);
  body.set_radius(0.1);
  EXPECT_NEAR(body.find_least_gap(1), 0.15, 1e-8);
  body.move(down);
  std::vector<Row> now(2);
  body.get_positions(now);
  EXPECT_NEAR(now[0][2], 0.1, 1e-3);
  EXPECT_GE(body.find_least_gap(0.1), -1e-9);
  desc.radius = 0.3;
  EXPECT_THROW(scene.create_body(rod, edge, {}, {}, {}, &desc), Occupied);
}

TEST(Cpp, LentPointsLiveAsLongAsTheyAreRead) {
  Environment environment = cube();
  const Scene scene = deforming_scene(environment);
  auto next = std::make_shared<std::vector<Row>>(kCorners);
  for (Row &at : *next) at[0] *= 2;
  const std::weak_ptr<void> watched = next;
  EXPECT_EQ(environment.deform(Lent(std::move(next))).outcome, DSW_DEFORM_DONE);
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(environment.get_points()[3], 2);
  EXPECT_EQ(environment.get_vertex_position(environment.get_vertex_id(1))[0], 2);
  environment.deform(Lent(std::make_shared<std::vector<Row>>(kCorners)));
  EXPECT_TRUE(watched.expired());
}

TEST(Cpp, BodiesAndWallsMoveTogether) {
  Environment environment = cube();
  Scene scene = deforming_scene(environment);
  const std::vector<Row> rod = {{0.25, 0.5, 0.25}, {0.75, 0.5, 0.25}}, raised = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}},
                         down = {{0.25, 0.5, -0.5}, {0.75, 0.5, -0.5}};
  const Body body(scene, scene.create_body(rod, std::vector<std::uint32_t>{0, 1}));
  const std::vector<dsw_body_id> bodies = {body.id()};
  std::vector<dsw_move_report> reports(1);
  auto options = defaults<dsw_together_options>();
  options.stop = DSW_TOGETHER_STOP_ISLAND;
  scene.move_together(bodies, raised, &options, reports);
  EXPECT_EQ(reports[0].fraction, 1);
  EXPECT_THROW(scene.move_together(bodies, std::vector<Row>(1), nullptr, {}), WrongSize);
  scene.move_together(bodies, rod, nullptr, {});
  std::vector<double> fractions(1), places(rod.size() * 3);
  const std::vector<Row> steps(rod.size(), Row{0, 0, 2});
  const double fraction = scene.step_fraction(bodies, steps, nullptr, places, fractions);
  EXPECT_TRUE(fraction > 0 && fraction < 0.5 && fractions[0] == fraction);
  EXPECT_EQ(places[2], rod[0][2] + fraction * 2);
  EXPECT_THROW(scene.step_fraction(bodies, std::vector<Row>(1), nullptr, {}), WrongSize);
  // The floor comes up by half of the cube, and takes the body along. Then it meets the body after 2 of 3 parts.
  auto next = std::make_shared<std::vector<Row>>(kCorners);
  for (Row &at : *next) at[2] = std::max(at[2], 0.125);
  EXPECT_EQ(scene.deform(Lent(next), bodies, raised, nullptr, reports).outcome, DSW_DEFORM_DONE);
  EXPECT_EQ(reports[0].fraction, 1);
  auto last = std::make_shared<std::vector<Row>>(*next);
  for (Row &at : *last) at[2] = std::max(at[2], 0.6875);
  const std::weak_ptr<void> watched = next;
  next.reset();
  const dsw_deform_report report = scene.deform(Lent(last));
  EXPECT_EQ(report.outcome, DSW_DEFORM_FRACTION);
  EXPECT_NEAR(report.fraction, 2.0 / 3, 1e-9);
  EXPECT_TRUE(watched.expired());
  EXPECT_FALSE(environment.get_wall_contacts().empty());
  scene.move_together(bodies, down, nullptr, reports);
  EXPECT_LT(reports[0].fraction, 1e-9);
  EXPECT_THROW(scene.deform(Lent(last)), InUse);
}

TEST(Cpp, ARodTurnsWhileTheFloorRises) {
  Environment environment = cube();
  Scene scene = deforming_scene(environment);
  const std::vector<Row> rod = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}};
  const Body body(scene, scene.create_body(rod, std::vector<std::uint32_t>{0, 1}));
  const std::vector<dsw_body_id> bodies = {body.id()};
  const double half = std::sqrt(0.5);
  const std::vector<double> motions = {0, 0, half, half, 0.5, 0.5, 0.5, 0, 0, 0};
  std::vector<dsw_move_report> reports(1);
  auto next = std::make_shared<std::vector<Row>>(kCorners), other = std::make_shared<std::vector<Row>>(kCorners);
  for (Row &at : *next) at[2] = std::max(at[2], 0.75);
  const std::weak_ptr<void> read = next;
  EXPECT_THROW(scene.deform_rigid(Lent(std::move(other)), bodies, std::vector<double>(9)), WrongSize);
  const dsw_deform_report report = scene.deform_rigid(Lent(std::move(next)), bodies, motions, nullptr, reports);
  EXPECT_EQ(report.outcome, DSW_DEFORM_FRACTION);
  EXPECT_TRUE(report.fraction < 2.0 / 3 && report.fraction > 0.6666666 && reports[0].fraction == report.fraction);
  EXPECT_FALSE(read.expired());
}

TEST(Cpp, AtTheWorkLimitPointsThatAreReadStay) {
  Environment environment = cube();
  Scene scene = deforming_scene(environment);
  const double least = 5e-324;  // integers are long beside it
  const std::vector<Row> rod = {{0.5, 0.25, 0.25}, {0.5, 0.75, 0.25}},
                         side = {{least, 0.25, 0.25}, {least, 0.75, 0.25}};
  const Body body(scene, scene.create_body(rod, std::vector<std::uint32_t>{0, 1}));
  const std::vector<dsw_body_id> bodies = {body.id()};
  std::vector<dsw_move_report> reports(1);
  auto options = defaults<dsw_scene_deform_options>();
  options.max_work = 1;
  auto before = std::make_shared<std::vector<Row>>(kCorners), next = std::make_shared<std::vector<Row>>(kCorners);
  const std::weak_ptr<void> read = before;
  EXPECT_EQ(scene.deform(Lent(std::move(before))).outcome, DSW_DEFORM_DONE);
  for (Row &at : *next) at[2] = std::max(at[2], 0.5);
  const std::weak_ptr<void> watched = next;
  EXPECT_EQ(scene.deform(Lent(std::move(next)), bodies, side, &options, reports).outcome, DSW_DEFORM_LIMITED);
  EXPECT_EQ(reports[0].vertices_limited, 2u);
  EXPECT_TRUE(watched.expired() && !read.expired());
}

TEST(Cpp, AChangeOwnsItsLists) {
  Environment environment = cube();
  const std::vector<Row> blade = {{-1, -1, 0.5}, {2, -1, 0.5}, {-1, 2, 0.5}, {2, 2, 0.5}};
  Change cut = environment.cut(blade, 2, 2);
  environment.remove_volumes(std::vector<dsw_volume_id>{environment.get_volume_id(0)});
  const Change last = environment.get_change(), kept = std::move(cut);
  EXPECT_EQ(kept.volumes_split, 1u);
  ASSERT_EQ(kept.volume_count, 2u);
  EXPECT_EQ(kept.volumes[0].before.generation, 1u);
  EXPECT_EQ(kept.get_faces().size(), kept.face_count);
  ASSERT_EQ(last.volume_count, 1u);
  EXPECT_TRUE(is_null(last.volumes[0].after));
  EXPECT_EQ(last.volumes_split, 0u);
}

TEST(Cpp, TrianglesMakeThePlane) {
  const std::vector<std::array<double, 2>> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<int> triangles = {0, 1, 2, 0, 2, 3};
  const Environment environment = Environment::of(DSW_CELL_TYPE_TRIANGLE, points, triangles);
  EXPECT_EQ(environment.dimension(), 2u);
  EXPECT_EQ(environment.cast({0.75, 0.25}, {0.75, -0.25}).time, 0.5);
  EXPECT_THROW(environment.cast({0.75, 0.25, 1}, {0.75, -0.25}), WrongSize);
}

TEST(Cpp, SnapshotsLoad) {
  Environment environment = cube();
  Scene scene(environment);
  const dsw_particle_id particle = scene.create_particle(kMiddle);
  Environment other = Environment::load(environment.save());
  Scene copy = Scene::load(other, scene.save());
  EXPECT_EQ(copy.move_particle(particle, kBeyond).time, scene.move_particle(particle, kBeyond).time);
  EXPECT_THROW(Environment::load(std::vector<std::uint8_t>(3)), Error);
}

}  // namespace

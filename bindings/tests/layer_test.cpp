// The layer that all languages share: who owns what, and what several threads may do. The sanitizers look on.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/host.h"

using namespace dartsweep;

namespace {

const std::vector<double> kPoints = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
const std::vector<std::int64_t> kCube = {0, 1, 2, 3, 4, 5, 6, 7};
const Point kMiddle = {0.5, 0.5, 0.5}, kNear = {0.25, 0.5, 0.5}, kBeyond = {0.5, 0.5, 2.5};

Environment cube() { return Environment({kPoints.data(), 24}, {kCube.data(), 8, 8}); }

template <class Call>
dsw_status status_of(Call call) {
  try {
    call();
  } catch (const Error &error) {
    EXPECT_STRNE(error.what(), "");
    return error.status();
  }
  return DSW_STATUS_OK;
}

TEST(Layer, ClosesOnceInAnyOrder) {
  std::optional<Environment> environment(cube());
  std::optional<Scene> scene(std::in_place, *environment);
  Body body(*scene, scene->create_body({kMiddle.at, 3}));
  environment->close();
  environment->close();
  EXPECT_THROW(environment->cast(kMiddle, kBeyond), Closed);
  environment.reset();
  EXPECT_EQ(scene->move_particle(scene->create_particle(kMiddle), kBeyond).time, 0.25);
  scene->close();
  scene->close();
  scene.reset();
  EXPECT_THROW(body.get_counts(), Closed);
}

TEST(Layer, StatusesAreThrown) {
  Environment environment = cube();
  Scene scene(environment);
  EXPECT_EQ(status_of([&] { environment.get_volume_id(1); }), DSW_STATUS_OUT_OF_RANGE);
  EXPECT_EQ(status_of([&] { scene.destroy_particle({9, 1}); }), DSW_STATUS_STALE_ID);
  EXPECT_EQ(status_of([&] { environment.deform({}); }), DSW_STATUS_NOT_ENABLED);
  EXPECT_EQ(status_of([&] { environment.locate_points({kPoints.data(), 24}, {}, {}); }), DSW_STATUS_WRONG_SIZE);
  EXPECT_EQ(status_of([&] { Environment::load({}); }), DSW_STATUS_NULL_ARGUMENT);
}

/// Two triangles that make a square.
Environment square() {
  static const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
  static const std::int64_t triangles[] = {0, 1, 2, 0, 2, 3};
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.uniform_cell_type = DSW_CELL_TYPE_TRIANGLE;
  return Environment({corners, 8}, {triangles, 6, 8}, {}, {}, {}, {}, {}, {}, &desc);
}

TEST(Layer, PointsOfThePlaneHaveTwoCoordinates) {
  Environment environment = square();
  Array<std::uint8_t> block = environment.save();
  Environment loaded = Environment::load({block.data(), block.size()});
  EXPECT_EQ(loaded.dimension(), 2u);
  EXPECT_EQ(loaded.get_points().size(), 8u);
  EXPECT_EQ(loaded.info().volume_count, 2u);
  const Point corner = loaded.get_vertex_position(loaded.get_vertex_id(2));
  EXPECT_TRUE(corner.size == 2 && corner.at[0] == 1 && corner.at[1] == 1 && corner.at[2] == 0);
  const Point start(0.5, 0.25);
  EXPECT_EQ(loaded.cast(start, {0.5, 2.25}).time, 0.375);
  EXPECT_EQ(loaded.cast({0.5, 0.25, 0}, {0.5, 2.25, 0}).time, 0.375);
  EXPECT_EQ(status_of([&] { loaded.cast({0.5, 0.25, 1}, start); }), DSW_STATUS_WRONG_SIZE);
  EXPECT_EQ(status_of([&] { cube().cast(start, kMiddle); }), DSW_STATUS_WRONG_SIZE);

  Scene scene(loaded);
  const double rope[] = {0.5, 0.25, 0.75, 0.25}, rows[] = {0.5, 1.25, 9, 0.75, 0.5, 9};
  const std::uint32_t edge[] = {0, 1};
  Body body(scene, scene.create_body({rope, 4}, {edge, 2}));
  const dsw_move_report report = body.move({rows, 2, 2, 24});
  EXPECT_EQ(report.vertices_stopped, 1u);
  const Array<dsw_body_contact> contacts = body.get_contacts();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_TRUE(contacts.get(0).time == 0.75 && contacts.get(0).contact.normal[1] == -1 &&
              contacts.get(0).contact.normal[2] == 0);
  double positions[4];
  body.get_positions({positions, 4});
  EXPECT_TRUE(positions[0] == 0.5 && positions[1] > 0.99 && positions[1] < 1 && positions[3] == 0.5);
  body.get_positions({positions, 2, 2});
  EXPECT_EQ(status_of([&] { body.get_positions({positions, 3}); }), DSW_STATUS_WRONG_SIZE);
  EXPECT_EQ(status_of([&] { body.move({rows, 2, 3, 24}); }), DSW_STATUS_WRONG_SIZE);
  const Vec3 position = scene.get_particle_position(scene.create_particle(start)).position;
  EXPECT_TRUE(position.x == 0.5 && position.y == 0.25 && position.z == 0);
}

/// Points in memory of their very size: the sanitizers would see a third coordinate.
template <class Array>
Array of(std::vector<double> &numbers) {
  numbers.shrink_to_fit();
  return {numbers.data(), numbers.size()};
}

TEST(Layer, ArraysOfThePlaneAreReadAndWrittenByTwo) {
  Environment environment = square();
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  Scene scene(environment, &desc);
  std::vector<double> from = {0.5, 0.25, 0.25, 0.5}, to = {0.5, 2.25, -1.75, 0.5}, fixed = {0.75, 0.25, 0.25, 0.75},
                      out(4);
  dsw_volume_id volumes[2];
  environment.locate_points(of<Points>(from), {}, {volumes, 2});
  EXPECT_TRUE(volumes[0].index == 0 && volumes[1].index == 1);
  dsw_flight flights[2];
  environment.cast_segments(of<Points>(from), of<Points>(to), {}, nullptr, {flights, 2});
  EXPECT_TRUE(flights[0].time == 0.375 && flights[1].time == 0.125);
  dsw_sweep sweeps[2];
  environment.sweep_edges(of<Points>(from), of<Points>(to), of<Points>(fixed), {}, nullptr, {sweeps, 2});
  EXPECT_TRUE(sweeps[0].time == 0.375 && sweeps[1].time == 0.125);

  dsw_particle_id particles[2];
  scene.create_particles(of<Points>(from), {}, {particles, 2});
  scene.cast_from_particles({particles, 2}, of<Points>(to), nullptr, {flights, 2});
  EXPECT_TRUE(flights[0].time == 0.375 && flights[1].time == 0.125);
  scene.move_particles({particles, 2}, of<Points>(fixed), nullptr, {});
  scene.get_particle_positions({particles, 2}, of<PointsOut>(out));
  EXPECT_EQ(out, fixed);
  const dsw_body_id bodies[] = {scene.create_body(of<Points>(from)), scene.create_body(of<Points>(fixed))};
  std::vector<double> targets = {0.5, 0.5, 0.5, 0.75, 0.75, 0.5, 0.75, 0.75};
  scene.move_bodies({bodies, 2}, of<Points>(targets), nullptr, {});
  Body(scene, bodies[1]).get_positions(of<PointsOut>(out));
  EXPECT_EQ(out, (std::vector<double>{0.75, 0.5, 0.75, 0.75}));

  auto next = std::make_shared<std::vector<double>>(std::vector<double>{0, 0, 1, 0, 1, 2, 0, 2});
  EXPECT_EQ(environment.deform({next->data(), 8, 0, next}).outcome, DSW_DEFORM_DONE);
  const Array<double> points = environment.get_points();
  ASSERT_EQ(points.size(), 8u);
  EXPECT_TRUE(points.get(5) == 2 && points.get(7) == 2);
}

TEST(Layer, SurgeryInThePlaneReadsByTwo) {
  Environment environment = square();
  const dsw_vertex_id vertices[] = {environment.get_vertex_id(1), environment.get_vertex_id(2)};
  const std::int64_t triangle[] = {0, 2, 1};
  dsw_volumes_desc kind;
  dsw_volumes_desc_init(&kind, sizeof kind);
  kind.uniform_cell_type = DSW_CELL_TYPE_TRIANGLE;
  std::vector<double> added = {2, 0.5}, blade = {0.25, -1, 0.25, 2}, line = {0.5, -1, 0.5, 2};
  std::vector<double> shape = {0.125, 0.125, 0.5, 0.125, 0.25, 0.25};
  const dsw_volume_id made =
      environment.add_volumes({vertices, 2}, of<Points>(added), {triangle, 3, 8}, {}, {}, {}, {}, {}, &kind).get(0);
  EXPECT_NEAR(environment.get_centre(made).at[0], 4.0 / 3, 1e-15);
  EXPECT_EQ(environment.cut(of<Points>(blade), 2, 1).volumes_split, 2u);
  const std::uint32_t corners[] = {0, 1, 1, 2, 2, 0};
  EXPECT_GT(environment.carve(of<Points>(shape), {corners, 6}).volumes_crossed, 0u);
  EXPECT_GT(environment.tie(of<Points>(line)).face_count, 0u);
  EXPECT_EQ(status_of([&] { environment.cut(of<Points>(blade), 3, 1); }), DSW_STATUS_WRONG_SIZE);
  EXPECT_EQ(status_of([&] { environment.carve(of<Points>(shape), {corners, 5}); }), DSW_STATUS_WRONG_SIZE);
  const dsw_face_id side = environment.get_face_id(environment.get_volume_id(made.index), 0);
  const dsw_vertex_id middle = environment.split_edge({side.volume, side.generation, side.local}, 0.5).vertex;
  EXPECT_EQ(environment.get_vertex_position(middle).size, 2u);
  Trace trace;
  trace.add_walk(environment, {0.75, 0.5}, {0.75, 3}, 0.25);
  const Array<double> drawn = trace.get_points();
  ASSERT_GT(drawn.size(), 3u);
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_TRUE(i % 3 != 2 || drawn.get(i) == 0);
}

TEST(Layer, ChangesAreCopiesThatLast) {
  std::optional<Environment> environment(square());
  const double blade[] = {0.25, -1, 0.25, 2};
  const auto lasting = [](Change change) {
    EXPECT_EQ(change.volumes_split, 2u);
    EXPECT_EQ(change.get_faces().size(), 2u);
    EXPECT_EQ(change.get_vertices().size(), 3u);
    EXPECT_EQ(change.get_vertices().get(0).vertex.index, 4u);
    EXPECT_EQ(change.get_volumes().size(), change.volume_count);
    EXPECT_EQ(change.get_detached().size(), 0u);
    EXPECT_EQ(change.volumes[0].before.generation, 1u);
  };
  Change cut = environment->cut({blade, 4}, 2, 1), last = environment->get_change();
  environment->unsew_face(cut.get_faces().get(0).front);
  EXPECT_EQ(environment->get_change().volume_count, 0u);
  environment.reset();
  lasting(std::move(cut));
  lasting(std::move(last));
}

std::string words_of(const std::function<void()> &call) {
  try {
    call();
  } catch (const Error &error) {
    return error.what();
  }
  return "";
}

TEST(Layer, WrongNumbersOfCoordinatesAreTold) {
  Environment plane = square(), space = cube();
  std::vector<double> five(5), six(6);
  dsw_volume_id volumes[3];
  const auto locate = [&](Environment &in, Points points) {
    return words_of([&] { in.locate_points(points, {}, {volumes, 2}); });
  };
  EXPECT_EQ(locate(plane, of<Points>(five)), "a point of the plane has 2 coordinates; 5 numbers are no points");
  EXPECT_EQ(locate(space, of<Points>(five)), "a point of space has 3 coordinates; 5 numbers are no points");
  EXPECT_EQ(locate(plane, {six.data(), 2, 3, 24}), "a point of the plane has 2 coordinates, not 3");
  EXPECT_EQ(locate(space, {six.data(), 3, 2, 16}), "a point of space has 3 coordinates, not 2");
  EXPECT_EQ(locate(plane, of<Points>(six)), "volumes has 2 entries, not 3");
  EXPECT_EQ(words_of([&] { plane.locate(kMiddle); }), "a point of the plane has 2 coordinates, or a third that is 0");
  EXPECT_EQ(words_of([&] { space.locate({1, 2}); }), "a point of space has 3 coordinates, not 2");
}

TEST(Layer, EmptyArraysAreLeftOutWhereverTheyLie) {
  const std::vector<std::uint8_t> bytes(1);
  const std::vector<std::int32_t> numbers(1);
  const std::vector<dsw_volume_id> ids(1);
  std::vector<std::int32_t> locations(1, 7);
  const std::int32_t *const end = numbers.data() + 1;
  Environment environment({kPoints.data(), 24}, {kCube.data(), 8, 8}, {end, 0, 8}, {bytes.data() + 1, 0}, {end, 0}, {},
                          {end, 0, 8}, {end, 0, 8});
  EXPECT_EQ(environment.info().volume_count, 1u);
  std::vector<dsw_volume_id> found(1);
  environment.locate_points({kMiddle.at, 3}, {ids.data() + 1, 0}, {found.data(), 1}, {locations.data() + 1, 0});
  EXPECT_EQ(found[0].generation, 1u);
}

TEST(Layer, LentPositionsAreHeldUntilTheNext) {
  Environment environment = cube();
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  Scene scene(environment, &desc);
  std::vector<std::weak_ptr<void>> lent;
  for (int i = 0; i < 3; ++i) {
    auto next = std::make_shared<std::vector<double>>(kPoints);
    (*next)[0] = -0.25 * i;
    lent.push_back(next);
    environment.deform({next->data(), 24, 0, next});
    EXPECT_EQ(environment.get_points().get(0), -0.25 * i);
  }
  EXPECT_TRUE(lent[0].expired() && lent[1].expired() && !lent[2].expired());
  environment.close();
  EXPECT_FALSE(lent[2].expired());
  scene.close();
  EXPECT_TRUE(lent[2].expired());
}

TEST(Layer, ContextsKeepTheirSink) {
  struct Counter : LogSink {
    explicit Counter(int &counter) : lines(counter) {}
    ~Counter() override { lines = -1; }
    void write(int, const char *) override { ++lines; }
    int &lines;
  };
  int lines = 0, before = 0;
  std::optional<Environment> environment;
  {
    const Context context(1, std::make_unique<Counter>(lines));
    before = lines;  // a context says if this processor lacks the kernel of DARTSWEEP_KERNEL
    environment.emplace(Points{kPoints.data(), 24}, Indices{kCube.data(), 8, 8}, Indices{}, View<const std::uint8_t>{},
                        View<const std::int32_t>{}, View<const std::uint32_t>{}, Indices{}, Indices{}, nullptr,
                        &context);
  }
  EXPECT_EQ(lines, before + 1);
  environment.reset();
  EXPECT_EQ(lines, -1);
}

TEST(Layer, RoomForPointsIsWhatTheArrayHas) {
  Environment environment = cube();
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  Scene scene(environment, &desc);
  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  const auto lend = [](std::size_t count) {
    auto next = std::make_shared<std::vector<double>>(kPoints);
    next->resize(3 * count);
    return Lent{next->data(), count, 3, next};
  };
  const auto split = [&] { environment.split_edge(environment.get_edge_id(environment.get_volume_id(0), 0), 0.5); };
  environment.deform(lend(9), &options);
  EXPECT_EQ(options.point_room, 0u);
  split();
  EXPECT_EQ(status_of(split), DSW_STATUS_BORROWED);
  environment.deform(lend(9), &options);
  EXPECT_EQ(status_of(split), DSW_STATUS_BORROWED);
  options.point_room = 1000;
  EXPECT_EQ(status_of([&] { environment.deform(lend(9), &options); }), DSW_STATUS_WRONG_SIZE);
  EXPECT_EQ(status_of([&] { environment.deform(lend(8)); }), DSW_STATUS_WRONG_SIZE);
}

TEST(Layer, SnapshotsGoOn) {
  Environment environment = cube();
  Scene scene(environment);
  const dsw_particle_id particle = scene.create_particle(kMiddle);
  Array<std::uint8_t> block = environment.save(), inside = scene.save();
  Environment other = Environment::load({block.data(), block.size()});
  Scene copy = Scene::load(other, {inside.data(), inside.size()});
  EXPECT_EQ(copy.move_particle(particle, kBeyond).time, scene.move_particle(particle, kBeyond).time);
}

TEST(Layer, SnapshotsHaveContactsAsTheyWere) {
  Environment environment = square();
  const dsw_volume_id wall = environment.get_volume_id(1);
  environment.mark_volumes({&wall, 1}, DSW_MARK_IMPASSABLE);
  Scene scene(environment);
  const double point[] = {0.75, 0.25}, target[] = {0.25, 0.75};
  Body body(scene, scene.create_body({point, 2}));
  body.move({target, 2});
  Array<std::uint8_t> block = environment.save(), inside = scene.save();
  Environment other = Environment::load({block.data(), block.size()});
  Scene copy = Scene::load(other, {inside.data(), inside.size()});
  const Array<dsw_body_contact> was = body.get_contacts(), is = Body(copy, body.id()).get_contacts();
  ASSERT_TRUE(was.size() == 1 && is.size() == 1);
  EXPECT_TRUE(equal(was[0].contact.behind, wall));
  EXPECT_EQ(std::memcmp(was.begin(), is.begin(), sizeof was[0]), 0);
}

TEST(Layer, ThreadsMayCallAndCloseAsTheyLike) {
  for (int round = 0; round < 10; ++round) {
    Environment environment = cube();
    Scene scene(environment);
    const dsw_particle_id particle = scene.create_particle(kMiddle);
    std::atomic<int> refused{0};
    std::vector<std::thread> threads;
    for (int number = 0; number < 8; ++number)
      threads.emplace_back([&, number] {
        try {
          for (int i = 0; i < 200; ++i) {
            if (number == 0 && i == 150) scene.close();
            if (number % 2) scene.move_particle(particle, i % 2 ? kMiddle : kNear);
            if (number == 2) environment.set_tag(environment.get_volume_id(0), static_cast<std::uint32_t>(i));
            if (number == 4) Scene another(environment);
            environment.cast(kMiddle, kBeyond);
            scene.get_particle_position(particle);
          }
        } catch (const Closed &) {
          ++refused;
        }
      });
    for (std::thread &thread : threads) thread.join();
    EXPECT_TRUE(scene.is_closed());
    EXPECT_GE(refused.load(), 1);
  }
}

}  // namespace

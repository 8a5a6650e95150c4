-- Tests of meshes whose parts lie on each other.
local dsw = require "dartsweep"
local lu = require "luaunit"

-- Cubes with points of their own; each is x, y, z and a width.
local function cubes(flags, merge_distance, ...)
  local corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}
  local points, cells = {}, {}
  for i, cube in ipairs {...} do
    cells[i] = {}
    for k, corner in ipairs(corners) do
      cells[i][k] = #points
      points[#points + 1] = {cube[1] + cube[4] * corner[1], cube[2] + cube[4] * corner[2], cube[3] + cube[4] * corner[3]}
    end
  end
  return dsw.Environment {points = points, cells = cells, flags = flags, merge_distance = merge_distance}
end

TestTouching = {}

function TestTouching:test_parts_that_touch_are_counted_and_sewn()
  local one, four = {0, 0, 0, 1}, {{1, 0, 0, 0.5}, {1, 0.5, 0, 0.5}, {1, 0, 0.5, 0.5}, {1, 0.5, 0.5, 0.5}}
  local loose <close> = cubes(dsw.ENVIRONMENT_FIND_TOUCHING, 0, one, table.unpack(four))
  lu.assertEquals(loose:build_report().touching_face_count, 13)
  lu.assertEquals(loose:build_report().touching_face.volume, 0)
  lu.assertEquals(loose:build_report().touched_face.volume, 1)
  local sewn <close> = cubes(dsw.ENVIRONMENT_CONFORM | dsw.ENVIRONMENT_FIND_TOUCHING, 0, one, table.unpack(four))
  lu.assertEquals(sewn:build_report().part_count, 1)
  lu.assertEquals(sewn:build_report().changed_count, 1)
  lu.assertEquals(sewn:build_report().touching_face_count, 0)
  lu.assertEquals(sewn:cast({0.25, 0.5, 0.5}, {1.375, 0.375, 0.25}).outcome, dsw.OUTCOME_REACHED)
  local near <close> = cubes(dsw.ENVIRONMENT_MERGE_POINTS, 1e-9, one, {1 + 1e-10, 0, 0, 1})
  lu.assertEquals(near:build_report().merged_point_count, 4)
  lu.assertError(cubes, dsw.ENVIRONMENT_CONFORM, 0, one, {1, 0.25, 0.25, 1})
end

function TestTouching:test_particles_and_vertices_leave()
  local environment <close> = cubes(0, 0, {0, 0, 0, 1})
  local scene <close> = dsw.Scene(environment)
  local top = environment:cast({0.5, 0.5, 0.5}, {0.5, 0.5, 3}).contact.wall
  environment:mark_exits({top}, 6)
  lu.assertEquals({environment:get_exit(top), #environment:get_exit_faces()}, {6, 1})
  local particle = scene:create_particle({0.25, 0.25, 0.5})
  local flight = scene:move_particle(particle, {0.25, 0.25, 2.5}, {flags = dsw.CAST_LEAVE})
  lu.assertEquals({flight.outcome, scene:get_particle_count()}, {dsw.OUTCOME_EXIT, 0})
  local left = scene:get_exits()
  lu.assertEquals({#left, left[1].patch, left[1].time, left[1].point[3]}, {1, 6, 0.25, 1})
  local rod = scene:create_body {positions = {{0.25, 0.5, 0.25}, {0.25, 0.5, 0.75}}, edges = {0, 1}}
  rod:move({{0.25, 0.5, 0.75}, {0.25, 0.5, 1.25}}, {flags = dsw.MOVE_LEAVE})
  lu.assertEquals({#rod:get_exits(), rod:get_exits()[1].vertex.index}, {1, 1})
  lu.assertError(environment.mark_exits, environment, {dsw.FaceId(0, 1, 9)}, 1)
end

function TestTouching:test_bodies_that_penetrate_are_freed()
  local environment <close> = cubes(0, 0, {0, 0, 0, 1})
  local scene <close> = dsw.Scene(environment)
  local line = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {1.25, 0.5, 0.5}}
  lu.assertError(scene.create_body, scene, {positions = line, edges = {0, 1, 1, 2}})
  local wire = scene:create_body {positions = line, edges = {0, 1, 1, 2}, flags = dsw.BODY_START_PENETRATING}
  local crossed = wire:find_penetrations()
  lu.assertEquals({wire:is_penetrating(), #crossed, crossed[1].part.edge.index}, {true, 1, 1})
  lu.assertError(wire.move, wire, line)
  lu.assertEquals({wire:depenetrate(dsw.VolumeId(0, 0), 0.125)}, {false, 0})
  local freed, distance = wire:depenetrate()
  lu.assertEquals({freed, wire:is_penetrating(), #wire:find_penetrations()}, {true, false, 0})
  lu.assertTrue(distance >= 0.25 and distance <= 0.5)
end

function TestTouching:test_threads_are_cut()
  local environment <close> = cubes(0, 0, {0, 0, 0, 1})
  local scene <close> = dsw.Scene(environment)
  local thread = scene:create_body {positions = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}}, edges = {0, 1}}
  local blade = {{0.375, 0, 0}, {0.375, 0, 1}, {0.375, 1, 0}, {0.375, 1, 1}}
  lu.assertEquals(scene:cut_bodies(blade, 2, 2), 1)
  local cuts = scene:get_body_cuts()
  lu.assertEquals({#cuts, cuts[1].edge_parameter, cuts[1].body.index}, {1, 0.25, thread:id().index})
  lu.assertEquals({scene:cut_bodies(blade, 2, 2), thread:get_counts().edge_count}, {0, 2})
  lu.assertError(scene.cut_bodies, scene, blade, 2, 3)
end

function TestTouching:test_rays_meet_bodies()
  local environment <close> = cubes(0, 0, {0, 0, 0, 1})
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_BODY_CONTACTS})
  local leaf = scene:create_body {positions = {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.25, 0.75, 0.5}}, triangles = {0, 1, 2}, level = dsw.LEVEL_FACES}
  local flights, partners = scene:cast({{0.3, 0.3, 0.75}, {0.9, 0.9, 0.75}}, {{0.3, 0.3, 0.25}, {0.9, 0.9, 0.25}})
  lu.assertEquals({flights[1].outcome, flights[1].time, flights[1].contact.normal[3]}, {dsw.OUTCOME_CONTACT, 0.5, 1})
  lu.assertEquals(partners[1].body.index, leaf:id().index)
  lu.assertEquals(flights[2].outcome, dsw.OUTCOME_REACHED)
  local nearest, near = scene:find_nearest({{0.3, 0.3, 0.625}})
  lu.assertEquals({nearest[1].distance, near[1].face.generation}, {0.125, 1})
  local distances = environment:find_signed_distances({{0.5, 0.5, 0.75}, {0.5, 0.5, 3}})
  lu.assertEquals({distances[1], distances[2]}, {-0.25, 2})
  local sight = environment:cast({0, 0.5, 0.5}, {1, 0.5, 0.25}, nil, {flags = dsw.CAST_OPEN_ENDS})
  lu.assertEquals(sight.outcome, dsw.OUTCOME_REACHED)
end

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

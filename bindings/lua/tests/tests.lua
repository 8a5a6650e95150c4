-- What the scenario has no bits for, and the scenario. Usage: lua tests.lua SCENARIO.JSON [ARGUMENT OF LUAUNIT...]
local dsw = require "dartsweep"
local lu = require "luaunit"
local scenario = require "scenario"
require "carving"
require "rigid"
require "touching"
local scenario_file = table.remove(arg, 1)
local INSIDE, OUTSIDE = scenario.INSIDE, scenario.OUTSIDE

-- The error object of a call that must fail.
local function problem_of(call, ...)
  local good, problem = pcall(call, ...)
  lu.assertFalse(good)
  lu.assertEquals(getmetatable(problem), dsw.Error, tostring(problem))
  return problem
end

local function collect()
  for _ = 1, 3 do collectgarbage() end
end

TestScenario = {}

function TestScenario:test_all_bits_are_those_of_c()
  local file <close> = assert(io.open(scenario_file))
  for line in scenario.play():gmatch "[^\n]+" do lu.assertEquals(line, file:read "l") end
  lu.assertNil(file:read "l")
end

TestErrors = {}

function TestErrors:test_every_status_has_its_name()
  for constant, status in pairs(dsw) do
    if constant:find "^STATUS_" and status ~= dsw.STATUS_OK then
      local problem = problem_of(dsw.raise_status, status)
      local words = constant:sub(#"STATUS_" + 1):lower():gsub("_?(%a)(%a*)", function(first, rest) return first:upper() .. rest end)
      lu.assertEquals(problem.name, words)
      lu.assertEquals(problem.status, status)
    end
  end
end

function TestErrors:test_the_text_is_that_of_the_library_and_says_where()
  local environment <close> = scenario.create()
  local problem = problem_of(function() environment:cast({0, 0 / 0, 0}, INSIDE) end)
  lu.assertEquals(problem.message, "dsw_environment_cast: from[1] is nan, must be finite")
  lu.assertStrMatches(tostring(problem), ".*tests.lua:%d+: dsw_environment_cast: from%[1%] is nan, must be finite")
  -- Also through the package's own Lua.
  problem = problem_of(function() environment:cast_segments({0, 0 / 0, 0}, INSIDE) end)
  lu.assertStrContains(problem.where, "tests.lua")
end

function TestErrors:test_the_failing_call_changes_nothing()
  local environment <close> = scenario.create()
  local scene <close> = dsw.Scene(environment)
  scene:create_particle(INSIDE)
  local before = scene:save()
  lu.assertEquals(problem_of(scene.create_particles, scene, {INSIDE, OUTSIDE}).name, "Outside")
  lu.assertEquals(problem_of(environment.mark_volumes, environment, {(environment:locate(INSIDE))}).name, "Occupied")
  lu.assertEquals(scene:save(), before)
  lu.assertEquals(#scene:get_occupants(), 1)
end

function TestErrors:test_arguments_of_other_types_are_refused()
  local environment <close> = scenario.create()
  local cast, cast_segments = environment.cast, environment.cast_segments
  local face = environment:get_face_id(environment:get_volume_id(0), 0)
  local function refused(text, ...) lu.assertErrorMsgContains(text, ...) end
  refused("'from' (a point, {x, y, z} or {x, y}, expected, got number)", cast, environment, 24, INSIDE)
  refused("'from' (a point, {x, y, z} or {x, y}, expected, got table)", cast, environment, {1}, INSIDE)
  refused("'start' (VolumeId expected, got FaceId)", cast, environment, INSIDE, INSIDE, face)
  refused("'self' (Environment expected, got nil)", cast, nil, INSIDE, INSIDE)
  refused("'self' (Environment expected, got userdata)", cast, io.stdout, INSIDE, INSIDE)
  refused("'self' (Environment expected, got userdata)", cast, dsw.DoubleArray(4), INSIDE, INSIDE)
  refused("'environment' (Environment expected, got nil)", dsw.Scene, nil)
  refused("'index' (an integer of 32 bits expected, got number)", environment.get_volume_id, environment, 0.5)
  refused("'index' (an integer of 32 bits expected, got number)", environment.get_volume_id, environment, -1)
  refused("'points' (3 numbers for each point expected", cast_segments, environment, {{1, 2}, {3, 4}, {5, 6}}, INSIDE)
  refused("'points' (3 numbers for each point expected", cast_segments, environment, {1, 2, 3, 4}, INSIDE)
  refused("'flights' (FlightArray expected, got SweepArray)", cast_segments, environment, INSIDE, INSIDE, nil, nil, dsw.SweepArray(1))
  refused("'volumes' (VolumeIdArray expected, got table)", environment.mark_volumes, environment, {face})
  lu.assertEquals(problem_of(cast_segments, environment, {INSIDE}, {INSIDE, INSIDE}).name, "WrongSize")
  refused("SceneDesc has no member 'feature'", dsw.Scene, environment, {feature = dsw.FEATURE_DEFORMING})
  refused("'features' (an integer of 32 bits expected, got string)", dsw.Scene, environment, {features = "all"})
  refused("'rotation' (4 numbers expected, got table)", function() dsw.RigidMotion().rotation = {1} end)
  refused("has no member 'cell'", dsw.Environment, {points = {INSIDE}, cell = {}})
end

TestPlane = {}

function TestPlane:test_points_have_two_coordinates()
  local environment <close> = dsw.Environment {points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, cells = {{0, 1, 2}, {0, 2, 3}}}
  lu.assertEquals({environment:dimension(), #environment:get_points()}, {2, 8})
  lu.assertEquals(environment:get_vertex_position(environment:get_vertex_id(2)), {1, 1})
  local flight = environment:cast({0.5, 0.25}, {0.5, 2.25})
  lu.assertEquals({flight.time, flight.contact.normal}, {0.375, {0, -1, 0}})
  lu.assertEquals(environment:cast({0.5, 0.25, 0}, {0.5, 2.25, 0}).time, 0.375)
  local side = environment:find_faces({0, 2}, {1, 2})[1]
  local vertex = environment:split_edge(dsw.EdgeId(side.volume, side.generation, side.local_index), 0.25)
  lu.assertEquals(environment:get_vertex_position(vertex), {1, 0.25})
  environment:mark_vertices {environment:get_vertex_id(2)}
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local body = scene:create_body {positions = {{0.5, 0.25}, {0.75, 0.25}}, edges = {{0, 1}}}
  lu.assertEquals(body:move({{0.5, 1.25}, {0.75, 0.5}}).vertices_stopped, 1)
  lu.assertEquals({body:get_contacts()[1].time, #body:get_positions()}, {0.75, 4})
  lu.assertEquals(environment:deform({{0, 0}, {1, 0}, {1, 2}, {0, 2}, {1, 0.5}}).outcome, dsw.DEFORM_DONE)
end

function TestPlane:test_wrong_lengths_are_told()
  local environment <close> = scenario.create_plane()
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local body = scene:create_body {positions = {{40, 30}, {45, 30}}, edges = {{0, 1}}}
  local particles = scene:create_particles {40, 30}
  local function refused(text, ...)
    local problem = problem_of(...)
    lu.assertEquals(problem.name, "WrongSize")
    lu.assertStrContains(problem.message, text)
  end
  refused("2 coordinates, or a third that is 0", environment.cast, environment, {40, 30, 1}, {40, 30})
  refused("2 coordinates, not 3", environment.sweep_edges, environment, {{40, 30}}, {{1, 2, 3}, {1, 2, 3}}, {{40, 31}})
  refused("2 coordinates, not 3", environment.deform, environment, {{1, 2, 3}})
  refused("2 coordinates; 3 numbers are no points", body.move, body, {1, 2, 3})
  refused("point_count is 3, the environment has 121", environment.deform, environment, dsw.DoubleArray(6))
  refused("target_count is 3, there are 2", body.move, body, dsw.DoubleArray(6))
  refused("positions has 3 entries, not 2", body.get_positions, body, dsw.DoubleArray(6))
  refused("positions has 3 entries, not 1", scene.get_particle_positions, scene, particles, dsw.DoubleArray(6))
  lu.assertErrorMsgContains("2 numbers for each point", environment.cast_segments, environment, {{1, 2, 3}, {1, 2, 3}}, {1, 2})
  lu.assertErrorMsgContains("2 numbers for each point", scene.create_particles, scene, {1, 2, 3})
end

function TestPlane:test_polygons()
  local environment <close> = dsw.Environment {points = {{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}, cells = {{0, 1, 2, 3, 4}}}
  lu.assertEquals((environment:get_volume_counts(environment:get_volume_id(0))), dsw.CELL_TYPE_POLYGON)
end

TestOwnership = {}

function TestOwnership:test_closing_twice_is_fine()
  local environment = scenario.create()
  local scene = dsw.Scene(environment)
  for _, each in ipairs {scene, scene, environment, environment} do each:close() end
  lu.assertTrue(scene:is_closed() and environment:is_closed())
  lu.assertEquals({tostring(environment), tostring(scene)}, {"Environment, closed", "Scene, closed"})
end

function TestOwnership:test_use_after_closing_is_an_error()
  local environment = scenario.create()
  local scene = dsw.Scene(environment)
  local body, particle = scenario.create_catheter(scene), scene:create_particle(INSIDE)
  scene:close()
  for _, call in ipairs {
    function() body:get_positions() end, function() body:move(dsw.DoubleArray(36)) end, function() scene:save() end,
    function() scene:move_particle(particle, INSIDE) end, function() scene:create_particle(INSIDE) end,
  } do
    local problem = problem_of(call)
    lu.assertEquals({problem.name, problem.message}, {"Closed", "the scene is closed"})
  end
  environment:close()
  for _, call in ipairs {
    function() environment:save() end, function() environment:cast(INSIDE, INSIDE) end, function() dsw.Scene(environment) end,
  } do
    local problem = problem_of(call)
    lu.assertEquals({problem.name, problem.message}, {"Closed", "the environment is closed"})
  end
end

function TestOwnership:test_metatables_are_not_handed_out()
  local environment = scenario.create()
  lu.assertFalse(getmetatable(environment))
  lu.assertFalse(getmetatable(dsw.Scene(environment)))
end

function TestOwnership:test_variables_that_close_do()
  local environment, scene
  pcall(function()
    local first <close> = scenario.create()
    local second <close> = dsw.Scene(first)
    environment, scene = first, second
    error "on the way"
  end)
  lu.assertTrue(environment:is_closed() and scene:is_closed())
end

function TestOwnership:test_a_scene_keeps_its_environment()
  local environment = scenario.create()
  local scene <close> = dsw.Scene(environment)
  environment:close()
  environment = nil
  collect()
  lu.assertEquals(scene:move_particle(scene:create_particle(INSIDE), {24, 24, 50}).outcome, dsw.OUTCOME_REACHED)
end

function TestOwnership:test_a_body_keeps_its_scene_and_can_be_destroyed()
  local body = scenario.create_catheter(dsw.Scene(scenario.create()))
  collect()
  lu.assertEquals(#body:get_positions(), 3 * scenario.LINKS)
  body:destroy()
  lu.assertEquals(problem_of(body.destroy, body).name, "StaleId")
  lu.assertEquals(problem_of(body.get_positions, body).name, "StaleId")
end

function TestOwnership:test_what_is_forgotten_is_given_back()
  local environment <close> = scenario.create()
  do
    local both = {dsw.Scene(environment), dsw.Scene(environment)}
    lu.assertEquals(problem_of(environment.mark_region, environment, 1).name, "Shared") -- as long as there are two scenes
    lu.assertFalse(both[1]:is_closed())
  end
  collect()
  lu.assertEquals(environment:mark_region(1), 192)
end

function TestOwnership:test_lent_positions_are_read_in_place()
  local environment <close> = scenario.create()
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local first, second = environment:get_points(), environment:get_points()
  environment:deform(first)
  lu.assertEquals(problem_of(environment.deform, environment, first).name, "InUse")
  for i = 3, #second, 3 do second[i] = second[i] + 0.25 end
  environment:deform(second)
  second[1] = 1.5
  lu.assertEquals(environment:get_points()[1], 1.5)
end

function TestOwnership:test_lent_positions_are_held_and_let_go()
  local environment = scenario.create()
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local held = setmetatable({}, {__mode = "k"})
  local function lend()
    local positions = environment:get_points()
    held[positions] = true
    environment:deform(positions)
  end
  local function count()
    collect()
    local number = 0
    for _ in pairs(held) do number = number + 1 end
    return number
  end
  coroutine.wrap(lend)() -- a coroutine that is gone afterwards
  lu.assertEquals(count(), 1)
  lend()
  lu.assertEquals(count(), 1)
  problem_of(environment.deform, environment, dsw.DoubleArray(6)) -- what is refused is not held
  lu.assertEquals(count(), 1)
  scene:close()
  environment:close()
  lu.assertEquals(count(), 0)
end

TestValues = {}

function TestValues:test_arrays_are_indexed_like_tables()
  local array = dsw.DoubleArray {{1, 2, 3}, {4, 5, 6}}
  lu.assertEquals({#array, array[1], array[6], array[7], array[0], array.x}, {6, 1.0, 6.0})
  array[2] = 7.5
  lu.assertEquals(array:totable(), {1, 7.5, 3, 4, 5, 6})
  lu.assertEquals({array:point(2)}, {4, 5, 6})
  array:set_point(1, 8, 9, 10)
  local sum = 0
  for _, value in ipairs(array) do sum = sum + value end
  lu.assertEquals(sum, 42)
  lu.assertEquals(tostring(array), "DoubleArray of 6")
  lu.assertErrorMsgContains("6 elements, from 1", function() array[7] = 1 end)
  lu.assertErrorMsgContains("cannot be a string", function() array[1] = "1" end)
  lu.assertErrorMsgContains("there is no such point", array.point, array, 3)
  lu.assertErrorMsgContains("is made of", dsw.DoubleArray, -1)
  lu.assertErrorMsgContains("is made of", dsw.UIntArray, {1, -1})
  lu.assertError(dsw.DoubleArray, 1e15)
end

function TestValues:test_arrays_go_through_bytes()
  local numbers = {0.1, -0.0, 1e300, 5e-324}
  local array = dsw.DoubleArray(string.pack("<dddd", table.unpack(numbers)))
  lu.assertEquals({string.unpack("<dddd", array:bytes())}, {0.1, -0.0, 1e300, 5e-324, 33})
  local ids = dsw.VolumeIdArray {dsw.VolumeId(3, 1), dsw.VolumeId(4, 2)}
  lu.assertEquals(ids:bytes(), string.pack("<I4I4I4I4", 3, 1, 4, 2))
  lu.assertEquals(dsw.VolumeIdArray(ids:bytes())[2], dsw.VolumeId(4, 2))
  lu.assertErrorMsgContains("whole elements", dsw.DoubleArray, "123")
end

function TestValues:test_arrays_are_filled_again()
  local environment <close> = scenario.create()
  local from, to = dsw.points {INSIDE, INSIDE}, dsw.points {{24, 24, 50}, {90, 24, 48}}
  local flights = dsw.FlightArray(2)
  lu.assertTrue(rawequal(environment:cast_segments(from, to, nil, nil, flights), flights))
  lu.assertEquals(flights[1].outcome, dsw.OUTCOME_REACHED)
  to:set_point(1, 24, 90, 48)
  environment:cast_segments(from, to, nil, nil, flights)
  lu.assertEquals(flights[1].outcome, dsw.OUTCOME_CONTACT)
end

function TestValues:test_nearest_of_points_and_segments()
  local environment <close> = scenario.create()
  local from, to = {INSIDE, INSIDE}, {{24, 24, 50}, {25, 24, 48}}
  local volumes, locations = dsw.VolumeIdArray(2), dsw.IntArray(2)
  local points = environment:find_nearest_to_points(from, 20, nil, nil, volumes, locations)
  lu.assertEquals(points[1].distance, environment:find_nearest(INSIDE, 20).distance)
  lu.assertEquals(locations[2], dsw.LOCATION_PASSABLE)
  local segments = environment:find_nearest_to_segments(from, to, 20, volumes)
  lu.assertTrue(segments[1].nearest.distance <= points[1].distance)
  lu.assertTrue(segments[1].segment_parameter >= 0 and segments[1].segment_parameter <= 1)
  lu.assertEquals(#segments[1].segment_point, 3)
end

function TestValues:test_places_inside()
  local environment <close> = scenario.create()
  local outside = {{24, 24, 900}, INSIDE}
  local volumes = dsw.VolumeIdArray(2)
  local inside = environment:find_inside(outside, 0.5, nil, volumes)
  lu.assertEquals({inside[4], inside[5], inside[6]}, INSIDE)
  local _, location = environment:locate({inside[1], inside[2], inside[3]})
  lu.assertEquals(location, dsw.LOCATION_PASSABLE)
end

function TestValues:test_pairs()
  local function at(first, second, third) -- three pairs whose first features are at these heights
    return {
      {0.25, 0.25, first}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0},
      {-1, 0.25, second}, {1, 0.25, second}, {0, -1, 0}, {0, 1, 0},
      {0.5, 0.25, third}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0},
    }
  end
  local from, kinds = at(1, 1, 1), {dsw.PAIR_VERTEX_FACE, dsw.PAIR_EDGE_EDGE, dsw.PAIR_VERTEX_FACE}
  local function expect(touches, times, ranks)
    for i = 1, 3 do
      lu.assertEquals(touches[i].time, times[i])
      lu.assertEquals(touches[i].rank, ranks[i])
    end
  end
  local touches = dsw.sweep_pairs(3, kinds, from, at(-2, -2, -1), dsw.PAIRS_RANK)
  expect(touches, {1 / 3, 1 / 3, 0.5}, {0, 0, 2})
  -- Later, by so little that the rounded time is the same.
  local later = at(-2 + 2 ^ -52, -2, 2)
  lu.assertTrue(rawequal(dsw.sweep_pairs(3, dsw.ByteArray(kinds), from, later, dsw.PAIRS_RANK, touches, dsw.Context(2)), touches))
  expect(touches, {1 / 3, 1 / 3, 0}, {1, 0, 2})
  lu.assertEquals(touches[3].touches, 0)
  local flat = dsw.sweep_pairs(2, {dsw.PAIR_VERTEX_EDGE}, {{0.5, 1}, {0, 0}, {1, 0}}, {{0.5, -1}, {0, 0}, {1, 0}})
  lu.assertEquals({flat[1].time, #dsw.sweep_pairs(3, {}, {}, {})}, {0.5, 0})
  local motion, wall = {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {{0, -5}, {3, -9}, {3, 9}} -- half a turn
  lu.assertEquals(problem_of(dsw.sweep_pairs, 3, {0, 2, 0}, from, later).name, "Unsupported")
  lu.assertEquals(dsw.sweep_rigid_pairs(2, {dsw.PAIR_VERTEX_EDGE}, wall, {}, motion, {0, 0xffffffff})[1].time, 0.25)
  lu.assertEquals(problem_of(dsw.sweep_pairs, 3, {0, 1}, from, later).name, "WrongSize")
  lu.assertEquals(problem_of(dsw.sweep_pairs, 3, kinds, from, at(0 / 0, 0, 0)).name, "NonFinite")
end

-- One hexahedron with its floor at a height.
local function room(z)
  return {{0, 0, z}, {4, 0, z}, {4, 4, z}, {0, 4, z}, {0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}}
end

local function strand(x, z)
  z = z or 1
  return {x, 1, z, x, 2, z, x, 3, z}
end

local function strands(x, other) return table.move(strand(other), 1, 9, 10, strand(x)) end

local function make_room() return dsw.Environment {points = room(0), cells = {{0, 1, 2, 3, 4, 5, 6, 7}}} end

local function make_scene(environment)
  return dsw.Scene(environment, {features = dsw.FEATURE_BODY_CONTACTS | dsw.FEATURE_DEFORMING})
end

local function make_strand(scene, x) return scene:create_body {positions = strand(x), edges = {0, 1, 1, 2}} end

local function numbers_of(array) return table.move(array, 1, #array, 1, {}) end

function TestValues:test_strands_that_move_together_do_not_stop_each_other()
  local environment <close> = make_room()
  local scene <close> = make_scene(environment)
  local left, right = make_strand(scene, 1), make_strand(scene, 1.25)
  local both = dsw.BodyIdArray {left:id(), right:id()}
  local reports = scene:move_together(both, strands(2, 2.25))
  lu.assertEquals({#reports, reports[1].fraction, reports[2].fraction}, {2, 1, 1})
  lu.assertEquals(numbers_of(left:get_positions()), strand(2))
  local options = {stop = dsw.TOGETHER_STOP_FEATURE, max_rounds = 4}
  lu.assertTrue(rawequal(scene:move_together(both, strands(3, 5), options, reports), reports))
  lu.assertEquals({reports[1].vertices_stopped, reports[2].vertices_stopped}, {0, 3})
  lu.assertEquals(numbers_of(left:get_positions()), strand(3))
  -- One vertex at a time the left strand runs into the right one.
  scene:move_together(both, strands(1, 1.25))
  reports = scene:move_bodies(both, strands(2, 2.25))
  lu.assertEquals({reports[1].vertices_stopped, reports[2].vertices_stopped}, {3, 0})
end

function TestValues:test_a_floor_stops_before_a_strand_or_rises_with_it()
  local environment <close> = make_room()
  local scene <close> = make_scene(environment)
  local body = make_strand(scene, 2)
  local report, reports = scene:deform(room(2))
  lu.assertEquals({report.outcome, #reports}, {dsw.DEFORM_FRACTION, 0})
  lu.assertTrue(report.fraction < 0.5 and report.fraction > 0.4999999)
  local contacts = environment:get_wall_contacts()
  lu.assertEquals({contacts[1].time, contacts[1].body, report.contact_count}, {0.5, body:id(), #contacts})
  -- Integers are long beside the least double.
  report, reports = scene:deform(room(2), {body:id()}, strand(5e-324), {max_work = 1})
  lu.assertEquals({report.outcome, reports[1].vertices_limited}, {dsw.DEFORM_LIMITED, 3})
  lu.assertEquals(numbers_of(body:get_positions()), strand(2))
  report, reports = scene:deform(room(1.5), {body:id()}, strand(2, 2))
  lu.assertEquals({report.outcome, reports[1].fraction}, {dsw.DEFORM_DONE, 1})
  lu.assertEquals(numbers_of(body:get_positions()), strand(2, 2))
end

function TestValues:test_wrong_moves_together_are_refused()
  local environment <close> = make_room()
  local scene <close> = make_scene(environment)
  local body = make_strand(scene, 2)
  local one, twice = {body:id()}, {body:id(), body:id()}
  local function both_refuse(name, ids, targets)
    lu.assertEquals(problem_of(scene.move_together, scene, ids, targets).name, name)
    lu.assertEquals(problem_of(scene.deform, scene, room(1), ids, targets).name, name)
  end
  both_refuse("WrongSize", one, {2, 1, 1})
  both_refuse("DuplicateId", twice, strands(2, 2))
  both_refuse("StaleId", {dsw.BodyId(5, 1)}, strand(2))
  both_refuse("NonFinite", one, strand(0 / 0))
  lu.assertEquals(problem_of(scene.deform, scene, strand(2)).name, "WrongSize")
  lu.assertEquals(problem_of(scene.move_together, scene, one, strand(2), {stop = 3}).name, "Unsupported")
  local other <close> = make_room()
  local plain <close> = dsw.Scene(other)
  lu.assertEquals(problem_of(plain.deform, plain, room(1)).name, "NotEnabled")
end

function TestValues:test_near_rows()
  local points, cells = {}, {}
  for i = 0, 17 do points[i + 1] = {i % 3, i // 3 % 3, i // 9} end
  for _, at in ipairs {0, 1, 3, 4} do
    local cell = {}
    for k, corner in ipairs {0, 1, 4, 3, 9, 10, 13, 12} do cell[k] = at + corner end
    cells[#cells + 1] = cell
  end
  local environment <close> = dsw.Environment {points = points, cells = cells, regions = {1, 1, 1, 2}}
  environment:mark_region(2) -- a pillar, whose edge is at x = y = 1
  local scene <close> = dsw.Scene(environment)
  local wire = scene:create_body {positions = {{0.25, 1.5, 0.375}, {1.5, 0.25, 0.375}}, edges = {0, 1}}
  local half, none = math.sqrt(0.5), 2 ^ 32 - 1
  lu.assertEquals(#wire:get_near_rows(), 0)
  lu.assertEquals(wire:find_near_rows {margin = 0.25, radius = 0.0625, flags = dsw.NEAR_JACOBIAN}, 3)
  local rows = wire:get_near_rows()
  lu.assertEquals({rows[1].distance, rows[1].gap, rows[2].vertices}, {0.25, 0.1875, {1, none, none}})
  lu.assertEquals(rows[1].normal, {1, 0, 0})
  lu.assertEquals(rows[3].obstacle.kind, dsw.CELL_EDGE)
  lu.assertAlmostEquals(rows[3].distance, half / 4, 1e-15)
  lu.assertAlmostEquals(rows[3].normal[1], -half, 1e-15)
  lu.assertEquals({rows[3].weights, rows[3].obstacle_point}, {{0.5, 0.5, 0}, {1, 1, 0.375}})
  lu.assertTrue(rows[3].body:is_null() and not rows[3].wall:is_null())
  local offsets, columns, values = wire:get_near_offsets(), wire:get_near_columns(), wire:get_near_values()
  lu.assertEquals({#offsets, offsets[4], #columns, columns[12], values[1], values[5]}, {4, 12, 12, 5, 1, 1})
  wire:move {{0.265625, 1.5, 0.375}, {1.515625, 0.25, 0.375}}
  lu.assertEquals(wire:find_near_rows {margin = 0.25, radius = 0.0625}, 3)
  for i = 1, 3 do
    local row = wire:get_near_rows()[i]
    lu.assertEquals({row.key, row.previous}, {rows[i].key, i - 1})
  end
  lu.assertEquals(wire:get_near_rows()[1].distance, 0.265625)
  lu.assertEquals(#wire:get_near_offsets(), 0)
  lu.assertEquals(problem_of(wire.find_near_rows, wire, {margin = -1}).name, "OutOfRange")
end

function TestValues:test_a_thick_body_keeps_its_radius()
  local environment <close> = dsw.Environment {
    points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
    cells = {{0, 1, 2, 3, 4, 5, 6, 7}},
  }
  local scene <close> = dsw.Scene(environment)
  local described = {positions = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}}, edges = {0, 1}, radius = 0.1}
  local wire = scene:create_body(described)
  lu.assertEquals(wire:get_radius(), 0.1)
  lu.assertEquals(problem_of(wire.set_radius, wire, -1).name, "OutOfRange")
  lu.assertEquals(problem_of(wire.find_least_gap, wire, 0 / 0).name, "OutOfRange")
  wire:set_radius(0.125)
  lu.assertEquals({wire:get_radius(), wire:find_least_gap(0.0625)}, {0.125, 0.0625})
  lu.assertAlmostEquals(wire:find_least_gap(1), 0.125, 1e-8)
  lu.assertEquals(problem_of(wire.set_radius, wire, 0.5).name, "Occupied")
  local edges = scene:get_offending_edges()
  lu.assertEquals({#edges, edges[1], edges[2]}, {2, 0, 1})
  wire:set_radius(0.1)
  lu.assertAlmostEquals(wire:find_least_gap(1), 0.15, 1e-8)
  wire:move {{0.25, 0.5, -0.5}, {0.75, 0.5, -0.5}}
  lu.assertTrue(wire:find_least_gap(0.1) >= -1e-9)
  lu.assertAlmostEquals(wire:get_positions()[3], 0.1, 1e-3)
  described.radius = 0.3
  lu.assertEquals(problem_of(scene.create_body, scene, described).name, "Occupied")
end

function TestValues:test_empty_arrays_are_left_out()
  local environment <close> = dsw.Environment {
    points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, cells = {0, 1, 2, 3}, uniform_cell_type = dsw.CELL_TYPE_TETRA,
    types = "", offsets = {}, regions = {}, tags = dsw.UIntArray(0),
  }
  lu.assertEquals(environment:get_region(environment:get_volume_id(0)), 0)
  local volumes = environment:locate_points({{0.25, 0.25, 0.25}}, {}, nil, dsw.IntArray(0))
  lu.assertFalse(volumes[1]:is_null())
  local scene <close> = dsw.Scene(environment)
  lu.assertEquals(#scene:create_particles {}, 0)
  lu.assertEquals(#scene:move_particles({}, {}), 0)
  scene:move_particles(scene:create_particles {0.25, 0.25, 0.25}, {0.5, 0.25, 0.125}, nil, dsw.FlightArray(0))
end

function TestValues:test_ids_are_values()
  lu.assertTrue(dsw.VolumeId(3, 4) == dsw.VolumeId(3, 4))
  lu.assertFalse(dsw.VolumeId(3, 4) == dsw.VolumeId(3, 5))
  lu.assertFalse(dsw.VolumeId(3, 4) == dsw.VertexId(3, 4))
  lu.assertTrue(dsw.FaceId(0, 0, 0):is_null() and not dsw.FaceId(0, 1, 0):is_null())
  lu.assertEquals(tostring(dsw.VolumeId(3, 4)), "VolumeId {generation = 4, index = 3}")
end

function TestValues:test_members_are_copies()
  local environment <close> = scenario.create()
  local position = environment:cast(INSIDE, {90, 24, 48}).position
  collect()
  lu.assertEquals({position[2], position[3]}, {24, 48})
  local motion = dsw.RigidMotion()
  motion.translation = {1, 2, 3}
  lu.assertEquals(motion.translation, {1, 2, 3})
end

function TestValues:test_options_are_tables_or_objects()
  local environment <close> = scenario.create()
  local scene <close> = dsw.Scene(environment)
  local body = scenario.create_catheter(scene)
  local options = dsw.MoveOptions()
  options.vertex_response = dsw.RESPONSE_SLIDE
  local motion = {rotation = {0, 0, 0, 1}, translation = {0, 0, 1}}
  lu.assertEquals(body:move_rigid(motion, options).vertices_stopped, 0)
  lu.assertEquals(body:move_rigid(motion, {vertex_response = dsw.RESPONSE_SLIDE}).vertices_stopped, 0)
  lu.assertEquals({body:get_positions():point(1)}, {24.5, 25.25, 10.125})
end

function TestValues:test_surfaces_are_made_of_triangles()
  local environment <close> = scenario.create()
  local scene <close> = dsw.Scene(environment)
  local positions = {{24, 24, 48}, {25, 24, 48}, {24, 25, 48}, {24, 24, 49}}
  local body = scene:create_body {positions = positions, triangles = {{0, 1, 2}, {0, 3, 1}}, level = dsw.LEVEL_FACES}
  lu.assertEquals(#body:get_face_ids(), 2)
  lu.assertEquals(body:get_level(), dsw.LEVEL_FACES)
  lu.assertEquals(scene:body(body:id()):get_face_indices():totable(), {0, 1, 2, 0, 3, 1})
end

function TestValues:test_calls_have_several_results()
  local environment <close> = scenario.create()
  local volume, location = environment:locate(INSIDE)
  lu.assertEquals({location, volume:is_null()}, {dsw.LOCATION_PASSABLE, false})
  lu.assertEquals({environment:get_volume_counts(volume)}, {dsw.CELL_TYPE_HEXAHEDRON, 8, 12, 6})
  local other, volume_map = environment:coarsen()
  other:close()
  lu.assertEquals(#volume_map, 432)
end

function TestValues:test_the_log_is_read()
  local log = dsw.Log()
  local tetrahedron = {points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, cells = {{0, 1, 2, 3}}, threads = 2, log = log}
  dsw.Environment(tetrahedron):close()
  local lines = {}
  for level, text in log:lines() do lines[#lines + 1] = level .. " " .. text end
  lu.assertEquals(#lines, 1)
  lu.assertStrContains(lines[1], dsw.LOG_INFO .. " dsw_environment_create: 1 volumes")
end

function TestValues:test_a_bug_report_is_one_call()
  local environment <close> = scenario.create()
  local scene <close> = dsw.Scene(environment)
  local path = os.tmpname()
  scene:start_recording(nil, dsw.RECORDING_LATEST)
  scene:create_particle(INSIDE)
  local validation = scene:write_bug_report(path, "a note")
  lu.assertEquals({validation.is_right, validation.places, validation.text}, {1, 1, ""})
  local file <close> = assert(io.open(path, "rb"))
  lu.assertStrContains(file:read "a", "a note")
  os.remove(path)
end

function TestValues:test_static_functions_have_one_name()
  lu.assertIsFunction(dsw.Environment.load)
  for name in pairs(dsw) do
    local class, method = name:match("^(%u%w*%l%w*)_(%l[%w_]*)$")
    lu.assertFalse(class ~= nil and dsw[class] ~= nil, name)
  end
end

function TestValues:test_versions_agree()
  lu.assertEquals(dsw.version(), 1000000 * dsw.VERSION_MAJOR + 1000 * dsw.VERSION_MINOR + dsw.VERSION_PATCH)
  lu.assertEquals(dsw._VERSION, ("Dartsweep %d.%d.%d"):format(dsw.VERSION_MAJOR, dsw.VERSION_MINOR, dsw.VERSION_PATCH))
  lu.assertNil(swig_type) -- nothing is left among the globals
end

TestReports = {}

function TestReports:test_a_change_outlasts_the_next()
  local environment = scenario.create()
  local first = environment:cut({{-5, 3, 20.5}, {60, 3, 20.5}, {-5, 3, 60.25}, {60, 3, 60.25}}, 2, 2)
  lu.assertEquals({first.volumes_crossed, first.volumes_split, first.volumes_changed, first.is_closed}, {36, 24, 36, 0})
  lu.assertEquals({environment:get_change().distance, #environment:get_change():get_volumes()}, {first.distance, 60})
  local volume = environment:get_volume_id(3)
  environment:remove_volumes {volume}
  local second = environment:get_change()
  lu.assertEquals({second.volumes_split, #second:get_volumes(), #second:get_faces()}, {0, 1, 0})
  lu.assertTrue(second:get_volumes()[1].before == volume and second:get_volumes()[1].after:is_null())
  environment:close()
  lu.assertEquals({#first:get_volumes(), #first:get_vertices(), #first:get_faces(), #first:get_whole()}, {60, 35, 24, 12})
  lu.assertEquals({#first:get_carved(), #first:get_unrepaired(), #first:get_detached()}, {0, 0, 0})
  local origin = first:get_vertices()[1]
  lu.assertTrue(origin.weights[1] + origin.weights[2] == 1 and origin.from[1] ~= origin.from[2])
end

function TestReports:test_each_report_says_what_was_touched()
  local environment <close> = scenario.create()
  environment:mark_region(2)
  local flight = environment:cast(INSIDE, {90, 24, 48})
  lu.assertEquals({flight.contact.kind, flight.contact.marked_kind}, {dsw.CONTACT_PLANE, dsw.CELL_VOLUME})
  lu.assertEquals(flight.contact.obstacle, dsw.cell_of(flight.contact.wall))
  lu.assertTrue(environment:is_impassable(dsw.cell_of(flight.contact.behind)))
  lu.assertEquals(environment:cast(INSIDE, {24, 24, 50}).contact.kind, dsw.CONTACT_NONE)
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local body = scenario.create_catheter(scene)
  lu.assertEquals(body:split_edge(body:get_edge_ids()[1], 0.25).edge_parameter, 0.25)
  lu.assertEquals(#body:get_edge_ends(body:get_edge_ids()[1]), 2)
  local positions = environment:get_points()
  for i = 1, #positions, 3 do positions[i] = positions[i] + (48 - positions[i]) * 0.4375 end
  lu.assertEquals(environment:deform(positions).contact_count, #environment:get_wall_contacts())
  local touched = environment:get_wall_contacts()[1]
  lu.assertTrue(touched.body == body:id() and touched.contact.normal[1] > 0.9 and touched.contact.obstacle.kind ~= dsw.CELL_NONE)
  lu.assertEquals({touched.response, #environment:get_held_vertices()}, {dsw.WALL_PUSH, 0})
end

os.exit(lu.LuaUnit.run(), true)

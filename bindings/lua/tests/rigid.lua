-- Tests of rigid motions: how far bodies could go. And of what touches while all vertices move at once.
local dsw = require "dartsweep"
local lu = require "luaunit"

TestRigid = {}

-- One hexahedron, and a bar in the middle of a scene.
local function make_room()
  local points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}}
  return dsw.Environment {points = points, cells = {{0, 1, 2, 3, 4, 5, 6, 7}}}
end

local function make_bar(scene)
  return scene:create_body {positions = {{1, 2, 2}, {3, 2, 2}}, edges = {{0, 1}}}
end

function TestRigid:test_free_fractions_move_nothing()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment)
  local bar = make_bar(scene)
  local poses = {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 4, 0, 0}
  local contacts = dsw.BodyContactArray(3)
  local found = bar:find_free_fractions({2, 2, 2}, poses, {0, 1, 0, 0, 2, 2}, {0, 3, 5, 6}, nil, contacts)
  lu.assertEquals({found[1].fraction, found[1].piece, found[1].starts_free, found[3].starts_free}, {1, 2, 1, 0})
  lu.assertTrue(found[2].fraction < 0.25 and found[2].fraction > 0.25 - 1e-12)
  lu.assertEquals(contacts[2].time, 0.25)
  lu.assertEquals({bar:get_positions():point(1)}, {1, 2, 2})
  lu.assertFalse(pcall(bar.find_free_fractions, bar, {2, 2, 2}, {1, 2}, {0, 0}))
end

function TestRigid:test_how_much_of_steps_is_free()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment)
  local bar = make_bar(scene)
  local fraction, places, fractions = scene:step_fraction({bar:id()}, {4, 0, 0, 4, 0, 0})
  lu.assertTrue(fraction < 0.25 and fraction > 0.2499999)
  lu.assertEquals({places[1], fractions[1]}, {1 + 4 * fraction, fraction})
  lu.assertEquals({bar:get_positions():point(1)}, {1, 2, 2})
  local walls = {0, 0, 3, 0, 0, 3, 0, 0, 3, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}
  local moved, _, _, raised = scene:step_fraction({bar:id()}, {0, 0, 0, 0, 0, 0}, nil, nil, nil, walls)
  lu.assertTrue(moved < 2 / 3 and moved > 0.6666)
  lu.assertEquals(raised[3], 3 * moved)
end

function TestRigid:test_a_bar_slides_along_a_wall()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment)
  local bar = make_bar(scene)
  local report = bar:move_rigid({rotation = {0, 0, 0, 1}, translation = {4, 1, 0}}, {flags = dsw.MOVE_SLIDE_WHOLE})
  lu.assertAlmostEquals(report.fraction, 0.25, 1e-12)
  local x, y = bar:get_positions():point(2)
  lu.assertAlmostEquals(x, 4, 1e-9)
  lu.assertAlmostEquals(y, 3, 1e-9)
  lu.assertAlmostEquals(bar:get_motion_left().translation[1], 3, 1e-9)
end

function TestRigid:test_rigid_bodies_move_at_once()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_BODY_CONTACTS})
  local left = scene:create_body {positions = {{0.5, 2, 2}, {1, 2, 2}}, edges = {{0, 1}}}
  local right = scene:create_body {positions = {{3, 2, 2}, {3.5, 2, 2}}, edges = {{0, 1}}}
  local motions = {0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0}
  local reports = scene:move_rigid({left:id(), right:id()}, motions)
  lu.assertAlmostEquals(reports[1].fraction, 0.25, 1e-12)
  lu.assertEquals(reports[1].fraction, reports[2].fraction)
end

function TestRigid:test_thick_rigid_bodies_keep_their_distance_at_once()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_BODY_CONTACTS})
  local left = scene:create_body {positions = {{0.5, 2, 2}, {1, 2, 2}}, edges = {{0, 1}}, radius = 0.125}
  local right = scene:create_body {positions = {{3, 2, 2}, {3.5, 2, 2}}, edges = {{0, 1}}, radius = 0.125}
  local motions = {0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, -4, 0, 0}
  local reports = scene:move_rigid({left:id(), right:id()}, motions)
  lu.assertAlmostEquals(reports[1].fraction, 0.21875, 1e-9)
  lu.assertEquals(reports[1].fraction, reports[2].fraction)
end

function TestRigid:test_a_bar_turns_while_the_floor_rises()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local bar = make_bar(scene)
  local raised = {0, 0, 3, 4, 0, 3, 4, 4, 3, 0, 4, 3, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4}
  local half = math.sqrt(0.5)
  local report, reports = scene:deform_rigid(raised, {bar:id()}, {0, 0, half, half, 2, 2, 2, 0, 0, 0})
  lu.assertEquals(report.outcome, dsw.DEFORM_FRACTION)
  lu.assertAlmostEquals(report.fraction, 2 / 3, 1e-9)
  lu.assertEquals(reports[1].fraction, report.fraction)
  lu.assertAlmostEquals(environment:get_wall_contacts()[1].time, 2 / 3, 1e-12)
  lu.assertFalse(pcall(scene.deform_rigid, scene, raised, {bar:id()}, {0, 0, 0, 1}))
end

function TestRigid:test_only_the_parts_that_touch_stop_or_are_pushed()
  for _, response in ipairs {dsw.TOGETHER_RESPONSE_STOP, dsw.TOGETHER_RESPONSE_SLIDE} do
    local environment <close> = make_room()
    local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
    local bar = make_bar(scene)
    local raised = {0, 0, 3, 4, 0, 3, 4, 4, 3, 0, 4, 3, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4}
    local options = {stop = dsw.TOGETHER_STOP_FEATURE, response = response}
    local report = scene:deform(raised, {bar:id()}, {1, 2, 2, 3, 2, 2}, options)
    local stops = response == dsw.TOGETHER_RESPONSE_STOP
    lu.assertEquals(report.outcome, stops and dsw.DEFORM_HELD or dsw.DEFORM_DONE)
    lu.assertEquals(report.held_count, #environment:get_held_vertices())
    lu.assertAlmostEquals(bar:get_ways_left()[3], stops and 0 or -1, 1e-9)
  end
end

function TestRigid:test_back_edges_that_are_left_are_listed()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment)
  local flags = dsw.BODY_SKIP_BACK_EDGES | dsw.BODY_LEAVE_BACK_EDGES
  local corners, faces = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}
  local body = scene:create_body {positions = corners, triangles = faces, level = dsw.LEVEL_EDGES, flags = flags}
  lu.assertEquals(#body:get_untested_edges(), 0)
  body:move {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1.1, 1.1, 1.7}} -- the tip goes inwards
  lu.assertEquals(#body:get_untested_edges(), 3)
  body:move(corners)
  lu.assertEquals(#body:get_untested_edges(), 0)
end

function TestRigid:test_a_particle_has_a_state()
  local environment <close> = make_room()
  local scene <close> = dsw.Scene(environment)
  local particle = scene:create_particle {2, 2, 2}
  lu.assertEquals(scene:get_particle_cell(particle).kind, dsw.CELL_VOLUME)
  lu.assertEquals(scene:get_particle_aim(particle).kind, dsw.CELL_NONE)
  scene:move_particle(particle, {2, 2, 9})
  lu.assertEquals(scene:get_particle_aim(particle).kind, dsw.CELL_FACE)
end

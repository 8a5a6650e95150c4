-- Tests of what is drilled away, and of pieces that come off.
local dsw = require "dartsweep"
local lu = require "luaunit"
local scenario = require "scenario"

TestCarving = {}

function TestCarving:test_a_drill_halves_what_it_crosses()
  local environment <close> = scenario.create()
  environment:mark_volumes {environment:get_volume_id(237)}
  local drill = {{29.25, 29.25, 53.25}, {29.25, 27.25, 51.25}, {27.25, 29.25, 51.25}, {27.25, 27.25, 53.25}}
  local change = environment:carve(drill, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}, {finest = 1, flags = dsw.CARVE_COVER})
  lu.assertEquals({change.volumes_split, #change:get_carved(), #change:get_whole()}, {1, 63, 0})
end

function TestCarving:test_a_piece_becomes_a_body()
  local environment <close> = scenario.create()
  local scene <close> = dsw.Scene(environment)
  local volume = environment:get_volume_id(237)
  environment:mark_volumes {volume}
  local body, change = scene:body(environment:detach {volume = volume}), environment:get_change()
  lu.assertEquals(body:get_counts().vertex_slots, 8)
  lu.assertEquals({#change:get_body_vertices(), #change:get_body_faces(), #change:get_detached()}, {8, 12, 1})
  lu.assertTrue(change.distance > 0 and change:get_detached()[1] == volume and change:get_body_faces()[1].volume == volume)
  local origin = change:get_body_vertices()[8]
  lu.assertTrue(origin.vertex:is_null() and origin.from[1] == origin.from[2] and not origin.from[1]:is_null())
  lu.assertEquals(origin.weights, {1, 0})
end

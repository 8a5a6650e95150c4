-- Dartsweep for Lua: dartsweep.core with Lua's habits on top. README.md tells how arguments and results look.

local core = require "dartsweep.core"

-- Metatable and methods of a class's objects.
local function parts_of(class)
  local meta = getmetatable(class)[".instance"]
  return meta, meta[".fn"]
end
local environment_meta, Environment = parts_of(core.Environment)
local scene_meta, Scene = parts_of(core.Scene)
local body_meta, Body = parts_of(core.Body)
local log_meta, Log = parts_of(core.Log)

local version = core.version()
core._VERSION = ("Dartsweep %d.%d.%d"):format(math.floor(version / 1000000), math.floor(version / 1000) % 1000, version % 1000)

-- --- what all objects can do

local function same_members(a, b)
  local meta = getmetatable(a)
  if meta ~= getmetatable(b) then return false end
  for name in pairs(meta[".get"]) do
    if a[name] ~= b[name] then return false end
  end
  return true
end

local function text_of(value)
  if type(value) ~= "table" then return tostring(value) end
  local texts = {}
  for i, each in ipairs(value) do texts[i] = text_of(each) end
  return "{" .. table.concat(texts, ", ") .. "}"
end

for name, class in pairs(core) do
  if type(class) == "table" and getmetatable(class) then
    local meta, methods = parts_of(class)
    methods.__disown = nil -- SWIG's, of no use here
    for static in next, class do
      local second = name .. "_" .. static -- that SWIG also gives it
      if core[second] then core[second] = nil end
    end
    meta.__eq = (name:find("Id$") or name == "Cell") and same_members or nil
    local members = {}
    for member in pairs(meta[".get"]) do members[#members + 1] = member end
    table.sort(members)
    meta.__tostring = function(self)
      local texts = {}
      for i, member in ipairs(members) do texts[i] = member .. " = " .. text_of(self[member]) end
      return name .. " {" .. table.concat(texts, ", ") .. "}"
    end
  end
end

function core.Error:__tostring() return self.where .. self.message end

function environment_meta:__tostring()
  if self:is_closed() then return "Environment, closed" end
  return ("Environment of %d volumes"):format(self:info().volume_count)
end

function scene_meta:__tostring()
  if self:is_closed() then return "Scene, closed" end
  return ("Scene of %d particles and %d bodies"):format(self:get_particle_count(), self:get_body_count())
end

function body_meta:__tostring() return "Body " .. self:id().index end

environment_meta.__close = function(self) self:close() end
scene_meta.__close = environment_meta.__close

-- For loops: level and text of each line that has not been read.
function Log:lines()
  return function() return self:read() end
end

-- --- calls with named arguments: what is not an array is a member of the description

local function copied(given)
  local copy = {}
  for name, value in pairs(given) do copy[name] = value end
  return copy
end

local function take(given, name)
  local value = given[name]
  given[name] = nil
  return value
end

local type_of_row = {
  [4] = core.CELL_TYPE_TETRA, [5] = core.CELL_TYPE_PYRAMID, [6] = core.CELL_TYPE_WEDGE, [8] = core.CELL_TYPE_HEXAHEDRON,
}

local planar_type_of_row = {[3] = core.CELL_TYPE_TRIANGLE, [4] = core.CELL_TYPE_QUAD}

-- Takes the arrays of cells; rows of indices say their type themselves.
local function take_cells(given, dimension)
  local cells, types, offsets = take(given, "cells"), take(given, "types"), take(given, "offsets")
  if type(cells) == "table" and type(cells[1]) == "table" and not types and not given.uniform_cell_type then
    local width = #cells[1]
    given.uniform_cell_type = (dimension == 2 and planar_type_of_row or type_of_row)[width]
    if dimension == 2 and width > 4 then
      types, offsets = core.ByteArray(#cells), core.IntArray(#cells + 1)
      for i = 1, #types do types[i] = core.CELL_TYPE_POLYGON end
      for i = 1, #offsets do offsets[i] = width * (i - 1) end
    end
  end
  return cells, offsets, types, take(given, "regions"), take(given, "tags")
end

local make_environment = getmetatable(core.Environment).__call
getmetatable(core.Environment).__call = function(class, given)
  local desc = copied(given)
  local points, threads, log = take(desc, "points"), take(desc, "threads"), take(desc, "log")
  local faces, face_locations = take(desc, "faces"), take(desc, "face_locations")
  if type(points) == "table" and type(points[1]) == "table" and #points[1] == 2 then desc.dimension = 2 end
  local cells, offsets, types, regions, tags = take_cells(desc, desc.dimension)
  local context = (threads or log) and core.Context(threads, log) or nil
  return make_environment(class, points, cells, offsets, types, regions, tags, faces, face_locations, desc, context)
end

local add_volumes = Environment.add_volumes
function Environment:add_volumes(given)
  local desc = copied(given)
  local vertices, points, sew_to = take(desc, "vertices"), take(desc, "points"), take(desc, "sew_to")
  local cells, offsets, types, regions, tags = take_cells(desc, self:dimension())
  return add_volumes(self, vertices, points, cells, offsets, types, regions, tags, sew_to, desc)
end

local create_body = Scene.create_body
function Scene:create_body(given)
  local desc = copied(given)
  local positions, edges, hints = take(desc, "positions"), take(desc, "edges"), take(desc, "hints")
  local triangles, offsets = take(desc, "triangles"), nil
  if triangles then
    if type(triangles) == "table" then triangles = core.UIntArray(triangles) end
    offsets = core.UIntArray(#triangles / 3 + 1)
    for i = 1, #offsets do offsets[i] = 3 * (i - 1) end
  end
  return self:body(create_body(self, positions, edges, offsets, triangles, hints, desc))
end

function Scene:body(id) return core.Body(self, id) end

-- --- calls that fill arrays: new ones, where none are given

-- {fillers}

local coarsen = Environment.coarsen
function Environment:coarsen(options)
  local volume_map = core.UIntArray(self:info().volume_index_count)
  return coarsen(self, options, volume_map), volume_map
end

local locate_points = Environment.locate_points
function Environment:locate_points(points, hints, volumes, locations)
  points = core.points(points, self:dimension())
  volumes, locations = volumes or core.VolumeIdArray(#points // self:dimension()), locations or core.IntArray(#points // self:dimension())
  locate_points(self, points, hints, volumes, locations)
  return volumes, locations
end

local sweep_pairs = core.sweep_pairs
function core.sweep_pairs(dimension, kinds, from, to, flags, touches, context)
  touches = touches or core.PairTouchArray(#kinds)
  sweep_pairs(dimension, kinds, from, to, touches, flags, context)
  return touches
end

local sweep_rigid_pairs = core.sweep_rigid_pairs
function core.sweep_rigid_pairs(dimension, kinds, from, to, motions, indices, flags, touches, context)
  touches = touches or core.PairTouchArray(#kinds)
  sweep_rigid_pairs(dimension, kinds, from, to, motions, indices, touches, flags, context)
  return touches
end

local get_particle_positions = Scene.get_particle_positions
function Scene:get_particle_positions(particles, positions, volumes)
  positions, volumes = positions or core.DoubleArray(self:dimension() * #particles), volumes or core.VolumeIdArray(#particles)
  get_particle_positions(self, particles, positions, volumes)
  return positions, volumes
end

local deform = Scene.deform
function Scene:deform(positions, bodies, targets, options, reports)
  reports = reports or core.MoveReportArray(bodies and #bodies or 0)
  return deform(self, positions, bodies, targets, options, reports), reports
end

local move_rigid = Scene.move_rigid
function Scene:move_rigid(bodies, motions, options, reports)
  reports = reports or core.MoveReportArray(#bodies)
  move_rigid(self, bodies, motions, options, reports)
  return reports
end

local find_signed_distances = Environment.find_signed_distances
function Environment:find_signed_distances(points, distances, nearest)
  points = core.points(points, self:dimension())
  distances = distances or core.DoubleArray(#points // self:dimension())
  find_signed_distances(self, points, distances, nearest)
  return distances
end

local scene_cast = Scene.cast
function Scene:cast(from, to, options, starts, flights, partners)
  from, to = core.points(from, self:dimension()), core.points(to, self:dimension())
  flights = flights or core.FlightArray(#from // self:dimension())
  partners = partners or core.ContactPartnerArray(#from // self:dimension())
  scene_cast(self, from, to, starts, options, flights, partners)
  return flights, partners
end

local scene_find_nearest = Scene.find_nearest
function Scene:find_nearest(points, radius, hints, nearest, partners, volumes, locations)
  points = core.points(points, self:dimension())
  nearest = nearest or core.NearestArray(#points // self:dimension())
  partners = partners or core.ContactPartnerArray(#points // self:dimension())
  scene_find_nearest(self, points, radius or math.huge, hints, nearest, partners, volumes, locations)
  return nearest, partners
end

local deform_rigid = Scene.deform_rigid
function Scene:deform_rigid(positions, bodies, motions, options, reports)
  reports = reports or core.MoveReportArray(#bodies)
  return deform_rigid(self, positions, bodies, motions, options, reports), reports
end

local step_fraction = Scene.step_fraction
function Scene:step_fraction(bodies, steps, options, places, fractions, environment_steps, environment_places)
  places = places or core.DoubleArray(#steps)
  fractions = fractions or core.DoubleArray(#bodies)
  if environment_steps then environment_places = environment_places or core.DoubleArray(#environment_steps) end
  local fraction = step_fraction(self, bodies, steps, options, places, fractions, environment_steps, environment_places)
  return fraction, places, fractions, environment_places
end

local get_positions = Body.get_positions
function Body:get_positions(positions, volumes)
  positions = positions or core.DoubleArray(self:dimension() * self:get_counts().vertex_slots)
  get_positions(self, positions, volumes)
  return positions
end

local find_free_fractions = Body.find_free_fractions
function Body:find_free_fractions(centre, poses, indices, offsets, fractions, contacts)
  fractions = fractions or core.FreeFractionArray(offsets and #offsets - 1 or #indices // 2)
  find_free_fractions(self, centre, poses, indices, offsets, fractions, contacts)
  return fractions
end

-- What collects them is for the collector alone: called by hand it would leave an object without its C++ half.
for _, meta in ipairs { environment_meta, scene_meta, body_meta, log_meta } do meta.__metatable = false end

return core

-- The scenario of bindings/tests/README.md, in Lua. Its result is text, as in scenario.json.
local dsw = require "dartsweep"

local NX, NY, NZ, LINKS, PARTICLES, SIDE = 6, 6, 12, 12, 50, 10
local INSIDE, OUTSIDE = {24, 24, 48}, {-9, 0, 0}

local scenario = {INSIDE = INSIDE, OUTSIDE = OUTSIDE, LINKS = LINKS}

local function index_of(i, j, k) return (k * (NY + 1) + j) * (NX + 1) + i end

function scenario.points()
  local points = {}
  for k = 0, NZ do
    for j = 0, NY do
      for i = 0, NX do points[#points + 1] = {8 * i + j * k % 3, 8 * j + i * k % 3, 8 * k + i * j % 3} end
    end
  end
  return points
end

local function cells_and_regions()
  local corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}
  local cells, regions = {}, {}
  for k = 0, NZ - 1 do
    for j = 0, NY - 1 do
      for i = 0, NX - 1 do
        local cell = {}
        for c, corner in ipairs(corners) do cell[c] = index_of(i + corner[1], j + corner[2], k + corner[3]) end
        cells[#cells + 1] = cell
        regions[#regions + 1] = i > 0 and i < NX - 1 and j > 0 and j < NY - 1 and 1 or 2
      end
    end
  end
  return cells, regions
end

function scenario.create()
  local cells, regions = cells_and_regions()
  return dsw.Environment {points = scenario.points(), cells = cells, regions = regions}
end

function scenario.create_catheter(scene)
  local positions, edges = {}, {}
  for i = 0, LINKS - 1 do positions[i + 1] = {24.5, 25.25, 8.125 + 2.0 * i} end
  for i = 1, LINKS - 1 do edges[i] = {i - 1, i} end
  return scene:create_body {positions = positions, edges = edges}
end

-- --- the result

local Result = {}
Result.__index = Result

function Result:stage(name)
  self:end_stage()
  self.name, self.now = name, {}
end

function Result:end_stage()
  if self.name then
    self.stages[#self.stages + 1] = ('  "%s": ["%s"]'):format(self.name, table.concat(self.now, '", "'))
  end
end

function Result:integers(...)
  for _, value in ipairs {...} do self.now[#self.now + 1] = ("%016x"):format(value) end
end

-- Doubles, or points.
function Result:numbers(...)
  for _, value in ipairs {...} do
    if type(value) == "table" then
      self:numbers(table.unpack(value))
    else
      self:integers((string.unpack("<i8", string.pack("<d", value))))
    end
  end
end

-- --- stages, in the order of README.md

local function say_flights(result, flights)
  for _, flight in ipairs(flights) do
    result:integers(flight.outcome)
    result:numbers(flight.time, flight.position, flight.contact.normal)
    result:integers(flight.contact.wall.volume, flight.contact.wall.local_index, flight.volumes_visited)
  end
end

local function say_sweeps(result, sweeps)
  for _, sweep in ipairs(sweeps) do
    result:integers(sweep.outcome)
    result:numbers(sweep.time, sweep.point, sweep.edge_parameter)
  end
end

local function say_nearest(result, nearest)
  result:numbers(nearest.distance)
  result:integers(nearest.cell.kind, nearest.cell.index)
end

local function queries(result, environment, draw)
  result:stage "locate"
  local from = draw(64)
  local volumes, locations = environment:locate_points(from)
  for i, volume in ipairs(volumes) do result:integers(locations[i], volume.index, volume.generation) end

  result:stage "cast"
  local to = draw(64)
  say_flights(result, environment:cast_segments(from, to))

  result:stage "sweep"
  local first = {table.unpack(from, 1, 16)}
  say_sweeps(result, environment:sweep_edges(first, {table.unpack(to, 1, 16)}, draw(16)))

  result:stage "nearest"
  for i, point in ipairs(from) do
    if locations[i] == dsw.LOCATION_PASSABLE then
      say_nearest(result, environment:find_nearest(point, 20, volumes[i]))
    end
  end
end

local function say_moves(result, flights)
  for _, flight in ipairs(flights) do
    result:integers(flight.outcome)
    result:numbers(flight.time, flight.position)
  end
end

local function push(result, stage, contacts_stage, body, pull)
  result:stage(stage)
  local slide = {vertex_response = dsw.RESPONSE_SLIDE, edge_response = dsw.RESPONSE_SLIDE}
  for _ = 1, 10 do
    local positions = body:get_positions()
    for i = 1, LINKS do pull(positions, i) end
    local report = body:move(positions, slide)
    result:integers(report.vertices_stopped, report.contact_count)
    result:numbers(body:get_positions():totable())
  end

  result:stage(contacts_stage)
  local contacts = body:get_contacts()
  result:integers(#contacts)
  for _, contact in ipairs(contacts) do
    result:integers(contact.vertex.index, contact.contact.kind)
    result:numbers(contact.time, contact.point, contact.contact.normal)
    result:integers(contact.contact.wall.volume)
  end
end

local function status_of(call, ...)
  local good, problem = pcall(call, ...)
  return good and dsw.STATUS_OK or problem.status
end

local function say_blocks(result, ...)
  for _, bytes in ipairs {...} do
    local sum = 0
    for i = 1, #bytes do sum = sum + bytes:byte(i) end
    result:integers(#bytes, sum)
  end
end

local function snapshots(result, scene, environment, particles, draw)
  result:stage "snapshot"
  local block, scene_block = environment:save(), scene:save()
  say_blocks(result, block, scene_block)
  do
    local other <close> = dsw.Environment.load(block)
    local copy <close> = dsw.Scene.load(other, scene_block)
    say_moves(result, copy:move_particles(particles, draw(#particles)))
  end

  result:stage "damaged"
  local half = #block // 2
  result:integers(status_of(dsw.Environment.load, block:sub(1, half)))
  local flipped = block:sub(1, half) .. string.char(block:byte(half + 1) ~ 1) .. block:sub(half + 2)
  result:integers(status_of(dsw.Environment.load, flipped))
end

local function errors(result, scene, environment, particles)
  result:stage "errors"
  local first = particles[1]
  result:integers(status_of(environment.cast, environment, {0, 0 / 0, 0}, INSIDE))
  result:integers(status_of(environment.cast, environment, INSIDE, OUTSIDE, dsw.VolumeId(3, 7)))
  result:integers(status_of(environment.get_volume_id, environment, NX * NY * NZ))
  result:integers(status_of(scene.create_particle, scene, OUTSIDE))
  result:integers(status_of(scene.create_particle, scene, {4, 4, 4}))
  result:integers(status_of(scene.move_particles, scene, {first, first}, {INSIDE, INSIDE}))
  local particle = scene:create_particle(INSIDE)
  local _, volume = scene:get_particle_position(particle)
  result:integers(status_of(environment.mark_volumes, environment, {volume}))
  scene:destroy_particle(particle)
  result:integers(status_of(scene.destroy_particle, scene, particle))
  result:integers(status_of(scene.reset_statistics, scene))
  result:integers(status_of(dsw.Environment, {points = scenario.points(), cells = {{0, 1, 7, 7}}}))
end

local function cut(result, stage, environment, blade, rows, columns)
  result:stage(stage)
  local change = environment:cut(blade, rows, columns)
  result:numbers(change.distance)
  result:integers(change.volumes_split, #change:get_faces(), environment:info().volume_count)
  for _, vertex in ipairs(change:get_vertices()) do
    result:integers(vertex.vertex.index)
    result:numbers(vertex.weights[1])
  end
end

local function say_deformed(result, report, body)
  result:integers(report.outcome, report.held_count, report.contact_count, report.pushed_count)
  result:numbers(body:get_positions():totable())
end

local function deform(result)
  result:stage "deform"
  local environment <close> = scenario.create()
  environment:mark_region(2)
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local body = scenario.create_catheter(scene)
  local positions = environment:get_points()
  for i = 1, #positions, 3 do positions[i] = positions[i] + (48 - positions[i]) * 0.4375 end
  say_deformed(result, environment:deform(positions), body)
end

-- Squares whose corners have moved, half of them cut into two triangles.
function scenario.create_plane()
  local points, cells, offsets, types, regions = {}, {}, {0}, {}, {}
  for j = 0, SIDE do
    for i = 0, SIDE do points[#points + 1] = {8 * i + i * j % 3, 8 * j + (i + 2 * j) % 3} end
  end
  local function add(region, type, ...)
    for _, corner in ipairs {...} do cells[#cells + 1] = corner end
    offsets[#offsets + 1], types[#types + 1], regions[#regions + 1] = #cells, type, region
  end
  for j = 0, SIDE - 1 do
    for i = 0, SIDE - 1 do
      local a = j * (SIDE + 1) + i
      local d, region = a + SIDE + 1, i > 0 and i < SIDE - 1 and j > 0 and j < SIDE - 1 and 1 or 2
      if (i + j) % 2 == 0 then
        add(region, dsw.CELL_TYPE_QUAD, a, a + 1, d + 1, d)
      else
        add(region, dsw.CELL_TYPE_TRIANGLE, a, a + 1, d + 1)
        add(region, dsw.CELL_TYPE_TRIANGLE, a, d + 1, d)
      end
    end
  end
  return dsw.Environment {points = points, cells = cells, offsets = offsets, types = types, regions = regions}
end

local function plane(result, draw)
  result:stage "plane"
  local environment <close> = scenario.create_plane()
  local info, marked = environment:info(), environment:mark_region(2)
  environment:mark_vertices {environment:get_vertex_id(5 * (SIDE + 1) + 5)}
  result:integers(info.dimension, info.vertex_count, info.volume_count, info.face_count, info.boundary_face_count, marked)

  result:stage "plane locate"
  local from = draw(32)
  local volumes, locations = environment:locate_points(from)
  for i, volume in ipairs(volumes) do
    result:integers(locations[i], volume.index, volume.generation)
    if locations[i] == dsw.LOCATION_PASSABLE then say_nearest(result, environment:find_nearest(from[i], 20, volume)) end
  end

  result:stage "plane cast"
  local to = draw(32)
  for i = 1, 32, 2 do to[i][1] = to[i][1] + 40 end
  say_flights(result, environment:cast_segments(from, to))

  result:stage "plane sweep"
  local first, targets = {table.unpack(from, 1, 16)}, {table.unpack(to, 1, 16)}
  say_sweeps(result, environment:sweep_edges(first, targets, draw(16)))

  result:stage "plane particles"
  local scene <close> = dsw.Scene(environment, {features = dsw.FEATURE_DEFORMING})
  local particles = scene:create_particles(from)
  scene:move_particles(particles, to)
  result:numbers((scene:get_particle_positions(particles)):totable())
  local positions, edges = {}, {}
  for i = 1, LINKS do positions[i] = {20.25 + 3.0 * (i - 1), 40.5} end
  for i = 1, LINKS - 1 do edges[i] = {i - 1, i} end
  local rope = scene:create_body {positions = positions, edges = edges}
  push(result, "rope", "rope contacts", rope, function(now, i)
    local x, y = now:point(i, 2)
    now:set_point(i, x + 1.5, y + (4 - 0.75 * ((i - 1) % 3)))
  end)
  result:stage "plane snapshot"
  say_blocks(result, environment:save(), scene:save())

  result:stage "plane deform"
  local points = environment:get_points()
  local bent = dsw.DoubleArray(#points + 2 * 64)
  for i = 1, #points do bent[i] = points[i] + (i % 2 == 0 and (40 - points[i]) * 0.125 or 0) end
  say_deformed(result, environment:deform(bent), rope)
  cut(result, "plane cut", environment, {{20, 20.5}, {60.25, 41.25}}, 2, 1)
end

function scenario.play()
  local seed = 1
  local function drawn()
    seed = (seed * 4093 + 1021) % 65536
    return seed / 1024
  end
  local function draw(count)
    local points = {}
    for i = 1, count do points[i] = {4 + 0.625 * drawn(), 4 + 0.625 * drawn(), 1.5 * drawn()} end
    return points
  end
  local function draw_in_plane(count)
    local points = {}
    for i = 1, count do points[i] = {11 + 0.90625 * drawn(), 11 + 0.90625 * drawn()} end
    return points
  end

  local result = setmetatable({stages = {}}, Result)
  result:stage "vessel"
  local environment <close> = scenario.create()
  local info, marked = environment:info(), environment:mark_region(2)
  result:integers(info.vertex_count, info.volume_count, info.face_count, info.boundary_face_count, marked)
  queries(result, environment, draw)

  local scene <close> = dsw.Scene(environment)
  local _, regions = cells_and_regions()
  local centres = {}
  for cell, region in ipairs(regions) do
    if region == 1 and #centres < PARTICLES then
      centres[#centres + 1] = environment:get_centre(environment:get_volume_id(cell - 1))
    end
  end
  local particles = scene:create_particles(centres)
  result:stage "particles"
  for _ = 1, 4 do say_moves(result, scene:move_particles(particles, draw(#particles))) end
  push(result, "catheter", "contacts", scenario.create_catheter(scene), function(positions, i)
    local x, y, z = positions:point(i)
    positions:set_point(i, x + 1.75, y - 0.5 * ((i - 1) % 3), z + 3)
  end)
  snapshots(result, scene, environment, particles, draw)
  errors(result, scene, environment, particles)
  cut(result, "cut", environment, {{-5, 3, 20.5}, {60, 3, 20.5}, {-5, 3, 60.25}, {60, 3, 60.25}}, 2, 2)
  deform(result)
  seed = 1
  plane(result, draw_in_plane)
  result:end_stage()
  return "{\n" .. table.concat(result.stages, ",\n") .. "\n}\n"
end

return scenario

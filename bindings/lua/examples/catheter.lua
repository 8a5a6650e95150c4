-- A catheter is pushed along a square vessel, against its wall: it slides, and contacts say where it touches.
local dsw = require "dartsweep"

local WIDTH, LENGTH, LINKS = 5, 10, 8 -- cells, cells, vertices

-- Hexahedra of side 1; those on the outside are region 2.
local function make_vessel()
  local points, cells, regions = {}, {}, {}
  local function index_of(i, j, k) return (k * (WIDTH + 1) + j) * (WIDTH + 1) + i end
  for k = 0, LENGTH do
    for j = 0, WIDTH do
      for i = 0, WIDTH do points[#points + 1] = {i, j, k} end
    end
  end
  for k = 0, LENGTH - 1 do
    for j = 0, WIDTH - 1 do
      for i = 0, WIDTH - 1 do
        local cell = {}
        for top = k, k + 1 do
          cell[#cell + 1] = index_of(i, j, top) -- counter-clockwise, as in VTK
          cell[#cell + 1] = index_of(i + 1, j, top)
          cell[#cell + 1] = index_of(i + 1, j + 1, top)
          cell[#cell + 1] = index_of(i, j + 1, top)
        end
        cells[#cells + 1] = cell
        regions[#regions + 1] = i > 0 and i < WIDTH - 1 and j > 0 and j < WIDTH - 1 and 1 or 2
      end
    end
  end
  return dsw.Environment {points = points, cells = cells, regions = regions}
end

local function make_catheter(scene)
  local positions, edges = {}, {}
  for i = 1, LINKS do positions[i] = {2.5, 2.5, 0.25 + 0.5 * (i - 1)} end
  for i = 1, LINKS - 1 do edges[i] = {i - 1, i} end
  return scene:create_body {positions = positions, edges = edges}
end

local vessel <close> = make_vessel()
print(vessel:mark_region(2) .. " cells are wall")

local scene <close> = dsw.Scene(vessel)
local catheter = make_catheter(scene)
local slide = {vertex_response = dsw.RESPONSE_SLIDE, edge_response = dsw.RESPONSE_SLIDE}
for step = 1, 4 do
  local targets = catheter:get_positions()
  for i = 1, LINKS do
    local x, y, z = targets:point(i)
    targets:set_point(i, x + 0.4, y, z + 0.5)
  end
  print(("step %d: %d contacts"):format(step, catheter:move(targets, slide).contact_count))
end

local contact = catheter:get_contacts()[1]
print(("vertex %d met the wall at x = %.3f, at %.3f of its way"):format(contact.vertex.index, contact.point[1], contact.time))

local good, problem = pcall(scene.create_particle, scene, {0.5, 0.5, 5})
assert(not good and problem.status == dsw.STATUS_IMPASSABLE)
print("a particle in the wall: " .. problem.name)

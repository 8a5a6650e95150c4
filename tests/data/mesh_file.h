// Reads volume meshes for tests: Gmsh 4.1 ASCII (.msh) and legacy ASCII VTK unstructured grids (.vtk).
#pragma once

#include "mesh.h"

#include <string>

namespace dsw::oracle {

/// False if the file is packed (.gz) and the tests' host has no gzip: wine and Node.
bool can_unpack(const std::string& path);

/// False with a reason if the file cannot be read. Regions are the volumes' entity tags, or the cell array `region`.
bool read_mesh(const std::string& path, Mesh& mesh, std::string& reason);

}  // namespace dsw::oracle

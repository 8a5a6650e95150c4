#pragma once
// What the last change of the topology left for the host to read.

#include "base/memory.h"
#include "dartsweep/topology.h"

namespace dsw {

/** Arrays of the last change. */
struct ChangeResults {
  dsw_change numbers{};  // without its arrays
  Array<dsw_volume_change> volumes;
  Array<dsw_vertex_origin> vertices, body_vertices;
  Array<dsw_cut_face> faces;
  Array<dsw_volume_id> whole, carved, unrepaired, detached;
  Array<dsw_face_origin> body_faces;

  explicit ChangeResults(const Memory* memory)
      : volumes(memory),
        vertices(memory),
        body_vertices(memory),
        faces(memory),
        whole(memory),
        carved(memory),
        unrepaired(memory),
        detached(memory),
        body_faces(memory) {}
  /** The change as the host reads it. */
  dsw_change change() const noexcept;
  uint64_t memory_bytes() const noexcept;
};

}  // namespace dsw

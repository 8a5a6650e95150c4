// What the calls are made on: a small world with one of everything in it, and handles that are none.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <vector>

#include "dartsweep/dartsweep.h"

namespace boundary {

using Block = std::vector<unsigned char>;

/** Ends the program: without this the test would test nothing. */
inline void need(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "the test itself fails: %s: %s\n", what, dsw_last_error_message());
  std::exit(1);
}

Block save(const dsw_environment* environment);
Block save(const dsw_scene* scene);

/** A row of four unit cubes, in the plane of squares; two particles and two bodies, of four vertices each, in the
 * first. */
class Host {
 public:
  explicit Host(uint32_t d) : dimension(d) { make(); }
  ~Host() { clear(); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /** Makes the host anew, as it was before any call. */
  void renew() {
    clear();
    make();
  }
  /** It was destroyed by a call. */
  void forget(const void* handle);
  /** Whether nothing has changed since it was made. */
  bool is_unchanged() const;

  const uint32_t dimension;
  dsw_context* context = nullptr;
  dsw_environment* environment = nullptr;
  dsw_scene* scene = nullptr;  // with all features, so the only one of its environment
  dsw_trace* trace = nullptr;
  dsw_replay* replay = nullptr;
  dsw_environment* shared_environment = nullptr;  // for further scenes
  dsw_scene* shared_scene = nullptr;
  dsw_particle_id particles[2] = {};
  dsw_body_id bodies[2] = {};
  Block environment_block, scene_block, shared_block, recording;
  std::vector<double> next;  // lent to the environment

 private:
  void make();
  void clear();
};

/** Arrays of descriptions, which outlive all calls. */
struct Mesh {
  std::vector<double> points;
  std::vector<int64_t> connectivity;
};
const Mesh& row_of_cells(uint32_t dimension);

/** Destroyed handles whose memory is still there, one of each kind, and memory of zeros. */
struct Graveyard {
  dsw_context* context;
  dsw_environment* environment;
  dsw_scene* scene;
  dsw_trace* trace;
  dsw_replay* replay;
  void* zeros;
};
const Graveyard& graveyard();

/** Members that a call needs; the rest has its defaults. */
template <class T>
void describe(T&, uint32_t) {}
void describe(dsw_environment_desc& d, uint32_t dimension);
void describe(dsw_body_desc& d, uint32_t dimension);
void describe(dsw_volumes_desc& d, uint32_t dimension);
void describe(dsw_cut_desc& d, uint32_t dimension);
void describe(dsw_open_crack_desc& d, uint32_t dimension);
void describe(dsw_carve_desc& d, uint32_t dimension);
void describe(dsw_tie_desc& d, uint32_t dimension);
void describe(dsw_detach_desc& d, uint32_t dimension);
void describe(dsw_recording_desc& d, uint32_t dimension);

}  // namespace boundary

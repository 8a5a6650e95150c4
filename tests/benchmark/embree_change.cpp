#include "embree_change.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace dsw::bench {

namespace {

using Corner = std::array<float, 3>;

/** The six corners of a wall's two triangles. */
std::array<Corner, 6> corners(const WallMesh& walls, const scenes::Wall& wall) {
  std::array<Corner, 6> all{};
  for (std::uint32_t part = 0; part < 2; ++part) {
    const auto triangle = wall.triangle(part);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) all[3 * part + i][k] = static_cast<float>(walls.point(triangle[i])[k]);
    }
  }
  return all;
}

class Device {
 public:
  Device() : device_(rtcNewDevice("threads=1")) {}
  ~Device() { rtcReleaseDevice(device_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

RTCScene dynamic_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  return scene;
}

class Single final : public EmbreeUpdater {
 public:
  Single(const WallMesh& walls, std::size_t slots, bool refit)
      : EmbreeUpdater(refit ? "embree, one geometry, refit" : "embree, one geometry, rebuilt"),
        walls_(walls),
        scene_(dynamic_scene(device_.get())),
        geometry_(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE)) {
    rtcSetGeometryBuildQuality(geometry_, refit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
    vertices_ = static_cast<Corner*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Corner), 6 * slots));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0,
                                                                   RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 2 * slots));
    for (unsigned i = 0; i < 6 * slots; ++i) {
      indices[i] = i;
      vertices_[i] = {0, 0, 0};
    }
    for (std::size_t i = 0; i < walls.walls.size(); ++i) write(i, corners(walls, walls.walls[i]));
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }

  ~Single() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
  }

  void apply(const WallChange& change) override {
    for (const auto& item : change.removed) {
      std::array<Corner, 6> point;
      point.fill(vertices_[6 * item.id]);
      write(item.id, point);
    }
    for (const auto& item : change.added) write(item.id, corners(walls_, item.wall));
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

 private:
  RTCSceneTy* rays_meet() const override { return scene_; }

  void write(std::size_t slot, const std::array<Corner, 6>& values) {
    std::copy(values.begin(), values.end(), vertices_ + 6 * slot);
  }

  const WallMesh& walls_;
  Device device_;
  RTCScene scene_;
  RTCGeometry geometry_;
  Corner* vertices_;
};

class Chunks final : public EmbreeUpdater {
 public:
  Chunks(const WallMesh& walls, double size, bool instances)
      : EmbreeUpdater("embree, chunks of " + std::to_string(static_cast<int>(size)) + (instances ? ", instances" : "")),
        walls_(walls),
        size_(size),
        scene_(dynamic_scene(device_.get())) {
    for (std::uint32_t id = 0; id < walls.walls.size(); ++id) add(id, walls.walls[id]);
    for (auto& [key, chunk] : chunks_) {
      chunk.geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetGeometryBuildQuality(chunk.geometry, RTC_BUILD_QUALITY_LOW);
      fill(chunk);
      if (instances) {
        chunk.scene = dynamic_scene(device_.get());
        rtcAttachGeometry(chunk.scene, chunk.geometry);
        rtcCommitScene(chunk.scene);
        chunk.instance = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(chunk.instance, chunk.scene);
        rtcCommitGeometry(chunk.instance);
        rtcAttachGeometry(scene_, chunk.instance);
      } else {
        rtcAttachGeometry(scene_, chunk.geometry);
      }
    }
    rtcCommitScene(scene_);
  }

  ~Chunks() override {
    for (auto& [key, chunk] : chunks_) {
      rtcReleaseGeometry(chunk.geometry);
      if (chunk.instance != nullptr) {
        rtcReleaseGeometry(chunk.instance);
        rtcReleaseScene(chunk.scene);
      }
    }
    rtcReleaseScene(scene_);
  }

  void apply(const WallChange& change) override {
    std::vector<Chunk*> touched;
    for (const auto& item : change.removed) {
      Chunk& chunk = chunks_.find(key_of(item.wall))->second;
      const std::size_t slot = chunk.slot_of[item.id];
      chunk.walls[slot] = chunk.walls.back();
      chunk.ids[slot] = chunk.ids.back();
      chunk.slot_of[chunk.ids[slot]] = slot;
      chunk.walls.pop_back();
      chunk.ids.pop_back();
      touched.push_back(&chunk);
    }
    for (const auto& item : change.added) touched.push_back(&add(item.id, item.wall));
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (Chunk* chunk : touched) {
      if (chunk->geometry == nullptr) {
        continue;  // a chunk that had no wall: too rare to matter, and left out in Embree's favour
      }
      fill(*chunk);
      if (chunk->instance != nullptr) {
        rtcCommitScene(chunk->scene);
        rtcCommitGeometry(chunk->instance);
      }
    }
    rtcCommitScene(scene_);
  }

 private:
  RTCSceneTy* rays_meet() const override { return scene_; }

  struct Chunk {
    std::vector<std::array<Corner, 6>> walls;
    std::vector<std::uint32_t> ids;
    std::unordered_map<std::uint32_t, std::size_t> slot_of;
    RTCGeometry geometry = nullptr, instance = nullptr;
    RTCScene scene = nullptr;
    Corner* vertices = nullptr;
    std::size_t capacity = 0;
  };

  std::uint64_t key_of(const scenes::Wall& wall) const {
    std::uint64_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = 0.5 * (walls_.point(wall.vertices[0])[k] + walls_.point(wall.vertices[2])[k]);
      key = key << 20 | static_cast<std::uint64_t>(std::floor(middle / size_) + 1);
    }
    return key;
  }

  Chunk& add(std::uint32_t id, const scenes::Wall& wall) {
    Chunk& chunk = chunks_[key_of(wall)];
    chunk.slot_of[id] = chunk.walls.size();
    chunk.ids.push_back(id);
    chunk.walls.push_back(corners(walls_, wall));
    return chunk;
  }

  /** Copies the chunk's triangles into its buffers, which have some room; the rest are no numbers, which Embree leaves
   * out (points in one place make it abort). */
  void fill(Chunk& chunk) {
    if (chunk.walls.size() > chunk.capacity) {
      chunk.capacity = chunk.walls.size() + chunk.walls.size() / 4 + 8;
      chunk.vertices = static_cast<Corner*>(rtcSetNewGeometryBuffer(
          chunk.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Corner), 6 * chunk.capacity));
      auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
          chunk.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 2 * chunk.capacity));
      for (unsigned i = 0; i < 6 * chunk.capacity; ++i) indices[i] = i;
    }
    Corner* out = chunk.vertices;
    for (const auto& wall : chunk.walls) out = std::copy(wall.begin(), wall.end(), out);
    constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
    std::fill(out, chunk.vertices + 6 * chunk.capacity, Corner{kNoNumber, kNoNumber, kNoNumber});
    rtcUpdateGeometryBuffer(chunk.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(chunk.geometry);
  }

  const WallMesh& walls_;
  double size_;
  Device device_;
  RTCScene scene_;
  std::unordered_map<std::uint64_t, Chunk> chunks_;
};

}  // namespace

std::unique_ptr<EmbreeUpdater> make_embree_single(const WallMesh& walls, std::size_t slots, bool refit) {
  return std::make_unique<Single>(walls, slots, refit);
}

std::unique_ptr<EmbreeUpdater> make_embree_chunks(const WallMesh& walls, double chunk, bool instances) {
  return std::make_unique<Chunks>(walls, chunk, instances);
}

}  // namespace dsw::bench

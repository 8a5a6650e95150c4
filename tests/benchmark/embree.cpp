#include "embree.h"

#include "embree_casts.h"

#include <embree3/rtcore.h>

#include <stdexcept>

namespace dsw::bench {

namespace {

RTCIntersectContext incoherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

class Embree final : public Engine {
 public:
  Embree(std::string name, const EmbreeSetting& setting, const WallMesh& walls)
      : Engine(std::move(name)), setting_(setting), walls_(walls), device_(rtcNewDevice("threads=1")) {
    if (device_ == nullptr) throw std::runtime_error("no Embree device");
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, setting.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene_, setting.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    RTCGeometry geometry = rtcNewGeometry(device_, setting.quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, setting.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), walls.points->size() / 3));
    for (std::size_t i = 0; i < walls.points->size(); ++i) points[i] = static_cast<float>((*walls.points)[i]);
    const std::size_t width = setting.quads ? 4 : 3;
    const std::size_t count = setting.quads ? walls.walls.size() : walls.triangles.size();
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                   setting.quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3,
                                                                   width * sizeof(unsigned), count));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < width; ++k) {
        // Embree cuts a quadrilateral from its vertex 1 to its vertex 3.
        indices[width * i + k] =
            setting.quads ? walls.walls[i].vertices[(k + 1 - walls.walls[i].diagonal) % 4] : walls.triangles[i][k];
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }

  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  // A packet is written whole.
  void prepare(const Segments& segments) override { casts_.prepare(segments, 8); }

  void run(std::size_t first, std::size_t count) override {
    if (setting_.packet) {
      run_packets(first, count);
    } else if (setting_.occluded) {
      run_occluded(first, count);
    } else {
      casts_.run(scene_, first, count);
    }
  }

  Answer answer(std::size_t i) const override {
    const auto& result = casts_.result(i);
    if (result.primitive == kNone) return {};
    return {setting_.quads || setting_.occluded ? result.primitive : walls_.triangle_wall[result.primitive],
            static_cast<double>(result.time)};
  }

 private:
  void run_occluded(std::size_t first, std::size_t count) {
    RTCIntersectContext context = incoherent();
    for (std::size_t i = 0; i < count; ++i) {
      const auto& ray = casts_.ray(first + i);
      RTCRay query;
      query.org_x = ray.from[0];
      query.org_y = ray.from[1];
      query.org_z = ray.from[2];
      query.dir_x = ray.direction[0];
      query.dir_y = ray.direction[1];
      query.dir_z = ray.direction[2];
      query.tnear = 0.0f;
      query.tfar = 1.0f;
      query.time = 0.0f;
      query.mask = ~0u;
      query.flags = 0;
      rtcOccluded1(scene_, &context, &query);
      casts_.result(i) = {query.tfar < 0.0f ? 0u : kNone, 0.0f};
    }
  }

  void run_packets(std::size_t first, std::size_t count) {
    RTCIntersectContext context = incoherent();
    for (std::size_t base = 0; base < count; base += 8) {
      alignas(32) int valid[8];
      alignas(32) RTCRayHit8 query;
      for (std::size_t lane = 0; lane < 8; ++lane) {
        valid[lane] = base + lane < count ? -1 : 0;
        const auto& ray = casts_.ray(first + (base + lane < count ? base + lane : base));
        query.ray.org_x[lane] = ray.from[0];
        query.ray.org_y[lane] = ray.from[1];
        query.ray.org_z[lane] = ray.from[2];
        query.ray.dir_x[lane] = ray.direction[0];
        query.ray.dir_y[lane] = ray.direction[1];
        query.ray.dir_z[lane] = ray.direction[2];
        query.ray.tnear[lane] = 0.0f;
        query.ray.tfar[lane] = 1.0f;
        query.ray.time[lane] = 0.0f;
        query.ray.mask[lane] = ~0u;
        query.ray.flags[lane] = 0;
        query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect8(valid, scene_, &context, &query);
      for (std::size_t lane = 0; lane < 8; ++lane) {
        const bool hit = query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
        casts_.result(base + lane) = {hit ? query.hit.primID[lane] : kNone, query.ray.tfar[lane]};
      }
    }
  }

  EmbreeSetting setting_;
  const WallMesh& walls_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  EmbreeCasts casts_;
};

}  // namespace

std::unique_ptr<Engine> make_embree(const EmbreeSetting& setting, const WallMesh& walls) {
  std::string name = "embree";
  name += setting.high_quality ? ", high" : ", medium";
  name += setting.robust ? ", robust" : "";
  name += setting.quads ? ", quads" : "";
  name += setting.packet ? ", packets of 8" : "";
  name += setting.occluded ? ", occluded" : "";
  return std::make_unique<Embree>(std::move(name), setting, walls);
}

std::vector<std::unique_ptr<Engine>> make_embrees(const WallMesh& walls) {
  bool all_quads = true;
  for (const auto& wall : walls.walls) all_quads = all_quads && wall.vertex_count == 4;
  std::vector<std::unique_ptr<Engine>> engines;
  for (const bool quads : {false, true}) {
    for (const bool high : {false, true}) {
      for (const bool robust : {false, true}) {
        if (!quads || all_quads) engines.push_back(make_embree({high, robust, quads, false, false}, walls));
      }
    }
  }
  return engines;
}

}  // namespace dsw::bench

#include "deform_peers.h"
#include "embree_casts.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <stdexcept>

namespace dsw::bench {

namespace {

enum class Update { kRefit, kRebuildPart, kRebuildAll };

const char* name_of(Update update) {
  return update == Update::kRefit ? "refit" : update == Update::kRebuildPart ? "one geometry rebuilt" : "scene rebuilt";
}

class MovingEmbree final : public MovingEngine {
 public:
  MovingEmbree(const WallMesh& walls, bool quads, bool robust, Update update)
      : MovingEngine(std::string("embree, ") + name_of(update) + (quads ? ", quads" : "") + (robust ? ", robust" : "")),
        walls_(walls),
        own_(walls),
        quads_(quads),
        device_(rtcNewDevice("threads=1")) {
    if (device_ == nullptr) throw std::runtime_error("no Embree device");
    scene_ = rtcNewScene(device_);
    const int dynamic = update == Update::kRebuildAll ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_DYNAMIC;
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(dynamic | (robust ? RTC_SCENE_FLAG_ROBUST : 0)));
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    geometry_ = rtcNewGeometry(device_, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry_, update == Update::kRefit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
    points_ = static_cast<float*>(rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                          3 * sizeof(float), own_.vertices.size()));
    if (quads) {
      // Embree cuts a quadrilateral from its vertex 1 to its vertex 3.
      auto turned = own_.quads;
      for (auto& quad : turned) std::rotate(quad.begin(), quad.begin() + 3, quad.end());
      fill_indices(turned, RTC_FORMAT_UINT4);
    } else {
      fill_indices(own_.triangles, RTC_FORMAT_UINT3);
    }
    write();
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }

  ~MovingEmbree() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void write() override {
    float* out = points_;
    for (const std::uint32_t vertex : own_.vertices) {
      for (std::size_t k = 0; k < 3; ++k) *out++ = static_cast<float>(walls_.point(vertex)[k]);
    }
  }

  void update() override {
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  void prepare(const Segments& segments) override { casts_.prepare(segments); }
  void run(std::size_t first, std::size_t count) override { casts_.run(scene_, first, count); }

  Answer answer(std::size_t i) const override {
    const auto& result = casts_.result(i);
    if (result.primitive == kNone) return {};
    return {quads_ ? result.primitive : walls_.triangle_wall[result.primitive], static_cast<double>(result.time)};
  }

 private:
  template <std::size_t Width>
  void fill_indices(const std::vector<std::array<std::uint32_t, Width>>& all, RTCFormat format) {
    auto* out = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, format, Width * sizeof(unsigned), all.size()));
    for (const auto& one : all) out = std::copy(one.begin(), one.end(), out);
  }

  const WallMesh& walls_;
  WallPoints own_;
  bool quads_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;
  float* points_ = nullptr;
  EmbreeCasts casts_;
};

}  // namespace

std::vector<std::unique_ptr<MovingEngine>> make_moving_embrees(const WallMesh& walls) {
  std::vector<std::unique_ptr<MovingEngine>> engines;
  for (const bool quads : {false, true}) {
    for (const bool robust : {false, true}) {
      engines.push_back(std::make_unique<MovingEmbree>(walls, quads, robust, Update::kRefit));
    }
    engines.push_back(std::make_unique<MovingEmbree>(walls, quads, false, Update::kRebuildPart));
    engines.push_back(std::make_unique<MovingEmbree>(walls, quads, false, Update::kRebuildAll));
  }
  return engines;
}

}  // namespace dsw::bench

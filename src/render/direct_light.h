// Direct light, which met no caster: the light of each lamp on receivers, with what they see of it by rays;
// and that of the parts of skies, with shadow maps.
#pragma once

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "gpu_scene/gpu_scene.h"
#include "lights/light_shape.h"
#include "render/frame_data.h"
#include "render/shadow_maps.h"
#include "render/shadows/lamp_shadows.h"
#include "techniques/technique.h"

namespace nephroid {

// The air between lights and receivers.
struct LightsInAir {
  uint64_t lights = 0;                 // address of an AirLight for each light; 0: there is no air
  const gpu::Image* depths = nullptr;  // of DensityBox
  bool hasBox = false;
};

// For each frame: call update, recordShadowMaps, then record for each view. Where only the camera has moved,
// record is enough.
class DirectLight {
 public:
  // The device must outlive it. The profiles of lights are taken from `scene`. `shadowMapSize`: texels along
  // a side, as in planShadowMaps.
  DirectLight(gpu::Device& device, const Scene& scene, uint32_t shadowMapSize);

  // The properties for which a pipeline is made. Each point of a light has 0, 1 or 6 shadow maps.
  struct ProgramKey {
    uint32_t type = kEmitterPoint;
    uint32_t mapCount = 0;
    bool isLine = false;
    bool hasGobo = false;
    uint32_t profileType = kNoProfile;
    bool hasAir = false;
    bool hasAirBox = false;
    bool operator<(const ProgramKey& other) const {
      const auto tied = [](const ProgramKey& k) {
        return std::tie(k.type, k.mapCount, k.isLine, k.hasGobo, k.profileType, k.hasAir, k.hasAirBox);
      };
      return tied(*this) < tied(other);
    }
    std::vector<gpu::SpecializationConstant> specialization() const;  // as light.glsl.h has them
  };

  void resize(uint32_t shadowMapSize) { shadowMapSize_ = shadowMapSize; }

  // The host's work for a frame. `extents`: of scene.meshes. `shadows`: updated for the same scene; it must
  // outlive the frame. The device must not be using anything of this object.
  void update(const Scene& scene, const std::vector<MeshExtent>& extents, const LightsInAir& air,
              const LampShadows& shadows);

  void recordShadowMaps(gpu::CommandList& commands, const GpuScene& gpuScene);

  // Writes the illuminance (lux) on each receiver point of the region to `lux` (rgba32f, of the same size as
  // the points' images). `view`: of the points, in LampShadows. May be called several times in a frame.
  void record(gpu::CommandList& commands, const GpuScene& gpuScene, uint32_t view,
              const ReceiverPoints& points, const gpu::Image& lux);

  // Data of this frame for other passes that use light.glsl.h: of the emitters that stand for lights. Only in
  // air, and of skies, have they shadow maps.
  uint32_t lightCount() const { return static_cast<uint32_t>(lights_.size()); }
  const ProgramKey& key(uint32_t light) const { return lights_[light].key; }
  DirectConstants constants(uint32_t light) const;
  std::vector<const gpu::Image*> shadowMaps() const;  // of the lights for which anything can cast a shadow
  std::array<gpu::Binding, 3> bindings(uint32_t light, const GpuScene& gpuScene) const;

 private:
  // A light in this frame's passes.
  struct DrawnLight {
    ShadowedLight shadowed;
    ProgramKey key;
    bool isOfSky = false;
    uint32_t gobo = kNone;     // in Scene::textures
    uint32_t profile = kNone;  // in Scene::profiles
    vec2 goboTurn{0};
  };
  static DrawnLight drawn(const Scene& scene, ShadowedLight shadowed);

  // A lamp in this frame's passes.
  struct LampKey {
    uint32_t form = kLampBall;
    bool hasRadius = false;
    bool hasShadows = false;
    bool hasGobo = false;
    uint32_t profileType = kNoProfile;
    bool hasAir = false;
    bool hasAirBox = false;
    bool operator<(const LampKey& other) const {
      const auto tied = [](const LampKey& k) {
        return std::tie(k.form, k.hasRadius, k.hasShadows, k.hasGobo, k.profileType, k.hasAir, k.hasAirBox);
      };
      return tied(*this) < tied(other);
    }
  };
  struct DrawnLamp {
    LampKey key;
    LampConstants constants{};
    uint32_t light = 0;  // one of those in lights_ that stand for it
  };
  void addLamps(const Scene& scene, const LampShadows& shadows);
  void drawLamp(gpu::CommandList& commands, const GpuScene& gpuScene, const ReceiverPoints& points,
                uint32_t view, uint32_t lamp);

  gpu::Device& device_;
  uint32_t shadowMapSize_;
  gpu::Program shadowProgram_;
  // For closed objects with the light outside: their far sides cast no further shadow.
  gpu::Program closedShadowProgram_;
  std::map<ProgramKey, gpu::Program> programs_;  // of skies
  std::map<LampKey, gpu::Program> lampPrograms_;
  gpu::Sampler sampler_;
  gpu::Sampler goboSampler_;
  std::vector<gpu::Image> profiles_;  // as Scene::profiles, and a dark one last
  std::vector<gpu::Image> maps_;      // of each light
  gpu::Image none_;                   // stands in for images that are not read

  // Of the frame being made.
  std::vector<DrawnLight> lights_;
  std::vector<DrawnLamp> lamps_;
  const LampShadows* shadows_ = nullptr;
  std::vector<mat4> objectsToWorld_;
  LightsInAir air_;
};

}  // namespace nephroid

// Light that met no caster: what of each emitter's light reaches receivers past all that stands in its way.
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
#include "techniques/technique.h"

namespace nephroid {

// The air that light goes through on its way.
struct LightsInAir {
  uint64_t lights = 0;                 // address of an AirLight for each light; 0: there is no air
  const gpu::Image* depths = nullptr;  // of DensityBox
  bool hasBox = false;
};

// One frame is update, recordShadowMaps, then record for each view. A moved camera changes only what record
// does.
class DirectLight {
 public:
  // The device outlives it. `scene` gives the profiles of lights. `shadowMapSize` is that of planShadowMaps.
  DirectLight(gpu::Device& device, const Scene& scene, uint32_t shadowMapSize);

  // What a pipeline is made for. A light's points have no shadow map, one, or six.
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

  // What the host does in a frame. `extents` are those of scene.meshes. Nothing is in use by the device.
  void update(const Scene& scene, const std::vector<MeshExtent>& extents, const LightsInAir& air);

  void recordShadowMaps(gpu::CommandList& commands, const GpuScene& gpuScene);

  // Illuminance (lux) on each receiver point of the region asked for, in place of what stood there. `lux` is
  // rgba32f and of the size of the points. May be called several times a frame.
  void record(gpu::CommandList& commands, const GpuScene& gpuScene, const ReceiverPoints& points,
              const gpu::Image& lux);

  // Of this frame, for other passes that ask what of a light arrives: what light.glsl.h reads.
  uint32_t lightCount() const { return static_cast<uint32_t>(lights_.size()); }
  const ProgramKey& key(uint32_t light) const { return lights_[light].key; }
  DirectConstants constants(uint32_t light) const;
  std::vector<const gpu::Image*> shadowMaps() const;  // of lights that anything may shadow
  std::array<gpu::Binding, 3> bindings(uint32_t light, const GpuScene& gpuScene) const;

 private:
  // A light as the passes of this frame draw it.
  struct DrawnLight {
    ShadowedLight shadowed;
    ProgramKey key;
    uint32_t gobo = kNone;     // in Scene::textures
    uint32_t profile = kNone;  // in Scene::profiles
    vec2 goboTurn{0};
  };
  static DrawnLight drawn(const Scene& scene, ShadowedLight shadowed);

  gpu::Device& device_;
  uint32_t shadowMapSize_;
  gpu::Program shadowProgram_;
  // For closed objects about which the light is not: their far sides shade nothing more.
  gpu::Program closedShadowProgram_;
  std::map<ProgramKey, gpu::Program> programs_;
  gpu::Sampler sampler_;
  gpu::Sampler goboSampler_;
  std::vector<gpu::Image> profiles_;  // as Scene::profiles, and a dark one last
  std::vector<gpu::Image> maps_;      // of each light

  // Of the frame being made.
  std::vector<DrawnLight> lights_;
  std::vector<mat4> objectsToWorld_;
  LightsInAir air_;
};

}  // namespace nephroid

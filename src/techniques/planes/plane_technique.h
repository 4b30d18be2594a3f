// Techniques with virtual planes: caustics are drawn into textures on planes around the receivers, and
// receivers look them up there. These techniques differ in where the planes stand.
#pragma once

#include <array>
#include <vector>

#include "beams/plane_plan.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "techniques/planes/settings.h"
#include "techniques/planes/shader_data.h"
#include "techniques/technique_info.h"
#include "transport/queries.h"

namespace nephroid {

// The differences between these techniques.
struct PlaneTechniqueKind {
  TechniqueTraits traits;
  // Plans `planes` planes with `textureSize` texels along each side, for one portion of the light
  // (lightThroughCasters).
  PlaneSet (*plan)(const Scene& scene, const LightPortion& portion, std::span<const ReceiverBox> boxes,
                   uint32_t planes, uint32_t textureSize);
  uint32_t planes;
  // Whether the light goes about along the planes' axis, so that the virtual camera sees the receivers that
  // the light meets. Otherwise light goes in any direction, and may meet receivers that the camera does not
  // see.
  bool goesAlongAxis;
  const char* viewPass;      // name of the pass that draws what the virtual camera sees
  const char* texturesPass;  // name of the pass that fills the textures
};

class PlaneTechnique final : public TechniqueBase {
 public:
  PlaneTechnique(const TechniqueContext& context, const PlaneTechniqueKind& kind);

  TechniqueTraits traits() const override { return kind_.traits; }
  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  std::vector<Lattice> lattices() const override;
  std::vector<PassOutput> outputs() const override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;

 private:
  // A portion of the light, and its planes.
  struct LitPlanes {
    LightPortion light;
    PlaneSet planes{};
    uint32_t textureSize = 0;
    uint32_t channels = 3;  // of the textures: one where all beams have the same color
  };
  struct PlaneImages {
    // What the virtual camera sees, one layer for each window.
    gpu::Image normals;   // as receiver_normal.glsl.h packs them
    gpu::Image depths;    // 0 at nearestDepth and 1 at farthestDepth
    gpu::Image textures;  // units of flux, layers as textureIndex has them
  };

  std::vector<LightPortion> portionsOfLight(std::span<const ReceiverBox> boxes) const;
  void upload();
  void ensureImages(std::size_t set);
  void drawReceivers(gpu::CommandList& commands, const GpuScene& gpuScene, std::size_t set);
  void deposit(gpu::CommandList& commands, std::size_t set, VkDeviceAddress ofBeams);

  gpu::Device& device_;
  const TransportSettings transportSettings_;
  const BeamDivision division_;
  const PlaneSettings settings_;
  const PlaneTechniqueKind kind_;
  Stats& stats_;
  SceneTransport& transport_;
  const Casters casters_;
  const TransportSource& source_;

  gpu::Program receiversProgram_;
  std::array<gpu::Program, 2> depositPrograms_, shadePrograms_;  // one channel, three channels
  gpu::Sampler texelSampler_;

  // Of the frame being made.
  std::vector<LitPlanes> lit_;
  std::vector<PlaneImages> images_;  // one for each of them
  VkDeviceSize beamBytes_ = 0;
  gpu::Buffer beamUpload_, beams_;
};

}  // namespace nephroid

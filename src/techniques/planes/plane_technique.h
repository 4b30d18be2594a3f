// Caustics by way of textures on virtual planes around the receivers, which are lit by looking them up there.
// Techniques of this kind differ in how the planes stand.
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

// How one of them differs from another.
struct PlaneTechniqueKind {
  TechniqueTraits traits;
  // As many planes as are asked for, of `textureSize` texels along each side, for one portion of the light
  // (lightThroughCasters).
  PlaneSet (*plan)(const Scene& scene, const LightPortion& portion, std::span<const ReceiverBox> boxes,
                   uint32_t planes, uint32_t textureSize);
  uint32_t planes;
  // The light goes along the planes' axis, give or take, so that the virtual camera sees the receivers that
  // it meets; or else any way, and what it meets may be hidden.
  bool goesAlongAxis;
  const char* viewPass;      // name of the pass that draws what the virtual camera sees
  const char* texturesPass;  // name of the pass that fills the textures
};

class PlaneTechnique final : public TechniqueBase {
 public:
  PlaneTechnique(const TechniqueContext& context, const PlaneTechniqueKind& kind);

  TechniqueTraits traits() const override { return kind.traits; }
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
    uint32_t channels = 3;  // of the textures: one where all beams have the same colour
  };
  struct PlaneImages {
    // What the virtual camera sees, a layer a window.
    gpu::Image normals;   // as receiver_normal.glsl.h packs them
    gpu::Image depths;    // 0 at nearestDepth and 1 at farthestDepth
    gpu::Image textures;  // units of flux, layers as textureIndex has them
  };

  std::vector<LightPortion> portionsOfLight(std::span<const ReceiverBox> boxes) const;
  void upload();
  void ensureImages(std::size_t set);
  void drawReceivers(gpu::CommandList& commands, const GpuScene& gpuScene, std::size_t set);
  void deposit(gpu::CommandList& commands, std::size_t set, VkDeviceAddress ofBeams);

  gpu::Device& device;
  const TransportSettings transportSettings;
  const BeamDivision division;
  const PlaneSettings settings;
  const PlaneTechniqueKind kind;
  Stats& stats;
  SceneTransport& transport;
  const Casters casters;
  const TransportSource& source;

  gpu::Program receiversProgram;
  std::array<gpu::Program, 2> depositPrograms, shadePrograms;  // one channel, three channels
  gpu::Sampler texelSampler;

  // Of the frame being made.
  std::vector<LitPlanes> lit;
  std::vector<PlaneImages> images;  // one for each of them
  VkDeviceSize beamBytes = 0;
  gpu::Buffer beamUpload, beams;
};

}  // namespace nephroid

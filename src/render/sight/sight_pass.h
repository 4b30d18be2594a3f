// Draws the view through glass and in mirrors (Iwasaki 2005, 5.2 and 5.3). View rays are traced at the
// caster's vertices and interpolated between them. Where the ray of a pixel meets a receiver is found in
// images of the receivers: sliced object images across the mean direction in which view rays leave the
// caster, and for other directions the six images of a cube around it. The images hold surfaces, not light.
// The surface that a pixel finds replaces the receiver behind the caster, and is lit in the same way.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "gpu/program.h"
#include "gpu/resources.h"
#include "gpu_scene/gpu_scene.h"
#include "render/frame_resources.h"
#include "render/shadow_maps.h"
#include "render/sight/settings.h"
#include "render/sight/slices.h"
#include "render/sight/ways_in_water.h"
#include "render/sky/sky_pass.h"
#include "render/view.h"
#include "techniques/lattice.h"
#include "transport/scene_transport.h"

namespace nephroid {

// The images of receivers, with one layer for each slice or face of the cube.
struct ReceiverImages {
  gpu::Image depths;   // d32, reversed
  gpu::Image normals;  // r32ui: octahedral
  gpu::Image albedos;  // rg32ui: packSliceAlbedo
};

// For each frame: call update, then record.
class SightPass {
 public:
  // The device outlives it.
  SightPass(gpu::Device& device, const SightSettings& settings);

  // The host's work for a frame: computes view rays and the positions of the images, for the scene in which
  // `transport` was placed. `extents`: of its meshes. The device must not be using anything of this object.
  void update(SceneTransport& transport, const View& view, uvec2 pictureSize,
              const std::vector<MeshExtent>& extents);

  // The region of the picture that holds all casters.
  const gpu::Region& region() const { return region_; }
  bool disperses() const { return disperses_; }
  bool reflects() const { return reflects_; }

  // The frame's slices that may hold receivers.
  std::vector<Lattice> lattices() const;

  // As ways.frag reads them; none where no caster is in the picture.
  CasterImages casterImages() const {
    if (casters_.empty()) return {};
    return {&position_, &exit_, &direction_};
  }

  // Replaces receivers in `images` by those that casters show, and draws casters into the depth image.
  // Records its own passes.
  void record(gpu::CommandList& commands, const GpuScene& gpuScene, const FrameImages& images,
              const SkyPass& sky);

 private:
  // A caster that is in the picture.
  struct SeenCaster {
    std::array<gpu::IndexRange, 3>
        ranges{};  // triangles for each channel; only the first is used where it does not disperse
    SightConstants constants{};
    std::array<SliceSet, 3> slices{};  // as ranges
    gpu::Region region{};
    bool isMirror = false;
    bool disperses = false;

    uint32_t channels() const { return disperses ? 3 : 1; }
  };

  void add(SceneTransport& transport, const View& view, uint32_t object, const MeshExtent& extent,
           const gpu::Region& region, const MediumStack& media);
  void upload(const View& view);
  void ensureImages(uvec2 pictureSize);
  void drawCasters(gpu::CommandList& commands, std::span<const SeenCaster> casters, uint32_t channel,
                   const FrameImages& images);
  void drawReceivers(gpu::CommandList& commands, const GpuScene& gpuScene, const SightFrame& frame,
                     vec2 depths, uint32_t layer, uint32_t size);
  void drawSlices(gpu::CommandList& commands, const GpuScene& gpuScene, const SliceSet& set);
  void drawSurroundings(gpu::CommandList& commands, const GpuScene& gpuScene, const SeenCaster& caster);
  void lookThrough(gpu::CommandList& commands, const SeenCaster& caster, uint32_t channel,
                   const SeenImages& seen, bool isFirst);
  void lookAtReflected(gpu::CommandList& commands, const SeenCaster& caster, const FrameImages& images,
                       bool isFirst);
  void look(gpu::CommandList& commands, const gpu::Program& program, const SeenCaster& caster,
            uint32_t channel, gpu::Bindings bindings, const SeenImages& seen, bool isFirst);

  gpu::Device& device_;
  SightSettings settings_;
  gpu::Program casterProgram_, channelProgram_, seenProgram_, reflectedProgram_;
  gpu::Program sliceProgram_, texturedSliceProgram_;
  ReceiverImages receiverImages_;  // of one caster after the other
  // Of the picture's size, as caster.frag writes them.
  gpu::Image position_, exit_, direction_, receiver_;
  gpu::Buffer vertices_, indices_, camera_;

  // Of the frame being made.
  std::vector<SightMesh> meshes_;
  std::vector<SeenCaster> casters_;
  std::vector<ReceiverBounds> receivers_;
  std::vector<vec3> receiverColors_;  // of the objects
  std::vector<uint32_t> receiverMaterials_;
  std::vector<bool> isTextured_;
  gpu::Region region_{};
  bool disperses_ = false;
  bool reflects_ = false;
};

}  // namespace nephroid

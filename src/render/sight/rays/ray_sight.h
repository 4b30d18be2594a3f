// The view through casters by rays of each pixel (seen_by_rays.h), in a frame: what the rays end on are
// receiver points, lit as those that the camera sees.
#pragma once

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "render/frame_resources.h"
#include "render/shadow_maps.h"
#include "render/sight/rays/seen_by_rays.h"
#include "render/sight/ways_in_water.h"
#include "render/sky/sky_pass.h"
#include "render/view.h"
#include "techniques/technique.h"
#include "transport/scene_transport.h"

namespace nephroid {

// For each frame: call update, record, light the points, and hand `bindings` to the composite.
class RaySight {
 public:
  // The device outlives it.
  // `hasTurbidWater`: the scene has water that absorbs or scatters.
  RaySight(gpu::Device& device, bool hasTurbidWater);

  // The host's work, for the scene in which `transport` was placed. `extents`: of its meshes. The device must
  // not be using anything of this object.
  void update(SceneTransport& transport, const View& view, uvec2 pictureSize,
              const std::vector<MeshExtent>& extents, const SkyPass& sky);

  // The region of the picture that holds all casters.
  const gpu::Region& region() const { return seen_.region; }
  const RaySightCounts& counts() const { return seen_.counts; }
  const SeenByRays& seen() const { return seen_; }

  // Draws casters into the depth image, and takes the receivers behind them out of `images`.
  void record(gpu::CommandList& commands, const FrameImages& images);

  // The points to be lit, and where their light goes (lux). None where no way ends on a receiver.
  bool hasPoints() const { return !seen_.positions.empty(); }
  ReceiverPoints points() const;
  const gpu::Image& directLux() const { return directLux_; }
  const gpu::Image& causticsLux() const { return causticsLux_; }

  // For the ways in turbid water.
  CasterImages casterImages() const;

  // Of the pixels and points, as luminance.glsl.h has them.
  const gpu::Image& rest() const { return rest_; }
  const gpu::Image& ranges() const { return ranges_; }
  const gpu::Image& factors() const { return factors_; }

 private:
  uint32_t rows() const;
  void ensureImages(uvec2 pictureSize);
  struct Copied {
    std::span<const std::byte> bytes;
    const gpu::Image* image;
    gpu::Region region;
  };
  std::vector<Copied> copied(const FrameImages& images) const;

  gpu::Device& device_;
  bool hasTurbidWater_;
  gpu::Program program_;
  SeenByRays seen_;
  gpu::Buffer staging_;
  // Of the picture's size.
  gpu::Image rest_, ranges_;
  gpu::Image casterPositions_, exits_, directions_;  // with turbid water
  // Of the points, kPointsInRow in a row.
  gpu::Image positions_, normals_, factors_, directLux_, causticsLux_;
};

}  // namespace nephroid

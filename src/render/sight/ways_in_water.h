// The parts of view rays in water that absorbs or scatters, along which techniques scatter light to the eye.
#pragma once

#include <vector>

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "render/frame_resources.h"
#include "render/shadow_maps.h"
#include "render/sight/ways_data.h"
#include "render/view.h"
#include "transport/scene_transport.h"

namespace nephroid {

// Water in view that absorbs or scatters.
struct WaterInSight {
  uint32_t object = 0;
  WayConstants constants{};
  vec3 extinction{0};  // 1/m
};

// Of the pixels that show casters, as ways.frag reads them. Null where there are none.
struct CasterImages {
  const gpu::Image* position = nullptr;
  const gpu::Image* exit = nullptr;
  const gpu::Image* direction = nullptr;
};

// For each frame: call update, then record for each water.
class WaysInWater {
 public:
  // The device outlives it. `isByRays`: how the view through casters is found.
  WaysInWater(gpu::Device& device, bool isByRays);

  // Finds the water in view. `casterRegion`: of the picture, holds all casters.
  void update(const SceneTransport& transport, const View& view, uvec2 pictureSize,
              const std::vector<MeshExtent>& extents, const gpu::Region& casterRegion);

  // The water in view; last, the water that the eye is in, if any.
  const std::vector<WaterInSight>& waters() const { return waters_; }

  // Of the water that the eye is in; 0 where it is in none. 1/m
  vec3 extinctionAtEye() const;

  // Finds the parts of view rays in this water. Writes two images of the picture's size.
  void record(gpu::CommandList& commands, const WaterInSight& water, const FrameImages& images,
              const CasterImages& casters, const gpu::Image& start, const gpu::Image& direction);

 private:
  void add(const Scene& scene, const View& view, uint32_t object, uvec2 pictureSize, bool isInside,
           bool isInPicture);

  gpu::Program program_;
  std::vector<WaterInSight> waters_;
};

}  // namespace nephroid

// What the points of a frame's views see of each lamp (seen_lamps.h), as images for the device.
#pragma once

#include <array>
#include <vector>

#include "gpu/command_list.h"
#include "gpu/resources.h"
#include "render/frame_data.h"
#include "render/shadows/seen_lamps.h"
#include "techniques/technique.h"

namespace nephroid {

// What is lit: the views of SeenImages by kSeen..., and the points of sight by rays.
inline constexpr uint32_t kSeenByRays = kSeenCount, kLitViews = kSeenCount + 1;

// For each frame: call update. Then, where points are new: recordPoints for each view whose points the device
// has; look, while the device is not at work; and recordParts.
class LampShadows {
 public:
  // The device must outlive it.
  explicit LampShadows(gpu::Device& device) : device_(device) {}

  void resize(uvec2 picture);

  // `scene` must stay as it is until the next call.
  void update(const Scene& scene, const std::vector<MeshExtent>& extents);

  // Whether anything may stand before any lamp.
  bool isAny() const { return isAny_; }
  bool hasShadows(uint32_t lamp) const { return !lamps_[lamp].boxes.empty(); }

  // What was seen in the samples before is of another frame.
  void forget();

  // Copies a view's points for `look`.
  void recordPoints(gpu::CommandList& commands, uint32_t view, const ReceiverPoints& points);

  // Looks from the points that were copied last.
  void look(uint32_t view, const RayScene& rays, const SampleOfMany& sample);
  // Looks from points that are here already, which go into an image of that width.
  void look(uint32_t view, const RayScene& rays, const SampleOfMany& sample, const ViewPoints& points,
            uint32_t width);

  // Makes the images of what was seen since the last call.
  void recordParts(gpu::CommandList& commands);

  // r8: the part (0..1) of a lamp's light that comes to each of a view's points. With hasShadows.
  const gpu::Image& parts(uint32_t view, uint32_t lamp) const { return views_[view].parts[lamp]; }

 private:
  struct View {
    SeenLamps seen;
    gpu::Buffer positions, normals;  // of the picture's pixels
    uvec2 size{0};                   // of the images
    std::vector<gpu::Image> parts;   // of the lamps
    gpu::Buffer staging;
    bool isNew = false;
  };
  void store(View& view);

  gpu::Device& device_;
  uvec2 picture_{0};
  bool isAny_ = false;
  std::vector<ShadowedLamp> lamps_;
  std::array<View, kLitViews> views_;
};

}  // namespace nephroid

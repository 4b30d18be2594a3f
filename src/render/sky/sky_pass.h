// Draws the skies that are seen: into the albedo of pixels that see no receiver.
#pragma once

#include <array>
#include <map>

#include "gpu/command_list.h"
#include "lights/seen_skies.h"
#include "render/frame_resources.h"
#include "render/sky/sky_data.h"
#include "render/view.h"

namespace nephroid {

// What is known of sight at a caster, where the sky is seen by way of it.
struct CasterSight {
  uint32_t number = 0;  // its object + 1
  const gpu::Image& position;
  const gpu::Image& normal;
  const gpu::Image& direction;
  gpu::Region region;
};

class SkyPass {
 public:
  // The device and the scene, whose maps are drawn, outlive it.
  SkyPass(gpu::Device& device, const Scene& scene);

  // Takes the lights of `scene`. Returns whether what is seen differs from before. The device must not be
  // using anything of this object.
  bool update(const Scene& scene);
  const SeenSkies& skies() const { return skies_; }
  bool isSeen() const { return !skies_.all().empty(); }

  // For pixels that are seen by `view`. `spacing`: pixels between the samples of a pixel.
  void look(const View& view, uvec2 pictureSize, float spacing);
  float spacing() const { return constants_.spacing; }

  // Adds the skies where no surface is in the picture.
  void record(gpu::CommandList& commands, const FrameImages& images) const;
  // Adds them where a caster shows no receiver; `way`: kSkyThrough or kSkyReflected.
  void record(gpu::CommandList& commands, uint32_t way, const CasterSight& caster,
              const SeenImages& seen) const;

 private:
  gpu::Device& device_;
  SeenSkies skies_;
  std::map<uint32_t, gpu::Image> maps_;   // those that were seen, with all levels
  std::array<gpu::Program, 3> programs_;  // by kSky...
  SkyConstants constants_{};
};

}  // namespace nephroid

// The images and the programs of a frame.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "gpu/program.h"
#include "gpu/resources.h"
#include "render/frame_data.h"
#include "scene/tone_curve.h"

namespace nephroid {

// The surface that each pixel sees, and the light there. All of the frame's size, rgba32f.
struct SeenImages {
  gpu::Image position;  // m, a = 1 where there is a receiver
  gpu::Image normal;    // unit, on the side that is seen; for what is reflected a = reflectance
  gpu::Image albedo;  // a = material + 1 where there is a receiver; else 0, and rgb are the skies seen (nit)
  gpu::Image
      transmittance;  // of the casters through which, or in which, it is seen; a = kSight..., 0 for none
  gpu::Image directLux;
  gpu::Image causticsLux;
};

// Of the frame's size; rgba32f unless it says otherwise.
struct FrameImages {
  gpu::Image depth;  // d32, reversed: 1 near, 0 infinitely far
  // By kSeen...; all but kSeen are made when they are first needed.
  std::array<SeenImages, kSeenCount> seen;
  // The normal of the nearest caster, on the viewer's side. a = 1 where a caster is in front of the receiver,
  // -1 where the viewer sees its inside. Valid only where casters may be.
  gpu::Image casterNormal;
  // The parts of view rays in water that absorbs or scatters, and the light that it scatters along them
  // (nit). Created when they are first needed.
  gpu::Image wayStart, wayDirection, scattered;
  gpu::Image picture;  // rgba8, sRGB
};

SeenImages createSeenImages(gpu::Device& device, uint32_t width, uint32_t height);
FrameImages createFrameImages(gpu::Device& device, uint32_t width, uint32_t height);

// The properties of the casters in the picture, or in a part of it.
struct CasterTraits {
  bool areSeen = false;
  bool reflect = false;
  bool disperse = false;
  bool byRays = false;  // the other two do not matter then
  bool operator<(const CasterTraits& other) const {
    return std::tie(areSeen, reflect, disperse, byRays) <
           std::tie(other.areSeen, other.reflect, other.disperse, other.byRays);
  }
};

struct FramePrograms {
  gpu::Program receiver;
  gpu::Program texturedReceiver;
  std::map<CasterTraits, gpu::Program> picture;
  std::map<CasterTraits, gpu::Program> layers;  // they add to their targets
};

// The sources of luminance in a scene, besides lights on receivers.
struct LuminanceTraits {
  bool hasEmission = false;
  bool hasAir = false;
  bool hasTurbidWater = false;  // water that absorbs or scatters
  bool isSeenByRays = false;    // what casters show
};

FramePrograms createFramePrograms(gpu::Device& device, const LuminanceTraits& luminance, ToneCurve tone);
// Those of pictures alone, for another curve.
std::map<CasterTraits, gpu::Program> createPicturePrograms(gpu::Device& device,
                                                           const LuminanceTraits& luminance, ToneCurve tone);

}  // namespace nephroid

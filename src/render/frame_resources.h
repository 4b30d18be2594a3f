// The images a frame is made in and the programs that make it.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "gpu/program.h"
#include "gpu/resources.h"
#include "render/frame_data.h"

namespace nephroid {

// What pixels see, and the light there. Of the frame's size, rgba32f.
struct SeenImages {
  gpu::Image position;       // m, a = 1 where there is a receiver
  gpu::Image normal;         // unit, on the side that is seen; for what is reflected a = reflectance
  gpu::Image albedo;         // a = material + 1 where there is a receiver, else 0
  gpu::Image transmittance;  // of the casters through, or in, which it is seen; a = kSight..., 0 for none
  gpu::Image directLux;
  gpu::Image causticsLux;
};

// Of the frame's size; rgba32f unless it says otherwise.
struct FrameImages {
  gpu::Image depth;  // d32, reversed: 1 near, 0 infinitely far
  // By kSeen...; all but kSeen are made when they are first needed.
  std::array<SeenImages, kSeenCount> seen;
  // On the side of the viewer, a = 1 where a caster is in front of the receiver, -1 where that is its inside;
  // kept only where casters may be.
  gpu::Image casterNormal;
  // Where water takes of what is seen, made when that is first so: ways of sight in it, and what it scatters
  // along them (nit).
  gpu::Image wayStart, wayDirection, scattered;
  gpu::Image luminance;          // nit; filled for layers only
  gpu::Image directLuminance;    // nit; filled for layers only
  gpu::Image causticsLuminance;  // nit; filled for layers only
  gpu::Image picture;            // rgba8, sRGB
};

SeenImages createSeenImages(gpu::Device& device, uint32_t width, uint32_t height);
FrameImages createFrameImages(gpu::Device& device, uint32_t width, uint32_t height);

// What of casters is in the picture, or a part of it.
struct CasterTraits {
  bool areSeen = false;
  bool reflect = false;
  bool disperse = false;
  bool operator<(const CasterTraits& other) const {
    return std::tie(areSeen, reflect, disperse) < std::tie(other.areSeen, other.reflect, other.disperse);
  }
};

struct FramePrograms {
  gpu::Program receiver;
  gpu::Program texturedReceiver;
  std::map<CasterTraits, gpu::Program> picture;
  std::map<CasterTraits, gpu::Program> layers;
};

// What there is in a scene for luminance to come from besides lights on receivers.
struct LuminanceTraits {
  bool hasEmission = false;
  bool hasAir = false;
  bool hasTurbidWater = false;  // takes of light
};

FramePrograms createFramePrograms(gpu::Device& device, const LuminanceTraits& luminance);

}  // namespace nephroid

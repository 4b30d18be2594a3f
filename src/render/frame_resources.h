// The images a frame is made in and the programs that make it.
#pragma once

#include <array>

#include "gpu/program.h"
#include "gpu/resources.h"

namespace nephroid {

// Of the frame's size; rgba32f unless it says otherwise.
struct FrameImages {
  gpu::Image depth;             // d32, reversed: 1 near, 0 infinitely far
  gpu::Image receiverPosition;  // m, a = 1 where there is a receiver
  gpu::Image receiverNormal;    // unit, on the side of the viewer
  gpu::Image receiverAlbedo;    // a = material + 1 where there is a receiver, else 0
  gpu::Image casterNormal;  // unit, on the side of the viewer, a = object + 1 of the nearest caster in front
                            // of the receiver, else 0; filled for layers only
  gpu::Image casterReflectance;  // a = 1 where nothing is seen through the caster
  gpu::Image opticalDepth;  // of the dielectrics in front of the receiver: rgb by absorption, a by reflection
  gpu::Image directLux;     // a = 1 where there is a receiver
  gpu::Image causticsLux;
  gpu::Image luminance;          // nit; filled for layers only
  gpu::Image directLuminance;    // nit; filled for layers only
  gpu::Image causticsLuminance;  // nit; filled for layers only
  gpu::Image picture;            // rgba8, sRGB
};

FrameImages createFrameImages(gpu::Device& device, uint32_t width, uint32_t height);

struct FramePrograms {
  gpu::Program receiver;
  gpu::Program texturedReceiver;
  gpu::Program mirror;
  gpu::Program dielectric;
  gpu::Program nearestCaster;
  // Luminance and picture, where a caster may be in front (second index 1) and where none is, without and
  // with (first index 1) layers.
  std::array<std::array<gpu::Program, 2>, 2> composite;
};

FramePrograms createFramePrograms(gpu::Device& device, bool hasEmission);

}  // namespace nephroid

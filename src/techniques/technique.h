// How outgoing beams become light on receivers.
#pragma once

#include <functional>
#include <optional>

#include "gpu/command_list.h"
#include "gpu_scene/gpu_scene.h"
#include "scene/scene.h"
#include "techniques/lattice.h"
#include "techniques/pass_output.h"

namespace nephroid {

// Where receivers' light is asked for: a camera's pixels or a sensor's texels. Both images are of one size.
struct ReceiverPoints {
  const gpu::Image* position = nullptr;  // rgba32f: world m; a = 1 where there is a receiver, else 0
  const gpu::Image* normal = nullptr;    // rgba32f: unit, on the side of the viewer or sensor
  std::optional<gpu::Region> region{};   // of the images that is asked for; all of them without it
};

// Lines of sight through the volume of one object. Images are of the picture's size.
struct WaysOfSight {
  const gpu::Image* start = nullptr;  // rgba32f: m; a = length (m), 0 where there is none
  // rgba32f: rg = direction away from the eye, octahedral; b = the part of light from `start` that comes to
  // the eye, without what is taken by a m in the volume before it.
  const gpu::Image* direction = nullptr;
  uint32_t object = 0;
  std::optional<gpu::Region> region{};  // outside there are none
};

// A pass that adds to `causticsLux` at those points what `draw` draws with whole_picture.vert.
void drawCaustics(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& causticsLux,
                  const std::function<void()>& draw);

// One frame is update, record, then shade for each view. The first two may be left out while all that they
// depend on stands still.
class Technique {
 public:
  Technique() = default;
  Technique(const Technique&) = delete;
  Technique& operator=(const Technique&) = delete;
  virtual ~Technique() = default;

  // Before all else, and when they change: the images of points that `shade` will be asked for are of this
  // size.
  virtual void reserve(uvec2 /*size*/) {}

  // What the host does in a frame: rays, beams, planes, of the scene that the technique's transport was
  // placed in. Nothing is in use by the device.
  virtual void update(GpuScene& gpuScene) = 0;

  // What the device does that no view has a part in.
  virtual void record(gpu::CommandList& commands, GpuScene& gpuScene) = 0;

  // Whether what `shade` adds is the mean over a point's square of the receiver, out to half its neighbours,
  // and not what its centre gets.
  virtual bool coversSquares() const { return false; }

  // Whether `update` depends on where the camera stands.
  virtual bool followsCamera() const { return false; }

  // Of the last frame: where in the scene it is computed, and what passes of its own left behind.
  virtual std::vector<Lattice> lattices() const { return {}; }
  virtual std::vector<PassOutput> outputs() const { return {}; }

  // After the device has done a frame's work. False where a list turned out too short, and is longer now:
  // each view is to be shaded again.
  virtual bool finish() { return true; }

  // Adds to `causticsLux` (rgba32f, the size of the points) the illuminance (lux) on each receiver point by
  // light that met a caster, in the region asked for. May be called several times a frame. Synchronised with
  // all before it; what it records is named by passes of its own.
  virtual void shade(gpu::CommandList& commands, const ReceiverPoints& points,
                     const gpu::Image& causticsLux) = 0;

  // Adds to `luminance` (nit, rgba32f) what the object scatters on these ways toward the eye, once, of light
  // that met a caster. After `record`, in passes of its own.
  virtual void scatter(gpu::CommandList& /*commands*/, const WaysOfSight& /*ways*/,
                       const gpu::Image& /*luminance*/) {}
};

}  // namespace nephroid

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

// What a program that uses a technique has to know of it.
struct TechniqueTraits {
  // What `update` makes depends on where the camera stands.
  bool followsCamera = false;
  // Light goes in beams, which can be shown.
  bool usesBeams = false;
  // What `shade` adds is the mean over a point's square of the receiver, out to half way to its neighbors,
  // and not what its center gets.
  bool coversSquares = false;
  // It draws caustics, so that a sensor can be measured.
  bool drawsCaustics = true;
};

// One frame is update, record, then shade for each view. The first two may be left out while all that they
// depend on stands still. Whoever implements it alone derives from TechniqueBase, which has what most do; all
// is pure here, so that the compiler refuses a technique made of others that forgets to pass something on.
class Technique {
 public:
  Technique() = default;
  Technique(const Technique&) = delete;
  Technique& operator=(const Technique&) = delete;
  virtual ~Technique() = default;

  virtual TechniqueTraits traits() const = 0;

  // Before all else, and when they change: the images of points that `shade` will be asked for are of this
  // size, in pixels.
  virtual void reserve(uvec2 size) = 0;

  // What the host does in a frame: rays, beams, planes, of the scene that the technique's transport was
  // placed in. Nothing is in use by the device.
  virtual void update(GpuScene& gpuScene) = 0;

  // What the device does that no view has a part in.
  virtual void record(gpu::CommandList& commands, GpuScene& gpuScene) = 0;

  // Of the last frame: where in the scene it is computed, and what passes of its own left behind.
  virtual std::vector<Lattice> lattices() const = 0;
  virtual std::vector<PassOutput> outputs() const = 0;

  // After the device has done a frame's work. False where a list turned out too short, and is longer now:
  // each view is to be shaded again.
  virtual bool finish() = 0;

  // Adds to `causticsLux` (rgba32f, the size of the points) the illuminance (lux) on each receiver point by
  // light that met a caster, in the region asked for. May be called several times a frame. Synchronized with
  // all before it; what it records is named by passes of its own.
  virtual void shade(gpu::CommandList& commands, const ReceiverPoints& points,
                     const gpu::Image& causticsLux) = 0;

  // Adds to `luminance` (nit, rgba32f) what the object scatters on these ways toward the eye, once, of light
  // that met a caster. After `record`, in passes of its own.
  virtual void scatter(gpu::CommandList& commands, const WaysOfSight& ways, const gpu::Image& luminance) = 0;
};

// A technique that keeps nothing for the size of a picture, shows nothing of itself, never runs out of room
// and scatters nothing, unless it says otherwise.
class TechniqueBase : public Technique {
 public:
  void reserve(uvec2 /*size*/) override {}
  void record(gpu::CommandList& /*commands*/, GpuScene& /*gpuScene*/) override {}
  std::vector<Lattice> lattices() const override { return {}; }
  std::vector<PassOutput> outputs() const override { return {}; }
  bool finish() override { return true; }
  void scatter(gpu::CommandList& /*commands*/, const WaysOfSight& /*ways*/,
               const gpu::Image& /*luminance*/) override {}
};

}  // namespace nephroid

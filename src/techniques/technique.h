// The interface of techniques, which draw caustics.
#pragma once

#include <functional>
#include <optional>

#include "gpu/command_list.h"
#include "gpu_scene/gpu_scene.h"
#include "scene/scene.h"
#include "techniques/lattice.h"
#include "techniques/pass_output.h"

namespace nephroid {

struct RayMesh;

// The points of receivers for which light is computed: a camera's pixels or a sensor's texels. Both images
// have the same size.
struct ReceiverPoints {
  const gpu::Image* position = nullptr;  // rgba32f: world m; a = 1 where there is a receiver, else 0
  const gpu::Image* normal = nullptr;    // rgba32f: unit, on the side of the viewer or sensor
  std::optional<gpu::Region> region{};   // the part of the images to compute; without it, all
};

// The parts of view rays inside one object. Images are of the picture's size.
struct WaysOfSight {
  const gpu::Image* start = nullptr;  // rgba32f: m; a = length (m), 0 where there is none
  // rgba32f. rg: the direction away from the eye, octahedral. b: the part of light from `start` that comes to
  // the eye, without the extinction in the volume before it. a: the length (m) in the volume before `start`.
  const gpu::Image* direction = nullptr;
  uint32_t object = 0;
  std::optional<gpu::Region> region{};  // outside there are none
};

// Records a pass that adds the result of `draw`, which uses whole_picture.vert, to `causticsLux`.
void drawCaustics(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& causticsLux,
                  const std::function<void()>& draw);

// Properties of a technique that its users need.
struct TechniqueTraits {
  // The result of `update` depends on the camera's position.
  bool followsCamera = false;
  // It uses beams, which the viewer can show.
  bool usesBeams = false;
  // `shade` adds the mean over a square of the receiver around each point, half way to its neighbors, and not
  // the value at the point.
  bool coversSquares = false;
  // It draws caustics, so that a sensor can be measured.
  bool drawsCaustics = true;
};

// For each frame: call update, record, then shade for each view. The first two may be left out where nothing
// that they depend on has changed. Most techniques derive from TechniqueBase, which has defaults. Here all
// functions are pure, so that a technique that consists of others cannot forget to pass one on.
class Technique {
 public:
  Technique() = default;
  Technique(const Technique&) = delete;
  Technique& operator=(const Technique&) = delete;
  virtual ~Technique() = default;

  virtual TechniqueTraits traits() const = 0;

  // Sets the size (pixels) of the images of points for `shade`. To be called first, and when the size
  // changes.
  virtual void reserve(uvec2 size) = 0;

  // The host's work for a frame: rays, beams and planes, for the scene in which the technique's transport was
  // placed. The device must not be using anything of this object.
  virtual void update(GpuScene& gpuScene) = 0;

  // The device's work that does not depend on a view.
  virtual void record(gpu::CommandList& commands, GpuScene& gpuScene) = 0;

  // Of the last frame: the grids of the computation, and the outputs of the technique's passes.
  virtual std::vector<Lattice> lattices() const = 0;
  virtual std::vector<PassOutput> outputs() const = 0;
  // The mesh of rays of the last frame; null where there is none.
  virtual const RayMesh* rayMesh() const = 0;

  // To be called after the device has finished a frame. Returns false where a list was too short; it is
  // longer now, and each view has to be shaded again.
  virtual bool finish() = 0;

  // Adds the illuminance (lux) by light that met a caster to `causticsLux` (rgba32f, of the same size as the
  // points' images), for each receiver point of the region. May be called several times in a frame. It
  // records its own passes, which see the results of everything before.
  virtual void shade(gpu::CommandList& commands, const ReceiverPoints& points,
                     const gpu::Image& causticsLux) = 0;

  // Adds to `luminance` (nit, rgba32f) the light that met a caster and that the object scatters toward the
  // eye along these rays (single scattering). To be called after `record`; records its own passes.
  virtual void scatter(gpu::CommandList& commands, const WaysOfSight& ways, const gpu::Image& luminance) = 0;
};

// Defaults for a technique: nothing depends on the size of a picture, nothing is shown in the viewer, lists
// are never too short, and nothing scatters.
class TechniqueBase : public Technique {
 public:
  void reserve(uvec2 /*size*/) override {}
  void record(gpu::CommandList& /*commands*/, GpuScene& /*gpuScene*/) override {}
  std::vector<Lattice> lattices() const override { return {}; }
  std::vector<PassOutput> outputs() const override { return {}; }
  const RayMesh* rayMesh() const override { return nullptr; }
  bool finish() override { return true; }
  void scatter(gpu::CommandList& /*commands*/, const WaysOfSight& /*ways*/,
               const gpu::Image& /*luminance*/) override {}
};

}  // namespace nephroid

#include "techniques/light_volumes/light_volumes.h"

#include <algorithm>

#include "beams/tree.h"
#include "gpu/command_list.h"
#include "gpu/program.h"
#include "shaders/light_volumes_comp.h"
#include "techniques/light_beams.h"
#include "techniques/light_volumes/shader_data.h"

namespace nephroid {
namespace {

struct Counts {
  uint32_t tested, culled, drawn;
};

class LightVolumes final : public Technique {
 public:
  explicit LightVolumes(const TechniqueContext& context);

  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;
  bool coversSquares() const override { return true; }
  void finish() override;

 private:
  // A list on the device, and where the host writes it.
  struct Sent {
    gpu::Buffer upload, onDevice;
    VkDeviceSize bytes = 0;

    template <class T>
    void write(gpu::Device& on, const char* name, const std::vector<T>& values) {
      bytes = values.size() * sizeof(T);
      gpu::ensureBuffer(on, upload, name, bytes, gpu::MemoryKind::upload);
      gpu::ensureBuffer(on, onDevice, name, bytes);
      upload.write(values);
    }
    void copy(gpu::CommandList& commands) const { commands.copy(upload, onDevice, bytes); }
  };

  gpu::Device& device;
  const TechniqueSettings settings;
  Stats& stats;
  SceneTransport& transport;
  const Casters casters;
  const TransportSource& source;
  gpu::Program program;
  gpu::Buffer counts, countsRead;

  // Of the frame being made.
  BeamTree tree;
  Sent beams, bounds, still;
};

LightVolumes::LightVolumes(const TechniqueContext& context)
    : device(context.device),
      settings(context.settings),
      stats(context.stats),
      transport(context.transport),
      casters(context.casters),
      source(transport.source()),
      program(gpu::createComputeProgram(
          device, "light volumes", shaders::light_volumes_comp,
          {{0, settings.cosine == Cosine::stillWater}, {1, settings.culling == Culling::flat}, {2, 1}})),
      counts(gpu::createBuffer(device, "counts of light volumes", sizeof(Counts))),
      countsRead(gpu::createBuffer(device, "counts to read", sizeof(Counts), gpu::MemoryKind::readback)) {}

// The way that most of the light goes.
vec4 meanDirection(const std::vector<Beam>& beams) {
  glm::dvec3 sum(0);
  for (const Beam& beam : beams)
    sum += double(beam.flux.x + beam.flux.y + beam.flux.z) *
           glm::dvec3(beam.direction[0] + beam.direction[1] + beam.direction[2]);
  return vec4(vec3(sum / std::max(glm::length(sum), 1e-300)), 0);
}

void LightVolumes::update(GpuScene&) {
  const Scene& scene = transport.scene();
  const std::vector<ReceiverBox> boxes = receiverBoxes(scene);
  std::vector<std::vector<Beam>> portions;
  std::vector<vec4> directions;
  for (const std::vector<BandQuery>& queries : lightThroughCasters(transport, settings.paths, casters)) {
    portions.push_back(refinedBeams(scene, source, queries, boxes, settings));
    directions.push_back(meanDirection(portions.back()));
  }
  tree = buildBeamTree(portions);
  beams.write(device, "light volumes", tree.beams);
  bounds.write(device, "bounds of light volumes", tree.bounds);
  still.write(device, "directions through still water", directions);
}

void LightVolumes::record(gpu::CommandList& commands, GpuScene&) {
  if (tree.beams.empty()) return;
  commands.pass("light volumes", [&] {
    beams.copy(commands);
    bounds.copy(commands);
    still.copy(commands);
    commands.fill(counts, 0);
  });
}

void LightVolumes::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                         const gpu::Image& causticsLux) {
  if (tree.beams.empty()) return;
  const gpu::Region region =
      points.region.value_or(gpu::Region{{0, 0}, {causticsLux.width(), causticsLux.height()}});
  LightVolumeConstants constants{};
  constants.beams = beams.onDevice.address();
  constants.bounds = bounds.onDevice.address();
  constants.still = still.onDevice.address();
  constants.counts = counts.address();
  constants.root = tree.root;
  constants.corner = region.corner;
  constants.size = ivec2(region.size);
  const uvec2 tiles = (uvec2(constants.size) + kTileSize - 1u) / kTileSize;
  commands.pass("caustics", [&] {
    commands.dispatch(program, {tiles.x * kThreads, tiles.y, 1}, constants,
                      {*points.position, *points.normal, causticsLux});
    commands.barrier();
    commands.copy(counts, countsRead, sizeof(Counts));
  });
}

void LightVolumes::finish() {
  const Counts counted = tree.beams.empty() ? Counts{} : countsRead.as<Counts>()[0];
  setCount(stats, "light_volumes", tree.beams.size());
  setCount(stats, "bounds_tested", counted.tested);
  setCount(stats, "bounds_culled", counted.culled);
  setCount(stats, "volumes_drawn", counted.drawn);
}

}  // namespace

std::unique_ptr<Technique> makeLightVolumes(const TechniqueContext& context) {
  return std::make_unique<LightVolumes>(context);
}

}  // namespace nephroid

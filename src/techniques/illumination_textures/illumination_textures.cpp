#include "techniques/illumination_textures/illumination_textures.h"

#include <algorithm>
#include <array>

#include "beams/build.h"
#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "scene/emitters.h"
#include "shaders/deposit_comp.h"
#include "shaders/receivers_frag.h"
#include "shaders/receivers_vert.h"
#include "shaders/shade_comp.h"
#include "techniques/illumination_textures/plan.h"
#include "techniques/illumination_textures/shader_data.h"
#include "techniques/sources.h"
#include "transport/queries.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

// Light of one emitter through one caster, along one choice of reflections: it has a mean direction of its own.
struct LitCaster {
  std::vector<Beam> beams;
  PlaneSet planes{};
};

// Whether all beams have the same colour, so that one channel and a tint tell all.
bool isOfOneColor(const std::vector<LitCaster>& lit) {
  vec3 first(0);
  for (const LitCaster& caster : lit)
    for (const Beam& beam : caster.beams) {
      if (first == vec3(0)) first = beam.flux;
      const vec3 difference = abs(cross(beam.flux, first));
      if (std::max({difference.x, difference.y, difference.z}) > 1e-5f * dot(beam.flux, first)) return false;
    }
  return true;
}

template <class T>
void ensure(gpu::Device& device, gpu::Buffer& buffer, const char* name, std::size_t count, gpu::MemoryKind kind) {
  // Half as much again, so that a caustic that grows from frame to frame does not ask for memory in each.
  if (buffer.size() < count * sizeof(T)) buffer = gpu::createBuffer(device, name, (count + count / 2) * sizeof(T), kind);
}

class IlluminationTextures final : public Technique {
 public:
  explicit IlluminationTextures(const TechniqueContext& context);

  void update(const Scene& scene, GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& causticsLux) override;

 private:
  LitCaster light(const Scene& scene, std::span<const BandQuery> bands, std::span<const ReceiverBox> boxes) const;
  std::vector<Beam> beamsOf(const Scene& scene, std::span<const BandQuery> bands, const BeamSettings& settings) const;
  void upload();
  void drawReceivers(gpu::CommandList& commands, GpuScene& gpuScene, uint32_t set);
  std::size_t textureWords() const;

  gpu::Device& device;
  const TechniqueSettings settings;
  Stats& stats;
  Scene now;  // the scene of this frame: the sources look at it, and it stays where it is
  RayScene rays;
  TracedSource traced;
  std::unique_ptr<TransportSource> table;
  const TransportSource& source;

  gpu::Program receiversProgram;
  std::array<gpu::Program, 2> depositPrograms;  // one channel, three channels
  std::array<gpu::Program, 2> shadePrograms;

  // Of the frame being made.
  std::vector<LitCaster> lit;
  uint32_t channels = 3;
  gpu::Buffer beamUpload, beams, textures;
  std::vector<gpu::Image> receiverViews;  // one for each lit caster: normals toward the light and depths, a layer a window
  gpu::Image receiverDepth;
};

gpu::Program computeProgram(gpu::Device& device, const char* name, std::span<const uint32_t> code, uint32_t channels) {
  return gpu::createComputeProgram(device, name, code, {{0, channels}});
}

IlluminationTextures::IlluminationTextures(const TechniqueContext& context)
    : device(context.device), settings(context.settings), stats(context.stats), now(context.scene), rays(now), traced(now, rays),
      table(settings.source == Source::table ? makeTableSource(now, settings, traced, context.progress) : nullptr),
      source(table ? *table : static_cast<const TransportSource&>(traced)),
      receiversProgram(gpu::createRasterProgram(device, "receivers from the light", shaders::receivers_vert,
                                                shaders::receivers_frag,
                                                {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT}}, .depthFormat = VK_FORMAT_D32_SFLOAT})),
      depositPrograms{computeProgram(device, "deposit", shaders::deposit_comp, 1),
                      computeProgram(device, "deposit in color", shaders::deposit_comp, 3)},
      shadePrograms{computeProgram(device, "caustics", shaders::shade_comp, 1),
                    computeProgram(device, "caustics in color", shaders::shade_comp, 3)} {
  const uint32_t side = settings.textureSize;
  receiverDepth = gpu::createImage(device, "receivers' depth", {.format = VK_FORMAT_D32_SFLOAT, .width = side, .height = side});
}

std::vector<Beam> IlluminationTextures::beamsOf(const Scene& scene, std::span<const BandQuery> bands,
                                                const BeamSettings& beamSettings) const {
  std::vector<Beam> all;
  for (const BandQuery& band : bands) {
    BeamSet set = buildBeams(scene, source, band.query, band.bandColor, beamSettings);
    if (all.empty()) {
      all = std::move(set.beams);
    } else {
      all.insert(all.end(), set.beams.begin(), set.beams.end());
    }
  }
  return all;
}

LitCaster IlluminationTextures::light(const Scene& scene, std::span<const BandQuery> bands,
                                      std::span<const ReceiverBox> boxes) const {
  const uint32_t planes = std::max(settings.planes, 1u);
  LitCaster caster;
  caster.beams = beamsOf(scene, bands, {.refineDepth = 0, .targets = {}});
  caster.planes = planPlanes(caster.beams, boxes, planes, settings.textureSize);
  if (caster.planes.planes == 0 || !source.refines() || settings.refineDepth == 0) return caster;
  BeamSettings refined;
  refined.refineDepth = settings.refineDepth;
  refined.refineTolerance = 0.5f;
  refined.targets = {planeGrid(caster.planes, 0, 0), planeGrid(caster.planes, caster.planes.planes - 1, 0)};
  caster.beams = beamsOf(scene, bands, refined);
  caster.planes = planPlanes(caster.beams, boxes, planes, settings.textureSize);
  return caster;
}

void IlluminationTextures::update(const Scene& scene, GpuScene&) {
  now.time = scene.time;
  now.objects = scene.objects;
  now.materials = scene.materials;
  now.lights = scene.lights;
  rays.place(now);
  const std::vector<ReceiverBox> boxes = receiverBoxes(now);
  lit.clear();
  std::size_t beamCount = 0;
  for (const Emitter& emitter : emittersOf(now)) {
    const MediumStack media = traced.mediaAround(emitter);
    for (uint32_t object = 0; object < now.objects.size(); ++object) {
      if (!now.isCaster(now.objects[object])) continue;
      const std::vector<BandQuery> queries = queriesFor(now, object, emitter, media, settings.paths);
      for (std::size_t first = 0, last; first < queries.size(); first = last) {
        for (last = first; last < queries.size() && queries[last].query.reflections == queries[first].query.reflections;) ++last;
        LitCaster caster = light(now, std::span(queries).subspan(first, last - first), boxes);
        if (caster.planes.planes == 0) continue;
        beamCount += caster.beams.size();
        lit.push_back(std::move(caster));
      }
    }
  }
  channels = isOfOneColor(lit) ? 1 : 3;
  stats.counts = {{"beams", beamCount}, {"plane_sets", lit.size()}, {"channels", channels}};
  upload();
}

std::size_t IlluminationTextures::textureWords() const {
  std::size_t words = 0;
  for (const LitCaster& caster : lit) words += std::size_t(textureStart(caster.planes, 0, kWindows, channels));
  return words;
}

void IlluminationTextures::upload() {
  std::size_t beamCount = 0;
  for (const LitCaster& caster : lit) beamCount += caster.beams.size();
  ensure<Beam>(device, beamUpload, "beams to upload", beamCount, gpu::MemoryKind::upload);
  ensure<Beam>(device, beams, "beams", beamCount, gpu::MemoryKind::device);
  ensure<uint32_t>(device, textures, "illumination textures", textureWords(), gpu::MemoryKind::device);
  std::size_t first = 0;
  for (const LitCaster& caster : lit) {
    beamUpload.write(caster.beams, first * sizeof(Beam));
    first += caster.beams.size();
  }
  const uint32_t side = settings.textureSize;
  while (receiverViews.size() < lit.size())
    receiverViews.push_back(
        gpu::createImage(device, "receivers from the light", {.width = side, .height = side, .layers = kWindows}));
}

void IlluminationTextures::drawReceivers(gpu::CommandList& commands, GpuScene& gpuScene, uint32_t set) {
  // Where the virtual camera sees nothing, light counts as on a surface across its axis, at any depth.
  const vec4 nothing(-lit[set].planes.axisW, lit[set].planes.farthestDepth * 2 + 1e6f);
  for (uint32_t window = 0; window < kWindows; ++window) {
    commands.render({.colors = {{&receiverViews[set], window, nothing}}, .depth = gpu::DepthAttachment{&receiverDepth, 0, 1.0f}}, [&] {
      for (const SceneDraw& draw : gpuScene.draws())
        if (draw.type == MaterialType::diffuse)
          commands.drawIndexed(receiversProgram, gpuScene.indices(), draw.range, 1,
                               ViewConstants{lit[set].planes, gpuScene.vertices(), gpuScene.objects(), draw.object, window});
    });
    commands.barrier();
  }
}

void IlluminationTextures::record(gpu::CommandList& commands, GpuScene& gpuScene) {
  if (lit.empty()) return;
  commands.pass("receivers from the light", [&] {
    commands.copy(beamUpload, beams, beamUpload.size() < beams.size() ? beamUpload.size() : beams.size());
    commands.fill(textures, 0);
    for (uint32_t set = 0; set < lit.size(); ++set) drawReceivers(commands, gpuScene, set);
  });
  commands.pass("illumination textures", [&] {
    uint32_t firstBeam = 0;
    VkDeviceAddress texture = textures.address();
    for (uint32_t set = 0; set < lit.size(); ++set) {
      const PlaneSet& planes = lit[set].planes;
      const auto count = uint32_t(lit[set].beams.size());
      commands.dispatch(depositPrograms[channels == 3], {count, planes.planes * kWindows, 1},
                        DepositConstants{planes, beams.address() + firstBeam * sizeof(Beam), texture, count},
                        {receiverViews[set]});
      firstBeam += count;
      texture += textureStart(planes, 0, kWindows, channels) * sizeof(uint32_t);
    }
  });
}

void IlluminationTextures::shade(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& causticsLux) {
  commands.pass("caustics", [&] {
    VkDeviceAddress texture = textures.address();
    for (uint32_t set = 0; set < lit.size(); ++set) {
      commands.barrier();
      commands.dispatch(shadePrograms[channels == 3], {causticsLux.width(), causticsLux.height(), 1},
                        ShadeConstants{lit[set].planes, texture},
                        {*points.position, *points.normal, receiverViews[set], causticsLux});
      texture += textureStart(lit[set].planes, 0, kWindows, channels) * sizeof(uint32_t);
    }
  });
}

}  // namespace

std::unique_ptr<Technique> makeIlluminationTextures(const TechniqueContext& context) {
  return std::make_unique<IlluminationTextures>(context);
}

}  // namespace nephroid

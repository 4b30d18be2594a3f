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
#include "shaders/shade_frag.h"
#include "shaders/whole_picture_vert.h"
#include "techniques/illumination_textures/plan.h"
#include "techniques/illumination_textures/shader_data.h"
#include "techniques/sources.h"
#include "transport/queries.h"

namespace nephroid {
namespace {

// As many as the fewest workgroups of one dispatch that Vulkan promises can hold, at 64 threads each.
constexpr std::size_t kMostBeamsADispatch = 65535 * 64;

// Light of one emitter through one caster, along one choice of reflections: it has a mean direction of its
// own.
struct LitCaster {
  std::vector<Beam> beams;
  PlaneSet planes{};
  uint32_t channels = 3;  // of the textures: one where all beams have the same colour
};

// The images of a set of planes.
struct PlaneImages {
  // What the virtual camera sees, a layer a window.
  gpu::Image normals;   // as receiver_normal.glsl.h packs them
  gpu::Image depths;    // 0 at nearestDepth and 1 at farthestDepth
  gpu::Image textures;  // units of flux, layers as textureLayer has them
};

bool areOfOneColor(const std::vector<Beam>& beams) {
  const vec3 first = beams.front().flux;
  return std::ranges::all_of(beams, [&](const Beam& beam) {
    const vec3 difference = abs(cross(beam.flux, first));
    return std::max({difference.x, difference.y, difference.z}) <= 1e-5f * dot(beam.flux, first);
  });
}

template <class T>
void ensure(gpu::Device& device, gpu::Buffer& buffer, const char* name, std::size_t count,
            gpu::MemoryKind kind) {
  // Half as much again, so that a caustic that grows from frame to frame does not ask for memory in each.
  if (buffer.size() < count * sizeof(T))
    buffer = gpu::createBuffer(device, name, (count + count / 2) * sizeof(T), kind);
}

// Of a window, which begins in a corner of images of `imageSize` texels along a side.
ViewConstants viewOf(const PlaneSet& set, uint32_t window, uint32_t imageSize) {
  const auto row = [](vec3 axis, float from, float to) {
    return vec4(axis / (to - from), -from / (to - from));
  };
  const auto inImage = [&](vec3 axis, float from) {
    const float to = from + float(imageSize) / set.windows[window].texelsPerMetre;
    return 2.0f * row(axis, from, to) - vec4(0, 0, 0, 1);
  };
  ViewConstants constants{};
  constants.toClip[0] = inImage(set.axisU, set.windows[window].corner.x);
  constants.toClip[1] = inImage(set.axisV, set.windows[window].corner.y);
  constants.toClip[2] = row(set.axisW, set.nearestDepth, set.farthestDepth);
  constants.axisU = set.axisU;
  constants.axisV = set.axisV;
  constants.axisW = set.axisW;
  return constants;
}

class IlluminationTextures final : public Technique {
 public:
  explicit IlluminationTextures(const TechniqueContext& context);

  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;

 private:
  LitCaster light(const Scene& scene, std::span<const BandQuery> bands,
                  std::span<const ReceiverBox> boxes) const;
  std::vector<Beam> beamsOf(const Scene& scene, std::span<const BandQuery> bands,
                            const BeamSettings& settings) const;
  void upload();
  void ensureImages(std::size_t set);
  void drawReceivers(gpu::CommandList& commands, GpuScene& gpuScene, uint32_t set);
  void deposit(gpu::CommandList& commands, uint32_t set, VkDeviceAddress ofBeams);
  uint32_t followsReceivers() const { return settings.interpolation == Interpolation::surface; }

  gpu::Device& device;
  const TechniqueSettings settings;
  Stats& stats;
  SceneTransport& transport;
  const TransportSource& source;

  gpu::Program receiversProgram;
  std::array<gpu::Program, 2> depositPrograms;  // one channel, three channels
  std::array<gpu::Program, 2> shadePrograms;

  // Of the frame being made.
  std::vector<LitCaster> lit;
  VkDeviceSize beamBytes = 0;
  gpu::Buffer beamUpload, beams;
  std::vector<PlaneImages> images;  // one for each lit caster
  gpu::Sampler texelSampler;
};

gpu::Program depositProgram(gpu::Device& device, const char* name, uint32_t channels,
                            uint32_t followsReceivers) {
  return gpu::createComputeProgram(device, name, shaders::deposit_comp,
                                   {{0, channels}, {1, followsReceivers}});
}

gpu::Program shadeProgram(gpu::Device& device, const char* name, uint32_t channels,
                          uint32_t followsReceivers) {
  return gpu::createRasterProgram(device, name, shaders::whole_picture_vert, shaders::shade_frag,
                                  {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
                                  {{0, channels}, {1, followsReceivers}});
}

IlluminationTextures::IlluminationTextures(const TechniqueContext& context)
    : device(context.device),
      settings(context.settings),
      stats(context.stats),
      transport(context.transport),
      source(transport.source()),
      receiversProgram(gpu::createRasterProgram(
          device, "receivers from the light", shaders::receivers_vert, shaders::receivers_frag,
          {.colors = {{VK_FORMAT_R32_UINT}}, .depthFormat = VK_FORMAT_D32_SFLOAT})),
      depositPrograms{depositProgram(device, "deposit", 1, followsReceivers()),
                      depositProgram(device, "deposit in color", 3, followsReceivers())},
      shadePrograms{shadeProgram(device, "caustics", 1, followsReceivers()),
                    shadeProgram(device, "caustics in color", 3, followsReceivers())},
      texelSampler(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST})) {}

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

void IlluminationTextures::update(GpuScene&) {
  const Scene& now = transport.scene();
  const std::vector<ReceiverBox> boxes = receiverBoxes(now);
  lit.clear();
  std::size_t beamCount = 0;
  for (const Emitter& emitter : emittersOf(now)) {
    const MediumStack media = transport.mediaAround(emitter);
    for (uint32_t object = 0; object < now.objects.size(); ++object) {
      if (!now.isCaster(now.objects[object])) continue;
      const std::vector<BandQuery> queries = queriesFor(now, object, emitter, media, settings.paths);
      for (std::size_t first = 0, last; first < queries.size(); first = last) {
        for (last = first;
             last < queries.size() && queries[last].query.reflections == queries[first].query.reflections;)
          ++last;
        LitCaster caster = light(now, std::span(queries).subspan(first, last - first), boxes);
        if (caster.planes.planes == 0) continue;
        caster.channels = areOfOneColor(caster.beams) ? 1 : 3;
        beamCount += caster.beams.size();
        lit.push_back(std::move(caster));
      }
    }
  }
  stats.counts = {{"beams", beamCount}, {"plane_sets", lit.size()}};
  upload();
}

void IlluminationTextures::upload() {
  std::size_t beamCount = 0;
  for (const LitCaster& caster : lit) beamCount += caster.beams.size();
  ensure<Beam>(device, beamUpload, "beams to upload", beamCount, gpu::MemoryKind::upload);
  ensure<Beam>(device, beams, "beams", beamCount, gpu::MemoryKind::device);
  beamBytes = 0;
  for (const LitCaster& caster : lit) {
    beamUpload.write(caster.beams, beamBytes);
    beamBytes += caster.beams.size() * sizeof(Beam);
  }
  while (images.size() < lit.size()) images.emplace_back();
  for (std::size_t set = 0; set < lit.size(); ++set) ensureImages(set);
}

void IlluminationTextures::ensureImages(std::size_t set) {
  const auto image = [&](const char* name, VkFormat format, uint32_t layers) {
    return gpu::createImage(
        device, name,
        {.format = format, .width = settings.textureSize, .height = settings.textureSize, .layers = layers});
  };
  PlaneImages& own = images[set];
  if (!own.depths) {
    own.normals = image("receivers' normals", VK_FORMAT_R32_UINT, kWindows);
    own.depths = image("receivers' depths", VK_FORMAT_D32_SFLOAT, kWindows);
  }
  const uint32_t layers = textureLayer(lit[set].planes, 0, kWindows, lit[set].channels);
  if (own.textures.layerCount() < layers)
    own.textures = image("illumination textures", VK_FORMAT_R32_UINT, layers);
}

void IlluminationTextures::drawReceivers(gpu::CommandList& commands, GpuScene& gpuScene, uint32_t set) {
  const PlaneImages& own = images[set];
  const PlaneSet& planes = lit[set].planes;
  for (uint32_t window = 0; window < kWindows; ++window) {
    ViewConstants constants = viewOf(planes, window, settings.textureSize);
    constants.vertices = gpuScene.vertices();
    constants.objects = gpuScene.objects();
    commands.render({.colors = {{&own.normals, window, vec4(0)}},
                     .depth = gpu::DepthAttachment{&own.depths, window, 1.0f},
                     .region = gpu::Region{{0, 0}, uvec2(uint32_t(planes.windows[window].size))}},
                    [&] {
                      for (const SceneDraw& draw : gpuScene.draws()) {
                        if (draw.type != MaterialType::diffuse) continue;
                        constants.object = draw.object;
                        commands.drawIndexed(receiversProgram, gpuScene.indices(), draw.range, 1, constants);
                      }
                    });
  }
}

void IlluminationTextures::deposit(gpu::CommandList& commands, uint32_t set, VkDeviceAddress ofBeams) {
  const PlaneImages& own = images[set];
  const std::size_t all = lit[set].beams.size();
  for (std::size_t first = 0; first < all; first += kMostBeamsADispatch) {
    const auto count = uint32_t(std::min(all - first, kMostBeamsADispatch));
    commands.dispatch(depositPrograms[lit[set].channels == 3], {count, 1, 1},
                      DepositConstants{lit[set].planes, ofBeams + first * sizeof(Beam), count},
                      {own.depths, own.normals, own.textures});
  }
}

void IlluminationTextures::record(gpu::CommandList& commands, GpuScene& gpuScene) {
  if (lit.empty()) return;
  commands.pass("receivers from the light", [&] {
    commands.copy(beamUpload, beams, beamBytes);
    for (uint32_t set = 0; set < lit.size(); ++set) {
      commands.clear(images[set].textures, vec4(0));
      drawReceivers(commands, gpuScene, set);
    }
  });
  commands.pass("illumination textures", [&] {
    VkDeviceAddress ofBeams = beams.address();
    for (uint32_t set = 0; set < lit.size(); ++set) {
      deposit(commands, set, ofBeams);
      ofBeams += lit[set].beams.size() * sizeof(Beam);
    }
  });
}

void IlluminationTextures::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                                 const gpu::Image& causticsLux) {
  const bool isAll = points.region.size.x == 0 || points.region.size.y == 0;
  commands.pass("caustics", [&] {
    commands.render({.colors = {{&causticsLux, 0, std::nullopt}},
                     .region = isAll ? std::nullopt : std::optional(points.region)},
                    [&] {
                      for (uint32_t set = 0; set < lit.size(); ++set)
                        commands.draw(shadePrograms[lit[set].channels == 3], 3, 1,
                                      ShadeConstants{lit[set].planes, float(settings.textureSize)},
                                      {*points.position,
                                       *points.normal,
                                       {images[set].depths, texelSampler},
                                       {images[set].textures, texelSampler}});
                    });
  });
}

}  // namespace

std::unique_ptr<Technique> makeIlluminationTextures(const TechniqueContext& context) {
  return std::make_unique<IlluminationTextures>(context);
}

}  // namespace nephroid

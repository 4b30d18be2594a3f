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
constexpr std::size_t kMostBeamsADispatch = 65535 * 64 / kThreadsOfBeam;

// Light of one emitter through one caster, along one choice of reflections: it has a mean direction of its
// own.
struct LitCaster {
  std::vector<Beam> beams;
  std::size_t beamsOfOuterWindow = 0;  // the first so many; the inner window holds the others on all planes
  PlaneSet planes{};
};

// What the light's virtual camera sees.
struct ReceiverView {
  gpu::Image normals;  // as receiver_normal.glsl.h packs them
  gpu::Image depths;   // a layer a window, 0 at nearestDepth and 1 at farthestDepth
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

// The depths (m along axisW) at which a corner ray may leave light: flat planes, or wherever receivers are.
vec2 depthsOfDeposit(const Beam& beam, int corner, const PlaneSet& set, bool followsReceivers) {
  const float start = dot(beam.position[corner], set.axisW);
  const float lastPlane = set.firstDepth + float(set.planes - 1) * set.depthStep;
  if (!followsReceivers) return {set.firstDepth, lastPlane};
  const float arrival = start + 1.01f * beam.reach * dot(beam.direction[corner], set.axisW);
  return {start, std::max(start, std::min(arrival, set.farthestDepth))};
}

// Whether all that the outer window's texture is asked for lies off this beam: the inner one answers there,
// down to one and a half of the outer one's texels from its borders. Corner rays are straight: what is inside
// at both ends is so between them.
bool isInsideInnerWindow(const Beam& beam, const PlaneSet& set, bool followsReceivers) {
  const float border = 1 + 2 * set.windows[0].texelsPerMetre / set.windows[1].texelsPerMetre;
  for (int i = 0; i < 3; ++i) {
    const float approach = dot(beam.direction[i], set.axisW);
    if (approach < kLeastApproach) return false;
    const vec2 depths = depthsOfDeposit(beam, i, set, followsReceivers);
    for (const float depth : {depths.x, depths.y}) {
      const float distance = (depth - dot(beam.position[i], set.axisW)) / approach;  // m
      const vec2 texel = windowTexel(set, 0, beam.position[i] + distance * beam.direction[i]);
      if (std::min(texel.x, texel.y) <= border ||
          std::max(texel.x, texel.y) >= float(set.textureSize) - border)
        return false;
    }
  }
  return true;
}

void putBeamsOfOuterWindowFirst(LitCaster& caster, bool followsReceivers) {
  const auto inner = std::partition(caster.beams.begin(), caster.beams.end(), [&](const Beam& beam) {
    return !isInsideInnerWindow(beam, caster.planes, followsReceivers);
  });
  caster.beamsOfOuterWindow = std::size_t(inner - caster.beams.begin());
}

template <class T>
void ensure(gpu::Device& device, gpu::Buffer& buffer, const char* name, std::size_t count,
            gpu::MemoryKind kind) {
  // Half as much again, so that a caustic that grows from frame to frame does not ask for memory in each.
  if (buffer.size() < count * sizeof(T))
    buffer = gpu::createBuffer(device, name, (count + count / 2) * sizeof(T), kind);
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
  void drawReceivers(gpu::CommandList& commands, GpuScene& gpuScene, uint32_t set);
  void deposit(gpu::CommandList& commands, uint32_t set, uint32_t window, VkDeviceAddress ofBeams,
               VkDeviceAddress texture);
  VkDeviceAddress normalsOf(std::size_t set, uint32_t window) const;
  VkDeviceSize windowBytes() const {
    return VkDeviceSize(settings.textureSize) * settings.textureSize * sizeof(uint32_t);
  }
  std::size_t textureWords() const;
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
  uint32_t channels = 3;
  VkDeviceSize beamBytes = 0;
  gpu::Buffer beamUpload, beams, textures;
  std::vector<ReceiverView> receiverViews;  // one for each lit caster
  gpu::Buffer normals;                      // those of receiverViews, where threads read them one by one
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
                    shadeProgram(device, "caustics in color", 3, followsReceivers())} {}

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
        putBeamsOfOuterWindowFirst(caster, followsReceivers() != 0);
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
  for (const LitCaster& caster : lit)
    words += std::size_t(textureStart(caster.planes, 0, kWindows, channels));
  return words;
}

void IlluminationTextures::upload() {
  std::size_t beamCount = 0;
  for (const LitCaster& caster : lit) beamCount += caster.beams.size();
  ensure<Beam>(device, beamUpload, "beams to upload", beamCount, gpu::MemoryKind::upload);
  ensure<Beam>(device, beams, "beams", beamCount, gpu::MemoryKind::device);
  ensure<uint32_t>(device, textures, "illumination textures", textureWords(), gpu::MemoryKind::device);
  beamBytes = 0;
  for (const LitCaster& caster : lit) {
    beamUpload.write(caster.beams, beamBytes);
    beamBytes += caster.beams.size() * sizeof(Beam);
  }
  const uint32_t side = settings.textureSize;
  ensure<uint32_t>(device, normals, "receivers' normals", lit.size() * kWindows * side * side,
                   gpu::MemoryKind::device);
  while (receiverViews.size() < lit.size()) {
    gpu::ImageOptions options{
        .format = VK_FORMAT_R32_UINT, .width = side, .height = side, .layers = kWindows};
    gpu::Image normal = gpu::createImage(device, "receivers' normals", options);
    options.format = VK_FORMAT_D32_SFLOAT;
    receiverViews.push_back({std::move(normal), gpu::createImage(device, "receivers' depths", options)});
  }
}

void IlluminationTextures::drawReceivers(gpu::CommandList& commands, GpuScene& gpuScene, uint32_t set) {
  const ReceiverView& view = receiverViews[set];
  for (uint32_t window = 0; window < kWindows; ++window)
    commands.render({.colors = {{&view.normals, window, vec4(0)}},
                     .depth = gpu::DepthAttachment{&view.depths, window, 1.0f}},
                    [&] {
                      for (const SceneDraw& draw : gpuScene.draws())
                        if (draw.type == MaterialType::diffuse)
                          commands.drawIndexed(receiversProgram, gpuScene.indices(), draw.range, 1,
                                               ViewConstants{lit[set].planes, gpuScene.vertices(),
                                                             gpuScene.objects(), draw.object, window});
                    });
}

// Device address of the receivers' normals in a window.
VkDeviceAddress IlluminationTextures::normalsOf(std::size_t set, uint32_t window) const {
  return normals.address() + (set * kWindows + window) * windowBytes();
}

void IlluminationTextures::deposit(gpu::CommandList& commands, uint32_t set, uint32_t window,
                                   VkDeviceAddress ofBeams, VkDeviceAddress texture) {
  const std::size_t all = window == 0 ? lit[set].beams.size() : lit[set].beamsOfOuterWindow;
  for (std::size_t first = 0; first < all; first += kMostBeamsADispatch) {
    const auto count = uint32_t(std::min(all - first, kMostBeamsADispatch));
    commands.dispatch(depositPrograms[channels == 3], {count * kThreadsOfBeam, 1, 1},
                      DepositConstants{lit[set].planes, ofBeams + first * sizeof(Beam),
                                       normalsOf(set, window), texture, count, window},
                      {receiverViews[set].depths});
  }
}

void IlluminationTextures::record(gpu::CommandList& commands, GpuScene& gpuScene) {
  if (lit.empty()) return;
  commands.pass("receivers from the light", [&] {
    commands.copy(beamUpload, beams, beamBytes);
    commands.fill(textures, 0);
    for (uint32_t set = 0; set < lit.size(); ++set) drawReceivers(commands, gpuScene, set);
    commands.barrier();
    for (uint32_t set = 0; set < lit.size(); ++set)
      for (uint32_t window = 0; window < kWindows; ++window)
        commands.copy(receiverViews[set].normals, window, normals, (set * kWindows + window) * windowBytes());
  });
  commands.pass("illumination textures", [&] {
    VkDeviceAddress ofBeams = beams.address();
    VkDeviceAddress texture = textures.address();
    for (uint32_t set = 0; set < lit.size(); ++set) {
      for (uint32_t window = 0; window < kWindows; ++window) deposit(commands, set, window, ofBeams, texture);
      ofBeams += lit[set].beams.size() * sizeof(Beam);
      texture += textureStart(lit[set].planes, 0, kWindows, channels) * sizeof(uint32_t);
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
                      VkDeviceAddress texture = textures.address();
                      for (uint32_t set = 0; set < lit.size(); ++set) {
                        commands.draw(shadePrograms[channels == 3], 3, 1,
                                      ShadeConstants{lit[set].planes, texture},
                                      {*points.position, *points.normal, receiverViews[set].depths});
                        texture += textureStart(lit[set].planes, 0, kWindows, channels) * sizeof(uint32_t);
                      }
                    });
  });
}

}  // namespace

std::unique_ptr<Technique> makeIlluminationTextures(const TechniqueContext& context) {
  return std::make_unique<IlluminationTextures>(context);
}

}  // namespace nephroid

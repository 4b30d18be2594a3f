#include "techniques/planes/plane_technique.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>

#include "beams/light_beams.h"
#include "gpu/command_list.h"
#include "shaders/techniques/planes/deposit_comp.h"
#include "shaders/techniques/planes/receivers_frag.h"
#include "shaders/techniques/planes/receivers_vert.h"
#include "shaders/techniques/planes/shade_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

// The fewest that Vulkan promises.
constexpr std::size_t kMostGroupsADispatch = 65535;

// Of a window, which begins in a corner of images of `imageSize` texels along a side.
ViewConstants viewOf(const PlaneSet& set, uint32_t window, uint32_t imageSize) {
  const auto row = [](vec3 axis, float from, float to) {
    return vec4(axis / (to - from), -from / (to - from));
  };
  const auto inImage = [&](vec3 axis, float from) {
    const float to = from + float(imageSize) / set.windows[window].texelsPerMeter;
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

uint32_t followsReceivers(const PlaneSettings& settings) {
  return settings.interpolation == Interpolation::surface;
}

gpu::Program depositProgram(gpu::Device& device, const char* name, uint32_t channels,
                            const PlaneSettings& settings, bool goesAlongAxis) {
  return gpu::createComputeProgram(device, name, shaders::techniques_planes_deposit_comp,
                                   {{"kChannels", channels},
                                    {"kFollowsReceivers", followsReceivers(settings)},
                                    {"kGoesAlongAxis", goesAlongAxis}});
}

gpu::Program shadeProgram(gpu::Device& device, const char* name, uint32_t channels,
                          const PlaneSettings& settings) {
  return gpu::createRasterProgram(
      device, name, shaders::techniques_whole_picture_vert, shaders::techniques_planes_shade_frag,
      {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
      {{"kChannels", channels}, {"kFollowsReceivers", followsReceivers(settings)}});
}

// The directions of a sky, each of which has planes of its own and its share of the light alone, have about
// as many texels together as a few lights have.
PlaneSettings settingsFor(const Scene& scene, PlaneSettings settings) {
  constexpr std::size_t kAtFullSize = 4;
  constexpr uint32_t kFewestTexels = 64;
  std::size_t directions = 0;
  for (const Light& light : scene.lights) directions += light.sky.size();
  if (directions <= kAtFullSize) return settings;
  const float part = std::sqrt(float(kAtFullSize) / float(directions));
  settings.textureSize =
      std::min(settings.textureSize, std::max(uint32_t(float(settings.textureSize) * part), kFewestTexels));
  return settings;
}

// For each portion of the light, texels along the sides of its textures: so that their sum stays bounded
// however many ways light goes by reflection, those that carry less get fewer.
std::vector<uint32_t> textureSizes(std::span<const LightPortion> portions, uint32_t full) {
  constexpr std::size_t kAtFullSize = 8;   // the next 4 times, 16 times ... as many at a half, a quarter ...
  constexpr uint32_t kFewestTexels = 128;  // those of a sky have no more to begin with
  std::vector<double> fluxes;
  for (const LightPortion& portion : portions) {
    double sum = 0;
    for (const Beam& beam : portion.beams) sum += double(beam.flux.x + beam.flux.y + beam.flux.z);
    fluxes.push_back(sum);
  }
  std::vector<std::size_t> byFlux(portions.size());
  std::iota(byFlux.begin(), byFlux.end(), 0u);
  std::ranges::stable_sort(byFlux, std::greater{}, [&](std::size_t i) { return fluxes[i]; });
  std::vector<uint32_t> sizes(portions.size());
  uint32_t size = full;
  std::size_t last = kAtFullSize;
  for (std::size_t rank = 0; rank < byFlux.size(); ++rank) {
    if (rank == last && size / 2 >= kFewestTexels) {
      size /= 2;
      last *= 4;
    }
    sizes[byFlux[rank]] = size;
  }
  return sizes;
}

}  // namespace

PlaneTechnique::PlaneTechnique(const TechniqueContext& context, const PlaneTechniqueKind& kindOf)
    : device_(context.device),
      transportSettings_(context.settings.transport),
      division_(context.settings.beams),
      settings_(settingsFor(context.transport.scene(), context.settings.own.of<PlaneSettings>())),
      kind_(kindOf),
      stats_(context.stats),
      transport_(context.transport),
      casters_(context.casters),
      source_(transport_.source()),
      receiversProgram_(
          gpu::createRasterProgram(device_, kind_.viewPass, shaders::techniques_planes_receivers_vert,
                                   shaders::techniques_planes_receivers_frag,
                                   {.colors = {{VK_FORMAT_R32_UINT}}, .depthFormat = VK_FORMAT_D32_SFLOAT})),
      depositPrograms_{depositProgram(device_, "deposit", 1, settings_, kind_.goesAlongAxis),
                       depositProgram(device_, "deposit in color", 3, settings_, kind_.goesAlongAxis)},
      shadePrograms_{shadeProgram(device_, "caustics", 1, settings_),
                     shadeProgram(device_, "caustics in color", 3, settings_)},
      texelSampler_(gpu::createSampler(device_, {.filter = VK_FILTER_NEAREST})) {}

std::vector<LightPortion> PlaneTechnique::portionsOfLight(std::span<const ReceiverBox> boxes) const {
  const Scene& scene = transport_.scene();
  std::vector<LightPortion> portions;
  for (const std::vector<BandQuery>& queries :
       lightThroughCasters(transport_, transportSettings_.paths, casters_)) {
    std::vector<Beam> all = refinedBeams(scene, source_, queries, boxes, division_, settings_.textureSize);
    if (!kind_.goesAlongAxis)
      portions.push_back({vec3(0), std::move(all), 0});
    else
      std::ranges::move(portionsByAxis(std::move(all), boxes), std::back_inserter(portions));
  }
  return portions;
}

void PlaneTechnique::update(GpuScene&) {
  const std::vector<ReceiverBox> boxes = receiverBoxes(transport_.scene());
  std::vector<LightPortion> portions = portionsOfLight(boxes);
  const std::vector<uint32_t> sizes = textureSizes(portions, settings_.textureSize);
  lit_.clear();
  for (std::size_t i = 0; i < portions.size(); ++i) {
    LitPlanes own{std::move(portions[i]), {}, sizes[i], 3};
    own.planes = kind_.plan(transport_.scene(), own.light, boxes, kind_.planes, own.textureSize);
    if (own.planes.planes == 0) continue;
    own.channels = areOfOneColor(own.light.beams) ? 1 : 3;
    lit_.push_back(std::move(own));
  }
  std::size_t beamCount = 0;
  for (const LitPlanes& own : lit_) beamCount += own.light.beams.size();
  setCount(stats_, "beams", beamCount);
  setCount(stats_, "plane_sets", lit_.size());
  upload();
}

void PlaneTechnique::upload() {
  beamBytes_ = 0;
  for (const LitPlanes& own : lit_) beamBytes_ += own.light.beams.size() * sizeof(Beam);
  gpu::ensureBuffer(device_, beamUpload_, "beams to upload", beamBytes_, gpu::MemoryKind::upload);
  gpu::ensureBuffer(device_, beams_, "beams", beamBytes_, gpu::MemoryKind::device);
  VkDeviceSize offset = 0;
  for (const LitPlanes& own : lit_) {
    beamUpload_.write(own.light.beams, offset);
    offset += own.light.beams.size() * sizeof(Beam);
  }
  if (images_.size() < lit_.size()) images_.resize(lit_.size());
  for (std::size_t set = 0; set < lit_.size(); ++set) ensureImages(set);
}

std::vector<Lattice> PlaneTechnique::lattices() const {
  std::vector<Lattice> all;
  for (const LitPlanes& own : lit_)
    for (uint32_t plane = 0; plane < own.planes.planes; ++plane)
      for (const Window& window : own.planes.windows) {
        const float side = window.size / window.texelsPerMeter;
        const vec3 corner = window.corner.x * own.planes.axisU + window.corner.y * own.planes.axisV +
                            (own.planes.firstDepth + float(plane) * own.planes.depthStep) * own.planes.axisW;
        all.push_back(
            {LatticeKind::planes, corner, {side * own.planes.axisU, side * own.planes.axisV, vec3(0)}});
      }
  return all;
}

std::vector<PassOutput> PlaneTechnique::outputs() const {
  constexpr float kShownUnits = 1e-6f;  // of the flux that is left in a texel
  std::vector<PassOutput> all;
  for (std::size_t set = 0; set < lit_.size(); ++set) {
    all.push_back({kind_.viewPass, "depths", &images_[set].depths, kShowDepth});
    all.push_back({kind_.texturesPass, "flux", &images_[set].textures, kShowLight, kShownUnits});
  }
  return all;
}

void PlaneTechnique::ensureImages(std::size_t set) {
  const uint32_t size = lit_[set].textureSize;
  const auto image = [&](const char* name, VkFormat format, uint32_t layers) {
    return gpu::createImage(device_, name,
                            {.format = format, .width = size, .height = size, .layers = layers});
  };
  PlaneImages& own = images_[set];
  if (!own.depths || own.depths.width() != size) {
    own = {};
    own.normals = image("receivers' normals", VK_FORMAT_R32_UINT, kWindows);
    own.depths = image("receivers' depths", VK_FORMAT_D32_SFLOAT, kWindows);
  }
  const uint32_t layers = layersOfChannel(lit_[set].planes) * lit_[set].channels;
  if (!own.textures || own.textures.layerCount() < layers)
    own.textures = image("illumination textures", VK_FORMAT_R32_UINT, layers);
}

void PlaneTechnique::drawReceivers(gpu::CommandList& commands, const GpuScene& gpuScene, std::size_t set) {
  const PlaneImages& own = images_[set];
  const PlaneSet& planes = lit_[set].planes;
  for (uint32_t window = 0; window < kWindows; ++window) {
    ViewConstants constants = viewOf(planes, window, lit_[set].textureSize);
    constants.vertices = gpuScene.vertices();
    constants.objects = gpuScene.objects();
    commands.render({.colors = {{&own.normals, window, vec4(0)}},
                     .depth = gpu::DepthAttachment{&own.depths, window, 1.0f},
                     .region = gpu::Region{{0, 0}, uvec2(uint32_t(planes.windows[window].size))}},
                    [&] {
                      for (const SceneDraw& draw : gpuScene.draws()) {
                        if (draw.type != MaterialType::diffuse) continue;
                        constants.object = draw.object;
                        commands.drawIndexed(receiversProgram_, gpuScene.indices(), draw.range, 1, constants);
                      }
                    });
  }
}

void PlaneTechnique::deposit(gpu::CommandList& commands, std::size_t set, VkDeviceAddress ofBeams) {
  const PlaneImages& own = images_[set];
  const std::size_t all = lit_[set].light.beams.size();
  const std::size_t most = kMostGroupsADispatch * device_.subgroupSize();
  for (std::size_t first = 0; first < all; first += most) {
    const auto count = uint32_t(std::min(all - first, most));
    commands.dispatch(depositPrograms_[lit_[set].channels == 3], {count, 1, 1},
                      DepositConstants{lit_[set].planes, ofBeams + first * sizeof(Beam), count,
                                       float(lit_[set].textureSize)},
                      {{"seenDepths", own.depths}, {"seenNormals", own.normals}, {"textures", own.textures}});
  }
}

void PlaneTechnique::record(gpu::CommandList& commands, GpuScene& gpuScene) {
  if (lit_.empty()) return;
  commands.pass(kind_.viewPass, [&] {
    commands.copy(beamUpload_, beams_, beamBytes_);
    for (std::size_t set = 0; set < lit_.size(); ++set) {
      commands.clear(images_[set].textures, vec4(0));
      drawReceivers(commands, gpuScene, set);
    }
  });
  commands.pass(kind_.texturesPass, [&] {
    VkDeviceAddress ofBeams = beams_.address();
    for (std::size_t set = 0; set < lit_.size(); ++set) {
      deposit(commands, set, ofBeams);
      ofBeams += lit_[set].light.beams.size() * sizeof(Beam);
    }
  });
}

void PlaneTechnique::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                           const gpu::Image& causticsLux) {
  drawCaustics(commands, points, causticsLux, [&] {
    for (std::size_t set = 0; set < lit_.size(); ++set)
      commands.draw(shadePrograms_[lit_[set].channels == 3], 3, 1,
                    ShadeConstants{lit_[set].planes, float(lit_[set].textureSize)},
                    {{"receiverPosition", *points.position},
                     {"receiverNormal", *points.normal},
                     {"seenDepths", images_[set].depths, texelSampler_},
                     {"textures", images_[set].textures, texelSampler_}});
  });
}

}  // namespace nephroid

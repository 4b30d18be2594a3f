// Hierarchical light volumes (Barczak and Olano): for each block of pixels the beams that may light it are
// found down a tree of their bounds, and each pixel asks those.
#include <algorithm>
#include <span>

#include "beams/light_beams.h"
#include "beams/tree.h"
#include "gpu/command_list.h"
#include "gpu/program.h"
#include "scene/volume.h"
#include "shaders/techniques/light_volumes/beam_on_patch_frag.h"
#include "shaders/techniques/light_volumes/beam_on_patch_vert.h"
#include "shaders/techniques/light_volumes/patches_comp.h"
#include "techniques/light_volumes/scattered_light.h"
#include "techniques/light_volumes/settings.h"
#include "techniques/light_volumes/shader_data.h"
#include "techniques/technique_info.h"

namespace nephroid {
namespace {

struct Counts {
  uint32_t tested, culled, drawn, wanted, unfinished;
};

// Draws that a frame starts with room for: more than most need.
constexpr VkDeviceSize kDrawsAPixel = 2;
constexpr BeamDrawCommand kNoDraws{0, 1, 0, 0, 0};

// A list in an image of `texels` to each, as beam_texels.glsl.h reads it, and where the host writes it.
template <class T>
class TexelList {
 public:
  explicit TexelList(std::string nameOf) : name(std::move(nameOf)) {}

  void write(gpu::Device& device, const std::vector<T>& values) {
    const auto rows = uint32_t((values.size() + kInRow - 1) / kInRow);
    if (!texels || texels.height() < rows) {
      const uint32_t roomy = rows + rows / 2 + 1;
      texels = gpu::createImage(
          device, name, {.format = VK_FORMAT_R32G32B32A32_UINT, .width = kInRow * kTexels, .height = roomy});
      upload = gpu::createBuffer(device, name, sizeof(T) * kInRow * roomy, gpu::MemoryKind::upload);
    }
    upload.write(values);
  }
  void copy(gpu::CommandList& commands) const { commands.copy(upload, 0, texels); }
  const gpu::Image& image() const { return texels; }

 private:
  static constexpr uint32_t kTexels = sizeof(T) / sizeof(uvec4), kInRow = kTexelsInRow / kTexels;
  std::string name;
  gpu::Image texels;
  gpu::Buffer upload;
};

constexpr TechniqueTraits kTraits{.usesBeams = true, .coversSquares = true};

class LightVolumes final : public TechniqueBase {
 public:
  explicit LightVolumes(const TechniqueContext& context);

  TechniqueTraits traits() const override { return kTraits; }
  void reserve(uvec2 size) override;
  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;
  void scatter(gpu::CommandList& commands, const WaysOfSight& ways, const gpu::Image& luminance) override {
    scattered.draw(commands, ways, luminance);
  }
  bool finish() override;

 private:
  gpu::Device& device;
  const Paths paths;
  const BeamDivision division;
  const LightVolumeSettings settings;
  Stats& stats;
  SceneTransport& transport;
  const Casters casters;
  const TransportSource& source;
  gpu::Program patches, beamOnPatch;
  gpu::Buffer counts, countsRead;
  bool isFirstView = true;    // of the frame being made
  uint32_t levelOfRoots = 0;  // of the hierarchy, from where its parts are taken one after the other
  gpu::Buffer draws, noDraws, command;
  gpu::Image axesU, axesV;  // of the squares that pixels show

  // Of the frame being made.
  BeamTree tree;
  TexelList<Beam> beams{"light volumes"};
  TexelList<BeamBounds> bounds{"bounds of light volumes"};
  gpu::Buffer portionsRead;
  ScatteredLight scattered;
};

gpu::RasterState stateOfDraws() {
  gpu::RasterState state;
  state.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}};
  state.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
  return state;
}

LightVolumes::LightVolumes(const TechniqueContext& context)
    : device(context.device),
      paths(context.settings.transport.paths),
      division(context.settings.beams),
      settings(context.settings.own.of<LightVolumeSettings>()),
      stats(context.stats),
      transport(context.transport),
      casters(context.casters),
      source(transport.source()),
      patches(gpu::createComputeProgram(device, "patches", shaders::techniques_light_volumes_patches_comp,
                                        {{"kIsFlat", settings.culling == Culling::flat}})),
      beamOnPatch(gpu::createRasterProgram(
          device, "beam on a patch", shaders::techniques_light_volumes_beam_on_patch_vert,
          shaders::techniques_light_volumes_beam_on_patch_frag, stateOfDraws(),
          {{"kIsStill", settings.cosine == Cosine::stillWater}})),
      counts(gpu::createBuffer(device, "counts of light volumes", sizeof(Counts))),
      countsRead(gpu::createBuffer(device, "counts to read", sizeof(Counts), gpu::MemoryKind::readback)),
      noDraws(gpu::createBuffer(device, "no draws", sizeof(BeamDrawCommand), gpu::MemoryKind::upload)),
      command(gpu::createBuffer(device, "draws of beams", sizeof(BeamDrawCommand))),
      scattered(device) {
  noDraws.write(std::vector{kNoDraws});
}

// The groups of bounds so many levels below the root; those of beams where the tree ends before.
std::vector<uint32_t> rootsBelow(const BeamTree& tree, uint32_t levels) {
  std::vector<uint32_t> roots{tree.root};
  for (uint32_t level = 0; level < levels; ++level) {
    std::vector<uint32_t> next;
    for (const uint32_t root : roots) {
      const auto parts = std::span(tree.bounds).subspan(root, kChildren);
      if (std::ranges::any_of(parts, [](const BeamBounds& part) { return (part.kind & kIsBeam) != 0; }))
        next.push_back(root);
      else
        for (const BeamBounds& part : parts)
          if (part.nearest <= part.farthest) next.push_back(part.first);
    }
    roots = next;
  }
  return roots;
}

vec3 downInto(const Object& water) {
  return water.placement.direction({0, -1, 0});
}

// Where most of the light of a portion goes, and through what.
BeamPortion portionOf(const Scene& scene, uint32_t caster, const std::vector<Beam>& beams) {
  glm::dvec3 sum(0);
  for (const Beam& beam : beams)
    sum += double(beam.flux.x + beam.flux.y + beam.flux.z) *
           glm::dvec3(beam.direction[0] + beam.direction[1] + beam.direction[2]);
  BeamPortion portion{vec3(sum / std::max(glm::length(sum), 1e-300)), vec3(0)};
  const Object& object = scene.objects[caster];
  if (object.water && dot(portion.still, downInto(object)) > 0)
    portion.extinction = extinctionOf(scene.materialOf(object));
  return portion;
}

void LightVolumes::reserve(uvec2 size) {
  axesU = gpu::createImage(device, "first axes of squares", {.width = size.x, .height = size.y});
  axesV = gpu::createImage(device, "second axes of squares", {.width = size.x, .height = size.y});
  gpu::ensureBuffer(device, draws, "beams on patches", kDrawsAPixel * size.x * size.y * sizeof(BeamDraw));
}

void LightVolumes::update(GpuScene&) {
  const Scene& scene = transport.scene();
  const std::vector<ReceiverBox> boxes = receiverBoxes(scene);
  std::vector<std::vector<Beam>> portions;
  std::vector<BeamPortion> ofPortions;
  std::vector<uint32_t> objects;  // that portions come from
  for (const std::vector<BandQuery>& queries : lightThroughCasters(transport, paths, casters)) {
    portions.push_back(refinedBeams(scene, source, queries, boxes, division, settings.detail));
    objects.push_back(queries.front().query.object);
    ofPortions.push_back(portionOf(scene, objects.back(), portions.back()));
  }
  if (settings.contributionError > 0) leaveOutWeakest(portions, double(settings.contributionError));
  scattered.begin();
  for (std::size_t i = 0; i < portions.size(); ++i) {
    const Object& caster = scene.objects[objects[i]];
    if (ofPortions[i].extinction != vec3(0) && scatters(scene.materialOf(caster)))
      scattered.add(scene, objects[i], portions[i], downInto(caster));
  }
  tree = buildBeamTree(portions);
  beams.write(device, tree.beams);
  bounds.write(device, tree.bounds);
  gpu::ensureBuffer(device, portionsRead, "portions of light volumes",
                    ofPortions.size() * sizeof(BeamPortion), gpu::MemoryKind::upload);
  portionsRead.write(ofPortions);
}

void LightVolumes::record(gpu::CommandList& commands, GpuScene&) {
  if (tree.beams.empty()) return;
  commands.pass("light volumes", [&] {
    beams.copy(commands);
    bounds.copy(commands);
    scattered.upload(commands);
  });
}

void LightVolumes::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                         const gpu::Image& causticsLux) {
  if (tree.beams.empty()) return;
  const uvec2 imageSize(causticsLux.width(), causticsLux.height());
  const gpu::Region region = points.region.value_or(gpu::Region{{0, 0}, imageSize});
  const uvec2 tiles = (region.size + kTileSize - 1u) / kTileSize;
  PatchConstants listing{};
  listing.counts = counts.address();
  listing.draws = draws.address();
  listing.command = command.address();
  listing.room = uint32_t(draws.size() / sizeof(BeamDraw));
  listing.corner = region.corner;
  listing.size = ivec2(region.size);
  const BeamDrawConstants drawing{portionsRead.address(), draws.address(), vec2(imageSize)};
  commands.pass("beams on patches", [&] {
    commands.copy(noDraws, command, sizeof(BeamDrawCommand));
    if (isFirstView) commands.fill(counts, 0);
    isFirstView = false;
    for (const uint32_t root : rootsBelow(tree, levelOfRoots)) {
      listing.root = root;
      commands.barrier();
      commands.dispatch(patches, {tiles.x * device.subgroupSize(), tiles.y, 1}, listing,
                        {{"receiverPosition", *points.position},
                         {"receiverNormal", *points.normal},
                         {"axesU", axesU},
                         {"axesV", axesV},
                         {"boundsTexels", bounds.image()},
                         {"beamTexels", beams.image()}});
    }
  });
  drawCaustics(commands, points, causticsLux, [&] {
    commands.drawIndirect(beamOnPatch, command, drawing,
                          {{"receiverPosition", *points.position},
                           {"axesU", axesU},
                           {"axesV", axesV},
                           {"beamTexels", beams.image()}});
  });
  commands.barrier();
  commands.copy(counts, countsRead, sizeof(Counts));
}

bool LightVolumes::finish() {
  isFirstView = true;
  const Counts counted = tree.beams.empty() ? Counts{} : countsRead.as<Counts>()[0];
  setCount(stats, "light_volumes", tree.beams.size());
  setCount(stats, "bounds_tested", counted.tested);
  setCount(stats, "bounds_culled", counted.culled);
  setCount(stats, "volumes_drawn", counted.drawn);
  if (scattered.count() > 0) setCount(stats, "volumes_in_layers", scattered.count());
  if (counted.unfinished > 0) ++levelOfRoots;
  if (counted.wanted > 0)
    gpu::ensureBuffer(device, draws, "beams on patches", counted.wanted * sizeof(BeamDraw));
  return counted.unfinished == 0 && counted.wanted == 0;
}

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  return std::make_unique<LightVolumes>(context);
}

constexpr Setting kSettings[] = {
    choiceSetting<&LightVolumeSettings::culling>(
        "culling", "Find light volumes down their hierarchy, or ask each of them for every block of pixels"),
    choiceSetting<&LightVolumeSettings::cosine>(
        "cosine",
        "The cosine between a light volume and a receiver: each volume's own, or that of the light's mean "
        "direction, which is right for still water"),
    realSetting<&LightVolumeSettings::contributionError>(
        "contribution-error", 0, 1,
        "The part of the light that may be left out, the weakest light volumes first"),
    wholeSetting<&LightVolumeSettings::detail>(
        "volume-detail", 16, 8192,
        "Texels along each side of the planes about the light on which it is judged whether a light volume "
        "bends and has to be divided"),
};
constexpr SettingsOwner kOwners[] = {settingsOwner<LightVolumeSettings>("light-volumes", kSettings)};

constexpr Omission kOmissions[] = {
    omissions::kReflection,
    omissions::kSpectrum,
    {"Detail between the rays of a caster's vertices; where receivers hide each other from the light, "
     "that between beams",
     hasCaster},
    omissions::kScatteringAside,
};

}  // namespace

extern const TechniqueInfo kLightVolumes;
constinit const TechniqueInfo kLightVolumes{
    .name = "light-volumes",
    .summary = "Each pixel asks for the beams that it lies in (paper 5): any beams on any receiver",
    .make = make,
    .traits = kTraits,
    .settings = kOwners,
    .omissions = kOmissions,
    .prepare = prepareTransport,
    .isStillPrepared = isTransportStillPrepared,
};

}  // namespace nephroid

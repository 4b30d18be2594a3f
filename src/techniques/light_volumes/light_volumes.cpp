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
  explicit TexelList(std::string nameOf) : name_(std::move(nameOf)) {}

  void write(gpu::Device& device, const std::vector<T>& values) {
    const auto rows = uint32_t((values.size() + kInRow - 1) / kInRow);
    if (!texels_ || texels_.height() < rows) {
      const uint32_t roomy = rows + rows / 2 + 1;
      texels_ = gpu::createImage(
          device, name_, {.format = VK_FORMAT_R32G32B32A32_UINT, .width = kInRow * kTexels, .height = roomy});
      upload_ = gpu::createBuffer(device, name_, sizeof(T) * kInRow * roomy, gpu::MemoryKind::upload);
    }
    upload_.write(values);
  }
  void copy(gpu::CommandList& commands) const { commands.copy(upload_, 0, texels_); }
  const gpu::Image& image() const { return texels_; }

 private:
  static constexpr uint32_t kTexels = sizeof(T) / sizeof(uvec4), kInRow = kTexelsInRow / kTexels;
  std::string name_;
  gpu::Image texels_;
  gpu::Buffer upload_;
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
    scattered_.draw(commands, ways, luminance);
  }
  bool finish() override;

 private:
  gpu::Device& device_;
  const Paths paths_;
  const BeamDivision division_;
  const LightVolumeSettings settings_;
  Stats& stats_;
  SceneTransport& transport_;
  const Casters casters_;
  const TransportSource& source_;
  gpu::Program patches_, beamOnPatch_;
  gpu::Buffer counts_, countsRead_;
  bool isFirstView_ = true;    // of the frame being made
  uint32_t levelOfRoots_ = 0;  // of the hierarchy, from where its parts are taken one after the other
  gpu::Buffer draws_, noDraws_, command_;
  gpu::Image axesU_, axesV_;  // of the squares that pixels show

  // Of the frame being made.
  BeamTree tree_;
  TexelList<Beam> beams_{"light volumes"};
  TexelList<BeamBounds> bounds_{"bounds of light volumes"};
  gpu::Buffer portionsRead_;
  ScatteredLight scattered_;
};

gpu::RasterState stateOfDraws() {
  gpu::RasterState state;
  state.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}};
  state.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
  return state;
}

LightVolumes::LightVolumes(const TechniqueContext& context)
    : device_(context.device),
      paths_(context.settings.transport.paths),
      division_(context.settings.beams),
      settings_(context.settings.own.of<LightVolumeSettings>()),
      stats_(context.stats),
      transport_(context.transport),
      casters_(context.casters),
      source_(transport_.source()),
      patches_(gpu::createComputeProgram(device_, "patches", shaders::techniques_light_volumes_patches_comp,
                                         {{"kIsFlat", settings_.culling == Culling::flat}})),
      beamOnPatch_(gpu::createRasterProgram(
          device_, "beam on a patch", shaders::techniques_light_volumes_beam_on_patch_vert,
          shaders::techniques_light_volumes_beam_on_patch_frag, stateOfDraws(),
          {{"kIsStill", settings_.cosine == Cosine::stillWater}})),
      counts_(gpu::createBuffer(device_, "counts of light volumes", sizeof(Counts))),
      countsRead_(gpu::createBuffer(device_, "counts to read", sizeof(Counts), gpu::MemoryKind::readback)),
      noDraws_(gpu::createBuffer(device_, "no draws", sizeof(BeamDrawCommand), gpu::MemoryKind::upload)),
      command_(gpu::createBuffer(device_, "draws of beams", sizeof(BeamDrawCommand))),
      scattered_(device_) {
  noDraws_.write(std::vector{kNoDraws});
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
  axesU_ = gpu::createImage(device_, "first axes of squares", {.width = size.x, .height = size.y});
  axesV_ = gpu::createImage(device_, "second axes of squares", {.width = size.x, .height = size.y});
  gpu::ensureBuffer(device_, draws_, "beams on patches", kDrawsAPixel * size.x * size.y * sizeof(BeamDraw));
}

void LightVolumes::update(GpuScene&) {
  const Scene& scene = transport_.scene();
  const std::vector<ReceiverBox> boxes = receiverBoxes(scene);
  std::vector<std::vector<Beam>> portions;
  std::vector<BeamPortion> ofPortions;
  std::vector<uint32_t> objects;  // that portions come from
  for (const std::vector<BandQuery>& queries : lightThroughCasters(transport_, paths_, casters_)) {
    portions.push_back(refinedBeams(scene, source_, queries, boxes, division_, settings_.detail));
    objects.push_back(queries.front().query.object);
    ofPortions.push_back(portionOf(scene, objects.back(), portions.back()));
  }
  if (settings_.contributionError > 0) leaveOutWeakest(portions, double(settings_.contributionError));
  scattered_.begin();
  for (std::size_t i = 0; i < portions.size(); ++i) {
    const Object& caster = scene.objects[objects[i]];
    if (ofPortions[i].extinction != vec3(0) && scatters(scene.materialOf(caster)))
      scattered_.add(scene, objects[i], portions[i], downInto(caster));
  }
  tree_ = buildBeamTree(portions);
  beams_.write(device_, tree_.beams);
  bounds_.write(device_, tree_.bounds);
  gpu::ensureBuffer(device_, portionsRead_, "portions of light volumes",
                    ofPortions.size() * sizeof(BeamPortion), gpu::MemoryKind::upload);
  portionsRead_.write(ofPortions);
}

void LightVolumes::record(gpu::CommandList& commands, GpuScene&) {
  if (tree_.beams.empty()) return;
  commands.pass("light volumes", [&] {
    beams_.copy(commands);
    bounds_.copy(commands);
    scattered_.upload(commands);
  });
}

void LightVolumes::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                         const gpu::Image& causticsLux) {
  if (tree_.beams.empty()) return;
  const uvec2 imageSize(causticsLux.width(), causticsLux.height());
  const gpu::Region region = points.region.value_or(gpu::Region{{0, 0}, imageSize});
  const uvec2 tiles = (region.size + kTileSize - 1u) / kTileSize;
  PatchConstants listing{};
  listing.counts = counts_.address();
  listing.draws = draws_.address();
  listing.command = command_.address();
  listing.room = uint32_t(draws_.size() / sizeof(BeamDraw));
  listing.corner = region.corner;
  listing.size = ivec2(region.size);
  const BeamDrawConstants drawing{portionsRead_.address(), draws_.address(), vec2(imageSize)};
  commands.pass("beams on patches", [&] {
    commands.copy(noDraws_, command_, sizeof(BeamDrawCommand));
    if (isFirstView_) commands.fill(counts_, 0);
    isFirstView_ = false;
    for (const uint32_t root : rootsBelow(tree_, levelOfRoots_)) {
      listing.root = root;
      commands.barrier();
      commands.dispatch(patches_, {tiles.x * device_.subgroupSize(), tiles.y, 1}, listing,
                        {{"receiverPosition", *points.position},
                         {"receiverNormal", *points.normal},
                         {"axesU", axesU_},
                         {"axesV", axesV_},
                         {"boundsTexels", bounds_.image()},
                         {"beamTexels", beams_.image()}});
    }
  });
  drawCaustics(commands, points, causticsLux, [&] {
    commands.drawIndirect(beamOnPatch_, command_, drawing,
                          {{"receiverPosition", *points.position},
                           {"axesU", axesU_},
                           {"axesV", axesV_},
                           {"beamTexels", beams_.image()}});
  });
  commands.barrier();
  commands.copy(counts_, countsRead_, sizeof(Counts));
}

bool LightVolumes::finish() {
  isFirstView_ = true;
  const Counts counted = tree_.beams.empty() ? Counts{} : countsRead_.as<Counts>()[0];
  setCount(stats_, "light_volumes", tree_.beams.size());
  setCount(stats_, "bounds_tested", counted.tested);
  setCount(stats_, "bounds_culled", counted.culled);
  setCount(stats_, "volumes_drawn", counted.drawn);
  if (scattered_.count() > 0) setCount(stats_, "volumes_in_layers", scattered_.count());
  if (counted.unfinished > 0) ++levelOfRoots_;
  if (counted.wanted > 0)
    gpu::ensureBuffer(device_, draws_, "beams on patches", counted.wanted * sizeof(BeamDraw));
  return counted.unfinished == 0 && counted.wanted == 0;
}

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  return std::make_unique<LightVolumes>(context);
}

constexpr Setting kSettings[] = {
    choiceSetting<&LightVolumeSettings::culling>(
        "culling",
        "How the light volumes of a block of pixels are found. hierarchical: by their hierarchy; flat: by a "
        "test of each volume"),
    choiceSetting<&LightVolumeSettings::cosine>(
        "cosine",
        "The cosine between a light volume and a receiver's normal. exact: for each volume; still-water: for "
        "the light's mean direction, which is right for still water"),
    realSetting<&LightVolumeSettings::contributionError>(
        "contribution-error", 0, 1,
        "The part (0 to 1) of the light that may be left out; the weakest light volumes are left out first"),
    wholeSetting<&LightVolumeSettings::detail>("volume-detail", 16, 8192,
                                               "Texels along each side of the planes on which it is tested "
                                               "whether a light volume bends and has to be divided"),
};
constexpr SettingsOwner kOwners[] = {settingsOwner<LightVolumeSettings>("light-volumes", kSettings)};

constexpr Omission kOmissions[] = {
    omissions::kReflection,
    omissions::kSpectrum,
    omissions::kSizeOfLamps,
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

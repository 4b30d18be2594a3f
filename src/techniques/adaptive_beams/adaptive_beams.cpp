// Light followed where it counts, within an error asked for, and kept where it landed.
#include <oneapi/tbb/parallel_for.h>

#include <bit>
#include <iomanip>
#include <sstream>

#include "core/accuracy.h"
#include "gpu/command_list.h"
#include "scene/volume.h"
#include "shaders/techniques/adaptive_beams/landed_light_frag.h"
#include "shaders/techniques/whole_picture_vert.h"
#include "techniques/adaptive_beams/landed_light.h"
#include "techniques/adaptive_beams/level_picture.h"
#include "techniques/adaptive_beams/picture_mesh.h"
#include "techniques/adaptive_beams/sensor_light.h"
#include "techniques/composite.h"
#include "techniques/technique_info.h"

namespace nephroid {

extern const TechniqueInfo kLightVolumes;

namespace {

constexpr uint32_t kLayerSide = kTilesInRow * kTileStride;  // texels
constexpr std::size_t kTexelBytes = 4 * sizeof(uint16_t);
constexpr std::size_t kLayerBytes = std::size_t(kLayerSide) * kLayerSide * kTexelBytes;

// Of a number that is not negative and no larger than a half float can be.
uint16_t halfOf(float value) {
  constexpr float kExponents = 0x1p-112f;  // between the two
  return uint16_t((std::bit_cast<uint32_t>(value * kExponents) + 0x1000u) >> 13);
}

constexpr TechniqueTraits kTraits{.followsCamera = true};

std::string inPercent(double part) {
  std::ostringstream text;
  text << std::setprecision(2) << 100 * part << " %";
  return text.str();
}

// A sentence where the error that was asked for is not reached; otherwise empty.
std::string shortfallOf(const RayMesh& mesh, const Accuracy& accuracy, bool isPicture) {
  const RayMeshStats& told = mesh.stats;
  // A claim is worth so much, and chance moves it.
  constexpr double kDoubt = 2;
  const bool isMet = told.error <= (told.bound == RayMeshBound::none ? kDoubt : 1) * double(accuracy.error);
  const std::string sky =
      told.fewSkyParts == 0
          ? ""
          : "the sky's caustics are those of " + std::to_string(told.fewSkyParts) +
                " parts of it, as its casters have many triangles (a smaller --error: more)";
  if (isMet) return sky;
  std::string cause = "weak reflections are chosen at random (a smaller --error keeps more of them)";
  if (told.bound == RayMeshBound::bytes)
    cause = "--memory " + std::to_string(accuracy.memory) + " leaves no room for more paths";
  if (told.bound == RayMeshBound::beams)
    cause = "no more than " + std::to_string(mesh.beams.size()) + " beams are made" +
            (isPicture ? " (for a larger picture or a smaller --error, more)" : "");
  return "the light of caustics may be off by up to " + inPercent(told.error) + " of its mean, not " +
         inPercent(double(accuracy.error)) + ": " + cause + (sky.empty() ? "" : "; " + sky);
}

void tell(const RayMesh& mesh, Paths paths, const Accuracy& accuracy, bool isPicture, Stats& stats) {
  const RayMeshStats& told = mesh.stats;
  setCount(stats, "rays", told.rays);
  setCount(stats, "shadow_rays", told.shadowRays);
  setCount(stats, "beams", mesh.beams.size());
  const auto levelsTold = [&](const std::string& name, std::span<const uint64_t> beams) {
    for (std::size_t i = 0; i < beams.size(); ++i)
      if (beams[i] > 0) setCount(stats, name + std::to_string(i), beams[i]);
  };
  levelsTold("beams_cut_", told.beamsByLevel);
  levelsTold("beams_past_boundaries_", told.beamsByBranch);
  setCount(stats, "single_paths", told.singlePaths);
  setCount(stats, "ray_mesh_bytes", told.bytes);
  setCount(stats, "bound_met", told.bound != RayMeshBound::none);
  stats.shortfall = shortfallOf(mesh, accuracy, isPicture);
  stats.budget = LightBudget{told.incidentFlux, told.landedFlux, told.lostFlux,
                             told.shadedFlux,   told.missedFlux, paths == Paths::all};
  stats.error = told.error;
  // Without reflection, what is totally reflected is lost by definition.
  const double out = told.droppedFlux + (paths == Paths::all ? told.lostFlux : 0);
  stats.leftOut = told.incidentFlux > 0 ? out / told.incidentFlux : 0;
}

// Calls trace(). Throws RuntimeFailure, with the memory that would do, where even the fewest paths do not
// fit.
template <class Trace>
void traceWithin(const Accuracy& accuracy, const Trace& trace) {
  try {
    trace();
  } catch (const TooManyPaths& failure) {
    const uint64_t needed = (kPartsOfMemory * failure.bytes >> 20) + 1;
    throw RuntimeFailure("the fewest paths of light through the casters do not fit into --memory " +
                         std::to_string(accuracy.memory) + ": they need " + std::to_string(needed));
  }
}

class AdaptiveBeams final : public TechniqueBase {
 public:
  explicit AdaptiveBeams(const TechniqueContext& context)
      : device_(context.device),
        transport_(context.transport),
        settings_(context.settings),
        stats_(context.stats),
        progress_(context.progress ? *context.progress : ownProgress_),
        program_(gpu::createRasterProgram(device_, "adaptive beams", shaders::techniques_whole_picture_vert,
                                          shaders::techniques_adaptive_beams_landed_light_frag,
                                          {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}})),
        wordSampler_(gpu::createSampler(device_, {.filter = VK_FILTER_NEAREST})),
        tileSampler_(gpu::createSampler(device_)),
        levels_(std::make_unique<LevelPicture>(device_)) {}

  void reserve(uvec2 size) override { pictureSize_ = size; }
  TechniqueTraits traits() const override { return kTraits; }
  void update(GpuScene&) override;
  void record(gpu::CommandList& commands, GpuScene&) override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;
  const RayMesh* rayMesh() const override { return &mesh_; }
  std::vector<PassOutput> outputs() const override;

 private:
  void stage();

  gpu::Device& device_;
  SceneTransport& transport_;
  const TechniqueSettings& settings_;
  Stats& stats_;
  Progress ownProgress_;
  Progress& progress_;
  gpu::Program program_;
  gpu::Sampler wordSampler_, tileSampler_;
  uvec2 pictureSize_{640, 480};
  RayMesh mesh_;
  LandedLight light_;
  uint32_t layers_ = 0;
  gpu::Buffer stagedCells_, stagedTiles_;
  gpu::Image cells_, tiles_;
  std::unique_ptr<LevelPicture> levels_;
};

void AdaptiveBeams::update(GpuScene&) {
  const Scene& scene = transport_.scene();
  const Accuracy& accuracy = accuracyOf(settings_);
  const RayMeshSettings wanted = settingsOfPicture(scene, pictureSize_, settings_);
  traceWithin(accuracy, [&] { traceRayMesh(scene, transport_.rayScene(), wanted, progress_, mesh_); });
  light_.build(mesh_);
  stage();
  tell(mesh_, wanted.paths, accuracy, true, stats_);
  setCount(stats_, "light_cells", light_.cells.size());
  setCount(stats_, "landed_light_bytes", light_.bytes());
}

// The image of cells is made as large as they ask for, and that of tiles layer by layer.
void AdaptiveBeams::stage() {
  const std::size_t words = light_.cells.size() * kCellWords;
  const uint32_t rows = uint32_t((words + kWordsInRow - 1) / kWordsInRow);
  if (!cells_ || cells_.height() < rows) {
    cells_ =
        gpu::createImage(device_, "cells of landed light",
                         {.format = VK_FORMAT_R32_UINT, .width = kWordsInRow, .height = rows + rows / 2 + 1});
    stagedCells_ = gpu::createBuffer(device_, "staged cells of landed light",
                                     VkDeviceSize(cells_.height()) * kWordsInRow * sizeof(uint32_t),
                                     gpu::MemoryKind::upload);
  }
  stagedCells_.writeBytes(std::as_bytes(std::span(light_.cells)), 0);
  const std::size_t count = light_.tileCount();
  layers_ = uint32_t((count + kTilesInLayer - 1) / kTilesInLayer);
  if (!tiles_ || tiles_.layerCount() < layers_) {
    tiles_ = gpu::createImage(device_, "landed light",
                              {.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                               .width = kLayerSide,
                               .height = kLayerSide,
                               .layers = std::max(layers_, 1u)});
    stagedTiles_ = gpu::createBuffer(device_, "staged landed light", std::max(layers_, 1u) * kLayerBytes,
                                     gpu::MemoryKind::upload);
  }
  const std::span<uint16_t> halves = stagedTiles_.as<uint16_t>();
  const float inverse = 1 / light_.grid.luxOfUnit;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t tile) {
    const std::size_t inLayer = tile % kTilesInLayer;
    const std::size_t column = inLayer % kTilesInRow * kTileStride, row = inLayer / kTilesInRow * kTileStride;
    const float* texel = light_.texels.data() + tile * 3 * kTexelsOfTile;
    for (std::size_t y = 0; y < kTileStride; ++y) {
      uint16_t* to =
          halves.data() + 4 * ((tile / kTilesInLayer * kLayerSide + row + y) * kLayerSide + column);
      for (std::size_t x = 0; x < kTileStride; ++x, ++texel)
        for (std::size_t c = 0; c < 3; ++c) to[4 * x + c] = halfOf(texel[c * kTexelsOfTile] * inverse);
    }
  });
}

void AdaptiveBeams::record(gpu::CommandList& commands, GpuScene&) {
  commands.pass("landed light", [&] {
    commands.copy(stagedCells_, 0, cells_, 0);
    for (uint32_t layer = 0; layer < layers_; ++layer)
      commands.copy(stagedTiles_, layer * kLayerBytes, tiles_, layer);
  });
}

void AdaptiveBeams::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                          const gpu::Image& causticsLux) {
  if (light_.texels.empty()) return;
  drawCaustics(commands, points, causticsLux, [&] {
    commands.draw(program_, 3, 1, light_.grid,
                  {{"receiverPosition", *points.position},
                   {"receiverNormal", *points.normal},
                   {"cells", cells_, wordSampler_},
                   {"tiles", tiles_, tileSampler_}});
  });
}

std::vector<PassOutput> AdaptiveBeams::outputs() const {
  PassOutput levels{"landed light", "levels"};
  levels.make = [this](const ReceiverPoints& points, Legend& legend) {
    return levels_->draw(light_, cells_, wordSampler_, points, legend);
  };
  return {levels};
}

constexpr SettingsOwner kOwners[] = {settingsOwner<Accuracy>("Accuracy", kAccuracySettings)};

// What water scatters toward the eye is drawn by light volumes.
constexpr const TechniqueInfo* kParts[] = {&kLightVolumes};

constexpr Omission kOmissions[] = {omissions::kSpectrum, omissions::kScatteringAside};

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  auto own = std::make_unique<AdaptiveBeams>(context);
  const Scene& scene = context.transport.scene();
  const bool isWaterSeen = std::ranges::any_of(scene.objects, [&](const Object& object) {
    return object.water && scatters(scene.materialOf(object));
  });
  if (!isWaterSeen) return own;
  TechniqueContext ofWater = context;
  ofWater.casters = Casters::water;
  std::vector<CompositePart> parts;
  parts.push_back({std::move(own)});
  parts.push_back({kLightVolumes.make(ofWater), false, true});
  return std::make_unique<CompositeTechnique>(std::move(parts));
}

std::vector<vec3> measure(const SensorRequest& request, Progress& progress, Stats& stats) {
  const Accuracy& accuracy = accuracyOf(request.settings);
  const Paths paths = request.settings.transport.paths;
  RayMesh mesh;
  std::vector<vec3> lux;
  traceWithin(accuracy, [&] {
    lux = lightOnSensor(request.scene, request.rays, request.sensor,
                        {accuracy.error, paths, bytesForPaths(accuracy)}, mesh, progress);
  });
  tell(mesh, paths, accuracy, false, stats);
  return lux;
}

}  // namespace

extern const TechniqueInfo kAdaptiveBeams;
constinit const TechniqueInfo kAdaptiveBeams{
    .name = "adaptive-beams",
    .summary = "Beams refined where they count, within an error, and kept where they landed",
    .make = make,
    .traits = kTraits,
    .settings = kOwners,
    .omissions = kOmissions,
    .parts = kParts,
    .prepare = prepareTransport,
    .isStillPrepared = isTransportStillPrepared,
    .measure = measure,
};

}  // namespace nephroid

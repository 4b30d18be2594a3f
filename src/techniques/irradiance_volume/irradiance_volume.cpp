// Caustics looked up in a volume that was made for each caster beforehand: Wyman, Hansen and Shirley 2004,
// "Interactive Caustics Using Local Precomputed Irradiance".
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <tuple>

#include "core/error.h"
#include "gpu/program.h"
#include "gpu/transfer.h"
#include "irradiance_volume/harmonics.h"
#include "irradiance_volume/volume_file.h"
#include "lights/light_intensity.h"
#include "scene/volume.h"
#include "shaders/techniques/irradiance_volume/volume_frag.h"
#include "shaders/techniques/whole_picture_vert.h"
#include "techniques/irradiance_volume/cell_images.h"
#include "techniques/irradiance_volume/scene_volumes.h"
#include "techniques/irradiance_volume/shader_data.h"
#include "techniques/technique_info.h"

namespace nephroid {
namespace {

// Light of a volume on the device: as `representation` of lookup.h has it, in images or in words.
struct HeldLight {
  CellImages cells;   // of all but bricks
  gpu::Buffer words;  // of bricks; of shells, what their cells come after
};

// How light is displaced: a row for each y and z of the lattice.
struct HeldFlow {
  gpu::Image moves;  // rgba32f
  gpu::Buffer staged;
};

// What looking up light can leave out.
struct LookUpTraits {
  bool flows = false;
  bool isTinted = false;
  bool isNear = false;  // the lamp
  bool operator<(const LookUpTraits& other) const {
    return std::tie(flows, isTinted, isNear) < std::tie(other.flows, other.isTinted, other.isNear);
  }
};

constexpr TechniqueTraits kTraits{};

class IrradianceVolumes final : public TechniqueBase {
 public:
  explicit IrradianceVolumes(const TechniqueContext& context);

  TechniqueTraits traits() const override { return kTraits; }
  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  std::vector<Lattice> lattices() const override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;

 private:
  struct Share {
    VolumeConstants constants{};
    const HeldLight* light = nullptr;
    const HeldFlow* flow = nullptr;  // none where light stays
    const gpu::Program* program = nullptr;
  };

  void addShares(const Object& object, IrradianceVolume& volume, const Emitter& emitter,
                 const ShapedLight& light);
  // The same for all points of one light at once.
  void addResolved(const Object& object, IrradianceVolume& volume, std::span<const Emitter> emitters,
                   const ShapedLight& light);
  // For light of `lux` on the caster.
  void addShare(const Object& object, const IrradianceVolume& volume, const SampleLayout& layout,
                const mat3& toFrame, vec3 lux, vec3 nearness, const HeldLight& held,
                const LightFlow& flow = {});
  const HeldLight& onDevice(IrradianceVolume& volume, uint32_t sample);
  void stage(HeldLight& held, const SampleLayout& layout, std::span<const uint32_t> words) const;
  const HeldFlow& staged(const LightFlow& flow);
  const gpu::Program& programFor(const LookUpTraits& traits);

  gpu::Device& device_;
  const IrradianceVolumeSettings settings_;
  Stats& stats_;
  SceneTransport& transport_;
  SceneVolumes volumes_;
  std::map<LookUpTraits, gpu::Program> programs_;  // made when first needed
  gpu::Sampler cellSampler_, moveSampler_;
  CellImages noCells_;  // bound where a share has none
  gpu::Image noMoves_;
  std::map<std::pair<const IrradianceVolume*, uint32_t>, HeldLight> uploaded_;
  // Of the frame being made; those after the ones that are used are left from frames before.
  std::vector<Share> shares_;
  std::deque<HeldFlow> flows_;
  std::deque<HeldLight> resolved_;
  std::size_t usedFlows_ = 0, usedResolved_ = 0;
};

IrradianceVolumes::IrradianceVolumes(const TechniqueContext& context)
    : device_(context.device),
      settings_(context.settings.own.of<IrradianceVolumeSettings>()),
      stats_(context.stats),
      transport_(context.transport),
      volumes_(sceneVolumes(transport_.scene(), context.settings)),
      cellSampler_(gpu::createSampler(device_)),
      moveSampler_(gpu::createSampler(device_, {.filter = VK_FILTER_NEAREST})),
      noMoves_(gpu::createImage(device_, "no irradiance flow", {})) {
  stageCells(device_, noCells_, uvec3(1), 0, std::array<uint32_t, kWordsOfCell>{});
}

const gpu::Program& IrradianceVolumes::programFor(const LookUpTraits& traits) {
  const auto found = programs_.find(traits);
  if (found != programs_.end()) return found->second;
  return programs_
      .emplace(traits,
               gpu::createRasterProgram(device_, "irradiance volume", shaders::techniques_whole_picture_vert,
                                        shaders::techniques_irradiance_volume_volume_frag,
                                        {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
                                        {{"kRepresentation", uint32_t(settings_.representation)},
                                         {"kFlows", traits.flows},
                                         {"kIsTinted", traits.isTinted},
                                         {"kIsNear", traits.isNear}}))
      .first->second;
}

void IrradianceVolumes::stage(HeldLight& held, const SampleLayout& layout,
                              std::span<const uint32_t> words) const {
  const bool isShells = settings_.representation == Representation::shells;
  if (settings_.representation != Representation::multiResolution)
    stageCells(device_, held.cells, layout.size, isShells ? kShellWords / kWordsOfCell : 0, words);
  if (isShells) words = words.first(kShellWords);
  if (isShells || settings_.representation == Representation::multiResolution)
    held.words = gpu::upload(device_, "irradiance volume", std::vector<uint32_t>(words.begin(), words.end()));
}

// Light samples go to the device when they are needed first, and stay there.
const HeldLight& IrradianceVolumes::onDevice(IrradianceVolume& volume, uint32_t sample) {
  const auto [found, isNew] = uploaded_.try_emplace({&volume, sample});
  HeldLight& held = found->second;
  if (!isNew) return held;
  const SampleView& view = volume.sample(sample);
  if (view.layout.words > 0) stage(held, view.layout, view.words);
  if (held.cells.vectors)
    device_.submitAndWait([&](gpu::CommandList& commands) { copyCells(commands, held.cells); });
  held.cells.staged = {};
  return held;
}

const HeldFlow& IrradianceVolumes::staged(const LightFlow& flow) {
  if (usedFlows_ == flows_.size()) flows_.emplace_back();
  HeldFlow& held = flows_[usedFlows_++];
  if (!held.moves || held.moves.width() != flow.side)
    held.moves =
        gpu::createImage(device_, "irradiance flow", {.width = flow.side, .height = flow.side * flow.side});
  std::vector<vec4> moves;
  for (const vec3& move : flow.moves) moves.emplace_back(move, 0);
  gpu::ensureBuffer(device_, held.staged, "irradiance flow", moves.size() * sizeof(vec4),
                    gpu::MemoryKind::upload);
  held.staged.write(moves);
  return held;
}

// As nearScale has it, of lamps at these points taken together.
vec3 nearnessOf(std::span<const Emitter> emitters, vec3 center) {
  if (emitters.empty() || emitters[0].type == kEmitterDirectional) return vec3(0);
  vec3 sum(0);
  for (const Emitter& emitter : emitters) sum += emitter.position - center;
  const vec3 lamp = sum / float(emitters.size());
  return lamp / std::max(dot(lamp, lamp), 1e-20f);
}

void IrradianceVolumes::addShare(const Object& object, const IrradianceVolume& volume,
                                 const SampleLayout& layout, const mat3& toFrame, vec3 lux, vec3 nearness,
                                 const HeldLight& held, const LightFlow& flow) {
  if (layout.words == 0 || lux == vec3(0)) return;
  const Placement& placement = object.placement;
  const vec3 center = placement.point(volume.sphere().center);
  // From the world, meters, to the sample's frame, bounding radii; and on to places.
  const float placesPerMeter = layout.placesPerUnit / (placement.scale * volume.sphere().radius);
  const mat3 turn = toFrame * glm::transpose(glm::mat3_cast(placement.rotation));
  const bool isMirrored = glm::determinant(turn) < 0;
  const quat rotation = std::sqrt(placesPerMeter) * glm::normalize(glm::quat_cast(isMirrored ? -turn : turn));
  Share& share = shares_.emplace_back();
  VolumeConstants& constants = share.constants;
  constants.turn = {rotation.x, rotation.y, rotation.z, rotation.w};
  constants.origin = -(placesPerMeter * (turn * center)) - layout.placesPerUnit * layout.corner;
  constants.center = center;
  constants.inverseRadius = 1 / (placement.scale * volume.regionRadius());
  constants.lux = lux * held.cells.color;
  constants.sizeAcross = layout.size.x | layout.size.y << 16;
  constants.sizeAndFlowSide = layout.size.z | flow.side << 16 | (isMirrored ? kIsMirrored : 0);
  constants.words = held.words ? held.words.address() : 0;
  constants.source = glm::transpose(turn) * layout.source;
  constants.flowOrigin = flow.origin;
  constants.flowScale = flow.scale;
  constants.nearness = nearness;
  share.light = &held;
  if (flow.side > 0) share.flow = &staged(flow);
  share.program = &programFor({flow.side > 0, bool(held.cells.tints), nearness != vec3(0)});
}

void IrradianceVolumes::addShares(const Object& object, IrradianceVolume& volume, const Emitter& emitter,
                                  const ShapedLight& light) {
  const vec3 center = object.placement.point(volume.sphere().center);
  const vec3 lux = illuminance(light, emitter, center), nearness = nearnessOf({&emitter, 1}, center);
  const vec3 inOwnSpace = object.placement.inverseDirection(emitterDirection(emitter, center));
  for (const SampleShare& share : volume.lightSamples().around(inOwnSpace, settings_.lightInterpolation))
    addShare(object, volume, volume.sample(share.sample).layout, volume.toFrame(share), share.weight * lux,
             nearness, onDevice(volume, share.sample), volume.flow(share));
}

void IrradianceVolumes::addResolved(const Object& object, IrradianceVolume& volume,
                                    std::span<const Emitter> emitters, const ShapedLight& light) {
  const vec3 center = object.placement.point(volume.sphere().center);
  const uint32_t order = volume.key().settings.order;
  std::vector<float> coefficients(std::size_t{order + 1} * (order + 1), 0);
  vec3 lux(0);
  float sum = 0;
  for (const Emitter& emitter : emitters) {
    const vec3 part = illuminance(light, emitter, center);
    const float weight = part.x + part.y + part.z;
    const std::vector<float> harmonics =
        sphericalHarmonics(order, object.placement.inverseDirection(emitterDirection(emitter, center)));
    for (std::size_t j = 0; j < coefficients.size(); ++j) coefficients[j] += weight * harmonics[j];
    lux += part;
    sum += weight;
  }
  if (sum <= 0) return;
  for (float& coefficient : coefficients) coefficient /= sum;
  if (usedResolved_ == resolved_.size()) resolved_.emplace_back();
  HeldLight& held = resolved_[usedResolved_++];
  const SampleLayout& layout = volume.sample(0).layout;
  stage(held, layout, volume.resolve(coefficients));
  addShare(object, volume, layout, mat3(1), lux, nearnessOf(emitters, center), held);
}

void IrradianceVolumes::update(GpuScene&) {
  const Scene& now = transport_.scene();
  shares_.clear();
  usedFlows_ = usedResolved_ = 0;
  const std::vector<ShapedLight> lights = shapedLights(now);
  for (uint32_t l = 0; l < lights.size(); ++l) {
    const std::vector<Emitter> emitters = emittersOf(now.lights[l], l);
    for (std::size_t i = 0; i < now.objects.size(); ++i) {
      if (!volumes_.ofObject[i]) continue;
      IrradianceVolume& volume = *volumes_.ofObject[i];
      if (settings_.representation == Representation::harmonics) {
        addResolved(now.objects[i], volume, emitters, lights[l]);
        continue;
      }
      for (const Emitter& emitter : emitters) addShares(now.objects[i], volume, emitter, lights[l]);
    }
  }
  uint64_t bytes = 0;
  const auto add = [&](const HeldLight& held) { bytes += held.words.size() + cellBytes(held.cells); };
  for (const auto& [sample, held] : uploaded_) add(held);
  for (const HeldLight& held : resolved_) add(held);
  setCount(stats_, "lookups", shares_.size());
  setCount(stats_, "light_samples", uploaded_.size());
  setCount(stats_, "volume_bytes", bytes);
}

void IrradianceVolumes::record(gpu::CommandList& commands, GpuScene&) {
  for (std::size_t i = 0; i < usedFlows_; ++i) commands.copy(flows_[i].staged, 0, flows_[i].moves, 0);
  for (std::size_t i = 0; i < usedResolved_; ++i) copyCells(commands, resolved_[i].cells);
}

std::vector<Lattice> IrradianceVolumes::lattices() const {
  std::vector<Lattice> all;
  for (const Share& each : shares_) {
    const VolumeConstants& share = each.constants;
    // Shells have no box of their own: that of the region stands for it.
    const float radius = 1 / share.inverseRadius;
    Lattice lattice{LatticeKind::cells, share.center - radius, {}, uvec3(1)};
    mat3 edges(2 * radius);
    if (settings_.representation != Representation::shells) {
      const float handedness = (share.sizeAndFlowSide & kIsMirrored) != 0 ? -1.0f : 1.0f;
      mat3 linear;
      for (int i = 0; i < 3; ++i) linear[i] = handedness * turned(mat3(1)[i], share.turn);
      const mat3 toWorld = glm::inverse(linear);
      const uvec3 size(share.sizeAcross & 0xffffu, share.sizeAcross >> 16u, share.sizeAndFlowSide & 0xffffu);
      const vec3 places = glm::max(vec3(size), vec3(2)) - 1.0f;
      lattice.corner = toWorld * -share.origin;
      edges = mat3(places.x * toWorld[0], places.y * toWorld[1], places.z * toWorld[2]);
      lattice.cells = uvec3(places);
    }
    lattice.edges = {edges[0], edges[1], edges[2]};
    all.push_back(lattice);
  }
  return all;
}

void IrradianceVolumes::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                              const gpu::Image& causticsLux) {
  drawCaustics(commands, points, causticsLux, [&] {
    for (const Share& share : shares_) {
      const CellImages& cells = share.light->cells.vectors ? share.light->cells : noCells_;
      const gpu::Image& tints = cells.tints ? cells.tints : cells.vectors;  // any, where they are not read
      commands.draw(*share.program, 3, 1, share.constants,
                    {{"receiverPosition", *points.position},
                     {"receiverNormal", *points.normal},
                     {"cellVectors", cells.vectors, cellSampler_},
                     {"cellTints", tints, cellSampler_},
                     {"flowMoves", share.flow ? share.flow->moves : noMoves_, moveSampler_}});
    }
  });
}

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  return std::make_unique<IrradianceVolumes>(context);
}

constexpr Setting kSettings[] = {
    choiceSetting<&IrradianceVolumeSettings::representation>(
        "representation",
        "How an irradiance volume is stored: on an even grid, on concentric shells placed where the light "
        "changes, on a grid whose bricks are as fine as the light needs, or as spherical harmonics over "
        "light "
        "directions",
        true),
    choiceSetting<&IrradianceVolumeSettings::lightInterpolation>(
        "light-interpolation",
        "Interpolation between the light directions of a volume. nearest: the nearest one; barycentric: the "
        "weighted mean of three; rotated: the three turned to the light; flow: turned, and then moved as the "
        "caster moves its light"),
    wholeSetting<&IrradianceVolumeSettings::kilobytes>(
        "volume-kilobytes", 1, 65535, "Kilobytes of a volume for each light direction", true),
    wholeSetting<&IrradianceVolumeSettings::lightLevel>(
        "light-level", 0, kMostLightLevels,
        "How many times the icosahedron of light directions is subdivided: N times give 10 * 4^N + 2 "
        "directions, fewer for symmetric casters",
        true),
    wholeSetting<&IrradianceVolumeSettings::radius>(
        "volume-radius", 2, 64,
        "The radius of a volume, in radii of its caster's bounding sphere; beyond it, light continues in the "
        "direction in which it left",
        true),
    wholeSetting<&IrradianceVolumeSettings::photons>("volume-photons", 1, 100000,
                                                     "Thousands of photons for each light direction", true),
    wholeSetting<&IrradianceVolumeSettings::harmonicOrder>("harmonic-order", 1, kMostHarmonicOrder,
                                                           "Order of the spherical harmonics", true),
    wholeSetting<&IrradianceVolumeSettings::error>(
        "volume-error", 0, 1000,
        "The error, in thousandths of the light on a caster, that bricks of a multi-resolution volume may "
        "have against the finest grid, whose size is --volume-kilobytes",
        true),
};
constexpr SettingsOwner kOwners[] = {settingsOwner<IrradianceVolumeSettings>("irradiance-volume", kSettings)};

constexpr Omission kOmissions[] = {
    {"Light beyond --volume-radius bounding radii of a caster's center, and what fades toward there",
     hasCaster},
    {"Shadows in caustics: what stands between a caster and a receiver hides nothing of its light",
     hasCaster},
    {"Light from one caster through another, and light that other objects keep from a caster", hasCaster},
    {"How near a light stands: it falls on a caster as it does on the caster's center, from one direction",
     hasNearLight},
    {"Reflection at glass, outside, inside and total, unless --paths all asks for it", hasGlass},
    omissions::kSpectrum,
    omissions::kSizeOfLamps,
    {"Water and sheets without a volume, which cast no caustics here", hasWaterOrSheet},
    {"Detail finer than a cell of the volume, and between the light directions it was made for", hasCaster},
    omissions::kScattering,
};

void prepare(const Scene& scene, SceneTransport&, const TechniqueSettings& settings, Progress& progress) {
  keepLightSamples(scene, settings, progress);
}

bool isMadeAlike(const Material& a, const Material& b) {
  return a.ior == b.ior && a.color == b.color && a.attenuationColor == b.attenuationColor &&
         a.attenuationDistance == b.attenuationDistance && a.scattering == b.scattering;
}

bool isStillPrepared(const PreparedParts& before, const PreparedParts& after, const TechniqueSettings&) {
  if (!std::ranges::equal(before.materials, after.materials, isMadeAlike)) return false;
  const bool isTinted = std::ranges::any_of(
      after.materials, [](const Material& material) { return extinctionOf(material) != vec3(0); });
  // What absorbs over a meter does so over less where the caster is scaled down.
  return !isTinted ||
         std::ranges::equal(before.placements, after.placements, {}, &Placement::scale, &Placement::scale);
}

void bake(const Scene& scene, const TechniqueSettings& settings, const BakeRequest& request,
          Progress& progress) {
  const SceneVolumes all = sceneVolumes(scene, settings);
  std::vector<IrradianceVolume*> volumes;
  for (const auto& volume : all.volumes) volumes.push_back(volume.get());
  if (volumes.empty())
    throw InputError("'" + request.scene.string() +
                     "' has no caster, so there is nothing to bake; give an object a material of type "
                     "'dielectric' or 'mirror'");
  writeVolumes(volumes, {request.first, request.end}, request.output, progress);
}

}  // namespace

extern const TechniqueInfo kIrradianceVolume;
constinit const TechniqueInfo kIrradianceVolume{
    .name = "irradiance-volume",
    .summary = "Light around each caster, traced beforehand and looked up (paper 3)",
    .make = make,
    .traits = kTraits,
    .settings = kOwners,
    .omissions = kOmissions,
    .prepare = prepare,
    .isStillPrepared = isStillPrepared,
    .bake = {"irradiance volumes", bake, mergeVolumes},
};

}  // namespace nephroid

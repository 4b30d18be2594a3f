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

  gpu::Device& device;
  const IrradianceVolumeSettings settings;
  Stats& stats;
  SceneTransport& transport;
  SceneVolumes volumes;
  std::map<LookUpTraits, gpu::Program> programs;  // made when first needed
  gpu::Sampler cellSampler, moveSampler;
  CellImages noCells;  // bound where a share has none
  gpu::Image noMoves;
  std::map<std::pair<const IrradianceVolume*, uint32_t>, HeldLight> uploaded;
  // Of the frame being made; those after the ones that are used are left from frames before.
  std::vector<Share> shares;
  std::deque<HeldFlow> flows;
  std::deque<HeldLight> resolved;
  std::size_t usedFlows = 0, usedResolved = 0;
};

IrradianceVolumes::IrradianceVolumes(const TechniqueContext& context)
    : device(context.device),
      settings(context.settings.own.of<IrradianceVolumeSettings>()),
      stats(context.stats),
      transport(context.transport),
      volumes(sceneVolumes(transport.scene(), context.settings)),
      cellSampler(gpu::createSampler(device)),
      moveSampler(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST})),
      noMoves(gpu::createImage(device, "no irradiance flow", {})) {
  stageCells(device, noCells, uvec3(1), 0, std::array<uint32_t, kWordsOfCell>{});
}

const gpu::Program& IrradianceVolumes::programFor(const LookUpTraits& traits) {
  const auto found = programs.find(traits);
  if (found != programs.end()) return found->second;
  return programs
      .emplace(traits,
               gpu::createRasterProgram(device, "irradiance volume", shaders::techniques_whole_picture_vert,
                                        shaders::techniques_irradiance_volume_volume_frag,
                                        {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
                                        {{"kRepresentation", uint32_t(settings.representation)},
                                         {"kFlows", traits.flows},
                                         {"kIsTinted", traits.isTinted},
                                         {"kIsNear", traits.isNear}}))
      .first->second;
}

void IrradianceVolumes::stage(HeldLight& held, const SampleLayout& layout,
                              std::span<const uint32_t> words) const {
  const bool isShells = settings.representation == Representation::shells;
  if (settings.representation != Representation::multiResolution)
    stageCells(device, held.cells, layout.size, isShells ? kShellWords / kWordsOfCell : 0, words);
  if (isShells) words = words.first(kShellWords);
  if (isShells || settings.representation == Representation::multiResolution)
    held.words = gpu::upload(device, "irradiance volume", std::vector<uint32_t>(words.begin(), words.end()));
}

// Light samples go to the device when they are needed first, and stay there.
const HeldLight& IrradianceVolumes::onDevice(IrradianceVolume& volume, uint32_t sample) {
  const auto [found, isNew] = uploaded.try_emplace({&volume, sample});
  HeldLight& held = found->second;
  if (!isNew) return held;
  const SampleView& view = volume.sample(sample);
  if (view.layout.words > 0) stage(held, view.layout, view.words);
  if (held.cells.vectors)
    device.submitAndWait([&](gpu::CommandList& commands) { copyCells(commands, held.cells); });
  held.cells.staged = {};
  return held;
}

const HeldFlow& IrradianceVolumes::staged(const LightFlow& flow) {
  if (usedFlows == flows.size()) flows.emplace_back();
  HeldFlow& held = flows[usedFlows++];
  if (!held.moves || held.moves.width() != flow.side)
    held.moves =
        gpu::createImage(device, "irradiance flow", {.width = flow.side, .height = flow.side * flow.side});
  std::vector<vec4> moves;
  for (const vec3& move : flow.moves) moves.emplace_back(move, 0);
  gpu::ensureBuffer(device, held.staged, "irradiance flow", moves.size() * sizeof(vec4),
                    gpu::MemoryKind::upload);
  held.staged.write(moves);
  return held;
}

// As nearScale has it, of lamps at these points taken together.
vec3 nearnessOf(std::span<const Emitter> emitters, vec3 centre) {
  if (emitters.empty() || emitters[0].type == kEmitterDirectional) return vec3(0);
  vec3 sum(0);
  for (const Emitter& emitter : emitters) sum += emitter.position - centre;
  const vec3 lamp = sum / float(emitters.size());
  return lamp / std::max(dot(lamp, lamp), 1e-20f);
}

void IrradianceVolumes::addShare(const Object& object, const IrradianceVolume& volume,
                                 const SampleLayout& layout, const mat3& toFrame, vec3 lux, vec3 nearness,
                                 const HeldLight& held, const LightFlow& flow) {
  if (layout.words == 0 || lux == vec3(0)) return;
  const Placement& placement = object.placement;
  const vec3 centre = placement.point(volume.sphere().center);
  // From the world, metres, to the sample's frame, bounding radii; and on to places.
  const float placesPerMetre = layout.placesPerUnit / (placement.scale * volume.sphere().radius);
  const mat3 turn = toFrame * glm::transpose(glm::mat3_cast(placement.rotation));
  const bool isMirrored = glm::determinant(turn) < 0;
  const quat rotation = std::sqrt(placesPerMetre) * glm::normalize(glm::quat_cast(isMirrored ? -turn : turn));
  Share& share = shares.emplace_back();
  VolumeConstants& constants = share.constants;
  constants.turn = {rotation.x, rotation.y, rotation.z, rotation.w};
  constants.origin = -(placesPerMetre * (turn * centre)) - layout.placesPerUnit * layout.corner;
  constants.centre = centre;
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
  const vec3 centre = object.placement.point(volume.sphere().center);
  const vec3 lux = illuminance(light, emitter, centre), nearness = nearnessOf({&emitter, 1}, centre);
  const vec3 inOwnSpace = object.placement.inverseDirection(emitterDirection(emitter, centre));
  for (const SampleShare& share : volume.lightSamples().around(inOwnSpace, settings.lightInterpolation))
    addShare(object, volume, volume.sample(share.sample).layout, volume.toFrame(share), share.weight * lux,
             nearness, onDevice(volume, share.sample), volume.flow(share));
}

void IrradianceVolumes::addResolved(const Object& object, IrradianceVolume& volume,
                                    std::span<const Emitter> emitters, const ShapedLight& light) {
  const vec3 centre = object.placement.point(volume.sphere().center);
  const uint32_t order = volume.key().settings.order;
  std::vector<float> coefficients(std::size_t{order + 1} * (order + 1), 0);
  vec3 lux(0);
  float sum = 0;
  for (const Emitter& emitter : emitters) {
    const vec3 part = illuminance(light, emitter, centre);
    const float weight = part.x + part.y + part.z;
    const std::vector<float> harmonics =
        sphericalHarmonics(order, object.placement.inverseDirection(emitterDirection(emitter, centre)));
    for (std::size_t j = 0; j < coefficients.size(); ++j) coefficients[j] += weight * harmonics[j];
    lux += part;
    sum += weight;
  }
  if (sum <= 0) return;
  for (float& coefficient : coefficients) coefficient /= sum;
  if (usedResolved == resolved.size()) resolved.emplace_back();
  HeldLight& held = resolved[usedResolved++];
  const SampleLayout& layout = volume.sample(0).layout;
  stage(held, layout, volume.resolve(coefficients));
  addShare(object, volume, layout, mat3(1), lux, nearnessOf(emitters, centre), held);
}

void IrradianceVolumes::update(GpuScene&) {
  const Scene& now = transport.scene();
  shares.clear();
  usedFlows = usedResolved = 0;
  const std::vector<ShapedLight> lights = shapedLights(now);
  for (uint32_t l = 0; l < lights.size(); ++l) {
    const std::vector<Emitter> emitters = emittersOf(now.lights[l], l);
    for (std::size_t i = 0; i < now.objects.size(); ++i) {
      if (!volumes.ofObject[i]) continue;
      IrradianceVolume& volume = *volumes.ofObject[i];
      if (settings.representation == Representation::harmonics) {
        addResolved(now.objects[i], volume, emitters, lights[l]);
        continue;
      }
      for (const Emitter& emitter : emitters) addShares(now.objects[i], volume, emitter, lights[l]);
    }
  }
  uint64_t bytes = 0;
  const auto add = [&](const HeldLight& held) { bytes += held.words.size() + cellBytes(held.cells); };
  for (const auto& [sample, held] : uploaded) add(held);
  for (const HeldLight& held : resolved) add(held);
  setCount(stats, "lookups", shares.size());
  setCount(stats, "light_samples", uploaded.size());
  setCount(stats, "volume_bytes", bytes);
}

void IrradianceVolumes::record(gpu::CommandList& commands, GpuScene&) {
  for (std::size_t i = 0; i < usedFlows; ++i) commands.copy(flows[i].staged, 0, flows[i].moves, 0);
  for (std::size_t i = 0; i < usedResolved; ++i) copyCells(commands, resolved[i].cells);
}

std::vector<Lattice> IrradianceVolumes::lattices() const {
  std::vector<Lattice> all;
  for (const Share& each : shares) {
    const VolumeConstants& share = each.constants;
    // Shells have no box of their own: that of the region stands for it.
    const float radius = 1 / share.inverseRadius;
    Lattice lattice{LatticeKind::cells, share.centre - radius, {}, uvec3(1)};
    mat3 edges(2 * radius);
    if (settings.representation != Representation::shells) {
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
    for (const Share& share : shares) {
      const CellImages& cells = share.light->cells.vectors ? share.light->cells : noCells;
      const gpu::Image& tints = cells.tints ? cells.tints : cells.vectors;  // any, where they are not read
      commands.draw(*share.program, 3, 1, share.constants,
                    {{"receiverPosition", *points.position},
                     {"receiverNormal", *points.normal},
                     {"cellVectors", cells.vectors, cellSampler},
                     {"cellTints", tints, cellSampler},
                     {"flowMoves", share.flow ? share.flow->moves : noMoves, moveSampler}});
    }
  });
}

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  return std::make_unique<IrradianceVolumes>(context);
}

constexpr Setting kSettings[] = {
    choiceSetting<&IrradianceVolumeSettings::representation>(
        "representation",
        "How an irradiance volume is kept: on an even grid, on concentric shells placed where the light "
        "changes, on a grid whose bricks are as fine as the light needs, or as spherical harmonics over "
        "light "
        "directions",
        true),
    choiceSetting<&IrradianceVolumeSettings::lightInterpolation>(
        "light-interpolation",
        "Between the light directions of a volume: the nearest, the three around by their weights, these "
        "turned "
        "to the light, or moved on from there as the caster moves light"),
    wholeSetting<&IrradianceVolumeSettings::kilobytes>(
        "volume-kilobytes", 1, 65535, "Kilobytes of a volume for each light direction", true),
    wholeSetting<&IrradianceVolumeSettings::lightLevel>(
        "light-level", 0, kMostLightLevels,
        "How often the icosahedron of light directions is cut finer: 10 * 4^N + 2 directions, fewer for "
        "symmetric casters",
        true),
    wholeSetting<&IrradianceVolumeSettings::radius>(
        "volume-radius", 2, 64,
        "Where a volume ends, in radii of its caster's bounding sphere; beyond, light goes on as it left",
        true),
    wholeSetting<&IrradianceVolumeSettings::photons>("volume-photons", 1, 100000,
                                                     "Thousands of photons for each light direction", true),
    wholeSetting<&IrradianceVolumeSettings::harmonicOrder>("harmonic-order", 1, kMostHarmonicOrder,
                                                           "Order of the spherical harmonics", true),
    wholeSetting<&IrradianceVolumeSettings::error>("volume-error", 0, 1000,
                                                   "How far, in thousandths of the light on a caster, the "
                                                   "bricks of a multi-resolution volume may be off "
                                                   "the finest grid, whose size --volume-kilobytes gives",
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

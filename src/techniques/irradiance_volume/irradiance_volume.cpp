#include "techniques/irradiance_volume/irradiance_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <tuple>

#include "core/cache_folder.h"
#include "gpu/program.h"
#include "gpu/transfer.h"
#include "irradiance_volume/harmonics.h"
#include "irradiance_volume/volume_file.h"
#include "lights/light_intensity.h"
#include "shaders/techniques/irradiance_volume/volume_frag.h"
#include "shaders/techniques/whole_picture_vert.h"
#include "techniques/irradiance_volume/cell_images.h"
#include "techniques/irradiance_volume/shader_data.h"

namespace nephroid {
namespace {

// Water has no region of its own, and a sheet too thin to bend light no caustic.
bool hasVolume(const Scene& scene, const Object& object) {
  const Material& material = scene.materialOf(object);
  return material.isCaster() && !material.thinWalled && !object.water;
}

VolumeSettings volumeSettings(const TechniqueSettings& settings) {
  VolumeSettings volume;
  volume.representation = uint32_t(settings.representation);
  volume.kilobytes = settings.volumeKilobytes;
  volume.lightLevel = settings.lightLevel;
  volume.radius = settings.volumeRadius;
  volume.photons = settings.volumePhotons;
  if (settings.representation == Representation::harmonics) volume.order = settings.harmonicOrder;
  if (settings.representation == Representation::multiResolution) volume.error = settings.volumeError;
  volume.paths = uint32_t(settings.paths);
  return volume;
}

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

class IrradianceVolumes final : public Technique {
 public:
  explicit IrradianceVolumes(const TechniqueContext& context);

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
  const TechniqueSettings settings;
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
      settings(context.settings),
      stats(context.stats),
      transport(context.transport),
      volumes(sceneVolumes(transport.scene(), settings)),
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
  stats.counts = {{"lookups", shares.size()}, {"light_samples", uploaded.size()}, {"volume_bytes", bytes}};
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

}  // namespace

SceneVolumes sceneVolumes(const Scene& scene, const TechniqueSettings& settings) {
  const VolumeSettings wanted = volumeSettings(settings);
  SceneVolumes all;
  std::vector<VolumeKey> keys;
  std::vector<std::size_t> owners;  // an object of each key
  std::vector<std::size_t> keyOfObject(scene.objects.size(), kNone);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!hasVolume(scene, object)) continue;
    const Material material = materialInOwnSpace(scene.materialOf(object), object.placement.scale);
    const VolumeKey key = volumeKey(scene.meshOf(object), material, wanted);
    keyOfObject[i] = std::size_t(std::ranges::find(keys, key) - keys.begin());
    if (keyOfObject[i] < keys.size()) continue;
    keys.push_back(key);
    owners.push_back(i);
  }
  std::vector<StoredVolume> stored;
  if (!settings.baked.empty()) stored = openVolumes(settings.baked, keys);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Object& owner = scene.objects[owners[i]];
    const Mesh& mesh = scene.meshOf(owner);
    all.volumes.push_back(settings.baked.empty()
                              ? std::make_unique<IrradianceVolume>(
                                    mesh, materialInOwnSpace(scene.materialOf(owner), owner.placement.scale),
                                    wanted, cacheFolder())
                              : std::make_unique<IrradianceVolume>(mesh, std::move(stored[i])));
  }
  all.ofObject.resize(scene.objects.size(), nullptr);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (keyOfObject[i] != kNone) all.ofObject[i] = all.volumes[keyOfObject[i]].get();
  return all;
}

void keepLightSamples(const Scene& scene, const TechniqueSettings& settings, Progress& progress) {
  const SceneVolumes volumes = sceneVolumes(scene, settings);
  std::set<std::pair<IrradianceVolume*, uint32_t>> samples;
  for (uint32_t l = 0; l < scene.lights.size(); ++l)
    for (const Emitter& emitter : emittersOf(scene.lights[l], l))
      for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        IrradianceVolume* volume = volumes.ofObject[i];
        if (!volume) continue;
        const Placement& placement = scene.objects[i].placement;
        const vec3 direction = emitterDirection(emitter, placement.point(volume->sphere().center));
        if (settings.representation == Representation::harmonics)
          samples.emplace(volume, 0);
        else
          for (const SampleShare& share : volume->lightSamples().around(placement.inverseDirection(direction),
                                                                        settings.lightInterpolation))
            samples.emplace(volume, share.sample);
      }
  progress.begin("Irradiance volumes", samples.size());
  for (const auto& [volume, sample] : samples) {
    volume->makeSample(sample);
    progress.advance();
  }
}

std::unique_ptr<Technique> makeIrradianceVolumes(const TechniqueContext& context) {
  return std::make_unique<IrradianceVolumes>(context);
}

}  // namespace nephroid

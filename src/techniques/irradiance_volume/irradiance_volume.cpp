#include "techniques/irradiance_volume/irradiance_volume.h"

#include <algorithm>
#include <map>

#include "core/cache_folder.h"
#include "gpu/program.h"
#include "gpu/transfer.h"
#include "irradiance_volume/volume_file.h"
#include "scene/light_intensity.h"
#include "shaders/volume_frag.h"
#include "shaders/whole_picture_vert.h"
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
  volume.paths = uint32_t(settings.paths);
  return volume;
}

mat3 linearPart(const Placement& placement) {
  return glm::mat3_cast(placement.rotation) * placement.scale;
}

class IrradianceVolumes final : public Technique {
 public:
  explicit IrradianceVolumes(const TechniqueContext& context);

  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList&, GpuScene&) override {}
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;

 private:
  // For light of `lux` on the caster, that travels along the unit vector `direction`.
  void addShares(const Object& object, IrradianceVolume& volume, vec3 direction, vec3 lux);
  VkDeviceAddress onDevice(IrradianceVolume& volume, uint32_t sample);

  gpu::Device& device;
  const TechniqueSettings settings;
  Stats& stats;
  SceneTransport& transport;
  SceneVolumes volumes;
  gpu::Program program;
  std::map<std::pair<const IrradianceVolume*, uint32_t>, gpu::Buffer> uploaded;
  std::vector<VolumeConstants> shares;  // of the frame being made
};

IrradianceVolumes::IrradianceVolumes(const TechniqueContext& context)
    : device(context.device),
      settings(context.settings),
      stats(context.stats),
      transport(context.transport),
      volumes(sceneVolumes(transport.scene(), settings)),
      program(gpu::createRasterProgram(device, "irradiance volume", shaders::whole_picture_vert,
                                       shaders::volume_frag,
                                       {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
                                       {{0, uint32_t(settings.representation)}})) {}

// Light samples go to the device when they are needed first, and stay there.
VkDeviceAddress IrradianceVolumes::onDevice(IrradianceVolume& volume, uint32_t sample) {
  gpu::Buffer& buffer = uploaded[{&volume, sample}];
  if (!buffer) {
    const std::span<const uint32_t> words = volume.sample(sample).words;
    buffer = gpu::upload(device, "irradiance volume", std::vector<uint32_t>(words.begin(), words.end()));
  }
  return buffer.address();
}

void IrradianceVolumes::addShares(const Object& object, IrradianceVolume& volume, vec3 direction, vec3 lux) {
  const Placement& placement = object.placement;
  const vec3 centre = placement.point(volume.sphere().centre);
  const float radius = volume.sphere().radius * placement.scale;
  const vec3 inOwnSpace = placement.inverseDirection(direction);
  for (const SampleShare& share : volume.lightSamples().around(inOwnSpace, settings.lightInterpolation)) {
    const SampleView& sample = volume.sample(share.sample);
    const mat3 frame = sampleFrame(volume.lightSamples().directions()[share.sample]);
    // From the world, metres, to the sample's frame, bounding radii.
    const mat3 turned = glm::transpose(frame) * share.toSample * glm::transpose(linearPart(placement)) /
                        (placement.scale * radius);
    const mat3 linear = sample.layout.placesPerUnit * turned;
    const vec3 offset = -(linear * centre) - sample.layout.placesPerUnit * sample.layout.corner;
    VolumeConstants constants{};
    for (int row = 0; row < 3; ++row)
      constants.toPlaces[row] = vec4(linear[0][row], linear[1][row], linear[2][row], offset[row]);
    constants.centre = centre;
    constants.inverseRadius = 1 / (placement.scale * volume.regionRadius());
    constants.lux = share.weight * lux;
    constants.size = sample.layout.size;
    constants.words = onDevice(volume, share.sample);
    if (sample.layout.words > 0 && constants.lux != vec3(0)) shares.push_back(constants);
  }
}

void IrradianceVolumes::update(GpuScene&) {
  const Scene& now = transport.scene();
  shares.clear();
  const std::vector<ShapedLight> lights = shapedLights(now);
  for (const Emitter& emitter : emittersOf(now))
    for (std::size_t i = 0; i < now.objects.size(); ++i) {
      if (!volumes.ofObject[i]) continue;
      const vec3 centre = now.objects[i].placement.point(volumes.ofObject[i]->sphere().centre);
      addShares(now.objects[i], *volumes.ofObject[i], emitterDirection(emitter, centre),
                illuminance(lights[emitter.light], emitter, centre));
    }
  uint64_t bytes = 0;
  for (const auto& [sample, buffer] : uploaded) bytes += buffer.size();
  stats.counts = {{"lookups", shares.size()}, {"light_samples", uploaded.size()}, {"volume_bytes", bytes}};
}

void IrradianceVolumes::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                              const gpu::Image& causticsLux) {
  const bool isAll = points.region.size.x == 0 || points.region.size.y == 0;
  commands.pass("caustics", [&] {
    commands.render({.colors = {{&causticsLux, 0, std::nullopt}},
                     .region = isAll ? std::nullopt : std::optional(points.region)},
                    [&] {
                      for (const VolumeConstants& share : shares)
                        commands.draw(program, 3, 1, share, {*points.position, *points.normal});
                    });
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

std::unique_ptr<Technique> makeIrradianceVolumes(const TechniqueContext& context) {
  return std::make_unique<IrradianceVolumes>(context);
}

}  // namespace nephroid

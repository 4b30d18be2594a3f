#include "techniques/irradiance_volume/irradiance_volume.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include "core/cache_folder.h"
#include "gpu/program.h"
#include "gpu/transfer.h"
#include "irradiance_volume/harmonics.h"
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
  if (settings.representation == Representation::harmonics) volume.order = settings.harmonicOrder;
  if (settings.representation == Representation::multiResolution) volume.error = settings.volumeError;
  volume.paths = uint32_t(settings.paths);
  return volume;
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
  // The same for all points of one light at once.
  void addResolved(const Object& object, IrradianceVolume& volume, std::span<const Emitter> emitters,
                   const ShapedLight& light);
  void addShare(const Object& object, const IrradianceVolume& volume, const SampleLayout& layout,
                const mat3& toFrame, vec3 lux, VkDeviceAddress words, const LightFlow& flow = {});
  // Filled, and kept until the next frame is made.
  template <class T>
  const gpu::Buffer& addBuffer(const char* name, const std::vector<T>& values);
  VkDeviceAddress onDevice(IrradianceVolume& volume, uint32_t sample);

  gpu::Device& device;
  const TechniqueSettings settings;
  Stats& stats;
  SceneTransport& transport;
  SceneVolumes volumes;
  gpu::Program program;
  std::map<std::pair<const IrradianceVolume*, uint32_t>, gpu::Buffer> uploaded;
  // Of the frame being made.
  std::vector<VolumeConstants> shares;
  std::deque<gpu::Buffer> ofFrame;
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

void IrradianceVolumes::addShare(const Object& object, const IrradianceVolume& volume,
                                 const SampleLayout& layout, const mat3& toFrame, vec3 lux,
                                 VkDeviceAddress words, const LightFlow& flow) {
  if (layout.words == 0 || lux == vec3(0)) return;
  const Placement& placement = object.placement;
  const vec3 centre = placement.point(volume.sphere().centre);
  // From the world, metres, to the sample's frame, bounding radii; and on to places.
  const float placesPerMetre = layout.placesPerUnit / (placement.scale * volume.sphere().radius);
  const mat3 turn = toFrame * glm::transpose(glm::mat3_cast(placement.rotation));
  const mat3 linear = placesPerMetre * turn;
  const vec3 offset = -(linear * centre) - layout.placesPerUnit * layout.corner;
  VolumeConstants constants{};
  for (int row = 0; row < 3; ++row)
    constants.toPlaces[row] = vec4(linear[0][row], linear[1][row], linear[2][row], offset[row]);
  constants.centre = centre;
  constants.inverseRadius = 1 / (placement.scale * volume.regionRadius());
  constants.lux = lux;
  constants.size = layout.size;
  constants.words = words;
  constants.source = glm::transpose(turn) * layout.source;
  constants.flowSide = flow.side;
  std::vector<vec3> values{flow.origin, flow.scale};
  values.insert(values.end(), flow.moves.begin(), flow.moves.end());
  constants.flow = addBuffer("irradiance flow", values).address();
  shares.push_back(constants);
}

void IrradianceVolumes::addShares(const Object& object, IrradianceVolume& volume, vec3 direction, vec3 lux) {
  const vec3 inOwnSpace = object.placement.inverseDirection(direction);
  for (const SampleShare& share : volume.lightSamples().around(inOwnSpace, settings.lightInterpolation))
    addShare(object, volume, volume.sample(share.sample).layout, volume.toFrame(share), share.weight * lux,
             onDevice(volume, share.sample), volume.flow(share));
}

void IrradianceVolumes::addResolved(const Object& object, IrradianceVolume& volume,
                                    std::span<const Emitter> emitters, const ShapedLight& light) {
  const vec3 centre = object.placement.point(volume.sphere().centre);
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
  const std::vector<uint32_t> words = volume.resolve(coefficients);
  const gpu::Buffer& buffer = addBuffer("resolved irradiance volume", words);
  addShare(object, volume, volume.sample(0).layout, mat3(1), lux, buffer.address());
}

template <class T>
const gpu::Buffer& IrradianceVolumes::addBuffer(const char* name, const std::vector<T>& values) {
  gpu::Buffer buffer = gpu::createBuffer(device, name, values.size() * sizeof(T), gpu::MemoryKind::upload);
  buffer.write(values);
  return ofFrame.emplace_back(std::move(buffer));
}

void IrradianceVolumes::update(GpuScene&) {
  const Scene& now = transport.scene();
  shares.clear();
  ofFrame.clear();
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
      const vec3 centre = now.objects[i].placement.point(volume.sphere().centre);
      for (const Emitter& emitter : emitters)
        addShares(now.objects[i], volume, emitterDirection(emitter, centre),
                  illuminance(lights[l], emitter, centre));
    }
  }
  uint64_t bytes = 0;
  for (const auto& [sample, buffer] : uploaded) bytes += buffer.size();
  for (const gpu::Buffer& buffer : ofFrame) bytes += buffer.size();
  stats.counts = {{"lookups", shares.size()}, {"light_samples", uploaded.size()}, {"volume_bytes", bytes}};
}

void IrradianceVolumes::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                              const gpu::Image& causticsLux) {
  drawCaustics(commands, points, causticsLux, [&] {
    for (const VolumeConstants& share : shares)
      commands.draw(program, 3, 1, share, {*points.position, *points.normal});
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
        const vec3 direction = emitterDirection(emitter, placement.point(volume->sphere().centre));
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

#include "techniques/irradiance_volume/scene_volumes.h"

#include <algorithm>
#include <set>

#include "core/cache_folder.h"
#include "irradiance_volume/volume_file.h"
#include "lights/emitters.h"

namespace nephroid {
namespace {

// Water has no region of its own, and a sheet too thin to bend light no caustic.
bool hasVolume(const Scene& scene, const Object& object) {
  const Material& material = scene.materialOf(object);
  return material.isCaster() && !material.thinWalled && !object.water;
}

VolumeSettings volumeSettings(const TechniqueSettings& all) {
  const auto& settings = all.own.of<IrradianceVolumeSettings>();
  VolumeSettings volume;
  volume.representation = uint32_t(settings.representation);
  volume.kilobytes = settings.kilobytes;
  volume.lightLevel = settings.lightLevel;
  volume.radius = settings.radius;
  volume.photons = settings.photons;
  if (settings.representation == Representation::harmonics) volume.order = settings.harmonicOrder;
  if (settings.representation == Representation::multiResolution) volume.error = settings.error;
  volume.paths = uint32_t(all.transport.paths);
  return volume;
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

void keepLightSamples(const Scene& scene, const TechniqueSettings& all, Progress& progress) {
  const auto& settings = all.own.of<IrradianceVolumeSettings>();
  const SceneVolumes volumes = sceneVolumes(scene, all);
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

}  // namespace nephroid

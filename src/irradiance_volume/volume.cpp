#include "irradiance_volume/volume.h"

#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "irradiance_volume/grid.h"
#include "irradiance_volume/shells.h"
#include "irradiance_volume/volume_file.h"
#include "transport/table/table.h"

namespace nephroid {
namespace {

void addVector(Hasher& hasher, vec3 v) {
  for (int i = 0; i < 3; ++i) hasher.add(v[i]);
}

uint64_t hashOf(const Material& material) {
  Hasher hasher;
  hasher.add(uint32_t(material.type));
  hasher.add(uint32_t{material.thinWalled});
  if (material.type == MaterialType::mirror || material.thinWalled) addVector(hasher, material.color);
  if (material.type == MaterialType::mirror) return hasher.value();
  addVector(hasher, material.ior);
  hasher.add(material.inverseAttenuationDistance());
  if (material.inverseAttenuationDistance() > 0) addVector(hasher, material.attenuationColor);
  return hasher.value();
}

VolumeSample represent(std::span<const PhotonPath> paths, const VolumeSettings& settings) {
  const std::size_t bytes = std::size_t{1000} * settings.kilobytes;
  if (settings.representation == kRepresentationShells)
    return shellSample(paths, float(settings.radius), bytes);
  return gridSample(paths, bytes);
}

SampleView viewOf(VolumeSample sample) {
  const auto owner = std::make_shared<const VolumeSample>(std::move(sample));
  return {owner->layout, owner->words, owner};
}

}  // namespace

Material materialInOwnSpace(const Material& material, float scale) {
  Material scaled = material;
  scaled.attenuationDistance /= scale;
  return scaled;
}

VolumeKey volumeKey(const Mesh& mesh, const Material& inOwnSpace, const VolumeSettings& settings) {
  return {geometryHash(mesh), hashOf(inOwnSpace), settings};
}

IrradianceVolume::IrradianceVolume(const Mesh& mesh, const Material& inOwnSpace,
                                   const VolumeSettings& settings, std::filesystem::path cacheFolder)
    : key_(volumeKey(mesh, inOwnSpace, settings)),
      material_(inOwnSpace),
      tracer_(std::make_unique<PhotonTracer>(mesh, *material_, Paths(settings.paths))),
      symmetry_(tracer_->symmetry()),
      sphere_(tracer_->sphere()),
      lightSamples_(symmetry_, settings.lightLevel),
      cacheFolder_(std::move(cacheFolder)),
      samples_(lightSamples_.directions().size()) {}

IrradianceVolume::IrradianceVolume(const Mesh& mesh, StoredVolume stored)
    : key_(stored.key),
      symmetry_(stored.symmetry),
      sphere_(boundingSphere(mesh)),
      lightSamples_(symmetry_, key_.settings.lightLevel),
      samples_(lightSamples_.directions().size()) {
  for (std::size_t i = 0; i < stored.samples.size(); ++i)
    samples_[stored.firstSample + i] = std::move(stored.samples[i]);
}

SampleView IrradianceVolume::makeSample(uint32_t index) const {
  if (samples_[index]) return *samples_[index];
  if (!tracer_)
    throw InputError("the irradiance volume holds no light sample " + std::to_string(index) + " of " +
                     std::to_string(samples_.size()) +
                     ": it is a part; bake the other light samples and merge them with --merge");
  if (std::optional<SampleView> cached = cachedSample(cacheFolder_, key_, symmetry_, index)) return *cached;
  const std::vector<PhotonPath> paths = tracer_->trace(
      lightSamples_.directions()[index], 1000 * key_.settings.photons, float(key_.settings.radius));
  SampleView traced = viewOf(represent(paths, key_.settings));
  keepSample(cacheFolder_, {key_, symmetry_, index, {traced}});
  return traced;
}

const SampleView& IrradianceVolume::sample(uint32_t index) {
  if (!samples_[index]) samples_[index] = makeSample(index);
  return *samples_[index];
}

vec3 IrradianceVolume::illuminance(vec3 point, vec3 normal, vec3 direction,
                                   LightInterpolation interpolation) {
  const vec3 place = (point - sphere_.centre) / sphere_.radius;
  const float fade = fadeAt(length(place) / float(key_.settings.radius));
  vec3 sum(0);
  for (const SampleShare& share : lightSamples_.around(direction, interpolation)) {
    const mat3 toFrame =
        glm::transpose(sampleFrame(lightSamples_.directions()[share.sample])) * share.toSample;
    const SampleView& view = sample(share.sample);
    const VolumeLight light = lightAt(view.layout, view.words, key_.settings.representation, toFrame * place);
    sum += fade * share.weight * surfaceIlluminance(light, toFrame * normal);
  }
  return sum;
}

}  // namespace nephroid

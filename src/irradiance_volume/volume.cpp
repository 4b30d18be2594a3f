#include "irradiance_volume/volume.h"

#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "irradiance_volume/bricks.h"
#include "irradiance_volume/grid.h"
#include "irradiance_volume/harmonics.h"
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
  if (settings.representation == kRepresentationMultiResolution)
    return brickSample(paths, bytes, 1e-3f * float(settings.error));
  return gridSample(paths, bytes);
}

bool isHarmonic(const VolumeSettings& settings) {
  return settings.representation == kRepresentationHarmonics;
}

std::size_t samplesOf(const VolumeSettings& settings, const LightSamples& lights) {
  return isHarmonic(settings) ? std::size_t{settings.order + 1} * (settings.order + 1)
                              : lights.directions().size();
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
      samples_(samplesOf(settings, lightSamples_)) {
  if (!isHarmonic(settings)) return;
  VolumeSettings ofBase = settings;
  ofBase.representation = kRepresentationGrid;
  ofBase.order = 0;
  base_ = std::make_unique<IrradianceVolume>(mesh, inOwnSpace, ofBase, cacheFolder_);
}

IrradianceVolume::IrradianceVolume(const Mesh& mesh, StoredVolume stored)
    : key_(stored.key),
      symmetry_(stored.symmetry),
      sphere_(boundingSphere(mesh)),
      lightSamples_(symmetry_, key_.settings.lightLevel),
      samples_(samplesOf(key_.settings, lightSamples_)) {
  for (std::size_t i = 0; i < stored.samples.size(); ++i)
    samples_[stored.firstSample + i] = std::move(stored.samples[i]);
}

SampleView IrradianceVolume::makeSample(uint32_t index) {
  if (samples_[index]) return *samples_[index];
  if (!tracer_)
    throw InputError("the irradiance volume holds no light sample " + std::to_string(index) + " of " +
                     std::to_string(samples_.size()) +
                     ": it is a part; bake the other light samples and merge them with --merge");
  if (std::optional<SampleView> cached = cachedSample(cacheFolder_, key_, symmetry_, index)) return *cached;
  if (isHarmonic(key_.settings)) {
    makeLayers();
    return *samples_[index];
  }
  const std::vector<PhotonPath> paths = tracer_->trace(
      lightSamples_.directions()[index], 1000 * key_.settings.photons, float(key_.settings.radius));
  SampleView traced = viewOf(represent(paths, key_.settings));
  keepSample(cacheFolder_, {key_, symmetry_, index, {traced}});
  return traced;
}

// They come of the same light samples, all at once.
void IrradianceVolume::makeLayers() {
  std::vector<VolumeSample> layers = harmonicLayers(*base_, key_.settings.order, float(key_.settings.radius),
                                                    std::size_t{1000} * key_.settings.kilobytes);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    samples_[i] = viewOf(std::move(layers[i]));
    keepSample(cacheFolder_, {key_, symmetry_, uint32_t(i), {*samples_[i]}});
  }
}

mat3 IrradianceVolume::toFrame(const SampleShare& share) const {
  return glm::transpose(sampleFrame(lightSamples_.directions()[share.sample])) * share.toSample;
}

std::vector<uint32_t> IrradianceVolume::resolve(std::span<const float> light) {
  std::vector<std::span<const uint32_t>> layers;
  for (uint32_t i = 0; i < sampleCount(); ++i) layers.push_back(sample(i).words);
  return resolveHarmonics(layers, light);
}

VolumeLight IrradianceVolume::resolvedLight(vec3 place, vec3 direction) {
  if (resolvedWords_.empty() || resolvedDirection_ != direction) {
    resolvedWords_ = resolve(sphericalHarmonics(key_.settings.order, direction));
    resolvedDirection_ = direction;
  }
  return lightAt(sample(0).layout, resolvedWords_, kRepresentationHarmonics, place);
}

const SampleView& IrradianceVolume::sample(uint32_t index) {
  if (!samples_[index]) samples_[index] = makeSample(index);
  return *samples_[index];
}

vec3 IrradianceVolume::illuminance(vec3 point, vec3 normal, vec3 direction,
                                   LightInterpolation interpolation) {
  const vec3 place = (point - sphere_.centre) / sphere_.radius;
  const float fade = fadeAt(length(place) / float(key_.settings.radius));
  if (isHarmonic(key_.settings)) return fade * surfaceIlluminance(resolvedLight(place, direction), normal);
  vec3 sum(0);
  for (const SampleShare& share : lightSamples_.around(direction, interpolation)) {
    const mat3 toSampleFrame = toFrame(share);
    const SampleView& view = sample(share.sample);
    const VolumeLight light =
        lightAt(view.layout, view.words, key_.settings.representation, toSampleFrame * place);
    sum += fade * share.weight * surfaceIlluminance(light, toSampleFrame * normal);
  }
  return sum;
}

}  // namespace nephroid

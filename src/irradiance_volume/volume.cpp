#include "irradiance_volume/volume.h"

#include <algorithm>
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
  if (material.scattering != vec3(0)) addVector(hasher, material.scattering);
  return hasher.value();
}

VolumeSample represent(std::span<const PhotonPath> paths, const VolumeSettings& settings, std::size_t bytes) {
  if (settings.representation == kRepresentationShells)
    return shellSample(paths, float(settings.radius), bytes);
  if (settings.representation == kRepresentationMultiResolution)
    return brickSample(paths, bytes, 1e-3f * float(settings.error));
  return gridSample(paths, bytes);
}

// Finer than what is made of it.
constexpr uint32_t kLeastKilobytesOfBase = 360;

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
  scaled.scattering *= scale;
  return scaled;
}

VolumeKey volumeKey(const Mesh& mesh, const Material& inOwnSpace, const VolumeSettings& settings) {
  return {geometryHash(mesh), hashOf(inOwnSpace), settings};
}

IrradianceVolume::IrradianceVolume(const Mesh& mesh, const Material& inOwnSpace,
                                   const VolumeSettings& settings, std::filesystem::path cacheFolder)
    : key_(volumeKey(mesh, inOwnSpace, settings)),
      material_(inOwnSpace),
      tracer_(std::make_unique<CasterTracer>(mesh, *material_, Paths(settings.paths))),
      symmetry_(tracer_->symmetry()),
      sphere_(tracer_->sphere()),
      lightSamples_(symmetry_, settings.lightLevel),
      cacheFolder_(std::move(cacheFolder)),
      samples_(samplesOf(settings, lightSamples_)) {
  if (!isHarmonic(settings)) return;
  VolumeSettings ofBase = settings;
  ofBase.representation = kRepresentationGrid;
  ofBase.order = 0;
  ofBase.kilobytes = std::max(ofBase.kilobytes, kLeastKilobytesOfBase);
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
  SampleView traced = traceSample(index);
  keepSample(cacheFolder_, {key_, symmetry_, index, {traced}});
  return traced;
}

SampleView IrradianceVolume::traceSample(uint32_t index) const {
  constexpr uint32_t kPhotonsPerTrial = 5;  // for each of those that movements are judged by
  constexpr float kBeyondRegion = 1.07f;  // radii that light is followed to, so that the last cells are full
  const VolumeSettings& settings = key_.settings;
  const float reach = kBeyondRegion * float(settings.radius);
  const uint32_t photons = 1000 * settings.photons;
  const mat3 frame = sampleFrame(lightSamples_.directions()[index]);
  const std::vector<PhotonPath> paths = tracer_->trace(frame, photons, reach);
  const std::size_t bytes = std::size_t{1000} * settings.kilobytes;
  const bool turns = !symmetry_.isBall && !paths.empty();  // a ball's light is the same from all sides
  const uint32_t side = turns ? flowSide(bytes) : 0;
  VolumeSample sample = represent(paths, settings, bytes - sizeof(uint32_t) * flowWordCount(side));
  sample.layout.source = kBeyondRegion * spreadSource(paths, reach);
  if (turns && sample.layout.words > 0) {
    const std::vector<uint32_t> flow = traceFlow(
        *tracer_, frame, paths, {reach, lightSamples_.halfStep(), photons / kPhotonsPerTrial, side});
    sample.words.insert(sample.words.end(), flow.begin(), flow.end());
    sample.layout.words = uint32_t(sample.words.size());
    sample.layout.flowSide = side;
  }
  return viewOf(std::move(sample));
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

const SampleView& IrradianceVolume::sample(uint32_t index) {
  if (!samples_[index]) samples_[index] = makeSample(index);
  return *samples_[index];
}

LightFlow IrradianceVolume::flow(const SampleShare& share) {
  const SampleView& view = sample(share.sample);
  return flowFor(view.layout, view.words, share.aside);
}

void IrradianceVolume::prepare(vec3 direction, LightInterpolation interpolation) {
  if (!prepared_.parts.empty() && prepared_.direction == direction &&
      prepared_.interpolation == interpolation)
    return;
  prepared_ = {direction, interpolation, {}};
  if (isHarmonic(key_.settings)) {
    const SampleLayout& layout = sample(0).layout;
    Part& part = prepared_.parts.emplace_back();
    part.view = viewOf({layout, resolve(sphericalHarmonics(key_.settings.order, direction))});
    return;
  }
  for (const SampleShare& share : lightSamples_.around(direction, interpolation))
    prepared_.parts.push_back({sample(share.sample), toFrame(share), share.weight, flow(share)});
}

vec3 IrradianceVolume::illuminance(vec3 point, vec3 normal, vec3 direction,
                                   LightInterpolation interpolation) {
  prepare(direction, interpolation);
  const auto radius = float(key_.settings.radius);
  const vec3 place = (point - sphere_.center) / sphere_.radius;
  vec3 sum(0);
  for (const Part& part : prepared_.parts) {
    const SampleLayout& layout = part.view.layout;
    if (layout.words == 0) continue;
    const vec3 there = part.toFrame * place / radius;
    const vec4 inRegion = placeInRegion(there, layout.source);
    if (inRegion.w == 0) continue;
    VolumeLight light =
        lightAt(layout, part.view.words, key_.settings.representation, radius * vec3(inRegion), part.flow);
    if (inRegion.w < 1)
      light.vector = spreadOn(light.vector, normalize(vec3(inRegion)), normalize(there - layout.source));
    sum += inRegion.w * part.weight * surfaceIlluminance(light, part.toFrame * normal);
  }
  return sum;
}

}  // namespace nephroid

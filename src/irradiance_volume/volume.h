// The local irradiance of a caster (Wyman, Hansen and Shirley 2004, "Interactive Caustics Using Local
// Precomputed Irradiance"): for light from sampled directions, the caustic light in the region around it. It
// is computed in the caster's own space, so it holds wherever the caster is moved, turned and scaled to.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "irradiance_volume/flow.h"
#include "irradiance_volume/light_samples.h"
#include "irradiance_volume/photons.h"

namespace nephroid {

struct VolumeSettings {
  uint32_t representation = kRepresentationShells;  // kRepresentation...
  uint32_t kilobytes = 360;                         // 1000 bytes, for each light direction
  uint32_t lightLevel = 3;                          // of LightSphere
  uint32_t radius = 3;                              // of the region, bounding radii
  uint32_t photons = 200;                           // thousands, for each light direction
  uint32_t paths = 0;                               // Paths
  uint32_t error = 0;  // of multi-resolution bricks, thousandths of the light; 0 for others
  uint32_t order = 0;  // of spherical harmonics; 0 for others
  bool operator==(const VolumeSettings&) const = default;
};

// What a volume was computed for. A volume is only ever used where its key is the one asked for.
struct VolumeKey {
  uint64_t geometry = 0;  // geometryHash
  uint64_t material = 0;  // hash of all that the light's way and colour depend on, in the mesh's own units
  VolumeSettings settings;
  bool operator==(const VolumeKey&) const = default;
};

// The material as the caster's own space has it: what absorbs over a metre does so over less where the
// caster is scaled down.
Material materialInOwnSpace(const Material& material, float scale);

VolumeKey volumeKey(const Mesh& mesh, const Material& inOwnSpace, const VolumeSettings& settings);

// One light sample of a volume, in memory or mapped from a file.
struct SampleView {
  SampleLayout layout;
  std::span<const uint32_t> words;
  std::shared_ptr<const void> owner;
};

// What a file holds of one volume.
struct StoredVolume {
  VolumeKey key;
  Symmetry symmetry;
  uint32_t firstSample = 0;
  std::vector<SampleView> samples;
};

class IrradianceVolume {
 public:
  // Light samples are traced when they are asked for first, and kept in `cacheFolder`, if it is not empty.
  // The mesh must outlive this.
  IrradianceVolume(const Mesh& mesh, const Material& inOwnSpace, const VolumeSettings& settings,
                   std::filesystem::path cacheFolder);
  // Light samples are those of a file.
  IrradianceVolume(const Mesh& mesh, StoredVolume stored);

  const VolumeKey& key() const { return key_; }
  const Symmetry& symmetry() const { return symmetry_; }
  const Sphere& sphere() const { return sphere_; }
  const LightSamples& lightSamples() const { return lightSamples_; }
  // m in the caster's own space: where the light kept ends.
  float regionRadius() const { return sphere_.radius * float(key_.settings.radius); }

  // How many are kept: one for each light direction, or for each spherical harmonic.
  uint32_t sampleCount() const { return uint32_t(samples_.size()); }
  // From the caster's own space to the frame of a light sample.
  mat3 toFrame(const SampleShare& share) const;
  // Of spherical harmonics: a grid, in the caster's own space, for light whose coefficients are `light`.
  std::vector<uint32_t> resolve(std::span<const float> light);

  // InputError where a file was given that does not hold it. `makeSample` does not keep it in memory.
  const SampleView& sample(uint32_t index);
  SampleView makeSample(uint32_t index);

  // How a light sample's light is displaced for its share.
  LightFlow flow(const SampleShare& share);

  // Lux by channel at a point of the caster's own space, on the side that the unit vector `normal` points to,
  // for light of 1 lux that travels along the unit vector `direction`: what the device computes.
  vec3 illuminance(vec3 point, vec3 normal, vec3 direction, LightInterpolation interpolation);

 private:
  void makeLayers();
  SampleView traceSample(uint32_t index) const;
  void prepare(vec3 direction, LightInterpolation interpolation);

  VolumeKey key_;
  std::optional<Material> material_;
  std::unique_ptr<CasterTracer> tracer_;  // none where a file was given
  Symmetry symmetry_;
  Sphere sphere_;
  LightSamples lightSamples_;
  std::filesystem::path cacheFolder_;
  std::vector<std::optional<SampleView>> samples_;
  std::unique_ptr<IrradianceVolume> base_;  // what spherical harmonics are made of

  // All that the illuminance of one direction of the light is made of.
  struct Part {
    SampleView view;
    mat3 toFrame{1};
    float weight = 1;
    LightFlow flow;
  };
  struct Prepared {
    vec3 direction{0};
    LightInterpolation interpolation = LightInterpolation::nearest;
    std::vector<Part> parts;
  };
  Prepared prepared_;  // of the last illuminance
};

}  // namespace nephroid

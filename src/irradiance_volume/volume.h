// The local irradiance of a caster (Wyman, Hansen and Shirley 2004, "Interactive Caustics Using Local
// Precomputed Irradiance"): for light from sampled directions, the caustic light in the region around it. It
// is computed in the caster's own space, so it is valid for every position, rotation and scale of the caster.
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

// Everything that a volume depends on. A stored volume is used only where its key is equal to the wanted one.
struct VolumeKey {
  uint64_t geometry = 0;  // geometryHash
  uint64_t material = 0;  // hash of everything in the material that the paths and colors of light depend on,
                          // in the mesh's own units
  VolumeSettings settings;
  bool operator==(const VolumeKey&) const = default;
};

// The material for the caster's own space. `scale`: of the caster; the attenuation distance is divided by it.
Material materialInOwnSpace(const Material& material, float scale);

VolumeKey volumeKey(const Mesh& mesh, const Material& inOwnSpace, const VolumeSettings& settings);

// One light sample of a volume, in memory or mapped from a file.
struct SampleView {
  SampleLayout layout;
  std::span<const uint32_t> words;
  std::shared_ptr<const void> owner;
};

// The part of a volume that a file holds.
struct StoredVolume {
  VolumeKey key;
  Symmetry symmetry;
  uint32_t firstSample = 0;
  std::vector<SampleView> samples;
};

class IrradianceVolume {
 public:
  // Light samples are traced when they are first needed, and stored in `cacheFolder` if it is not empty. The
  // mesh must outlive this.
  IrradianceVolume(const Mesh& mesh, const Material& inOwnSpace, const VolumeSettings& settings,
                   std::filesystem::path cacheFolder);
  // Uses the light samples of a file.
  IrradianceVolume(const Mesh& mesh, StoredVolume stored);

  const VolumeKey& key() const { return key_; }
  const Symmetry& symmetry() const { return symmetry_; }
  const Sphere& sphere() const { return sphere_; }
  const LightSamples& lightSamples() const { return lightSamples_; }
  // The radius (m, in the caster's own space) of the region with stored light.
  float regionRadius() const { return sphere_.radius * float(key_.settings.radius); }

  // The number of samples: one for each light direction, or one for each spherical harmonic.
  uint32_t sampleCount() const { return uint32_t(samples_.size()); }
  // From the caster's own space to the frame of a light sample.
  mat3 toFrame(const SampleShare& share) const;
  // For spherical harmonics only: the grid, in the caster's own space, for a light with the coefficients
  // `light`.
  std::vector<uint32_t> resolve(std::span<const float> light);

  // A sample; it is kept in memory. Throws InputError where a file was given that does not hold it.
  // `makeSample` does the same without keeping it.
  const SampleView& sample(uint32_t index);
  SampleView makeSample(uint32_t index);

  // The displacements of a sample for its share.
  LightFlow flow(const SampleShare& share);

  // The illuminance (lux, per channel) at `point` (in the caster's own space) on the front of a surface with
  // the unit normal `normal`, for light of 1 lux that travels along `direction` (unit). The same as the
  // device computes.
  vec3 illuminance(vec3 point, vec3 normal, vec3 direction, LightInterpolation interpolation);

 private:
  void makeLayers();
  SampleView traceSample(uint32_t index) const;
  void prepare(vec3 direction, LightInterpolation interpolation);

  VolumeKey key_;
  std::optional<Material> material_;
  std::unique_ptr<CasterTracer> tracer_;  // null where a file was given
  Symmetry symmetry_;
  Sphere sphere_;
  LightSamples lightSamples_;
  std::filesystem::path cacheFolder_;
  std::vector<std::optional<SampleView>> samples_;
  std::unique_ptr<IrradianceVolume> base_;  // the volume from which spherical harmonics are computed

  // One sample's part in the illuminance for a light direction.
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
  Prepared prepared_;  // for the last call of illuminance
};

}  // namespace nephroid

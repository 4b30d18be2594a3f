// The scene: plain structs that refer to each other by index. Units are meters, degrees and seconds. Axes are
// right-handed with +Y up. Colors are linear Rec. 709.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/shared_language.h"
#include "geometry/mesh.h"
#include "geometry/placement.h"
#include "scene/index.h"
#include "scene/light.h"
#include "scene/medium.h"
#include "scene/tone_curve.h"
#include "water/water.h"

namespace nephroid {

struct Camera {
  vec3 position{0, 0, 4};
  vec3 target{0};
  vec3 up{0, 1, 0};
  float verticalFov = 40;  // degrees, whole angle
  // Multiplies luminance before tone mapping; none: metered on the picture (render/metering.h).
  std::optional<float> exposure;
  ToneCurve tone = ToneCurve::neutral;
  bool operator==(const Camera&) const = default;
};

struct Environment {
  vec3 ambient{0};     // lux, on every receiver, from all directions
  vec3 background{0};  // nit
  bool operator==(const Environment&) const = default;
};

// RGBA in linear Rec. 709, [row * width + column], row 0 at the top. The texture coordinate (0, 0) is the
// upper left corner, as in glTF.
struct Texture {
  std::string name;
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<vec4> texels;
};

// Limits of an index of refraction.
inline constexpr double kLowestIor = 0.1, kHighestIor = 10;

enum class MaterialType { diffuse, dielectric, mirror };

struct Material {
  std::string name;
  MaterialType type = MaterialType::diffuse;
  vec3 color{0.8f};               // reflectance of a diffuse surface or a mirror
  uint32_t colorTexture = kNone;  // multiplies `color`
  vec3 emission{0};               // nit
  vec3 ior{1.5f};                 // per channel; equal channels: no dispersion
  float dispersion = 0;      // 20 / Abbe number (KHR_materials_dispersion); `ior` already follows from it
  vec3 attenuationColor{1};  // transmittance (0..1) after attenuationDistance
  float attenuationDistance = std::numeric_limits<float>::infinity();  // m
  vec3 scattering{0};  // 1/m, inside a dielectric, in addition to absorption
  PhaseType phase = PhaseType::isotropic;
  float g = 0;  // Henyey-Greenstein
  bool thinWalled =
      false;  // glTF transmission without a volume: light passes straight through, so no caustic
  bool isCaster() const { return type != MaterialType::diffuse; }
  bool isDispersive() const { return ior.x != ior.y || ior.y != ior.z; }
  bool operator==(const Material&) const = default;
  float inverseAttenuationDistance() const { return attenuationDistance > 0 ? 1 / attenuationDistance : 0; }
};

struct Object {
  std::string name;
  uint32_t mesh = 0;
  uint32_t material = 0;
  Placement placement;
  std::optional<Water> water;
};

inline constexpr uint32_t kLargestSensorSide = 16384;  // texels

// An illuminance meter. The texel in column i and row j covers u (i..i+1)/width and v (j..j+1)/height from
// `corner` (m). It faces cross(v, u).
struct Sensor {
  std::string name;
  vec3 corner{0};
  vec3 u{1, 0, 0};
  vec3 v{0, 0, 1};
  uvec2 resolution{256, 256};
  vec3 normal() const { return glm::normalize(glm::cross(v, u)); }
};

struct Scene {
  std::filesystem::path file;
  double time = 0;  // s, for everything that moves by itself
  Camera camera;
  Environment environment;
  std::vector<Texture> textures;
  std::vector<Profile> profiles;
  std::vector<SkyMap> skies;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Light> lights;
  bool hasDefaultSky = false;  // its file has no light: it is lit by a clear sky and its sun
  std::optional<Medium> medium;
  std::vector<Sensor> sensors;

  const Material& materialOf(const Object& object) const { return materials[object.material]; }
  const Mesh& meshOf(const Object& object) const { return meshes[object.mesh]; }
  bool isCaster(const Object& object) const { return materialOf(object).isCaster(); }
};

}  // namespace nephroid

// What exists: plain structs that refer to each other by index. Metres, degrees, seconds; right-handed, +Y
// up; linear Rec. 709.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

inline constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

struct Camera {
  vec3 position{0, 0, 4};
  vec3 target{0};
  vec3 up{0, 1, 0};
  float verticalFov = 40;  // degrees, whole angle
  float exposure = 1;      // multiplies luminance before tone mapping
  bool operator==(const Camera&) const = default;
};

struct Environment {
  vec3 ambient{0};     // lux, on every receiver, from all around
  vec3 background{0};  // nit
  bool operator==(const Environment&) const = default;
};

// Linear Rec. 709 RGBA, row 0 at the top; texture coordinate (0, 0) is the upper left corner, as in glTF.
struct Texture {
  std::string name;
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<vec4> texels;
};

enum class PhaseType { isotropic, henyeyGreenstein, nishita };

enum class MaterialType { diffuse, dielectric, mirror };

struct Material {
  std::string name;
  MaterialType type = MaterialType::diffuse;
  vec3 color{0.8f};               // reflectance of a diffuse surface or a mirror
  uint32_t colorTexture = kNone;  // multiplies `color`
  vec3 emission{0};               // nit
  vec3 ior{1.5f};                 // per channel; equal channels: no dispersion
  float dispersion = 0;      // 20 / Abbe number (KHR_materials_dispersion); `ior` already follows from it
  vec3 attenuationColor{1};  // what is left after attenuationDistance
  float attenuationDistance = std::numeric_limits<float>::infinity();  // m
  vec3 scattering{0};  // 1/m, in a dielectric's volume, besides what that absorbs
  PhaseType phase = PhaseType::isotropic;
  float g = 0;  // Henyey-Greenstein
  bool thinWalled =
      false;  // glTF transmission without a volume: light passes straight through, so no caustic
  bool isCaster() const { return type != MaterialType::diffuse; }
  bool isDispersive() const { return ior.x != ior.y || ior.y != ior.z; }
  bool operator==(const Material&) const = default;
  float inverseAttenuationDistance() const { return attenuationDistance > 0 ? 1 / attenuationDistance : 0; }
};

// Triangles in the object's own space, counter-clockwise from outside. All arrays but `triangles` are per
// vertex.
struct Mesh {
  std::string name;
  std::vector<vec3> positions;  // m
  std::vector<vec3> normals;  // unit, exact for shapes; averaged by area from the faces where a file has none
  std::vector<vec2> texcoords;  // empty when there are none
  std::vector<uvec3> triangles;
  bool isClosed = false;          // every edge has two faces after joining equal positions
  uint32_t droppedTriangles = 0;  // triangles without an area, left out when the mesh was made
  // The surface bends between vertices as their normals say (shapes); otherwise its triangles are flat.
  bool isCurved = false;
  // The part of the surface that is of flat facets: all of a box's or a cut gem's, the ends of a cylinder's.
  // None of water, which goes on smoothly however flat it is.
  float facetedPart = 0;
  bool isFaceted() const { return facetedPart > 0.99f; }
  bool hasEdges() const { return facetedPart >= 0.1f; }  // at which light parts
};

// A rigid motion and a uniform scale; anything else is baked into the mesh when it is loaded, so that what is
// computed for a mesh (a light transport table) holds wherever it stands.
struct Placement {
  vec3 translation{0};
  quat rotation{1, 0, 0, 0};
  float scale = 1;
  vec3 point(vec3 p) const { return rotation * (scale * p) + translation; }
  vec3 direction(vec3 d) const { return rotation * d; }
  vec3 inversePoint(vec3 p) const { return glm::conjugate(rotation) * (p - translation) / scale; }
  vec3 inverseDirection(vec3 d) const { return glm::conjugate(rotation) * d; }
  bool operator==(const Placement&) const = default;
};

struct Wave {
  float amplitude = 0;   // m
  float wavelength = 1;  // m
  vec2 direction{1, 0};  // in (x, z)
  float speed = 0;       // m/s
  float phase = 0;       // radians
};

// A drop that has fallen into simulated water: a dent, with the water it drives out heaped up around it.
struct WaterDrop {
  float time = 0;       // s
  vec2 position{0};     // m, (x, z)
  float radius = 0.1f;  // m
  float depth = 0.02f;  // m, in its middle
  bool operator==(const WaterDrop&) const = default;
};

// What moves through simulated water, upright and round, with a rim that falls off as a Gaussian.
struct WaterObstacle {
  float radius = 0.1f;     // m
  float depth = 0.02f;     // m that it reaches down in its middle
  std::vector<vec3> path;  // x, z (m) and time (s), which rises; it stands still before and after
  bool operator==(const WaterObstacle&) const = default;
};

// The wave equation on the water's grid, with walls that send waves back along its sides; still at time 0.
struct WaveSimulation {
  float speed = 1;    // m/s, of all waves
  float damping = 0;  // 1/s
  std::vector<WaterDrop> drops;
  std::vector<WaterObstacle> obstacles;
  bool operator==(const WaveSimulation&) const = default;
};

enum class SpectrumShape { jonswap, phillips };

// The sea as a sum of waves of random phases over its spectrum, which repeats at the water's sides.
struct OceanSpectrum {
  SpectrumShape shape = SpectrumShape::jonswap;
  vec2 wind{5, 0};                                       // m/s, in (x, z), 10 m above the water
  float fetch = 1e4f;                                    // m of water that the wind has blown over (JONSWAP)
  float depth = std::numeric_limits<float>::infinity();  // m, of the water
  float significantHeight = 0;                           // m; 0: that of wind and fetch
  float choppiness = 0;                                  // 1: crests as sharp as those of Gerstner's waves
  uint32_t seed = 0;
};

// The height field behind a mesh of the shape "water": y = sum of amplitude sin(2 pi / wavelength (direction
// . (x, z) - speed t) + phase), and on it what is simulated and the sea.
struct Water {
  vec2 size{1, 1};   // m
  uvec2 grid{2, 2};  // vertices along x and z; 0: the mesh is from a file
  std::vector<Wave> waves;
  std::optional<WaveSimulation> simulation{};
  std::optional<OceanSpectrum> ocean{};
};

struct Object {
  std::string name;
  uint32_t mesh = 0;
  uint32_t material = 0;
  Placement placement;
  std::optional<Water> water;
};

enum class LightType { directional, point, spot, line, area, sky };

// Light from all around, infinitely far away: cells of equal angles. The middle of the map is toward -z, its
// right half toward +x, its first row about +y.
struct SkyMap {
  std::string name;
  uvec2 size{1};                // columns, rows
  std::vector<vec3> luminance;  // nit, [row * size.x + column]
};

// A part of a sky as one directional light.
struct SkyPart {
  vec3 direction{0};    // unit, the way its light travels
  vec3 illuminance{0};  // lux on a facing surface
  bool operator==(const SkyPart&) const = default;
};

struct Light {
  std::string name;
  LightType type = LightType::point;
  vec3 position{0};          // point, spot; one end of a line; the first corner of an area
  vec3 end{0};               // the other end of a line
  vec3 u{0}, v{0};           // m, the sides of an area, which shines to the side of cross(v, u)
  vec3 direction{0, -1, 0};  // unit, the way the light travels; of an area, its normal
  vec3 intensity{1};      // cd; of the whole tube for a line, along its normal for an area; multiplies a sky
  vec3 illuminance{1};    // lux on a facing surface (directional)
  float innerAngle = 0;   // degrees, half angle of full intensity (spot)
  float outerAngle = 45;  // degrees, half angle of none; 180: no cone
  uint32_t samples = 8;   // points a line is replaced by
  uvec2 grid{4};          // points an area is replaced by, along its sides
  uint32_t goboTexture = kNone;  // what a spot's image lets through
  float goboRotation = 0;        // degrees, clockwise for who looks along the light
  uint32_t profile = kNone;      // which shapes a spot; its peak is `intensity`
  uint32_t skyMap = kNone;       // of Scene::skies
  float skyRotation = 0;         // degrees about +y, anticlockwise from above
  std::vector<SkyPart> sky;      // what the map is replaced by, before rotation and `intensity`
  bool operator==(const Light&) const = default;
};

// The goniometer's axes (IES LM-75). With vertical 0, horizontal 0 along the light:
enum class PhotometryType {
  c,  // vertical from 0 (along the light) to 180; horizontal around it, 0 up and 90 to the left of who looks
      // along it
  b,  // horizontal -90 to 90 is the latitude (+ to the right), vertical turns around the axis to the right
  a,  // vertical -90 to 90 is the latitude (+ up), horizontal turns around the axis upward
};

// Luminous intensity over direction, measured (IES LM-63), linear between the angles and 0 beyond the
// vertical ones. Left out by symmetry: in type C all around, where there is one horizontal angle, or what
// mirrors 0 to 90, 0 to 180, or 90 to 270 degrees; in types A and B what is below 0 on an axis that begins
// there.
struct Profile {
  std::string name;
  PhotometryType type = PhotometryType::c;
  std::vector<float> verticalAngles;    // degrees, ascending, two or more
  std::vector<float> horizontalAngles;  // degrees, ascending
  std::vector<float> fractions;         // of the peak, [horizontal * verticalAngles.size() + vertical]
  float peak = 0;                       // cd, above 0
};

// How dense the air is in a box, as a part of the most there may be: linear between the middles of its cells,
// and 0 outside.
struct DensityGrid {
  std::string name;
  vec3 corner{0};  // m, where all coordinates are lowest
  vec3 size{1};    // m
  uvec3 cells{1};
  std::vector<float> densities;  // 0 to 1, [(z * cells.y + y) * cells.x + x]
};

struct Medium {
  float extinction = 0;  // 1/m
  float albedo = 0;      // scattering over extinction
  PhaseType phase = PhaseType::isotropic;
  float g = 0;                      // Henyey-Greenstein
  float fogBase = 0;                // m along +y, up to where the air is as dense as `extinction` says
  float fogHeight = 0;              // m, above there, in which it thins out by the factor e; 0: it never does
  std::optional<DensityGrid> grid;  // multiplies that
};

// An illuminance meter. Texel (column i, row j) spans u (i..i+1)/width and v (j..j+1)/height from `corner`;
// faces cross(v, u).
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
  double time = 0;  // s; what moves by itself stands as it is at this time
  Camera camera;
  Environment environment;
  std::vector<Texture> textures;
  std::vector<Profile> profiles;
  std::vector<SkyMap> skies;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Light> lights;
  std::optional<Medium> medium;
  std::vector<Sensor> sensors;

  const Material& materialOf(const Object& object) const { return materials[object.material]; }
  const Mesh& meshOf(const Object& object) const { return meshes[object.mesh]; }
  bool isCaster(const Object& object) const { return materialOf(object).isCaster(); }
};

}  // namespace nephroid

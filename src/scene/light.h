// Lights, and the profiles and skies that shape them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/shared_language.h"
#include "scene/index.h"

namespace nephroid {

inline constexpr uint32_t kMostLineSamples = 4096;
inline constexpr uint32_t kMostAreaSamples = 64;  // along a side

inline constexpr float kSunAngle = 0.53f;   // degrees that the sun is seen under from the earth
inline constexpr float kWidestAngle = 179;  // degrees, of a directional light

enum class LightType { directional, point, spot, line, area, sky };

// Light from all directions, infinitely far away. Columns are longitudes and rows are latitudes, in equal
// steps. The middle of the map is toward -z, its right half toward +x, its first row around +y.
struct SkyMap {
  std::string name;
  uvec2 size{1};                // columns, rows
  std::vector<vec3> luminance;  // nit, [row * size.x + column]
};

// A part of a sky as one directional light that comes from about one direction.
struct SkyPart {
  vec3 direction{0};    // unit, in which its light travels
  vec3 illuminance{0};  // lux on a facing surface
  // Standard deviations of its directions, along two axes across `direction`.
  std::array<vec3, 2> spread{vec3(0), vec3(0)};
  bool operator==(const SkyPart&) const = default;
};

struct Light {
  std::string name;
  LightType type = LightType::point;
  vec3 position{0};          // point, spot; one end of a line; the first corner of an area
  vec3 end{0};               // the other end of a line
  vec3 u{0}, v{0};           // m, the sides of an area, which shines to the side of cross(v, u)
  vec3 direction{0, -1, 0};  // unit, in which the light travels; for an area, its normal
  vec3 intensity{1};    // cd; of the whole tube for a line, along its normal for an area; multiplies a sky
  vec3 illuminance{1};  // lux on a facing surface (directional)
  // m, of a point or a spot: a ball that looks evenly bright, whose intensity is that of the whole. 0: a
  // point.
  float radius = 0;
  float angle = 0;               // degrees that a directional light is seen under: a disk, evenly bright
  float innerAngle = 0;          // degrees, half angle of full intensity (spot)
  float outerAngle = 45;         // degrees, half angle outside of which there is no light; 180: no cone
  uint32_t samples = 8;          // points a line is replaced by
  uvec2 grid{4};                 // points an area is replaced by, along its sides
  uint32_t goboTexture = kNone;  // index of a spot's gobo in Scene::textures
  float goboRotation = 0;        // degrees, clockwise for who looks along the light
  uint32_t profile = kNone;      // index of a spot's profile in Scene::profiles; its peak is `intensity`
  uint32_t skyMap = kNone;       // index in Scene::skies
  float skyRotation = 0;         // degrees about +y, counterclockwise from above
  bool isSeen = true;            // a sky: where nothing stands, in glass and in mirrors
  uint32_t sun = kNone;          // a sky: the directional light, in Scene::lights, whose disk is seen in it
  std::vector<SkyPart> sky;      // the parts that stand for the map, before rotation and `intensity`
  // A sky: `sky` also where a technique would cut the map into as many parts as the error asked for takes.
  bool hasGivenSamples = false;
  bool operator==(const Light&) const = default;
};

// The axes of a goniometer (IES LM-75). The angles vertical 0, horizontal 0 are along the light:
enum class PhotometryType {
  c,  // vertical from 0 (along the light) to 180; horizontal around it, 0 up and 90 to the left of who looks
      // along it
  b,  // horizontal -90 to 90 is the latitude (+ to the right), vertical turns around the axis to the right
  a,  // vertical -90 to 90 is the latitude (+ up), horizontal turns around the axis upward
};

// Measured luminous intensity over direction (IES LM-63). It is linear between the angles, and 0 beyond the
// first and last vertical angles. A symmetric profile has only a part of the angles. Type C: a single
// horizontal angle stands for all; 0 to 90, 0 to 180 or 90 to 270 degrees are mirrored. Types A and B: an
// axis that begins at 0 is mirrored to negative angles.
struct Profile {
  std::string name;
  PhotometryType type = PhotometryType::c;
  std::vector<float> verticalAngles;    // degrees, ascending, two or more
  std::vector<float> horizontalAngles;  // degrees, ascending
  std::vector<float> fractions;         // of the peak, [horizontal * verticalAngles.size() + vertical]
  float peak = 0;                       // cd, above 0
};

}  // namespace nephroid

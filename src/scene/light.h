// Lights, and what shapes them.
#pragma once

#include <string>
#include <vector>

#include "core/shared_language.h"
#include "scene/index.h"

namespace nephroid {

inline constexpr uint32_t kMostLineSamples = 4096;
inline constexpr uint32_t kMostAreaSamples = 64;  // along a side

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

}  // namespace nephroid

// The clear sky and its sun, by the model of Preetham, Shirley and Smits, "A Practical Analytic Model for
// Daylight", 1999.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// Limits of the model: haze scatters little light from turbidity 2 on, and the zenith is dark beyond 10.
inline constexpr float kLowestTurbidity = 2, kHighestTurbidity = 10;

struct ClearSky {
  float azimuth = 0;     // degrees, of the sun: clockwise from above, 0 at north (-z), 90 at east (+x)
  float elevation = 40;  // degrees, of the sun above the horizon, 0 to 90
  float turbidity = 3;   // of the air: haze and air over air alone
  vec3 ground{0.1f};     // reflectance of the ground, which lies everywhere below the horizon
};

// The unit vector toward the sun.
vec3 towardSun(const ClearSky& clear);

// Luminance (nit) of the sky, without the sun, in a direction (unit) above the horizon.
vec3 clearSkyLuminance(const ClearSky& clear, vec3 toward);

// Illuminance (lux) by the sun of a surface that faces it, as the air leaves it.
vec3 sunIlluminance(const ClearSky& clear);

// The sky, without the sun, and the ground that sky and sun light.
SkyMap clearSkyMap(const ClearSky& clear);

// Makes `sky`, which has its name, strength and number of parts, a clear one. Its map is added to the scene
// where there is none of the same sky. Returns its sun. The caller adds both to the scene's lights, and sets
// `sky.sun` to the sun's index.
Light makeClearSky(const ClearSky& clear, Scene& scene, Light& sky);

// The sun of a sky that was changed, in strength and rotation, as the sky was.
Light sunWithSky(const Light& sunBefore, const Light& skyBefore, const Light& sky);

}  // namespace nephroid

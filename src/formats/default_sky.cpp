#include "formats/default_sky.h"

#include "lights/clear_sky.h"

namespace nephroid {
namespace {

constexpr uint32_t kSamples = 64;
// For the camera of framingCamera, which looks toward -z, the sun is at the left and a little ahead: shadows
// and caustics come toward the viewer.
constexpr ClearSky kDefaultSky{.azimuth = 300, .elevation = 40};

}  // namespace

void lightByDefault(Scene& scene, bool isBackgroundGiven) {
  if (!scene.lights.empty() || scene.environment.ambient != vec3(0)) return;
  Light sky;
  sky.name = "default sky";
  sky.samples = kSamples;
  sky.isSeen = !isBackgroundGiven;
  sky.sun = 0;
  scene.lights.push_back(makeClearSky(kDefaultSky, scene, sky));
  scene.lights.push_back(sky);
  scene.hasDefaultSky = true;
}

}  // namespace nephroid

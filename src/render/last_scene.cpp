#include "render/last_scene.h"

#include <utility>

namespace nephroid {
namespace {

// All that a shadow map depends on.
Light shape(Light light) {
  light.intensity = light.illuminance = vec3(1);
  light.goboTexture = light.profile = kNone;
  light.goboRotation = 0;
  return light;
}

std::vector<Light> shapes(const std::vector<Light>& lights) {
  std::vector<Light> all;
  for (const Light& light : lights) all.push_back(shape(light));
  return all;
}

}  // namespace

Remade LastScene::replace(const Scene& scene, bool keepsLight, bool beamsFollowCamera) {
  Camera camera = scene.camera;
  camera.exposure.reset();
  camera.tone = ToneCurve::neutral;
  std::vector<Standing> objects;
  for (const Object& object : scene.objects)
    objects.push_back({object.material, object.placement,
                       object.water ? scene.meshOf(object).positions : std::vector<vec3>()});

  const bool objectsStand = isThere_ && objects == objects_ && scene.materials == materials_;
  const bool cameraStands = camera == camera_;
  const bool lightsStand = scene.lights == lights_;
  Remade remade;
  remade.sight = !(objectsStand && cameraStands && scene.environment == environment_);
  remade.lamps = !(keepsLight && objectsStand && lightsStand);
  remade.shadowMaps = !(keepsLight && objectsStand && shapes(scene.lights) == shapes(lights_));
  remade.beams = !(keepsLight && objectsStand && lightsStand && (cameraStands || !beamsFollowCamera));

  isThere_ = true;
  camera_ = camera;
  environment_ = scene.environment;
  objects_ = std::move(objects);
  materials_ = scene.materials;
  lights_ = scene.lights;
  return remade;
}

}  // namespace nephroid

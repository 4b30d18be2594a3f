// The scene of Iwasaki 2005, figures 8 (a) and 12.
#pragma once

#include "geometry/shapes.h"
#include "scene/scene.h"

namespace nephroid {

// A glass ball of 6,400 vertices whose center is `height` (m) over a floor, under a point light.
inline Scene ballOverFloor(float height, vec3 light) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].type = MaterialType::dielectric;
  scene.meshes = {makeSphere(0.5f, {.vertices = 6400}), makePlane({20, 20})};
  scene.objects.resize(2);
  scene.objects[0].placement.translation = {0, height, 0};
  scene.objects[1].mesh = 1;
  scene.objects[1].material = 1;
  scene.lights.resize(1);
  scene.lights[0].position = light;
  scene.lights[0].intensity = vec3(100);
  return scene;
}

}  // namespace nephroid

// What a camera sees by way of casters, traced anew for every pixel: no vertex, slice or image in between.
// For scenes without lights, where a receiver's luminance is its reflectance times ambient over pi.
#pragma once

#include <cmath>
#include <numbers>

#include "core/image.h"
#include "optics/refraction.h"
#include "render/sight/view_rays.h"
#include "transport/scene_transport.h"

namespace nephroid {

class ExactSight {
 public:
  explicit ExactSight(const Scene& sceneToSee) : scene(sceneToSee), rays(scene), traced(scene, rays) {}

  // nit, row by row.
  std::vector<vec3> picture(const Camera& camera, uvec2 size) const {
    std::vector<vec3> pixels;
    for (uint32_t y = 0; y < size.y; ++y)
      for (uint32_t x = 0; x < size.x; ++x) pixels.push_back(through(camera, size, vec2(x, y) + 0.5f));
    return pixels;
  }

 private:
  vec3 through(const Camera& camera, uvec2 size, vec2 place) const {
    const vec3 forward = normalize(camera.target - camera.position);
    const vec3 right = normalize(cross(forward, camera.up));
    const float tangent = std::tan(0.5f * glm::radians(camera.verticalFov));
    const vec2 at = (2.0f * place / vec2(size) - 1.0f) * vec2(float(size.x) / float(size.y), 1) * tangent;
    const vec3 direction = normalize(forward + at.x * right - at.y * cross(right, forward));
    Hit hit;
    if (!rays.intersect({camera.position, direction}, hit)) return scene.environment.background;
    if (!scene.isCaster(scene.objects[hit.object])) return luminanceOf(hit);
    const OutgoingRay ray =
        traced.rayAt(sightQuery(hit.object, camera.position, 1, {}),
                     {hit.position, hit.flatPosition, hit.normal, hit.geometricNormal, hit.patch});
    vec3 sum = ray.transmittance * along(ray.position, ray.direction);
    const Material& material = scene.materialOf(scene.objects[hit.object]);
    if (material.type == MaterialType::dielectric)
      sum += fresnelReflectance(std::abs(dot(direction, hit.normal)), 1 / material.ior.y) *
             along(hit.position, reflectDirection(direction, hit.normal));
    return sum;
  }

  vec3 along(vec3 origin, vec3 direction) const {
    Hit hit;
    if (!rays.intersect({origin, direction, 10 * rays.largestRounding()}, hit) ||
        scene.isCaster(scene.objects[hit.object]))
      return scene.environment.background;
    return luminanceOf(hit);
  }

  vec3 luminanceOf(const Hit& hit) const {
    return scene.materialOf(scene.objects[hit.object]).color * scene.environment.ambient /
           std::numbers::pi_v<float>;
  }

  const Scene& scene;
  RayScene rays;
  TracedSource traced;
};

}  // namespace nephroid

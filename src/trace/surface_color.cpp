#include "trace/surface_color.h"

namespace nephroid {
namespace {

vec4 texel(const Texture& texture, int x, int y) {
  const auto wrapped = [](int i, uint32_t size) {
    const int n = static_cast<int>(size);
    return static_cast<std::size_t>(((i % n) + n) % n);
  };
  return texture.texels[wrapped(y, texture.height) * texture.width + wrapped(x, texture.width)];
}

vec3 sampleBilinear(const Texture& texture, vec2 coordinate) {
  const vec2 place = (coordinate - glm::floor(coordinate)) * vec2(texture.width, texture.height) - 0.5f;
  const vec2 first = glm::floor(place);
  const vec2 after = place - first;
  const int x = static_cast<int>(first.x), y = static_cast<int>(first.y);
  const vec4 upper = glm::mix(texel(texture, x, y), texel(texture, x + 1, y), after.x);
  const vec4 lower = glm::mix(texel(texture, x, y + 1), texel(texture, x + 1, y + 1), after.x);
  return vec3(glm::mix(upper, lower, after.y));
}

}  // namespace

vec2 texcoordAt(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshOf(scene.objects[hit.object]);
  if (mesh.texcoords.empty()) return vec2(0);
  const uvec3& corners = mesh.triangles[hit.triangle];
  return mesh.texcoords[corners.x] * (1 - hit.barycentric.x - hit.barycentric.y) +
         mesh.texcoords[corners.y] * hit.barycentric.x + mesh.texcoords[corners.z] * hit.barycentric.y;
}

vec3 diffuseReflectance(const Scene& scene, const Material& material, vec2 texcoord) {
  if (material.colorTexture == kNone) return material.color;
  return material.color * sampleBilinear(scene.textures[material.colorTexture], texcoord);
}

vec3 diffuseReflectance(const Scene& scene, const Hit& hit) {
  const Object& object = scene.objects[hit.object];
  const Material& material = scene.materialOf(object);
  if (scene.meshOf(object).texcoords.empty()) return material.color;
  return diffuseReflectance(scene, material, texcoordAt(scene, hit));
}

}  // namespace nephroid

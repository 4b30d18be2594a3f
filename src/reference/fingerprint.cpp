#include "reference/fingerprint.h"

#include "core/hash.h"

namespace nephroid {
namespace {

constexpr uint32_t kMethod = 5;  // one more whenever a pass computes something else

class SceneHasher {
 public:
  template <class... Values>
  void add(const Values&... values) {
    (addOne(values), ...);
  }
  uint64_t value() const { return hasher_.value(); }

 private:
  void addOne(float value) { hasher_.add(value); }
  void addOne(uint32_t value) { hasher_.add(value); }
  void addOne(const vec2& v) { add(v.x, v.y); }
  void addOne(const vec3& v) { add(v.x, v.y, v.z); }
  void addOne(const quat& q) { add(q.x, q.y, q.z, q.w); }
  template <class T>
  void addOne(const std::vector<T>& values) {
    hasher_.add(values.size());
    hasher_.add(std::as_bytes(std::span(values)));
  }

  Hasher hasher_;
};

void add(SceneHasher& hasher, const Material& m) {
  hasher.add(static_cast<uint32_t>(m.type), m.color, m.colorTexture, m.emission, m.ior, m.dispersion,
             m.attenuationColor, m.attenuationDistance, m.scattering, static_cast<uint32_t>(m.phase), m.g,
             uint32_t{m.thinWalled});
}

void add(SceneHasher& hasher, const Light& l) {
  hasher.add(static_cast<uint32_t>(l.type), l.position, l.end, l.direction, l.intensity, l.illuminance,
             l.innerAngle, l.outerAngle, l.goboTexture, l.goboRotation, l.profile, l.u, l.v, l.skyMap,
             l.skyRotation, uint32_t{l.isSeen}, l.sun, l.radius, l.angle);
}

void add(SceneHasher& hasher, const Medium& m) {
  hasher.add(m.extinction, m.albedo, static_cast<uint32_t>(m.phase), m.g, m.fogBase, m.fogHeight);
  if (m.grid)
    hasher.add(m.grid->corner, m.grid->size, m.grid->cells.x, m.grid->cells.y, m.grid->cells.z,
               m.grid->densities);
}

}  // namespace

uint64_t fingerprint(const Scene& scene) {
  SceneHasher hasher;
  hasher.add(kMethod);
  const Camera& camera = scene.camera;
  hasher.add(camera.position, camera.target, camera.up, camera.verticalFov);
  hasher.add(scene.environment.ambient, scene.environment.background);
  for (const Texture& texture : scene.textures) hasher.add(texture.width, texture.height, texture.texels);
  for (const Material& material : scene.materials) add(hasher, material);
  for (const Mesh& mesh : scene.meshes)
    hasher.add(mesh.positions, mesh.normals, mesh.texcoords, mesh.triangles, uint32_t{mesh.isCurved});
  for (const Object& object : scene.objects)
    hasher.add(object.mesh, object.material, object.placement.translation, object.placement.rotation,
               object.placement.scale);
  for (const Profile& profile : scene.profiles)
    hasher.add(static_cast<uint32_t>(profile.type), profile.verticalAngles, profile.horizontalAngles,
               profile.fractions);
  for (const SkyMap& sky : scene.skies) hasher.add(sky.size.x, sky.size.y, sky.luminance);
  for (const Light& light : scene.lights) add(hasher, light);
  if (const std::optional<Medium>& medium = scene.medium) add(hasher, *medium);
  for (const Sensor& sensor : scene.sensors)
    hasher.add(sensor.corner, sensor.u, sensor.v, sensor.resolution.x, sensor.resolution.y);
  return hasher.value();
}

}  // namespace nephroid

#include "scene/checks.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "geometry/mesh_checks.h"

namespace nephroid {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();
constexpr float kUnitTolerance = 1e-3f;
constexpr float kNearlyAlong = 0.9999f;  // cosine

std::string text(float value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string text(vec3 v) {
  return "(" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ")";
}

std::string rangeText(float lowest, float highest) {
  if (highest < kLargest) return "from " + text(lowest) + " to " + text(highest);
  return lowest > 0 ? "above 0, and finite" : "0 or more, and finite";
}

bool isWithin(float value, float lowest, float highest) {
  return value >= lowest && value <= highest;  // NaN is not
}

bool isWithin(vec3 v, float lowest, float highest) {
  return isWithin(v.x, lowest, highest) && isWithin(v.y, lowest, highest) && isWithin(v.z, lowest, highest);
}

// Of texels, color alone counts.
std::string text(vec4 v) {
  return text(vec3(v));
}

bool isWithin(vec4 v, float lowest, float highest) {
  return isWithin(vec3(v), lowest, highest);
}

// A part of a scene, whose name begins what is said about it.
struct Part {
  const char* kind;
  const std::string* name = nullptr;  // where it has one
  std::size_t index = 0;              // where it has a number

  std::string label() const {
    if (!name) return kind;
    return std::string(kind) + " " + (name->empty() ? std::to_string(index) : "\"" + *name + "\"");
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(label() + ": " + what); }

  template <class Value>
  void within(const char* field, const Value& value, float lowest, float highest) const {
    if (!isWithin(value, lowest, highest))
      fail(std::string(field) + " is " + text(value) + "; it must be " + rangeText(lowest, highest));
  }
  template <class Value>
  void notNegative(const char* field, const Value& value) const {
    within(field, value, 0, kLargest);
  }
  void positive(const char* field, float value) const {
    within(field, value, std::numeric_limits<float>::min(), kLargest);
  }
  template <class Value>
  void place(const char* field, const Value& value) const {
    within(field, value, -kLargestCoordinate, kLargestCoordinate);
  }
  void unit(const char* field, vec3 value) const {
    if (!(std::abs(length(value) - 1) <= kUnitTolerance))
      fail(std::string(field) + " is " + text(value) + "; it must be of length 1");
  }
  void number(const char* field, uint32_t value, uint32_t lowest, uint32_t highest) const {
    if (value < lowest || value > highest)
      fail(std::string(field) + " is " + std::to_string(value) + "; it must be from " +
           std::to_string(lowest) + " to " + std::to_string(highest));
  }
  // `what`: "mesh", of which there are `count`.
  void inRange(const char* what, uint32_t value, std::size_t count) const {
    if (value >= count)
      fail(std::string(what) + " " + (value == kNone ? "kNone" : std::to_string(value)) +
           " is not there; the scene has " + std::to_string(count) + ", counted from 0");
  }
  void optionalIndex(const char* what, uint32_t value, std::size_t count) const {
    if (value != kNone) inRange(what, value, count);
  }
  void size(const char* list, std::size_t size, std::size_t expected) const {
    if (size != expected)
      fail(std::string(list) + " holds " + std::to_string(size) + " values; it must hold " +
           std::to_string(expected));
  }
  // Each of a list.
  template <class Values>
  void allWithin(const char* field, const Values& values, float lowest, float highest) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!isWithin(values[i], lowest, highest))
        fail(std::string(field) + " " + std::to_string(i) + " is " + text(values[i]) + "; it must be " +
             rangeText(lowest, highest));
  }
};

void checkCamera(const Camera& camera) {
  const Part part{"camera"};
  part.place("position", camera.position);
  part.place("target", camera.target);
  part.place("up", camera.up);
  part.within("verticalFov", camera.verticalFov, 0.01f, 179);
  if (camera.exposure) part.positive("exposure", *camera.exposure);
  const vec3 view = camera.target - camera.position;
  if (!(length(view) > 0)) part.fail("position is the target as well; they must differ");
  if (!(length(camera.up) > 0)) part.fail("up is 0; it must point to a side of the view");
  // A camera that looks along `up` is upright toward -z instead.
  const vec3 forward = normalize(view);
  if (std::abs(dot(forward, normalize(camera.up))) >= kNearlyAlong && std::abs(forward.z) >= kNearlyAlong)
    part.fail("up lies along the view; it must point to another side");
}

void checkEnvironment(const Environment& environment) {
  const Part part{"environment"};
  part.notNegative("ambient", environment.ambient);
  part.notNegative("background", environment.background);
}

void checkMaterial(const Material& material, std::size_t index, const Scene& scene) {
  const Part part{"material", &material.name, index};
  part.within("color", material.color, 0, 1);
  part.optionalIndex("texture", material.colorTexture, scene.textures.size());
  part.notNegative("emission", material.emission);
  part.within("ior", material.ior, float(kLowestIor), float(kHighestIor));
  part.notNegative("dispersion", material.dispersion);
  part.within("attenuationColor", material.attenuationColor, 0, 1);
  if (!(material.attenuationDistance > 0))
    part.fail("attenuationDistance is " + text(material.attenuationDistance) +
              "; it must be above 0, or infinite");
  part.notNegative("scattering", material.scattering);
  part.within("g", material.g, -float(kLargestG), float(kLargestG));
}

void checkPlacement(const Part& part, const Placement& placement) {
  part.place("translation", placement.translation);
  part.within("scale", placement.scale, std::numeric_limits<float>::min(), kLargestCoordinate);
  const quat& q = placement.rotation;
  if (!(std::abs(glm::length(q) - 1) <= kUnitTolerance))
    part.fail("rotation (w, x, y, z) is (" + text(q.w) + ", " + text(q.x) + ", " + text(q.y) + ", " +
              text(q.z) + "); it must be of length 1");
}

void checkWater(const Part& part, const Water& water, const Mesh& mesh) {
  if (water.grid == uvec2(0)) return;  // its mesh is from a file
  part.number("grid of its water", std::min(water.grid.x, water.grid.y), 2, 8192);
  part.within("width of its water", water.size.x, std::numeric_limits<float>::min(), kLargestCoordinate);
  part.within("length of its water", water.size.y, std::numeric_limits<float>::min(), kLargestCoordinate);
  const std::size_t cells = std::size_t{water.grid.x - 1} * (water.grid.y - 1);
  if (mesh.positions.size() != std::size_t{water.grid.x} * water.grid.y || mesh.triangles.size() != 2 * cells)
    part.fail("its mesh is not that of its water; makeWater makes it");
  for (const Wave& wave : water.waves) {
    part.place("amplitude of a wave", wave.amplitude);
    part.positive("wavelength of a wave", wave.wavelength);
    part.place("speed of a wave", wave.speed);
    part.place("phase of a wave", wave.phase);
    part.place("direction of a wave", vec3(wave.direction, 0));
    if (wave.direction == vec2(0)) part.fail("direction of a wave is 0; its length must not be 0");
  }
  if (water.simulation) {
    part.positive("speed of its waves", water.simulation->speed);
    part.notNegative("damping of its waves", water.simulation->damping);
  }
}

void checkObject(const Object& object, std::size_t index, const Scene& scene) {
  const Part part{"object", &object.name, index};
  part.inRange("mesh", object.mesh, scene.meshes.size());
  part.inRange("material", object.material, scene.materials.size());
  checkPlacement(part, object.placement);
  if (object.water) checkWater(part, *object.water, scene.meshOf(object));
}

void checkSpot(const Part& part, const Light& light, const Scene& scene) {
  part.unit("direction", light.direction);
  part.within("outerAngle", light.outerAngle, 0.01f, 180);
  part.within("innerAngle", light.innerAngle, 0, light.outerAngle);
  part.place("goboRotation", light.goboRotation);
  part.optionalIndex("texture", light.goboTexture, scene.textures.size());
  part.optionalIndex("profile", light.profile, scene.profiles.size());
  if (light.goboTexture != kNone && light.outerAngle >= 90)
    part.fail("outerAngle is " + text(light.outerAngle) +
              "; with a gobo, whose image fills the cone, it must be less than 90");
}

void checkArea(const Part& part, const Light& light) {
  part.place("u", light.u);
  part.place("v", light.v);
  const vec3 across = cross(light.v, light.u);
  if (!(length(across) > 0)) part.fail("u and v span no area; they must not be 0 or in one line");
  if (!(dot(light.direction, normalize(across)) > 1 - kUnitTolerance))
    part.fail("direction is " + text(light.direction) + "; it must be cross(v, u), of length 1");
  part.number("grid", std::min(light.grid.x, light.grid.y), 1, kMostAreaSamples);
  part.number("grid", std::max(light.grid.x, light.grid.y), 1, kMostAreaSamples);
}

void checkSkyLight(const Part& part, const Light& light, const Scene& scene) {
  part.inRange("sky", light.skyMap, scene.skies.size());
  part.place("skyRotation", light.skyRotation);
  part.optionalIndex("sun", light.sun, scene.lights.size());
  if (light.sun != kNone && scene.lights[light.sun].type != LightType::directional)
    part.fail("sun is not a directional light");
  for (const SkyPart& sky : light.sky) {
    part.unit("direction of a part of the sky", sky.direction);
    part.notNegative("illuminance of a part of the sky", sky.illuminance);
    for (const vec3 axis : sky.spread) part.place("spread of a part of the sky", axis);
  }
}

void checkLight(const Light& light, std::size_t index, const Scene& scene) {
  const Part part{"light", &light.name, index};
  part.place("position", light.position);
  if (light.type == LightType::directional)
    part.notNegative("illuminance", light.illuminance);
  else
    part.notNegative("intensity", light.intensity);
  part.within("radius", light.radius, 0, kLargestCoordinate);
  part.within("angle", light.angle, 0, kWidestAngle);
  switch (light.type) {
    case LightType::point:
      return;
    case LightType::directional:
      return part.unit("direction", light.direction);
    case LightType::spot:
      return checkSpot(part, light, scene);
    case LightType::line:
      part.place("end", light.end);
      if (light.position == light.end) part.fail("end is where it begins; its length must not be 0");
      return part.number("samples", light.samples, 1, kMostLineSamples);
    case LightType::area:
      return checkArea(part, light);
    case LightType::sky:
      return checkSkyLight(part, light, scene);
  }
}

void checkTexture(const Texture& texture, std::size_t index) {
  const Part part{"texture", &texture.name, index};
  part.number("width", texture.width, 1, 1u << 16);
  part.number("height", texture.height, 1, 1u << 16);
  part.size("texels", texture.texels.size(), std::size_t{texture.width} * texture.height);
  part.allWithin("texel", texture.texels, 0, kLargest);
}

void checkAngles(const Part& part, const char* field, const std::vector<float>& angles, std::size_t least) {
  if (angles.size() < least)
    part.fail(std::string(field) + " holds " + std::to_string(angles.size()) + " values; it must hold " +
              std::to_string(least) + " or more");
  part.allWithin(field, angles, -360, 360);
  if (std::ranges::adjacent_find(angles, std::greater_equal{}) != angles.end())
    part.fail(std::string(field) + " must ascend");
}

void checkProfile(const Profile& profile, std::size_t index) {
  const Part part{"profile", &profile.name, index};
  checkAngles(part, "verticalAngles", profile.verticalAngles, 2);
  checkAngles(part, "horizontalAngles", profile.horizontalAngles, 1);
  part.size("fractions", profile.fractions.size(),
            profile.verticalAngles.size() * profile.horizontalAngles.size());
  part.allWithin("fraction", profile.fractions, 0, 1);
  part.positive("peak", profile.peak);
}

void checkSky(const SkyMap& sky, std::size_t index) {
  const Part part{"sky", &sky.name, index};
  part.number("width", sky.size.x, 1, 1u << 16);
  part.number("height", sky.size.y, 1, 1u << 16);
  part.size("luminance", sky.luminance.size(), std::size_t{sky.size.x} * sky.size.y);
  part.allWithin("luminance", sky.luminance, 0, kLargest);
}

// A light without the parts that its sky is replaced by would be dark without a word.
void checkHasParts(const Light& light, std::size_t index, const Scene& scene) {
  if (light.type != LightType::sky || !light.sky.empty()) return;
  const std::vector<vec3>& luminance = scene.skies[light.skyMap].luminance;
  if (std::ranges::any_of(luminance, [](vec3 cell) { return cell != vec3(0); }))
    Part{"light", &light.name, index}.fail("its sky is in no parts; skyParts makes them");
}

void checkMedium(const Medium& medium) {
  const Part part{"medium"};
  part.notNegative("extinction", medium.extinction);
  part.within("albedo", medium.albedo, 0, 1);
  part.within("g", medium.g, -float(kLargestG), float(kLargestG));
  part.place("fogBase", medium.fogBase);
  part.within("fogHeight", medium.fogHeight, 0, kLargestCoordinate);
}

void checkGrid(const DensityGrid& grid) {
  const Part part{"density grid", &grid.name};
  part.place("corner", grid.corner);
  part.within("size", grid.size, std::numeric_limits<float>::min(), kLargestCoordinate);
  part.number("cells", std::min({grid.cells.x, grid.cells.y, grid.cells.z}), 1, 1u << 16);
  part.size("densities", grid.densities.size(), std::size_t{grid.cells.x} * grid.cells.y * grid.cells.z);
  part.allWithin("density", grid.densities, 0, 1);
}

void checkPlacedObjects(const Scene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) checkObject(scene.objects[i], i, scene);
}

void checkMeshes(const Scene& scene) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    checkMesh(scene.meshes[i], Part{"mesh", &scene.meshes[i].name, i}.label());
}

// What is checked at each frame.
void checkMoving(const Scene& scene) {
  if (!std::isfinite(scene.time)) throw InputError("time is not finite; it must be a number of seconds");
  checkCamera(scene.camera);
  checkEnvironment(scene.environment);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) checkMaterial(scene.materials[i], i, scene);
  checkPlacedObjects(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) checkLight(scene.lights[i], i, scene);
  if (scene.medium) checkMedium(*scene.medium);
}

void requireAsMany(const char* what, std::size_t now, std::size_t before) {
  if (now != before)
    throw InputError("the scene has " + std::to_string(now) + " " + what + " and had " +
                     std::to_string(before) + "; what is drawn anew must have as many");
}

}  // namespace

void checkScene(const Scene& scene) {
  checkMoving(scene);
  checkMeshes(scene);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) checkTexture(scene.textures[i], i);
  for (std::size_t i = 0; i < scene.profiles.size(); ++i) checkProfile(scene.profiles[i], i);
  for (std::size_t i = 0; i < scene.skies.size(); ++i) checkSky(scene.skies[i], i);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) checkHasParts(scene.lights[i], i, scene);
  if (scene.medium && scene.medium->grid) checkGrid(*scene.medium->grid);
  for (const Sensor& sensor : scene.sensors) checkSensor(sensor);
}

void checkObjects(const Scene& scene) {
  checkPlacedObjects(scene);
  checkMeshes(scene);
}

void checkMoved(const Scene& scene, const Scene& before) {
  requireAsMany("meshes", scene.meshes.size(), before.meshes.size());
  requireAsMany("objects", scene.objects.size(), before.objects.size());
  requireAsMany("materials", scene.materials.size(), before.materials.size());
  checkMoving(scene);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object &object = scene.objects[i], &was = before.objects[i];
    const Part part{"object", &object.name, i};
    if (object.mesh != was.mesh)
      part.fail("it has another mesh than before; what is drawn anew must keep it");
    if (!object.water) continue;
    const Mesh &mesh = scene.meshOf(object), &meshBefore = before.meshOf(was);
    if (mesh.triangles.size() != meshBefore.triangles.size() ||
        mesh.positions.size() != meshBefore.positions.size() || mesh.normals.size() != mesh.positions.size())
      part.fail("its water has another mesh than before; only heights may change");
  }
}

void checkSensor(const Sensor& sensor) {
  const Part part{"sensor", &sensor.name};
  part.place("corner", sensor.corner);
  part.place("u", sensor.u);
  part.place("v", sensor.v);
  if (!(length(cross(sensor.v, sensor.u)) > 1e-6f * length(sensor.u) * length(sensor.v)))
    part.fail("u and v span no area; they must be longer than 0 and not parallel");
  part.number("resolution", std::min(sensor.resolution.x, sensor.resolution.y), 1, kLargestSensorSide);
  part.number("resolution", std::max(sensor.resolution.x, sensor.resolution.y), 1, kLargestSensorSide);
}

}  // namespace nephroid

#include "report/missing_light.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "report/counted.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostLinesOfAKind = 3;
constexpr double kNothing = 1e-4;  // of the light onto casters
constexpr double kNotable = 0.01;  // of it, that is lost

// Lines of one kind, of which not all have to be read.
class Lines {
 public:
  explicit Lines(std::vector<std::string>& all) : all_(all) {}
  ~Lines() {
    if (count_ > kMostLinesOfAKind)
      all_.back() += " (and " + counted(count_ - kMostLinesOfAKind, "more like it)", "more like it)");
  }
  void add(const std::string& line) {
    if (++count_ <= kMostLinesOfAKind) all_.push_back(line);
  }

 private:
  std::vector<std::string>& all_;
  std::size_t count_ = 0;
};

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

std::string inPercent(double part) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * part << " %";
  return text.str();
}

// The first object of each mesh that `isMeant`.
template <class IsMeant, class Say>
void forEachMesh(const Scene& scene, const IsMeant& isMeant, const Say& say) {
  std::vector<bool> isSaid(scene.meshes.size(), false);
  for (const Object& object : scene.objects) {
    if (isSaid[object.mesh] || !isMeant(object)) continue;
    isSaid[object.mesh] = true;
    say(object, scene.meshOf(object).findings);
  }
}

bool isGlass(const Scene& scene, const Object& object) {
  const Material& material = scene.materialOf(object);
  return material.type == MaterialType::dielectric && !material.thinWalled;
}

struct Ball {
  vec3 center;
  float radius;
};

std::vector<Ball> castersOf(const Scene& scene) {
  std::vector<Ball> balls;
  for (const Object& object : scene.objects) {
    if (!scene.isCaster(object)) continue;
    const Box bounds = worldBounds(scene, object);
    balls.push_back({bounds.center(), 0.5f * bounds.diagonal()});
  }
  return balls;
}

// Why no light reaches any caster; empty where the scene does not tell.
std::string whyNoneIsReached(const Scene& scene, const std::vector<Ball>& casters) {
  if (scene.lights.empty()) return "the scene has no light";
  std::string away;
  for (const Light& light : scene.lights) {
    if (isDark(light)) continue;
    const bool isReached = std::ranges::any_of(
        casters, [&](const Ball& ball) { return reaches(light, ball.center, ball.radius); });
    if (isReached) return {};
    if (!away.empty()) continue;
    away = light.type == LightType::area
               ? quoted(light.name) + " shines to its other side, that of cross(v, u): swap u and v"
               : quoted(light.name) + " points away from them all: they are outside of its cone";
  }
  return away.empty() ? "every light of the scene has an intensity of 0" : away;
}

// Which of the ways that light goes wrong took most of it.
std::string whyNothingLands(const Scene& scene, const LightBudget& light, const Sensor* sensor) {
  const double absorbed = light.incident - light.landed - light.lost - light.shaded - light.missed;
  const double most = std::max({light.lost, light.shaded, light.missed, absorbed});
  const std::string there = sensor ? "on the sensor " + quoted(sensor->name) : "on anything that receives it";
  if (most == light.shaded) {
    const bool isTurned = std::ranges::any_of(scene.objects, [&](const Object& object) {
      return isGlass(scene, object) && scene.meshOf(object).findings.inwardParts > 0;
    });
    return isTurned ? "casters are in their own shadow, since faces look inward as given"
                    : "something opaque stands between the lights and every caster";
  }
  if (most == light.lost) return "the light stays in the casters: it is totally reflected or trapped";
  if (most == light.missed) return "the light leaves the casters, and does not land " + there;
  return "the casters absorb it";
}

bool isBehind(const Sensor& sensor, const Ball& ball) {
  return dot(ball.center - sensor.corner, sensor.normal()) < -ball.radius;
}

}  // namespace

bool isDark(const Light& light) {
  return (light.type == LightType::directional ? light.illuminance : light.intensity) == vec3(0);
}

bool reaches(const Light& light, vec3 center, float radius) {
  if (isDark(light)) return false;
  const vec3 toCenter = center - light.position;
  if (light.type == LightType::area) return dot(toCenter, light.direction) > -radius;
  if (light.type != LightType::spot) return true;
  const float distance = glm::length(toCenter);
  if (distance <= radius) return true;
  const float offAxis = std::acos(glm::clamp(glm::dot(toCenter / distance, light.direction), -1.0f, 1.0f));
  return offAxis - std::asin(radius / distance) < glm::radians(light.outerAngle);
}

std::vector<std::string> meshWarnings(const Scene& scene) {
  std::vector<std::string> all;
  const auto isCaster = [&](const Object& object) { return scene.isCaster(object); };
  const auto glass = [&](const Object& object) { return isGlass(scene, object) && !object.water; };
  {
    Lines lines(all);
    forEachMesh(scene, isCaster, [&](const Object& object, const MeshFindings& found) {
      if (found.turnedParts == 0) return;
      const bool isOne = found.turnedParts == 1;
      lines.add(quoted(object.name) + ": " +
                counted(found.turnedParts, "closed part of its mesh", "closed parts of its mesh") + " (" +
                counted(found.turnedTriangles, "triangle", "triangles") + ") looked inward and " +
                (isOne ? "was turned" : "were turned") + "; faces = \"as-given\" keeps " +
                (isOne ? "it as a cavity" : "them as cavities"));
    });
  }
  {
    Lines lines(all);
    forEachMesh(scene, glass, [&](const Object& object, const MeshFindings& found) {
      if (found.inwardParts > 0 && found.inwardParts == found.closedParts)
        lines.add(
            quoted(object.name) +
            ": all its faces look inward, as given, so it makes no caustic; without faces = \"as-given\" "
            "they are turned, and a bubble in another object is one whose material has an ior of 1");
    });
  }
  {
    Lines lines(all);
    forEachMesh(scene, isCaster, [&](const Object& object, const MeshFindings& found) {
      if (found.repeatedTriangles > 0)
        lines.add(quoted(object.name) + ": " + counted(found.repeatedTriangles, "triangle", "triangles") +
                  " of its mesh stood twice and " + (found.repeatedTriangles == 1 ? "was" : "were") +
                  " left out");
    });
  }
  {
    Lines lines(all);
    forEachMesh(scene, glass, [&](const Object& object, const MeshFindings& found) {
      if (found.boundaryEdges > 0)
        lines.add(quoted(object.name) + ": its mesh is open (" +
                  counted(found.boundaryEdges, "edge", "edges") +
                  " with one face), so light that goes in may not come out, and its caustic may be poor or "
                  "missing; close it where it is to be solid glass");
    });
  }
  Lines lines(all);
  for (const Object& object : scene.objects)
    if (scene.materialOf(object).type == MaterialType::dielectric && scene.materialOf(object).thinWalled)
      lines.add(quoted(object.name) +
                ": its material is thin-walled (KHR_materials_transmission without a volume thickness), so "
                "light passes straight through and makes no caustic");
  return all;
}

std::vector<std::string> loadWarnings(const Scene& scene) {
  std::vector<std::string> all;
  if (scene.hasDefaultSky)
    all.push_back(
        "the scene has no light, so a clear sky and its sun light it; \"light = []\" leaves it dark");
  for (std::string& line : meshWarnings(scene)) all.push_back(std::move(line));
  return all;
}

std::vector<std::string> missingLight(const Scene& scene, const std::optional<LightBudget>& budget,
                                      const Sensor* sensor) {
  const std::vector<Ball> casters = castersOf(scene);
  if (casters.empty()) {
    if (scene.lights.empty()) return {"the scene has no light"};
    // Light that is seen in the air needs no caster.
    if (scene.medium || scene.objects.empty()) return {};
    return {"nothing makes caustics: no object is a dielectric or a mirror"};
  }
  const std::string dark = whyNoneIsReached(scene, casters);
  if (!dark.empty()) return {"no light reaches any caster: " + dark};
  if (budget && budget->incident <= 0)
    return {"no light reaches any caster: the lights' cones, profiles and gobos leave them dark"};
  if (sensor && std::ranges::all_of(casters, [&](const Ball& ball) { return isBehind(*sensor, ball); }))
    return {"the sensor " + quoted(sensor->name) +
            " faces away from every caster: it faces cross(v, u), so swap u and v to turn it"};
  const bool hasReceiver =
      sensor || std::ranges::any_of(scene.objects, [&](const Object& o) { return !scene.isCaster(o); });
  if (!hasReceiver) return {"nothing receives the light of casters: the scene has no diffuse object"};
  if (!budget) return {};
  if (budget->landed < kNothing * budget->incident)
    return {"there is no caustic: " + whyNothingLands(scene, *budget, sensor)};
  if (!budget->isLossTold || budget->lost <= kNotable * budget->incident) return {};
  return {inPercent(budget->lost / budget->incident) +
          " of the light onto casters is lost in them: it is trapped by reflection, or comes to a hole"};
}

}  // namespace nephroid

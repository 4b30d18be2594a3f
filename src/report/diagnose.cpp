#include "report/diagnose.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "lights/light_intensity.h"
#include "report/counted.h"
#include "report/missing_light.h"
#include "scene/checks.h"
#include "scene/framing.h"
#include "trace/ray_scene.h"

namespace nephroid {
namespace {

constexpr double kFoldsOfAScan = 0.01;  // part of all triangles

// Triangles with a vertex normal on the other side than their winding says.
std::size_t trianglesAgainstNormals(const Mesh& mesh) {
  return static_cast<std::size_t>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](uvec3 t) {
    const vec3 face =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    const vec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return glm::dot(face, sum) < 0;
  }));
}

void judgeSurface(const Mesh& mesh, CasterReport& report) {
  const MeshFindings& found = mesh.findings;
  auto& obstacles = report.obstacles;
  if (!mesh.isClosed && found.boundaryEdges > 0) {
    obstacles.push_back("its mesh is open (" +
                        counted(found.boundaryEdges, "boundary edge", "boundary edges") +
                        "): light that goes in does not come out by a surface everywhere");
  }
  if (found.nonManifoldEdges > 0) {
    obstacles.push_back("its mesh has " +
                        counted(found.nonManifoldEdges, "non-manifold edge", "non-manifold edges") +
                        " with more than two faces: inside and outside are not told apart there");
  }
  if (found.flippedEdges > 0) {
    obstacles.push_back(counted(found.flippedEdges, "edge", "edges") +
                        " of its mesh have faces that run against each other: some are turned inside out");
  }
  if (found.inwardParts > 0) {
    report.notes.push_back(counted(found.inwardParts, "closed part looks", "closed parts look") +
                           " inward, as given");
  }
  const std::size_t against = trianglesAgainstNormals(mesh);
  if (against > 0) {
    // A few folds of a scan do no harm.
    auto& lines = static_cast<double>(against) > kFoldsOfAScan * static_cast<double>(mesh.triangles.size())
                      ? obstacles
                      : report.notes;
    lines.push_back(counted(against, "triangle", "triangles") + " of " +
                    std::to_string(mesh.triangles.size()) +
                    " look another way than the normals at their corners");
  }
}

void judgeMaterial(const Material& material, CasterReport& report) {
  if (material.type != MaterialType::dielectric) return;
  if (material.thinWalled) {
    report.obstacles.push_back(
        "its material is thin-walled (KHR_materials_transmission without a volume thickness): light passes "
        "straight "
        "through");
  }
  if (material.ior == vec3(1)) report.obstacles.push_back("its index of refraction is 1: light is not bent");
}

void judgeLight(const Scene& scene, const Object& object, CasterReport& report) {
  const Box bounds = worldBounds(scene, object);
  const vec3 center = bounds.center();
  const float radius = 0.5f * bounds.diagonal();
  if (scene.lights.empty()) {
    report.obstacles.push_back("no light reaches it: the scene has none");
    return;
  }
  const auto bright =
      std::count_if(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return !isDark(l); });
  const auto reaching = std::count_if(scene.lights.begin(), scene.lights.end(),
                                      [&](const Light& l) { return reaches(l, center, radius); });
  if (bright == 0) {
    report.obstacles.push_back("no light reaches it: the intensity of every light is 0");
  } else if (reaching == 0) {
    report.obstacles.push_back(
        "no light reaches it: it is outside the cone, or behind the side, of every light");
  }
  for (const Light& light : scene.lights) {
    const bool hasPlace = light.type == LightType::point || light.type == LightType::spot;
    if (hasPlace && bounds.holdsInside({light.position, light.position})) {
      report.notes.push_back("the light \"" + light.name + "\" is inside its bounding box");
    }
  }
}

CasterReport judge(const Scene& scene, uint32_t index, bool hasReceiver) {
  const Object& object = scene.objects[index];
  const Mesh& mesh = scene.meshOf(object);
  CasterReport report;
  report.object = index;
  report.boundaryEdges = mesh.findings.boundaryEdges;
  report.nonManifoldEdges = mesh.findings.nonManifoldEdges;
  // A mirror sends light on from each face by itself, and water is open by its nature.
  if (scene.materialOf(object).type == MaterialType::dielectric && !object.water) {
    judgeSurface(mesh, report);
  }
  judgeMaterial(scene.materialOf(object), report);
  judgeLight(scene, object, report);
  if (!hasReceiver)
    report.obstacles.push_back("nothing receives its light: the scene has no diffuse object and no sensor");
  return report;
}

std::vector<TouchingPair> touchingPairs(const Scene& scene) {
  const RayScene rays(scene);
  const Contacts& contacts = rays.contacts();
  std::map<std::pair<uint32_t, uint32_t>, TouchingPair> pairs;
  for (uint32_t object = 0; object < contacts.setOf.size(); ++object)
    for (uint32_t triangle = 0; triangle < contacts.setOf[object].size(); ++triangle)
      for (const uint32_t other : contacts.around(object, triangle)) {
        const auto [low, high] = std::minmax(object, other);
        TouchingPair& pair = pairs[{low, high}];
        pair.objects[0] = low;
        pair.objects[1] = high;
        ++pair.triangles[object == high];
      }
  std::vector<TouchingPair> all;
  for (const auto& [key, pair] : pairs) all.push_back(pair);
  return all;
}

void warnAboutScene(const Scene& scene, SceneReport& report) {
  auto& warnings = report.warnings;
  warnings = loadWarnings(scene);
  if (scene.objects.empty()) warnings.push_back("the scene has no objects");
  for (const std::string& line : missingLight(scene, std::nullopt)) warnings.push_back(line);
  if (report.droppedTriangles > 0) {
    warnings.push_back(counted(report.droppedTriangles, "triangle", "triangles") +
                       " without an area left out");
  }
  for (const Material& material : scene.materials) {
    if (material.emission != vec3(0)) {
      warnings.push_back("the material \"" + material.name + "\" glows, but lights nothing else");
    }
  }
}

// What shapes a light besides its cone.
std::string describeShape(const Scene& scene, const Light& light) {
  std::ostringstream text;
  if (light.radius > 0) text << "  " << light.name << ": a ball of radius " << light.radius << " m\n";
  if (light.angle > 0) text << "  " << light.name << ": a disk, seen under " << light.angle << " degrees\n";
  if (light.goboTexture != kNone) {
    const Texture& gobo = scene.textures[light.goboTexture];
    text << "  " << light.name << ": gobo " << gobo.name << " (" << gobo.width << " x " << gobo.height
         << ")\n";
  }
  if (light.profile != kNone) {
    const Profile& profile = scene.profiles[light.profile];
    text << "  " << light.name << ": profile " << profile.name << " (type "
         << "CBA"[int(profile.type)] << ", " << profile.verticalAngles.size() << " vertical x "
         << profile.horizontalAngles.size() << " horizontal angles; by itself " << profile.peak
         << " cd at its peak, " << profileFlux(profile) << " lm)\n";
  }
  return text.str();
}

const char* nameOf(MaterialType type) {
  switch (type) {
    case MaterialType::dielectric:
      return "dielectric";
    case MaterialType::mirror:
      return "mirror";
    case MaterialType::diffuse:
      break;
  }
  return "diffuse";
}

}  // namespace

SceneReport diagnose(const Scene& scene) {
  checkScene(scene);
  SceneReport report;
  report.objects = scene.objects.size();
  report.materials = scene.materials.size();
  report.textures = scene.textures.size();
  report.lights = scene.lights.size();
  report.sensors = scene.sensors.size();
  for (const Object& object : scene.objects) {
    ++(scene.isCaster(object) ? report.casters : report.receivers);
    report.triangles += scene.meshOf(object).triangles.size();
    report.vertices += scene.meshOf(object).positions.size();
    report.droppedTriangles += scene.meshOf(object).droppedTriangles;
  }
  const bool hasReceiver = report.receivers > 0 || report.sensors > 0;
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.isCaster(scene.objects[i])) report.casterReports.push_back(judge(scene, i, hasReceiver));
  }
  report.touching = touchingPairs(scene);
  warnAboutScene(scene, report);
  return report;
}

std::string describe(const Scene& scene, const SceneReport& report) {
  std::ostringstream text;
  text << scene.file.string() << "\n"
       << "  " << counted(report.objects, "object", "objects") << " ("
       << counted(report.casters, "caster", "casters") << ", "
       << counted(report.receivers, "receiver", "receivers") << "), "
       << counted(report.triangles, "triangle", "triangles") << ", "
       << counted(report.vertices, "vertex", "vertices") << "\n"
       << "  " << counted(report.materials, "material", "materials") << ", "
       << counted(report.textures, "texture", "textures") << ", " << counted(report.lights, "light", "lights")
       << ", " << counted(report.sensors, "sensor", "sensors") << "\n";
  for (const Light& light : scene.lights) text << describeShape(scene, light);
  std::size_t hindered = 0;
  for (const CasterReport& caster : report.casterReports) {
    const Object& object = scene.objects[caster.object];
    const Mesh& mesh = scene.meshOf(object);
    hindered += caster.obstacles.empty() ? 0u : 1u;
    text << "  " << object.name << ": " << nameOf(scene.materialOf(object).type) << ", "
         << counted(mesh.triangles.size(), "triangle", "triangles") << ", "
         << (object.water    ? "water"
             : mesh.isClosed ? "closed"
                             : "open");
    text << (caster.obstacles.empty() ? "; makes caustics\n" : "; will make no caustics, or poor ones:\n");
    for (const std::string& obstacle : caster.obstacles) text << "    - " << obstacle << "\n";
    for (const std::string& note : caster.notes) text << "    (" << note << ")\n";
  }
  if (hindered > 0) {
    text << "  " << hindered << " of " << counted(report.casters, "caster", "casters")
         << " will make no caustics, or poor ones\n";
  }
  for (const TouchingPair& pair : report.touching) {
    text << "  " << scene.objects[pair.objects[0]].name << " and " << scene.objects[pair.objects[1]].name
         << " touch (" << pair.triangles[0] << " and " << counted(pair.triangles[1], "triangle", "triangles")
         << "): one boundary for light\n";
  }
  for (const std::string& warning : report.warnings) text << "  warning: " << warning << "\n";
  return text.str();
}

}  // namespace nephroid

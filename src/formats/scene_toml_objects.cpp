#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <tuple>

#include "core/error.h"
#include "formats/gltf.h"
#include "formats/mesh_file.h"
#include "formats/scene_toml.h"
#include "formats/scene_toml_imports.h"
#include "geometry/bounds.h"
#include "geometry/mesh_density.h"
#include "scene/dispersion.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

constexpr double kMostShapeVertices = 4e6;
constexpr double kVertexSlack = 1.1;

Material readDielectric(TomlTable& table) {
  Material material;
  material.color = vec3(1);
  material.ior = table.numberOrRgb("ior", kIor).value_or(material.ior);
  if (const auto abbe = table.number("abbe", kAbbe)) {
    if (material.isDispersive() || material.ior.y < 1)
      table.fail("abbe", "needs an \"ior\" of one number, 1 or more: the index at 587.6 nm");
    setDispersion(material, material.ior.y, 20 / *abbe);
  }
  const auto color = table.vector3("attenuation_color", kFraction);
  const auto distance = table.number("attenuation_distance", kPositive);
  if (color && !distance) table.fail("attenuation_color", "needs \"attenuation_distance\" (m) beside it");
  material.attenuationColor = color.value_or(material.attenuationColor);
  if (distance) material.attenuationDistance = static_cast<float>(*distance);
  for (const char* key : {"phase", "g"})
    if (table.has(key) && !table.has("scattering")) table.fail(key, "needs \"scattering\" (1/m) beside it");
  if (const auto scattering = table.numberOrRgb("scattering", kNotNegative)) {
    material.scattering = *scattering;
    readPhase(table, material.phase, material.g);
  }
  return material;
}

uint32_t materialNamed(TomlTable& table, const Scene& scene) {
  const std::string name = table.requiredText("material");
  std::vector<std::string> names;
  for (uint32_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name) return i;
    names.push_back(scene.materials[i].name);
  }
  const std::string nearest = nearestName(name, names);
  table.fail("material", "is \"" + name + "\", and no [[material]] has that name" +
                             (nearest.empty() ? "" : "; the nearest is \"" + nearest + "\""));
}

struct ObjectTransform {
  Placement placement;
  std::optional<float> fit;
};

ObjectTransform readTransform(TomlTable& table) {
  ObjectTransform transform;
  transform.placement.translation = table.vector3("translation").value_or(vec3(0));
  transform.placement.rotation = rotationOf(table.vector3("rotation").value_or(vec3(0)));
  const auto scale = table.number("scale", kPositive);
  const auto fit = table.number("fit", kPositive);
  if (scale && fit) table.fail("fit", "and \"scale\" cannot both be given");
  if (fit) transform.fit = static_cast<float>(*fit);
  transform.placement.scale = static_cast<float>(scale.value_or(1));
  return transform;
}

// Centers the box on the origin and makes its longest side `fit`, before the rest of the placement.
Placement fitted(const ObjectTransform& transform, const Box& box) {
  Placement placement = transform.placement;
  if (!transform.fit) return placement;
  placement.scale = *transform.fit / box.longestSide();
  placement.translation += placement.rotation * (-placement.scale * box.center());
  return placement;
}

Box boundsOf(const GltfPart& part) {
  Box bounds;
  for (const Object& object : part.objects)
    bounds.include(placedBox(boundingBox(part.meshes[object.mesh]), object.placement));
  return bounds;
}

Placement placed(const Placement& outer, const Placement& inner) {
  return {outer.point(inner.translation), glm::normalize(outer.rotation * inner.rotation),
          outer.scale * inner.scale};
}

Camera placed(const Placement& outer, Camera camera) {
  camera.position = outer.point(camera.position);
  camera.target = outer.point(camera.target);
  camera.up = outer.direction(camera.up);
  return camera;
}

template <class Element>
void append(std::vector<Element>& to, std::vector<Element>& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

void addTo(Scene& scene, GltfPart part, const Placement& placement, const std::string& prefix) {
  for (Material& material : part.materials) {
    material.name = prefix + material.name;
    if (material.colorTexture != kNone) material.colorTexture += static_cast<uint32_t>(scene.textures.size());
  }
  for (Object& object : part.objects) {
    object.name = prefix + object.name;
    object.mesh += static_cast<uint32_t>(scene.meshes.size());
    object.material += static_cast<uint32_t>(scene.materials.size());
    object.placement = placed(placement, object.placement);
  }
  for (Light& light : part.lights) {
    light.name = prefix + light.name;
    light.position = placement.point(light.position);
    light.direction = placement.direction(light.direction);
  }
  append(scene.textures, part.textures);
  append(scene.materials, part.materials);
  append(scene.meshes, part.meshes);
  append(scene.objects, part.objects);
  append(scene.lights, part.lights);
}

Faces readFaces(TomlTable& table) {
  constexpr std::array kFaces{Faces::outward, Faces::asGiven};
  return kFaces[table.choice("faces", {"outward", "as-given"})];
}

class ObjectReader {
 public:
  ObjectReader(Scene& scene, WaveRuns* waves) : scene_(scene), waves_(waves) {}

  std::optional<Camera> camera;  // the first that was imported

  void read(TomlTable& table) {
    Object object;
    object.name = readName(table, scene_.objects, "object " + std::to_string(scene_.objects.size() + 1));
    table.setName("[[object]] \"" + object.name + "\"");
    if (table.has("shape") + table.has("mesh") + table.has("import") != 1) {
      throw InputError(oneLine(table.at("") + "needs one of \"shape\", \"mesh\" and \"import\""));
    }
    if (table.has("import")) return import(table, object.name);
    object.material = materialNamed(table, scene_);
    const ObjectTransform transform = readTransform(table);
    object.mesh = table.has("mesh") ? meshFrom(table) : added(readShape(table, object, scene_, waves_));
    object.placement = fitted(transform, boundingBox(scene_.meshOf(object)));
    table.finish();
    scene_.objects.push_back(object);
  }

 private:
  uint32_t added(Mesh mesh) {
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<uint32_t>(scene_.meshes.size() - 1);
  }

  uint32_t meshFrom(TomlTable& table) {
    const std::string name = table.requiredText("mesh");
    const auto path = findModel(name, scene_.file.parent_path(), table.at("mesh"));
    const auto vertices =
        static_cast<uint32_t>(table.integer("vertices", {4, kMostShapeVertices}).value_or(0));
    const Faces faces = readFaces(table);
    const auto known = meshOfFile_.find({path, vertices, faces});
    if (known != meshOfFile_.end()) return known->second;
    Mesh mesh = loadMeshFile(path, faces);
    mesh.name = name;
    if (vertices > 0) mesh = withVertices(mesh, vertices, table.at("vertices"));
    if (vertices > 0 && mesh.positions.size() > kVertexSlack * vertices) {
      table.fail("vertices", "is too few: the mesh cannot be simplified to less than " +
                                 std::to_string(mesh.positions.size()));
    }
    return meshOfFile_[{path, vertices, faces}] = added(std::move(mesh));
  }

  // The names of what is imported begin with the object's.
  void import(TomlTable& table, const std::string& name) {
    const std::string file = table.requiredText("import");
    const ObjectTransform transform = readTransform(table);
    const Faces faces = readFaces(table);
    ImportChanges changes = importChanges(table);
    table.finish();
    const auto path = findModel(file, scene_.file.parent_path(), table.at("import"));
    if (lowerExtension(path) != ".gltf" && lowerExtension(path) != ".glb") {
      table.fail("import", "takes a .gltf or .glb file; for the geometry of others use \"mesh\"");
    }
    GltfPart part = loadGltf(path, faces);
    if (part.objects.empty() && transform.fit) table.fail("fit", "cannot be used: the file has no geometry");
    const Placement placement = transform.fit ? fitted(transform, boundsOf(part)) : transform.placement;
    if (part.camera && !camera) camera = placed(placement, *part.camera);
    addTo(scene_, std::move(part), placement, name + "/");
    applyImportChanges(std::move(changes), name + "/", scene_);
  }

  Scene& scene_;
  WaveRuns* waves_;
  // By file, "vertices" and "faces".
  std::map<std::tuple<std::filesystem::path, uint32_t, Faces>, uint32_t> meshOfFile_;
};

}  // namespace

quat rotationOf(vec3 degrees) {
  const vec3 angles = glm::radians(degrees);
  return glm::angleAxis(angles.z, vec3(0, 0, 1)) * glm::angleAxis(angles.y, vec3(0, 1, 0)) *
         glm::angleAxis(angles.x, vec3(1, 0, 0));
}

void readMaterials(std::vector<TomlTable> tables, Scene& scene) {
  for (TomlTable& table : tables) {
    table.requiredText("name");
    const std::string name = readName(table, scene.materials, "");
    table.setName("[[material]] \"" + name + "\"");
    if (!table.has("type")) table.requiredText("type");
    constexpr std::array kTypes{MaterialType::diffuse, MaterialType::dielectric, MaterialType::mirror};
    const MaterialType type = kTypes[table.choice("type", {"diffuse", "dielectric", "mirror"})];
    Material material;
    if (type == MaterialType::dielectric) {
      material = readDielectric(table);
    } else {
      const vec3 byDefault(type == MaterialType::mirror ? 1.0f : 0.8f);
      material.color = table.numberOrRgb("color", kFraction).value_or(byDefault);
    }
    material.name = name;
    material.type = type;
    table.finish();
    scene.materials.push_back(material);
  }
}

std::optional<Camera> readObjects(std::vector<TomlTable> tables, Scene& scene, WaveRuns* waves) {
  ObjectReader reader(scene, waves);
  for (TomlTable& table : tables) reader.read(table);
  return reader.camera;
}

}  // namespace nephroid

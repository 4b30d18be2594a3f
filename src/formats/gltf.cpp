#include "formats/gltf.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/default_sky.h"
#include "formats/gltf_material.h"
#include "geometry/mesh_checks.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

using dmat3 = glm::dmat3;
using dmat4 = glm::dmat4;
using dvec3 = glm::dvec3;

constexpr double kLargestCoordinate = 1e9;  // m

// What a node's transform comes to: a placement, and what is left over for the mesh itself.
struct SplitTransform {
  Placement placement;
  std::optional<dmat4> baked;  // when the transform is not a rigid motion and a uniform scale: all of it
};

dmat4 localTransform(const GltfFile& file, const tinygltf::Node& node) {
  for (const auto* numbers : {&node.matrix, &node.translation, &node.rotation, &node.scale}) {
    for (const double number : *numbers) {
      if (!(std::abs(number) <= kLargestCoordinate))
        file.fail("node \"" + node.name + "\" has a transform that is not finite");
    }
  }
  dmat4 matrix(1);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return matrix;
  }
  if (node.rotation.size() == 4) {
    const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(glm::length(q) > 1e-9)) file.fail("node \"" + node.name + "\" has a rotation of length 0");
    matrix = glm::mat4_cast(glm::normalize(q));
  }
  for (int k = 0; k < 3 && node.scale.size() == 3; ++k) matrix[k] *= node.scale[static_cast<std::size_t>(k)];
  for (int k = 0; k < 3 && node.translation.size() == 3; ++k)
    matrix[3][k] = node.translation[static_cast<std::size_t>(k)];
  return matrix;
}

SplitTransform split(const dmat4& world) {
  const dmat3 linear(world);
  const double determinant = glm::determinant(linear);
  const double scale = std::cbrt(std::abs(determinant));
  const dmat3 rotation = linear / scale, product = glm::transpose(rotation) * rotation;
  double error = determinant > 0 ? 0 : 1;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) error = std::max(error, std::abs(product[i][j] - (i == j ? 1 : 0)));
  }
  SplitTransform result;
  if (error > 1e-5) {
    result.baked = world;
    return result;
  }
  result.placement = {vec3(world[3]), quat(glm::normalize(glm::quat_cast(rotation))),
                      static_cast<float>(scale)};
  return result;
}

void bake(Mesh& mesh, const dmat4& transform) {
  const dmat3 linear(transform), forNormals = glm::transpose(glm::inverse(linear));
  const bool isMirrored = glm::determinant(linear) < 0;
  for (vec3& p : mesh.positions) p = vec3(transform * glm::dvec4(p, 1));
  for (vec3& n : mesh.normals) n = vec3(glm::normalize(forNormals * dvec3(n)));
  for (uvec3& t : mesh.triangles) {
    if (isMirrored) std::swap(t.y, t.z);
  }
}

void addTriangles(const GltfFile& file, int mode, const std::vector<uint32_t>& corners, Mesh& mesh) {
  if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      mesh.triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
      mesh.triangles.emplace_back(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      mesh.triangles.emplace_back(corners[0], corners[i], corners[i + 1]);
  } else {
    file.fail("a mesh is drawn in mode " + std::to_string(mode) + ", which does not exist");
  }
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& path, Faces faces) : file_(openGltf(path)), faces_(faces) {}

  GltfPart read() {
    struct Visit {
      int node;
      dmat4 parent;
    };
    std::vector<Visit> visits;
    for (const int root : roots()) visits.push_back({root, dmat4(1)});
    std::reverse(visits.begin(), visits.end());
    std::vector<bool> seen(file_.model.nodes.size());
    while (!visits.empty()) {
      const Visit visit = visits.back();
      visits.pop_back();
      const std::size_t index = gltfIndex(file_, visit.node, file_.model.nodes.size(), "node");
      if (seen[index])
        file_.fail("node " + std::to_string(index) + " is reached twice; nodes must form a tree");
      seen[index] = true;
      const tinygltf::Node& node = file_.model.nodes[index];
      const dmat4 world = visit.parent * localTransform(file_, node);
      addNode(node, world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        visits.push_back({*child, world});
    }
    return std::move(part_);
  }

 private:
  std::vector<int> roots() const {
    const auto& model = file_.model;
    if (!model.scenes.empty()) {
      return model.scenes[gltfIndex(file_, std::max(model.defaultScene, 0), model.scenes.size(), "scene")]
          .nodes;
    }
    std::vector<bool> isChild(model.nodes.size());
    for (const auto& node : model.nodes) {
      for (const int child : node.children)
        isChild[gltfIndex(file_, child, model.nodes.size(), "node")] = true;
    }
    std::vector<int> result;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      if (!isChild[i]) result.push_back(static_cast<int>(i));
    }
    return result;
  }

  void addNode(const tinygltf::Node& node, const dmat4& world) {
    for (int i = 0; i < 16; ++i) {
      if (!(std::abs(world[i / 4][i % 4]) <= kLargestCoordinate))
        file_.fail("node \"" + node.name + "\" lies farther than 1e9 m away");
    }
    if (node.mesh >= 0) addMesh(node, world);
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end()) addLight(light->second, world);
    if (node.camera >= 0 && !part_.camera) addCamera(node.camera, world);
  }

  void addMesh(const tinygltf::Node& node, const dmat4& world) {
    if (!(std::abs(glm::determinant(dmat3(world))) > 1e-30)) {
      file_.fail("node \"" + node.name + "\" has a scale of zero; it must not be");
    }
    const auto& mesh = file_.model.meshes[gltfIndex(file_, node.mesh, file_.model.meshes.size(), "mesh")];
    const SplitTransform transform = split(world);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const auto& primitive = mesh.primitives[i];
      const bool hasSurface =
          primitive.mode != TINYGLTF_MODE_POINTS && primitive.mode != TINYGLTF_MODE_LINE &&
          primitive.mode != TINYGLTF_MODE_LINE_LOOP && primitive.mode != TINYGLTF_MODE_LINE_STRIP;
      if (!hasSurface) continue;
      Object object;
      object.name = freeName(!node.name.empty() ? node.name : !mesh.name.empty() ? mesh.name : "object");
      object.material = materialOf(primitive.material);
      object.mesh = meshOf(node.mesh, i, primitive, transform.baked);
      object.placement = transform.placement;
      part_.objects.push_back(std::move(object));
    }
  }

  std::string freeName(const std::string& wanted) {
    const int uses = ++nameUses_[wanted];
    return uses == 1 ? wanted : freeName(wanted + " " + std::to_string(uses));
  }

  uint32_t materialOf(int index) {
    const auto known = materials_.find(index);
    if (known != materials_.end()) return known->second;
    GltfMaterial read = readGltfMaterial(file_, index);
    if (read.image >= 0) read.material.colorTexture = textureOf(read.image);
    materials_[index] = static_cast<uint32_t>(part_.materials.size());
    part_.materials.push_back(read.material);
    return materials_[index];
  }

  uint32_t textureOf(int image) {
    const auto known = textures_.find(image);
    if (known != textures_.end()) return known->second;
    textures_[image] = static_cast<uint32_t>(part_.textures.size());
    part_.textures.push_back(readGltfImage(file_, image));
    return textures_[image];
  }

  uint32_t meshOf(int index, std::size_t primitiveIndex, const tinygltf::Primitive& primitive,
                  const std::optional<dmat4>& baked) {
    const auto next = static_cast<uint32_t>(part_.meshes.size());
    if (baked) {
      Mesh mesh = readPrimitive(index, primitiveIndex, primitive);
      bake(mesh, *baked);
      finishMesh(mesh, file_.source + ": mesh \"" + mesh.name + "\"", faces_);
      part_.meshes.push_back(std::move(mesh));
      return next;
    }
    const auto [entry, isNew] = meshes_.try_emplace({index, primitiveIndex}, next);
    if (isNew) part_.meshes.push_back(readPrimitive(index, primitiveIndex, primitive));
    return entry->second;
  }

  Mesh readPrimitive(int index, std::size_t primitiveIndex, const tinygltf::Primitive& primitive) {
    Mesh mesh;
    const std::string& name = file_.model.meshes[static_cast<std::size_t>(index)].name;
    mesh.name = (name.empty() ? "mesh " + std::to_string(index) : name) +
                (primitiveIndex > 0 ? "." + std::to_string(primitiveIndex) : "");
    const std::string source = file_.source + ": mesh \"" + mesh.name + "\"";
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) file_.fail("mesh \"" + mesh.name + "\" has no positions");
    mesh.positions = vectors(position->second);
    const auto normal = primitive.attributes.find("NORMAL");
    if (normal != primitive.attributes.end()) mesh.normals = vectors(normal->second);
    const GltfMaterial material = readGltfMaterial(file_, primitive.material);
    if (material.image >= 0) readTexcoords(primitive, material, mesh);
    std::vector<uint32_t> corners;
    if (primitive.indices >= 0) {
      corners = readGltfIndices(file_, primitive.indices);
    } else {
      for (uint32_t i = 0; i < mesh.positions.size(); ++i) corners.push_back(i);
    }
    addTriangles(file_, primitive.mode, corners, mesh);
    finishMesh(mesh, source, faces_);
    return mesh;
  }

  std::vector<vec3> vectors(int accessor) {
    const GltfNumbers numbers = readGltfNumbers(file_, accessor, 3, 3);
    std::vector<vec3> result(numbers.count());
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = vec3(numbers.values[3 * i], numbers.values[3 * i + 1], numbers.values[3 * i + 2]);
    }
    return result;
  }

  void readTexcoords(const tinygltf::Primitive& primitive, const GltfMaterial& material, Mesh& mesh) {
    const auto found = primitive.attributes.find("TEXCOORD_" + std::to_string(material.texcoordSet));
    if (found == primitive.attributes.end()) {
      mesh.texcoords.assign(mesh.positions.size(), vec2(0));
      return;
    }
    const GltfNumbers numbers = readGltfNumbers(file_, found->second, 2, 2);
    if (numbers.count() != mesh.positions.size())
      file_.fail("mesh \"" + mesh.name + "\" has another number of texture coordinates than of positions");
    for (std::size_t i = 0; i < numbers.count(); ++i) {
      mesh.texcoords.emplace_back(material.texcoordTransform *
                                  dvec3(numbers.values[2 * i], numbers.values[2 * i + 1], 1));
    }
  }

  void addLight(const tinygltf::Value& extension, const dmat4& world) {
    const int index = extension.Has("light") && extension.Get("light").IsNumber()
                          ? extension.Get("light").GetNumberAsInt()
                          : -1;
    const auto& given = file_.model.lights[gltfIndex(file_, index, file_.model.lights.size(), "light")];
    Light light;
    light.name = freeName(given.name.empty() ? "light" : given.name);
    light.position = vec3(world[3]);
    const dvec3 direction = dmat3(world) * dvec3(0, 0, -1);
    if (!(glm::length(direction) > 1e-12))
      file_.fail("light \"" + light.name + "\" stands in a node with a scale of zero");
    light.direction = vec3(glm::normalize(direction));
    light.intensity = vec3(static_cast<float>(given.intensity));
    for (std::size_t k = 0; k < 3 && given.color.size() >= 3; ++k)
      light.intensity[static_cast<int>(k)] *= static_cast<float>(given.color[k]);
    for (int k = 0; k < 3; ++k) {
      if (!(light.intensity[k] >= 0 && light.intensity[k] <= 1e12f)) {
        file_.fail("light \"" + light.name + "\" must have an intensity from 0 to 1e12");
      }
    }
    light.illuminance = light.intensity;
    setType(given, light);
    part_.lights.push_back(light);
  }

  void setType(const tinygltf::Light& given, Light& light) {
    if (given.type == "point") {
      light.type = LightType::point;
    } else if (given.type == "directional") {
      light.type = LightType::directional;
    } else if (given.type == "spot") {
      light.type = LightType::spot;
      light.innerAngle = static_cast<float>(glm::degrees(given.spot.innerConeAngle));
      light.outerAngle = static_cast<float>(glm::degrees(given.spot.outerConeAngle));
      const bool isRight = light.innerAngle >= 0 && light.innerAngle <= light.outerAngle &&
                           light.outerAngle > 0 && light.outerAngle <= 90.001f;
      if (!isRight)
        file_.fail("light \"" + light.name + "\" must have 0 <= innerConeAngle <= outerConeAngle <= pi / 2");
      light.outerAngle = std::min(light.outerAngle, 90.0f);
    } else {
      file_.fail("light \"" + light.name + "\" is of type \"" + given.type +
                 "\"; it must be point, spot or directional");
    }
  }

  void addCamera(int index, const dmat4& world) {
    const auto& given = file_.model.cameras[gltfIndex(file_, index, file_.model.cameras.size(), "camera")];
    if (given.type != "perspective") return;
    const dvec3 view = dmat3(world) * dvec3(0, 0, -1), up = dmat3(world) * dvec3(0, 1, 0);
    const double fov = glm::degrees(given.perspective.yfov);
    if (!(fov > 0 && fov < 180 && glm::length(glm::cross(view, up)) > 0))
      file_.fail("camera " + std::to_string(index) + " is degenerate; yfov must be from 0 to pi");
    Camera camera;
    camera.position = vec3(world[3]);
    camera.target = vec3(dvec3(world[3]) + glm::normalize(view));
    camera.up = vec3(glm::normalize(up));
    camera.verticalFov = static_cast<float>(fov);
    part_.camera = camera;
  }

  GltfFile file_;
  Faces faces_;
  GltfPart part_;
  std::map<int, uint32_t> materials_, textures_;
  std::map<std::pair<int, std::size_t>, uint32_t> meshes_;
  std::map<std::string, int> nameUses_;
};

}  // namespace

GltfPart loadGltf(const std::filesystem::path& file, Faces faces) {
  return GltfReader(file, faces).read();
}

Mesh loadGltfMesh(const std::filesystem::path& file, Faces faces) {
  const GltfPart part = loadGltf(file, faces);
  Mesh mesh;
  for (const Object& object : part.objects) {
    const Mesh& piece = part.meshes[object.mesh];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const vec3 p : piece.positions) mesh.positions.push_back(object.placement.point(p));
    for (const vec3 n : piece.normals) mesh.normals.push_back(object.placement.direction(n));
    for (const uvec3 t : piece.triangles) mesh.triangles.push_back(t + first);
    mesh.droppedTriangles += piece.droppedTriangles;
    mesh.findings.repeatedTriangles += piece.findings.repeatedTriangles;
    mesh.findings.turnedParts += piece.findings.turnedParts;
    mesh.findings.turnedTriangles += piece.findings.turnedTriangles;
  }
  finishMesh(mesh, file.string(), faces);
  return mesh;
}

Scene loadGltfScene(const std::filesystem::path& file, double time) {
  GltfPart part = loadGltf(file);
  Scene scene;
  scene.file = file;
  scene.time = time;
  scene.textures = std::move(part.textures);
  scene.materials = std::move(part.materials);
  scene.meshes = std::move(part.meshes);
  scene.objects = std::move(part.objects);
  scene.lights = std::move(part.lights);
  scene.camera = part.camera ? *part.camera : framingCamera(scene);
  lightByDefault(scene, false);
  return scene;
}

}  // namespace nephroid

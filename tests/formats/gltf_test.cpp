#include "formats/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/load.h"
#include "formats/save_scene.h"
#include "formats/scene_toml.h"
#include "geometry/bounds.h"
#include "geometry/mesh_checks.h"
#include "report/diagnose.h"
#include "support/scratch_files.h"
#include "support/shared_data.h"

namespace nephroid {
namespace {

std::string base64(const std::string& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

template <class Value>
std::string bytesOf(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Value), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// A tetrahedron: four positions, then twelve indices of one byte.
const std::string kBytes = bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
                           bytesOf<uint8_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});

struct Parts {
  std::string nodes = R"([{"mesh": 0}])";
  std::string materials = "[{}]";
  std::string more;  // further members, each ending in a comma
  std::string accessors =
      R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
          {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}])";
  std::string views =
      R"([{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
  std::string primitive = R"({"attributes": {"POSITION": 0}, "indices": 1, "material": 0})";
};

std::string gltf(const Parts& parts) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": )" + parts.nodes +
         R"(, "materials": )" + parts.materials + ", " + parts.more + R"("meshes": [{"primitives": [)" +
         parts.primitive + R"(]}], "accessors": )" + parts.accessors + R"(, "bufferViews": )" + parts.views +
         R"(, "buffers": [{"byteLength": )" + std::to_string(kBytes.size()) +
         R"(, "uri": "data:application/octet-stream;base64,)" + base64(kBytes) + R"("}]})";
}

class Gltf : public ScratchFiles {
 protected:
  Scene load(const Parts& parts) const { return loadScene(write("t.gltf", gltf(parts))); }
  Material material(const std::string& json) const {
    Parts parts;
    parts.materials = "[" + json + "]";
    return load(parts).materials.at(0);
  }
  void expectError(const Parts& parts, const std::string& part) const {
    const std::string error = inputErrorOf([&] { load(parts); });
    EXPECT_NE(error.find("t.gltf"), std::string::npos) << "lacks the file: " << error;
    EXPECT_NE(error.find(part), std::string::npos) << error << "\nlacks: " << part;
  }
};

TEST_F(Gltf, ReadsAMeshAndFindsItsNormals) {
  const Scene scene = load({});
  ASSERT_EQ(scene.objects.size(), 1u);
  const Mesh& mesh = scene.meshOf(scene.objects[0]);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(mesh.isClosed);
  EXPECT_NEAR(meshTopology(mesh).signedVolume, 1.0 / 6, 1e-6);
  EXPECT_EQ(mesh.normals.size(), 12u);  // a tetrahedron has no smooth corner
}

TEST_F(Gltf, ARigidNodeStaysAPlacement) {
  Parts parts;
  parts.nodes = R"([{"children": [1], "translation": [0, 10, 0]},
                    {"mesh": 0, "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 2, 2]}])";
  const Scene scene = load(parts);
  const Placement& placement = scene.objects.at(0).placement;
  EXPECT_NEAR(placement.scale, 2, 1e-5);
  EXPECT_LT(glm::distance(placement.point({1, 0, 0}), vec3(0, 12, 0)), 1e-5f);
  EXPECT_LT(glm::distance(scene.meshes[0].positions[scene.meshes[0].triangles[0].z], vec3(1, 0, 0)), 1e-6f);
}

TEST_F(Gltf, ShearStretchAndMirroringAreBakedAndStayOutward) {
  for (const char* node :
       {R"([{"mesh": 0, "scale": [1, 2, 3]}])", R"([{"mesh": 0, "scale": [-1, 2, 3]}])",
        R"([{"mesh": 0, "matrix": [1, 0, 0, 0, 0.5, 2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 1]}])"}) {
    Parts parts;
    parts.nodes = node;
    const Scene scene = load(parts);
    const MeshTopology topology = meshTopology(scene.meshOf(scene.objects.at(0)));
    EXPECT_EQ(scene.objects[0].placement.scale, 1);
    EXPECT_NEAR(topology.signedVolume, 1, 1e-5) << node;
    EXPECT_EQ(scene.meshes.size(), 1u);
    for (const CasterReport& caster : diagnose(scene).casterReports) EXPECT_TRUE(caster.notes.empty());
  }
}

TEST_F(Gltf, MaterialsBecomeWhatLightTransportKnows) {
  const Material glass = material(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
      "KHR_materials_ior": {"ior": 1.6}, "KHR_materials_dispersion": {"dispersion": 1},
      "KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": [0.5, 1, 1], "attenuationDistance": 0.25}}})");
  EXPECT_EQ(glass.type, MaterialType::dielectric);
  EXPECT_FALSE(glass.thinWalled);
  EXPECT_EQ(glass.attenuationColor, vec3(0.5f, 1, 1));
  EXPECT_EQ(glass.attenuationDistance, 0.25f);
  // Abbe number 20: (n_green - 1) / (n_blue - n_red) = 20.
  EXPECT_FLOAT_EQ(glass.ior.y, 1.6f);
  EXPECT_NEAR((glass.ior.y - 1) / (glass.ior.z - glass.ior.x), 20, 1e-3);

  const Material pane =
      material(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.9}}})");
  EXPECT_TRUE(pane.thinWalled);
  EXPECT_EQ(pane.ior, vec3(1.5f));
  EXPECT_EQ(material(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.4}}})").type,
            MaterialType::diffuse);

  const Material gold =
      material(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 0.8, 0.3, 1], "roughnessFactor": 0.05}})");
  EXPECT_EQ(gold.type, MaterialType::mirror);
  EXPECT_EQ(gold.color, vec3(1, 0.8f, 0.3f));
  EXPECT_EQ(material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.5}})").type, MaterialType::diffuse);

  const Material lamp = material(
      R"({"emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10}}})");
  EXPECT_EQ(lamp.emission, vec3(10, 5, 0));
}

TEST_F(Gltf, ABaseColorTextureIsMadeLinear) {
  // One pixel of 8-bit RGBA: (128, 255, 0, 255).
  const std::string png =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGNo+M/wHwAFggJ/5y8hgAAAAABJRU5ErkJggg==";
  Parts parts;
  parts.materials = R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])";
  parts.more = R"("textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" + png + R"("}],)";
  const std::string error = inputErrorOf([&] {
    const Scene scene = load(parts);
    ASSERT_EQ(scene.textures.size(), 1u);
    ASSERT_EQ(scene.textures[0].texels.size(), 1u);
    const vec4 texel = scene.textures[0].texels[0];
    EXPECT_NEAR(texel.x, 0.21586, 1e-4);
    EXPECT_EQ(texel.y, 1);
    EXPECT_EQ(scene.materials[0].colorTexture, 0u);
    EXPECT_EQ(scene.meshes[0].texcoords.size(), scene.meshes[0].positions.size());
  });
  EXPECT_EQ(error, "");
}

TEST_F(Gltf, LightsAndTheFirstCameraComeWithTheirNodes) {
  Parts parts;
  parts.nodes = R"([{"mesh": 0, "children": [1, 2, 3]},
    {"camera": 0, "translation": [0, 0, 5]},
    {"translation": [0, 3, 0], "rotation": [-0.70710678, 0, 0, 0.70710678], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"extensions": {"KHR_lights_punctual": {"light": 1}}}])";
  parts.more =
      R"("extensionsUsed": ["KHR_lights_punctual"], "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
    "extensions": {"KHR_lights_punctual": {"lights": [
      {"type": "spot", "color": [1, 0.5, 0.25], "intensity": 8, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}},
      {"type": "directional", "intensity": 1000}]}},)";
  const Scene scene = load(parts);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].type, LightType::spot);
  EXPECT_EQ(scene.lights[0].intensity, vec3(8, 4, 2));
  EXPECT_LT(glm::distance(scene.lights[0].position, vec3(0, 3, 0)), 1e-6f);
  EXPECT_LT(glm::distance(scene.lights[0].direction, vec3(0, -1, 0)), 1e-6f);
  EXPECT_NEAR(scene.lights[0].outerAngle, glm::degrees(0.2), 1e-4);
  EXPECT_EQ(scene.lights[1].type, LightType::directional);
  EXPECT_EQ(scene.lights[1].illuminance, vec3(1000));
  EXPECT_EQ(scene.camera.position, vec3(0, 0, 5));
  EXPECT_LT(glm::distance(glm::normalize(scene.camera.target - scene.camera.position), vec3(0, 0, -1)),
            1e-6f);
  EXPECT_NEAR(scene.camera.verticalFov, glm::degrees(0.5), 1e-4);
}

// A stone of glass with a lamp.
Parts glassAndLamp() {
  Parts parts;
  parts.nodes = R"([{"mesh": 0, "name": "stone", "extensions": {"KHR_lights_punctual": {"light": 0}}}])";
  parts.more =
      R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}, "name": "lamp", "intensity": 5}]}},)";
  parts.materials =
      R"([{"name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
           "KHR_materials_volume": {"thicknessFactor": 1}}}])";
  return parts;
}

Scene withOtherGlassAndLamp(Scene scene, float more) {
  scene.lights.at(0).position += vec3(more, 0, 0);
  scene.lights[0].intensity *= 1 + more;
  scene.lights[0].direction = normalize(vec3(more, -1, 0));
  scene.objects.at(0).placement.translation.y += more;
  scene.objects[0].placement.rotation = glm::angleAxis(more, vec3(0, 1, 0));
  scene.materials.at(0).ior += 0.1f * more;
  scene.materials[0].attenuationColor = vec3(0.5f, 0.75f, 1);
  scene.materials[0].attenuationDistance = more;
  return scene;
}

void expectAlike(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.lights.at(0).position, b.lights.at(0).position);
  EXPECT_EQ(a.lights[0].intensity, b.lights[0].intensity);
  EXPECT_LT(glm::distance(a.lights[0].direction, b.lights[0].direction), 1e-6f);
  EXPECT_LT(glm::distance(a.objects.at(0).placement.point(vec3(1)), b.objects.at(0).placement.point(vec3(1))),
            1e-5f);
  EXPECT_EQ(a.materials.at(0).ior, b.materials.at(0).ior);
  EXPECT_EQ(a.materials[0].attenuationColor, b.materials[0].attenuationColor);
  EXPECT_EQ(a.materials[0].attenuationDistance, b.materials[0].attenuationDistance);
}

TEST_F(Gltf, WhatIsChangedOfAnImportIsSavedInTheSceneThatImportsIt) {
  write("room.gltf", gltf(glassAndLamp()));
  std::string text = "[[object]]\nname = \"room\"\nimport = \"room.gltf\"\n";
  const auto file = write("s.toml", text);
  // The second time, what was changed before is changed again.
  for (const float more : {0.25f, 0.5f}) {
    const Scene before = readTomlScene(text, file, 0);
    const Scene after = withOtherGlassAndLamp(before, more);
    const SavedScene saved = savedScene(text, before, after);
    EXPECT_TRUE(saved.notSaved.empty());
    expectAlike(readTomlScene(saved.text, file, 0), after);
    text = saved.text;
  }
}

TEST_F(Gltf, WhatIsChangedOfAFileIsSavedInASceneAroundIt) {
  const auto file = write("room.gltf", gltf(glassAndLamp()));
  const Scene before = loadScene(file);
  const Scene after = withOtherGlassAndLamp(before, 0.25f);
  const SavedScene saved = savedScene(sceneAround(file), before, after);
  EXPECT_TRUE(saved.notSaved.empty());
  expectAlike(readTomlScene(saved.text, write("room.toml", ""), 0), after);
}

TEST_F(Gltf, AChangeOfWhatAnImportDoesNotBringIsAnError) {
  write("room.gltf", gltf(glassAndLamp()));
  const std::string error = inputErrorOf([&] {
    loadScene(write("s.toml",
                    "[[object]]\nname = \"room\"\nimport = \"room.gltf\"\nlight = [{ name = \"lamq\" }]\n"));
  });
  EXPECT_NE(error.find("s.toml:4"), std::string::npos) << error;
  EXPECT_NE(error.find("nearest is \"lamp\""), std::string::npos) << error;
}

TEST_F(Gltf, AnImportComesUnderTheObjectsTransform) {
  Parts parts;
  parts.nodes =
      R"([{"mesh": 0, "name": "stone", "translation": [1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}])";
  parts.more = R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},)";
  parts.materials = R"([{"name": "clay"}])";
  write("room.gltf", gltf(parts));
  const Scene scene = loadScene(write(
      "s.toml", "[[object]]\nname = \"room\"\nimport = \"room.gltf\"\nscale = 2\ntranslation = [0, 1, 0]\n"));
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "room/stone");
  EXPECT_EQ(scene.materials.at(0).name, "room/clay");
  EXPECT_EQ(scene.objects[0].placement.scale, 2);
  EXPECT_LT(glm::distance(scene.objects[0].placement.translation, vec3(2, 1, 0)), 1e-6f);
  EXPECT_LT(glm::distance(scene.lights.at(0).position, vec3(2, 1, 0)), 1e-6f);
  const Scene geometry = loadScene(write("g.toml",
                                         "[[material]]\nname = \"m\"\ntype = \"diffuse\"\n[[object]]\nmesh = "
                                         "\"room.gltf\"\nmaterial = \"m\"\n"));
  EXPECT_TRUE(geometry.hasDefaultSky);  // as the file's lights are not taken
  EXPECT_EQ(boundingBox(geometry.meshes.at(0)).low, vec3(1, 0, 0));
}

TEST_F(Gltf, SparseStridedAndNormalizedAccessorsAreRead) {
  Parts parts;
  // All positions are zero but the last three, which are given sparsely.
  parts.accessors =
      R"([{"componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 3,
            "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 3}}},
          {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}])";
  // Bytes 58 to 60 hold the indices 1, 2, 3 (the last triangle's are at 57).
  parts.views = R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                    {"buffer": 0, "byteOffset": 57, "byteLength": 3}, {"buffer": 0, "byteOffset": 12, "byteLength": 36}])";
  EXPECT_NEAR(meshTopology(load(parts).meshes.at(0)).signedVolume, 1.0 / 6, 1e-6);
}

TEST_F(Gltf, StripsAndFansAreTriangles) {
  for (const int mode : {5, 6}) {
    Parts parts;
    parts.primitive = R"({"attributes": {"POSITION": 0}, "mode": )" + std::to_string(mode) + "}";
    const Mesh mesh = load(parts).meshes.at(0);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(meshTopology(mesh).flippedEdges, 0u) << mode;
  }
}

TEST_F(Gltf, WhatReachesOutOfItsBufferIsRefused) {
  const auto withAccessor = [](const std::string& accessor) {
    Parts parts;
    parts.accessors =
        "[" + accessor + R"(, {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}])";
    return parts;
  };
  expectError(withAccessor(R"({"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"})"),
              "past the end");
  expectError(withAccessor(
                  R"({"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 4, "type": "VEC3"})"),
              "past the end");
  expectError(
      withAccessor(R"({"bufferView": 0, "componentType": 5126, "count": 4000000000000000, "type": "VEC3"})"),
      "elements");
  expectError(withAccessor(R"({"bufferView": 9, "componentType": 5126, "count": 4, "type": "VEC3"})"),
              "buffer view");
  expectError(withAccessor(R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC2"})"),
              "components");
  expectError(withAccessor(R"({"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"})"), "");
  Parts views;
  views.views = R"([{"buffer": 0, "byteLength": 480000}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
  expectError(views, "past the end");
  views.views = R"([{"buffer": 7, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
  expectError(views, "buffer");
  Parts fewer = withAccessor(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})");
  expectError(fewer, "refers to vertex 3");
}

TEST_F(Gltf, WrongFilesAreRefused) {
  Parts cycle;
  cycle.nodes = R"([{"children": [1]}, {"children": [0], "mesh": 0}])";
  expectError(cycle, "tree");
  Parts none;
  none.nodes = R"([{"mesh": 5}])";
  expectError(none, "mesh 5");
  Parts flat;
  flat.nodes = R"([{"mesh": 0, "scale": [1, 0, 1]}])";
  expectError(flat, "scale of zero");
  Parts packed;
  packed.more = R"("extensionsRequired": ["KHR_draco_mesh_compression"],)";
  expectError(packed, "KHR_draco_mesh_compression");
  Parts light;
  light.nodes = R"([{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 3}}}])";
  expectError(light, "light 3");
  Parts dark;
  dark.nodes = R"([{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}])";
  dark.more = R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": -1}]}},)";
  expectError(dark, "intensity");
  EXPECT_NE(inputErrorOf([&] { loadScene(write("t.gltf", std::string(100000, '['))); }), "");
  EXPECT_NE(inputErrorOf([&] { loadScene(write("t.glb", "glTF")); }), "");
}

TEST(GltfData, LoadsEveryFileOfTheSharedData) {
  const auto folder = sharedData() / "data" / "gltf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const auto casters = [&](const char* name) {
    const Scene scene = loadScene(folder / name);
    std::array<std::size_t, 2> openAndClosed{};
    for (const Object& object : scene.objects) {
      if (scene.materialOf(object).type == MaterialType::dielectric)
        ++openAndClosed[scene.meshOf(object).isClosed];
    }
    return openAndClosed;
  };
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Scene scene = loadScene(entry.path());
    EXPECT_FALSE(scene.objects.empty()) << entry.path();
    EXPECT_FALSE(describe(scene, diagnose(scene)).empty());
  }
  EXPECT_EQ(casters("DispersionTest.glb"), (std::array<std::size_t, 2>{0, 25}));
  EXPECT_EQ(casters("IridescentDishWithOlives-decoded.glb"), (std::array<std::size_t, 2>{0, 2}));
  EXPECT_EQ(loadScene(folder / "LightsPunctualLamp-decoded.glb").lights.size(), 5u);
  EXPECT_EQ(loadScene(folder / "Lights.glb").lights.size(), 4u);
}

TEST(MeshData, LoadsEveryMeshOfTheSharedDataAsTheManifestSays) {
  const auto folder = sharedData() / "data" / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const auto scratch = std::filesystem::temp_directory_path() / "nephroid-mesh-data.toml";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ofstream(scratch)
        << "[[material]]\nname = \"m\"\ntype = \"dielectric\"\n[[object]]\nmaterial = \"m\"\nmesh = \""
        << entry.path().string() << "\"\n";
    const Scene scene = loadScene(scratch);
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(scene.meshes.at(0).isClosed, name.find("closed") != name.npos) << name;
    EXPECT_EQ(scene.meshes[0].droppedTriangles, 0u) << name;
  }
  std::filesystem::remove(scratch);
}

}  // namespace
}  // namespace nephroid

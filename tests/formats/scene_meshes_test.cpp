// The geometry of objects: meshes from files, and shapes that are made.
#include <gtest/gtest.h>

#include <cstdlib>

#include "geometry/mesh_checks.h"
#include "geometry/shapes.h"
#include "scene/framing.h"
#include "support/scene_file.h"

namespace nephroid {
namespace {

TEST_F(SceneFile, MeshesAreFoundBesideTheSceneAndThenAmongTheModels) {
  const std::string scene = kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"t.obj\"\n";
  const auto models = folder() / "models";
  std::filesystem::create_directories(models);
  std::ofstream(models / "t.obj") << kTetrahedron;
  EXPECT_NE(errorOf(scene), "");
  setenv("NEPHROID_MODELS", ("/nowhere:" + models.string()).c_str(), 1);
  EXPECT_EQ(load(scene).meshes[0].triangles.size(), 4u);
  write("t.obj", kTetrahedron + "v 2 2 2\nf 1 2 5\n");
  EXPECT_EQ(load(scene).meshes[0].triangles.size(), 5u);
  unsetenv("NEPHROID_MODELS");
}

TEST_F(SceneFile, FitCentersAndScalesTheLongestSide) {
  write("t.obj", "v 10 0 0\nv 14 0 0\nv 10 2 0\nv 10 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Scene scene = load(
      kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"t.obj\"\nfit = 2\ntranslation = [0, 5, 0]\n");
  const auto [low, high] = worldBounds(scene, scene.objects[0]);
  EXPECT_LT(glm::distance(low, vec3(-1, 4.5f, -0.25f)), 1e-5f);
  EXPECT_LT(glm::distance(high, vec3(1, 5.5f, 0.25f)), 1e-5f);
}

TEST_F(SceneFile, ObjectsOfOneFileShareItsMesh) {
  write("t.obj", kTetrahedron);
  const std::string object = "[[object]]\nmaterial = \"glass\"\nmesh = \"t.obj\"\n";
  const Scene scene = load(kMaterials + object + object);
  EXPECT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST_F(SceneFile, FacesAreTurnedUnlessTheyAreWantedAsGiven) {
  write("inward.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const std::string object = "[[object]]\nmaterial = \"glass\"\nmesh = \"inward.obj\"\n";
  const std::string kept = object + "faces = \"as-given\"\n";
  const Scene scene = load(kMaterials + object + kept + object + "faces = \"outward\"\n" + kept);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.objects[2].mesh, scene.objects[0].mesh);
  EXPECT_EQ(scene.objects[3].mesh, scene.objects[1].mesh);
  EXPECT_NEAR(meshTopology(scene.meshOf(scene.objects[0])).signedVolume, 1.0 / 6, 1e-6);
  EXPECT_NEAR(meshTopology(scene.meshOf(scene.objects[1])).signedVolume, -1.0 / 6, 1e-6);
  expectError(kMaterials + object + "faces = \"inward\"\n", {"scene.toml:10", "faces", "outward"});
  expectError(kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"box\"\nfaces = \"as-given\"\n",
              {"scene.toml:10", "faces"});
}

TEST_F(SceneFile, FacesOfAnImportAreTurnedAsWell) {
  write("inward.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,)"
                       "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"
                       "AAABAAIAAAADAAEAAAACAAMAAQADAAIA\"}]}");
  const auto volume = [&](const std::string& more) {
    return meshTopology(load("[[object]]\nimport = \"inward.gltf\"\n" + more).meshes.at(0)).signedVolume;
  };
  EXPECT_NEAR(volume(""), 1.0 / 6, 1e-6);
  EXPECT_NEAR(volume("faces = \"as-given\"\n"), -1.0 / 6, 1e-6);
}

TEST_F(SceneFile, AMeshHasTheVerticesAskedFor) {
  std::ostringstream obj;
  const Mesh ball = makeSphere(1, {.vertices = 6000});
  for (const vec3 p : ball.positions) obj << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const uvec3& t : ball.triangles) obj << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
  write("ball.obj", obj.str());
  const std::string object = kMaterials + "[[object]]\nmesh = \"ball.obj\"\nmaterial = \"glass\"\n";
  const Scene scene =
      load(object + "vertices = 1500\n" + "[[object]]\nmesh = \"ball.obj\"\nmaterial = \"glass\"\n" +
           "[[object]]\nmesh = \"ball.obj\"\nmaterial = \"glass\"\nvertices = 9000\n");
  EXPECT_EQ(scene.meshes[0].positions.size(), 1500u);
  EXPECT_EQ(scene.meshes[1].positions.size(), ball.positions.size());
  EXPECT_EQ(scene.meshes[2].positions.size(), 9000u);
  EXPECT_TRUE(scene.meshes[0].isClosed);
  const MeshTopology whole = meshTopology(scene.meshes[1]), refined = meshTopology(scene.meshes[2]);
  EXPECT_TRUE(refined.isClosed());
  EXPECT_EQ(refined.flippedEdges, 0u);
  EXPECT_NEAR(refined.area, whole.area, 1e-5 * whole.area);
  EXPECT_NEAR(refined.signedVolume, whole.signedVolume, 1e-5 * whole.signedVolume);
  const MeshTopology topology = meshTopology(scene.meshes[0]);
  EXPECT_NEAR(topology.signedVolume, 4.18879, 4.18879 * 0.01);
  for (std::size_t i = 0; i < 1500; ++i)
    EXPECT_GT(dot(scene.meshes[0].normals[i], scene.meshes[0].positions[i]), 0.99f);
  // A third face on an edge.
  write("fin.obj", kTetrahedron + "v 1 1 1\nf 1 2 5\n");
  expectError(kMaterials + "[[object]]\nmesh = \"fin.obj\"\nmaterial = \"glass\"\nvertices = 4\n",
              {"scene.toml:10", "object 1", "more than two faces"});
  expectError(object + "vertices = 3\n", {"vertices", "4"});
}

TEST_F(SceneFile, WaterMovesWithTime) {
  const std::string toml =
      kMaterials +
      "[[object]]\nmaterial = \"glass\"\nshape = \"water\"\nsize = [4, 2]\ngrid = [40, 20]\n"
      "waves = [{amplitude = 0.1, wavelength = 1, direction = [1, 0], speed = 0.25}]\n";
  const Scene still = load(toml), later = load(toml, 2);
  ASSERT_TRUE(still.objects[0].water);
  EXPECT_EQ(still.objects[0].water->grid, uvec2(40, 20));
  EXPECT_EQ(still.meshes[0].positions.size(), 800u);
  EXPECT_NEAR(still.meshes[0].positions[5].y, -later.meshes[0].positions[5].y, 1e-5);  // half a wavelength on
  EXPECT_NE(still.meshes[0].positions[5].y, 0);
}

// Seams of texture coordinates must not crease what is smooth.
TEST_F(SceneFile, NormalsOfAnObjAreAveragedByAreaAcrossSeams) {
  write("t.obj",
        "v 0 0 0.2\nv 2 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/2 4/2\n"
        "f 1/1 4/2 5/1\nf 1/1 5/2 2/1\n");
  const Scene scene = load(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"t.obj\"\n");
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.positions.size(), 5u);
  // The areas of the faces around the top, doubled: (0.2, 0.4, 2) with y of either sign, and (-0.2, 0.2, 1)
  // with y of either sign.
  for (std::size_t i = 0; i < 5; ++i) {
    if (mesh.positions[i].z > 0) {
      EXPECT_LT(distance(mesh.normals[i], vec3(0, 0, 1)), 1e-6f);
    }
  }
}

// A cube whose corners are joined has the six sides that it shows; a low roof stays smooth.
TEST_F(SceneFile, NormalsGoNoFurtherThanACrease) {
  write("t.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvn -1 -1 -1\nvn 1 -1 -1\n"
        "vn 1 1 -1\nvn -1 1 -1\nvn -1 -1 1\nvn 1 -1 1\nvn 1 1 1\nvn -1 1 1\nf 4//4 3//3 2//2 1//1\n"
        "f 5//5 6//6 7//7 8//8\nf 1//1 2//2 6//6 5//5\nf 2//2 3//3 7//7 6//6\nf 3//3 4//4 8//8 7//7\n"
        "f 4//4 1//1 5//5 8//8\n");
  const Scene scene = load(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"t.obj\"\n");
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.findings.splitVertices, 16u);
  EXPECT_TRUE(mesh.isFaceted());
  EXPECT_TRUE(mesh.isClosed);
}

TEST_F(SceneFile, NormalsOfAnObjAreKeptWhereItHasThem) {
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 1 1\nf 1//1 2//1 3//2\n");
  const Scene scene = load(kMaterials + "[[object]]\nmaterial = \"white\"\nmesh = \"t.obj\"\n");
  EXPECT_EQ(scene.meshes[0].normals[0], vec3(0, 0, 1));
  EXPECT_LT(glm::distance(scene.meshes[0].normals[2], glm::normalize(vec3(0, 1, 1))), 1e-6f);
}

TEST_F(SceneFile, WrongMeshesAreToldWithTheirLine) {
  const auto expectMeshError = [&](const std::string& name, const std::string& bytes,
                                   const std::string& part) {
    write(name, bytes);
    expectError(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"" + name + "\"\n", {name, part});
  };
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", ":3");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n", ":3");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1e99 0\nf 1 2 3\n", "finite");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0\n", ":2");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ":4");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", ":4");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", ":4");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", ":4");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n", "normal");
  expectMeshError("a.obj", "v 0 0 0\n", "no faces");
  expectMeshError("a.obj", "", "no faces");
  expectMeshError("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "zero area");
  expectMeshError("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n",
                  "a.ply");
  expectMeshError(
      "a.ply",
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int vertex_indices\n"
      "end_header\n\xff\xff\xff\xff",
      "list");
  expectMeshError(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
      "a.ply");
  expectMeshError(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
      "ends");
  expectMeshError("a.3ds", "MM", "a.3ds");
}

TEST_F(SceneFile, TrianglesWithoutAreaAreLeftOutAndCounted) {
  write("t.obj", kTetrahedron + "f 1 1 2\nf 3 3 3\n");
  const Scene scene = load(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"t.obj\"\n");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 4u);
  EXPECT_EQ(scene.meshes[0].droppedTriangles, 2u);
  EXPECT_TRUE(scene.meshes[0].isClosed);
  EXPECT_NEAR(meshTopology(scene.meshes[0]).signedVolume, 1.0 / 6, 1e-6);
}

TEST_F(SceneFile, APlyMeshReadsLikeItsObj) {
  write("t.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const Scene scene = load(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"t.ply\"\n");
  EXPECT_TRUE(scene.meshes[0].isClosed);
  EXPECT_EQ(scene.meshes[0].positions.size(), 12u);  // each of its faces has a normal of its own
  EXPECT_NEAR(meshTopology(scene.meshes[0]).signedVolume, 1.0 / 6, 1e-6);
}

}  // namespace
}  // namespace nephroid

#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "formats/mesh_file.h"
#include "formats/mesh_formats.h"
#include "geometry/mesh_checks.h"

namespace nephroid {
namespace {

vec3 vectorOf(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

// The meshes of a node and of those below it, each where its node puts it.
void append(const aiScene& scene, const aiNode& node, const aiMatrix4x4& transform,
            bool& everyPieceHasNormals, Mesh& mesh) {
  const aiMatrix3x3 forNormals = aiMatrix3x3(transform).Inverse().Transpose();
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& piece = *scene.mMeshes[node.mMeshes[i]];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    everyPieceHasNormals = everyPieceHasNormals && piece.HasNormals();
    for (unsigned v = 0; v < piece.mNumVertices; ++v) {
      mesh.positions.push_back(vectorOf(transform * piece.mVertices[v]));
      mesh.normals.push_back(piece.HasNormals() ? vectorOf(forNormals * piece.mNormals[v]) : vec3(0));
    }
    for (unsigned f = 0; f < piece.mNumFaces; ++f) {
      const aiFace& face = piece.mFaces[f];
      // Points and lines have fewer corners. Assimp's own triangulation ends the program on some broken
      // faces.
      for (unsigned k = 2; k < face.mNumIndices; ++k) {
        mesh.triangles.push_back(first + uvec3(face.mIndices[0], face.mIndices[k - 1], face.mIndices[k]));
      }
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    append(scene, *node.mChildren[i], transform * node.mChildren[i]->mTransformation, everyPieceHasNormals,
           mesh);
}

}  // namespace

Mesh read3ds(const std::string& bytes, const std::string& source, Faces faces) {
  Mesh mesh;
  try {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_ValidateDataStructure, "3ds");
    if (!scene || !scene->mRootNode)
      throw InputError(source + ": cannot be read: " + importer.GetErrorString());
    bool everyPieceHasNormals = true;
    // Coordinates stay as the file has them: the root's own transform is Assimp's turn from z up to y up.
    append(*scene, *scene->mRootNode, aiMatrix4x4(), everyPieceHasNormals, mesh);
    if (!everyPieceHasNormals) mesh.normals.clear();
  } catch (const InputError& error) {
    throw InputError(oneLine(error.what()));
  } catch (const std::exception& error) {
    throw InputError(oneLine(source + ": cannot be read: " + error.what()));
  }
  finishMesh(mesh, source, faces);
  return mesh;
}

}  // namespace nephroid

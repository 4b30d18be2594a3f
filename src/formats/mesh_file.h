// Geometry from a file: OBJ, PLY, 3DS, glTF.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// Reads the geometry of an .obj, .ply, .3ds, .gltf or .glb file as one mesh; the extension decides. Normals
// are taken from the file where every corner has one; otherwise they are averaged by area. `faces`: as for
// finishMesh. Texture coordinates are left out: materials of a scene file have no texture, and vertices that
// are split at texture seams would only cost rays. Throws InputError.
Mesh loadMeshFile(const std::filesystem::path& file, Faces faces = Faces::outward);

// Finds a mesh that is named in a scene file. Looks beside the scene file, then in the directories of
// NEPHROID_MODELS (separated by colons; by default the models of Debian's glmark2-data). Throws InputError
// with the places where it looked; the message begins with `where`.
std::filesystem::path findModel(const std::filesystem::path& name,
                                const std::filesystem::path& sceneDirectory, const std::string& where);

// Reads a whole file. Throws InputError when it is missing, no regular file, or larger than `largest` bytes.
std::string readFile(const std::filesystem::path& file, std::uintmax_t largest);

// The file's extension in small letters, with its dot.
std::string lowerExtension(const std::filesystem::path& file);

// Replaces line breaks and other control characters by blanks, so that an error message is one line.
std::string oneLine(std::string text);

}  // namespace nephroid

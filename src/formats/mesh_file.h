// Geometry from a file: OBJ, PLY, 3DS, glTF.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// The geometry of an .obj, .ply, .3ds, .gltf or .glb file as one mesh, by its extension. Normals are the
// file's where it gives one for every corner, otherwise averaged by area. Texture coordinates are left out: a
// material given in a scene file has no texture, and vertices split along their seams would only cost rays.
// Throws InputError.
Mesh loadMeshFile(const std::filesystem::path& file);

// Where a mesh named in a scene file is: beside the scene file, then in the directories of NEPHROID_MODELS
// (separated by colons; by default where Debian's glmark2-data has its models). Throws InputError, beginning
// with `where`, naming the places.
std::filesystem::path findModel(const std::filesystem::path& name,
                                const std::filesystem::path& sceneDirectory, const std::string& where);

// The whole of a file. Throws InputError when it is missing, no regular file, or larger than `largest` bytes.
std::string readFile(const std::filesystem::path& file, std::uintmax_t largest);

// The extension of the file in small letters, with its dot.
std::string lowerExtension(const std::filesystem::path& file);

// The text with line breaks and other control characters as blanks, so that an error stays on one line.
std::string oneLine(std::string text);

}  // namespace nephroid

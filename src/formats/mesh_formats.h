// One reader for each mesh format: from the bytes of a file to a finished mesh (finishMesh). `source` names
// the file in errors. For any bytes they return a mesh or throw InputError, and never another exception.
#pragma once

#include <string>

#include "scene/scene.h"

namespace nephroid {

Mesh readObj(const std::string& bytes, const std::string& source, Faces faces);
Mesh readPly(const std::string& bytes, const std::string& source, Faces faces);
Mesh read3ds(const std::string& bytes, const std::string& source, Faces faces);

}  // namespace nephroid

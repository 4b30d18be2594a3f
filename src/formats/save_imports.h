// Writes changes of imported objects, lights and materials into the scene that imports them.
#pragma once

#include <string>
#include <vector>

#include "formats/toml_text.h"
#include "scene/scene.h"

namespace nephroid {

// Saves the changes of everything that the [[object]] `table` imports, whose names begin with `prefix`.
// Removes the names of what was saved from `notSaved`.
void saveImported(const Scene& before, const Scene& after, const std::string& prefix,
                  const toml::table& table, TomlText& text, std::vector<std::string>& notSaved);

// The Euler angles (degrees) of a scene file.
vec3 eulerDegrees(quat rotation);

}  // namespace nephroid

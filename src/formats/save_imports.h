// What was changed of imported things, as the scene that imports them has it.
#pragma once

#include <string>
#include <vector>

#include "formats/toml_text.h"
#include "scene/scene.h"

namespace nephroid {

// Of what the [[object]] `table` imports: things whose names begin with `prefix`. Names of those that are
// saved go from `notSaved`.
void saveImported(const Scene& before, const Scene& after, const std::string& prefix,
                  const toml::table& table, TomlText& text, std::vector<std::string>& notSaved);

// As a scene file has it, degrees.
vec3 eulerDegrees(quat rotation);

}  // namespace nephroid

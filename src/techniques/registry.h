// Finds techniques by name. To add one: a new folder, a line in list.h and a line in CMakeLists.txt.
#pragma once

#include "techniques/technique_info.h"

namespace nephroid {

// All techniques, in the order in which they are listed. The first one is the default.
std::span<const TechniqueInfo* const> techniques();

// Throws InputError, with the nearest name, where there is no technique with this name.
const TechniqueInfo& techniqueNamed(const std::string& name);

// Makes the technique that `context.settings` names.
std::unique_ptr<Technique> makeTechnique(const TechniqueContext& context);

}  // namespace nephroid

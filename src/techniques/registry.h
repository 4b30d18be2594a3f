// The techniques by name: a further one is a folder of its own, a line in list.h and a line in
// CMakeLists.txt.
#pragma once

#include "techniques/technique_info.h"

namespace nephroid {

// In the order in which they are listed; the first is used where none is named.
std::span<const TechniqueInfo* const> techniques();

// Throws InputError with the nearest name where there is none of that name.
const TechniqueInfo& techniqueNamed(const std::string& name);

// The technique that `context.settings` names.
std::unique_ptr<Technique> makeTechnique(const TechniqueContext& context);

}  // namespace nephroid

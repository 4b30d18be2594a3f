// The changes that a scene makes to the contents of an imported file.
#pragma once

#include <string>
#include <vector>

#include "formats/toml_table.h"
#include "scene/scene.h"

namespace nephroid {

// The tables [[object.light]], [[object.part]] and [[object.material]] of an [[object]] with "import".
struct ImportChanges {
  std::vector<TomlTable> lights, parts, materials;
};

ImportChanges importChanges(TomlTable& table);

// Applies the changes to the elements of `scene` whose names are `prefix` followed by a table's name. Throws
// InputError.
void applyImportChanges(ImportChanges changes, const std::string& prefix, Scene& scene);

}  // namespace nephroid

// What a scene changes of what a file brings that it imports.
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

// To the elements of `scene` whose names are `prefix` and then the name of a table. Throws InputError.
void applyImportChanges(ImportChanges changes, const std::string& prefix, Scene& scene);

}  // namespace nephroid

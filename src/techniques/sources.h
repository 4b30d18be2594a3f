// Where a technique's outgoing rays come from, as the settings ask for it.
#pragma once

#include <memory>
#include <vector>

#include "core/progress.h"
#include "scene/scene.h"
#include "techniques/settings.h"
#include "transport/source.h"
#include "transport/table/table.h"

namespace nephroid {

// A table for each caster that can have one, casters of one mesh and one index of refraction sharing theirs:
// from the cache, or built and left there.
std::vector<TransportTable> makeTables(const Scene& scene, const TechniqueSettings& settings,
                                       Progress& progress);

// The source "table": of the tables in `settings.baked`, or of makeTables; what no table holds goes to
// `traced`. Scene and `traced` must outlive it. Throws InputError where the baked file is not of this scene.
std::unique_ptr<TransportSource> makeTableSource(const Scene& scene, const TechniqueSettings& settings,
                                                 const TransportSource& traced, Progress& progress);

}  // namespace nephroid

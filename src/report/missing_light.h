// Says in a few lines what was mended in a scene's meshes, and why there is no caustic where one is expected.
// Both take a few ns for each object and light, never for each triangle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/stats.h"
#include "scene/scene.h"

namespace nephroid {

// Of the casters' meshes: parts that were turned or look inward, triangles that were left out, open surfaces,
// walls too thin to bend light. A line for each mesh and kind; of many, the first ones and how many more.
std::vector<std::string> meshWarnings(const Scene& scene);

// That a scene without lights has a sky by default, and what meshWarnings says.
std::vector<std::string> loadWarnings(const Scene& scene);

// Why light does not arrive: there is none, it points elsewhere, something stands in its way, it is trapped,
// or it lands elsewhere. `budget`: what became of it, where a technique has followed it. `sensor`: where it
// is wanted; null: on all receivers. Empty where all is well.
std::vector<std::string> missingLight(const Scene& scene, const std::optional<LightBudget>& budget,
                                      const Sensor* sensor = nullptr);

// Whether the light has a strength of 0.
bool isDark(const Light& light);

// Whether the light can reach a ball (m), by its type, strength, cone and side. Objects in between are
// ignored.
bool reaches(const Light& light, vec3 center, float radius);

}  // namespace nephroid

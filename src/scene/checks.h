// Checks scenes. Scenes from files are checked when they are read; scenes that were built in memory are
// checked with the same rules where they are first used.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// Checks a whole scene: numbers are finite and in range, indices are valid, lists have the right lengths,
// meshes are finished (finishMesh). Throws InputError, whose message tells what is wrong and what would be
// right. Takes a few ns for each vertex, texel and cell.
void checkScene(const Scene& scene);

// Checks only the objects and their meshes: all that says how much room they take. Throws InputError. Takes a
// few ns for each vertex.
void checkObjects(const Scene& scene);

// Checks only the parts of a scene that may change from frame to frame: camera, environment, materials,
// lights, placements and the shape of water. `before`: the scene of the frame before, with the same meshes,
// objects and materials. Takes some tens of ns for each object, material and light. Throws InputError.
void checkMoved(const Scene& scene, const Scene& before);

// Throws InputError.
void checkSensor(const Sensor& sensor);

}  // namespace nephroid

// Whether a scene can be used at all. Scenes from files are right when they have been read; one that was
// built in memory is held to the same rules where it is taken.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// All of a scene: numbers are finite and in range, indices name what is there, lists have the lengths that
// they must have, meshes are finished (finishMesh). Throws InputError, which names what is wrong and what
// would be right. Takes some ns for each vertex, texel and cell.
void checkScene(const Scene& scene);

// Its objects alone and their meshes: all that says how much room they take. Takes some ns for each vertex.
// Throws InputError.
void checkObjects(const Scene& scene);

// What of a scene may change from one frame to the next: camera, environment, materials, lights, where
// objects stand and the shape of water. `before`: the scene that it was, which has the same meshes, objects
// and materials. Takes some tens of ns for each object, material and light. Throws InputError.
void checkMoved(const Scene& scene, const Scene& before);

// Throws InputError.
void checkSensor(const Sensor& sensor);

}  // namespace nephroid

// Describes a scene: its contents, and the casters that make no caustics or poor ones, with the reason.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

struct CasterReport {
  uint32_t object = 0;
  uint32_t boundaryEdges = 0;          // edges of its mesh with one face
  uint32_t nonManifoldEdges = 0;       // with more than two
  std::vector<std::string> obstacles;  // reasons why it makes no caustics, or poor ones; empty: none
  std::vector<std::string> notes;      // remarks without consequences
};

// Two objects whose surfaces lie in the same place in some part: light meets one boundary there.
struct TouchingPair {
  uint32_t objects[2] = {0, 0};
  std::size_t triangles[2] = {0, 0};  // of each, in contact
};

struct SceneReport {
  std::size_t objects = 0, casters = 0, receivers = 0;
  std::size_t triangles = 0, vertices = 0;  // of all objects; a mesh that two objects use counts twice
  std::size_t droppedTriangles = 0;         // without an area, left out of the meshes
  std::size_t materials = 0, textures = 0, lights = 0, sensors = 0;
  std::vector<CasterReport> casterReports;  // in the order of the objects
  std::vector<TouchingPair> touching;
  std::vector<std::string> warnings;  // about the whole scene
};

// Throws InputError as checkScene does.
SceneReport diagnose(const Scene& scene);

// The report as lines of text for a reader.
std::string describe(const Scene& scene, const SceneReport& report);

}  // namespace nephroid

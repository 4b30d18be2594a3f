// The mesh of rays as lines over the picture.
#pragma once

#include "beams/ray_mesh/ray_mesh.h"
#include "techniques/pass_output.h"
#include "viewer/scene_lines.h"

namespace nephroid {

struct MeshLines {
  std::vector<SceneLine> sides;  // of beams, on the caster and where they land, each once
  std::vector<SceneLine> ways;   // of light between the two
};

// A side has the color of how often the beam was cut, the finer one of two that share it. Of more than
// `mostBeams` some are left out evenly; `mostWays` of them have the ways of their first corners.
MeshLines meshLines(const RayMesh& mesh, std::size_t mostBeams, std::size_t mostWays);

// How many beams there are of each number of cuts, and how many are one path alone.
Legend meshLegend(const RayMesh& mesh);

// Takes out the lines whose middles cannot be seen from there.
void removeHidden(const RayScene& rays, vec3 eye, std::vector<SceneLine>& lines);

}  // namespace nephroid

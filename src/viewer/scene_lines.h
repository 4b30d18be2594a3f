// Lines over the picture: beams, rays without light, and the grids of techniques.
#pragma once

#include <span>
#include <vector>

#include "techniques/lattice.h"
#include "transport/scene_transport.h"

namespace nephroid {

struct SceneLine {
  vec3 from{0}, to{0};  // m
  vec3 color{1};        // sRGB
  float opacity = 0.35f;
};

// The numbers of rays at vertices: with light, and without it for each reason.
struct BeamCounts {
  std::size_t carried = 0, occluded = 0, lost = 0, unlit = 0;  // rays at vertices
};

inline constexpr vec3 kCarriedColor{1, 0.9f, 0.55f};  // for white light; other light has its own color
inline constexpr vec3 kOccludedColor{0.35f, 0.55f, 1};
inline constexpr vec3 kLostColor{1, 0.35f, 0.3f};

// The corner rays of beams, at most `most` of them. They go from the caster to the first surface that they
// meet, or as far as the size of the scene. `paths`: which paths are followed.
std::vector<SceneLine> beamLines(SceneTransport& transport, Paths paths, std::size_t most);

// The rays that carry no light, as short lines where light meets the caster: something stands before it, or
// the light is totally reflected until it is lost. `counts`: of all rays, also of those that are not drawn.
std::vector<SceneLine> culledLines(SceneTransport& transport, Paths paths, std::size_t most,
                                   BeamCounts& counts);

std::vector<SceneLine> latticeLines(std::span<const Lattice> lattices, LatticeKind kind);

}  // namespace nephroid

// Lines over the picture: where beams go, which of them carry nothing and why, and what techniques compute
// on.
#pragma once

#include <span>
#include <vector>

#include "techniques/lattice.h"
#include "transport/scene_transport.h"

namespace nephroid {

struct SceneLine {
  vec3 from{0}, to{0};  // m
  vec3 color{1};        // sRGB
};

// Why no light leaves a caster where it was asked for.
struct BeamCounts {
  std::size_t carried = 0, occluded = 0, lost = 0, unlit = 0;  // rays at vertices
};

inline constexpr vec3 kCarriedColor{1, 0.9f, 0.55f};  // of white light; else its own
inline constexpr vec3 kOccludedColor{0.35f, 0.55f, 1};
inline constexpr vec3 kLostColor{1, 0.35f, 0.3f};

// The rays on which beams stand, at most `most` of them, from where they leave the caster to the first
// surface they meet, or as far as the scene is wide; of lights through casters as `paths` has them.
std::vector<SceneLine> beamLines(SceneTransport& transport, Paths paths, std::size_t most);

// Those that carry no light, as short strokes where light meets the caster: what stands in its way before, or
// what is totally reflected until it is lost. `counts` of all, not of those that are drawn.
std::vector<SceneLine> culledLines(SceneTransport& transport, Paths paths, std::size_t most,
                                   BeamCounts& counts);

std::vector<SceneLine> latticeLines(std::span<const Lattice> lattices, LatticeKind kind);

}  // namespace nephroid

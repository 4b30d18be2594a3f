// How the caustic light of a light sample moves when the light turns away from the sample's direction.
// Between two samples it is moved rather than blended, because blended samples show double images (Wyman
// 2004, section 7).
//
// Everything here is in the frame that turns with the light, so a rotation of the sample, as Wyman does it,
// is no movement. In addition every node of a lattice has two displacements, one for each of the two axes
// about which the light may turn. They are found with photons traced for the sample's direction and for
// directions near it. Two photons are a pair where they have the same place on the disk of light, or the same
// point where they meet the caster, or where they leave it. Which kind of pair gives the best displacement
// differs from node to node; it is decided by a comparison with light traced for the other direction.
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

class CasterTracer;

struct FlowSettings {
  float reach = 3;       // bounding radii from the center, where paths end
  float angle = 0.07f;   // rad, about the largest angle between the light and the sample
  uint32_t photons = 0;  // for each of the four directions with which displacements are compared
  uint32_t side = 8;     // nodes along a side of the lattice
};

// Chooses the nodes along a side of the lattice, so that most of `bytes` is left for the light itself.
uint32_t flowSide(std::size_t bytes);
// The number of 32-bit words of the lattice.
std::size_t flowWordCount(uint32_t side);

// Computes the words of the lattice; empty where there is no light. `paths`: those for light along frame[2].
std::vector<uint32_t> traceFlow(const CasterTracer& tracer, const mat3& frame,
                                std::span<const PhotonPath> paths, const FlowSettings& settings);

// The displacements of a sample, in the units of its places, for light in another direction. `aside`: the
// components of the light's direction across the sample's direction. Empty where the sample has no lattice.
LightFlow flowFor(const SampleLayout& layout, std::span<const uint32_t> words, vec2 aside);

}  // namespace nephroid

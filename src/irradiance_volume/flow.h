// How the light of one light sample moves when the light turns away from it: what is looked up between
// samples is carried along, where Wyman 2004 (section 7) finds blended samples to ghost.
//
// Everything here is in the frame that turns with the light: rotating a sample, as Wyman does, is no movement
// at all. On top of it every node of a lattice has two displacements, one for each way that the light may
// turn. They come of photons followed for the sample's direction and for directions near it, paired by what
// stays theirs: the place on the disc of light, the point where they meet the caster, or the one where they
// leave it. Which of these moves the light best differs from place to place, and is judged against light
// traced there.
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

class CasterTracer;

struct FlowSettings {
  float reach = 3;       // bounding radii from the centre that paths end at
  float angle = 0.07f;   // rad, that the light will turn away from the sample at most, or nearly so
  uint32_t photons = 0;  // of each of the four directions that movements are judged by
  uint32_t side = 8;     // nodes along a side of the lattice
};

// Nodes along a side of the lattice that leaves most of `bytes` to the light itself.
uint32_t flowSide(std::size_t bytes);
// Of the words that the lattice takes.
std::size_t flowWordCount(uint32_t side);

// The words of the sample's movements; none where there is no light. `paths` are those of the light's
// direction, frame[2].
std::vector<uint32_t> traceFlow(const CasterTracer& tracer, const mat3& frame,
                                std::span<const PhotonPath> paths, const FlowSettings& settings);

// The movement of a sample for light that is off its direction by `aside`, in places of the sample: the
// components of the light's direction across the sample's own. None where the sample has none.
LightFlow flowFor(const SampleLayout& layout, std::span<const uint32_t> words, vec2 aside);

}  // namespace nephroid

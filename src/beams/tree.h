// A hierarchy of bounds over beams, so that whole groups of beams that cannot reach a place are skipped
// (Barczak and Olano, 3.3). Their hierarchy is a quadtree over the water; this one groups the beams of any
// caster by where they begin.
#pragma once

#include <span>
#include <vector>

#include "beams/beam.h"
#include "beams/beam_bounds.h"

namespace nephroid {

struct BeamTree {
  std::vector<Beam> beams;  // neighbors are stored together
  // Groups of kChildren bounds, filled up with empty ones. The bounds of single beams come first.
  std::vector<BeamBounds> bounds;
  uint32_t root = 0;  // the first of the topmost group
};

// The main direction of a beam, as BeamBounds has it.
uint32_t wayOf(const Beam& beam);

// The bounds of beams that all go mainly along `way`. They become bounds of kEveryWay where a corner ray is
// too far from that direction.
BeamBounds boundsOf(std::span<const Beam> beams, uint32_t way);

// `portions`: the beams of each portion. The same beams give the same tree, for any number of threads.
BeamTree buildBeamTree(std::span<const std::vector<Beam>> portions);

}  // namespace nephroid

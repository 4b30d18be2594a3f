// A hierarchy over beams, so that what lies off a bundle of them need not ask each (Barczak and Olano, 3.3;
// there a quadtree over the water, here over the beams of any caster by where they begin).
#pragma once

#include <span>
#include <vector>

#include "beams/beam.h"
#include "beams/beam_bounds.h"

namespace nephroid {

struct BeamTree {
  std::vector<Beam> beams;  // those near each other stand together
  // Groups of kChildren, filled up with empty ones. The beams' own come first.
  std::vector<BeamBounds> bounds;
  uint32_t root = 0;  // the first of the topmost group
};

// The way that a beam mainly goes.
uint32_t wayOf(const Beam& beam);

// Of beams that all go one way; of kEveryWay where a corner ray hardly does.
BeamBounds boundsOf(std::span<const Beam> beams, uint32_t way);

// `portions` holds for each portion its beams. The same beams give the same tree, whatever the threads.
BeamTree buildBeamTree(std::span<const std::vector<Beam>> portions);

}  // namespace nephroid

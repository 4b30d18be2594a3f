// Where the virtual planes stand.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "techniques/illumination_textures/plane_set.h"

namespace nephroid {

// The box of an opaque object's mesh, in the object's own space.
struct ReceiverBox {
  Placement placement;
  vec3 low{0};
  vec3 high{0};
};

std::vector<ReceiverBox> receiverBoxes(const Scene& scene);

// Planes for these beams: across their mean direction, from the nearest to the farthest place where a box may
// stop them, with windows about where they arrive. Of no planes when no beam meets a box.
PlaneSet planPlanes(std::span<const Beam> beams, std::span<const ReceiverBox> boxes, uint32_t planes,
                    uint32_t textureSize);

}  // namespace nephroid

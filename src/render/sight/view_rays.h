// Where the viewer looks to by way of a caster (Iwasaki 2005, 5.3): rays of sight at the vertices of the
// surface that faces the viewer, between which they are interpolated.
#pragma once

#include <cstdint>
#include <vector>

#include "render/sight/sight_data.h"
#include "render/view.h"
#include "transport/source.h"

namespace nephroid {

// Triangles of a caster's surface on the side of the viewer. Those whose corners look different ways are cut
// until they are a few pixels small.
struct SightMesh {
  std::vector<SightVertex> vertices;
  std::vector<uint32_t> indices;
};

// A line of sight from `eye`, inside of `media`, that meets the object, in one colour channel.
TransportQuery sightQuery(uint32_t object, vec3 eye, uint32_t channel, const MediumStack& media);

// Of what is within the picture. `rays`: of the scene.
SightMesh sightMesh(const Scene& scene, const TransportSource& source, const RayScene& rays,
                    const TransportQuery& query, const View& view);

}  // namespace nephroid

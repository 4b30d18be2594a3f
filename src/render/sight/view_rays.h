// Traces the view rays of a caster at the vertices of its visible surface (Iwasaki 2005, 5.3). Between
// vertices they are interpolated.
#pragma once

#include <cstdint>
#include <vector>

#include "render/sight/sight_data.h"
#include "render/view.h"
#include "transport/source.h"

namespace nephroid {

// The triangles of a caster's surface that face the viewer. Triangles whose corners have different paths are
// cut until they are a few pixels wide.
struct SightMesh {
  std::vector<SightVertex> vertices;
  std::vector<uint32_t> indices;
};

// The query for view rays from `eye` (m), inside `media`, that meet the object, in one color channel.
TransportQuery sightQuery(uint32_t object, vec3 eye, uint32_t channel, const MediumStack& media);

// Makes the mesh of the part that is within the picture. `rays`: of the scene.
SightMesh sightMesh(const Scene& scene, const TransportSource& source, const RayScene& rays,
                    const TransportQuery& query, const View& view);

}  // namespace nephroid

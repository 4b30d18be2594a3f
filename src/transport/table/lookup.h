// Looks up a light transport table (Iwasaki 2005, section 5.1). Written once for C++ and GLSL.
//
// A shader includes entry.h, contains `#define TableView TableLayout`, defines `uint tableWord(TableView
// table, uint index)`, which reads the buffer of the table's words, and then includes this file.
#ifndef NEPHROID_TRANSPORT_TABLE_LOOKUP_H
#define NEPHROID_TRANSPORT_TABLE_LOOKUP_H

#include "core/shared_language.h"
#include "optics/refraction.h"
#include "transport/outgoing_ray.h"
#include "transport/table/directions.h"
#include "transport/table/entry.h"

#ifdef __cplusplus
namespace nephroid {
struct TableView : TableLayout {
  const uint* words;
};
inline uint tableWord(const TableView& table, uint index) {
  return table.words[index];
}
}  // namespace nephroid
#endif

SHARED_BEGIN

SHARED_FUNCTION TableEntry tableEntry(TableView table, uint band, uint vertex, uint direction) {
  uint directions = 1u + table.rings * table.azimuths;
  uint block = (band * table.vertices + vertex) * table.blockWords;
  uint core = block + 3u * direction;
  uint w0 = tableWord(table, core);
  uint w1 = tableWord(table, core + 1u);
  uint w2 = tableWord(table, core + 2u);
  uint paths = block + 3u * directions;
  uint path = tableWord(table, paths + direction / 2u) >> (16u * (direction % 2u));
  uint code = tableWord(table, paths + (directions + 1u) / 2u + direction / 4u) >> (8u * (direction % 4u));
  TableEntry entry;
  entry.position =
      table.boxMinimum +
      table.boxExtent * vec3(fromUnorm16(w0 & 0xffffu), fromUnorm16(w0 >> 16u), fromUnorm16(w1 & 0xffffu));
  entry.direction = directionFromOctahedral(vec2(fromUnorm16(w1 >> 16u), fromUnorm16(w2 & 0xffffu)));
  entry.transmittance = fromUnorm16(w2 >> 16u);
  entry.pathLength = table.pathScale * fromUnorm16(path & 0xffffu);
  entry.code = code & 0xffu;
  return entry;
}

// Interpolates between unit vectors along the great circle at constant speed (as for quaternions).
SHARED_FUNCTION vec3 slerpDirection(vec3 a, vec3 b, float t) {
  float sine = length(cross(a, b));
  float cosine = dot(a, b);
  if (sine < 1e-4f) return cosine < 0.0f ? (t < 0.5f ? a : b) : normalize((1.0f - t) * a + t * b);
  float angle = atan(sine, cosine);
  return (sin((1.0f - t) * angle) * a + sin(t * angle) * b) / sine;
}

SHARED_FUNCTION float shareOf(float part, float rest) {
  return part > 0.0f ? part / (part + rest) : 0.0f;
}

// The path code with the largest sum of weights.
SHARED_FUNCTION uint prevailingCode(uvec4 code, vec4 weight) {
  uint prevailing = code[0];
  float most = -1.0f;
  for (int i = 0; i < 4; ++i) {
    float sum = 0.0f;
    for (int j = 0; j < 4; ++j) sum += code[j] == code[i] ? weight[j] : 0.0f;
    if (sum > most) {
      most = sum;
      prevailing = code[i];
    }
  }
  return prevailing;
}

// The ray that leaves the caster, in mesh space, for light that meets `vertex` along `direction` (unit, in
// the vertex's frame). It is interpolated between those of the four sampled rays that have the prevailing
// path code, because a mean over different paths would be a ray that does not exist. Position, transmittance
// and path length are bilinear; directions are interpolated on the sphere. Where the prevailing path carries
// no light, the result carries none. So edges stay sharp, and the flux is right on average. The transmittance
// is only Fresnel's, the same in all channels. The caller adds the absorption of the path, so that a changed
// color needs no new table.
SHARED_FUNCTION OutgoingRay lookUpRay(TableView table, uint band, uint vertex, vec3 direction) {
  DirectionCell cell = cellAround(direction, table.rings, table.azimuths);
  TableEntry entry[4];
  uvec4 code;
  for (int i = 0; i < 4; ++i) {
    entry[i] = tableEntry(table, band, vertex, cell.direction[i]);
    code[i] = entry[i].code;
  }
  uint prevailing = prevailingCode(code, cell.weight);

  vec4 weight;
  for (int i = 0; i < 4; ++i) weight[i] = code[i] == prevailing ? cell.weight[i] : 0.0f;
  weight /= weight[0] + weight[1] + weight[2] + weight[3];

  OutgoingRay ray;
  ray.position = vec3(0.0f);
  ray.pathLength = 0.0f;
  float transmittance = 0.0f;
  for (int i = 0; i < 4; ++i) {
    ray.position += weight[i] * entry[i].position;
    ray.pathLength += weight[i] * entry[i].pathLength;
    transmittance += weight[i] * entry[i].transmittance;
  }
  vec3 inner = slerpDirection(entry[0].direction, entry[1].direction, shareOf(weight[1], weight[0]));
  vec3 outer = slerpDirection(entry[2].direction, entry[3].direction, shareOf(weight[3], weight[2]));
  ray.direction = slerpDirection(inner, outer, shareOf(weight[2] + weight[3], weight[0] + weight[1]));
  ray.reach = kUnboundedReach;
  ray.flags = (prevailing >= kCodeOccluded ? kRayOccluded : 0u) |
              (prevailing % kCodeOccluded == kCodeLost ? kRayLost : 0u);
  ray.signature = prevailing;
  if (direction.z >= 0.0f) ray.flags |= kRayLost;
  float entering = 1.0f - fresnelReflectance(max(-direction.z, 0.0f), 1.0f / table.ior[band]);
  ray.transmittance = vec3(transmittance * entering);
  return ray;
}

SHARED_END

#endif

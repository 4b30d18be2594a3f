// Where a ray meets a receiver, found in images of the receivers. What an image shows at a texel is taken as
// the tangent plane of a surface; the ray meets that plane next to another texel, and so on: exact on flat
// receivers whatever the size of a texel.
#include "render/sight/slice_texel.glsl.h"

struct FoundReceiver {
  vec3 position;   // m
  vec3 normal;     // unit, toward where the ray comes from
  vec4 albedo;     // a = material + 1
  float distance;  // m along the ray; negative: nothing is found
};

const int kStepsToPlane = 4;

vec2 placeInFrame(SightFrame frame, vec3 point, float size) {
  const vec3 q = point - frame.apex;
  return (vec2(dot(q, frame.axisU), dot(q, frame.axisV)) * (frame.scale / dot(q, frame.axisW)) * 0.5 + 0.5) *
         size;
}

// Looks near the ray's point at `distance`, within the layer, for a receiver at `least` to `most` (m along
// the ray).
FoundReceiver findNear(vec3 origin, vec3 direction, float distance, float least, float most, SightFrame frame,
                       int layer, utexture2DArray texels, texture2DArray depths) {
  const float size = float(textureSize(depths, 0).x);
  FoundReceiver found;
  found.distance = -1;
  vec2 place = placeInFrame(frame, origin + distance * direction, size);
  for (int i = 0; i < kStepsToPlane; ++i) {
    if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(size)))) return found;
    const ivec3 at = ivec3(place, layer);
    if (texelFetch(depths, at, 0).r == 1) return found;
    const uvec4 texel = texelFetch(texels, at, 0);
    const float depth = sliceDepth(texel);
    const vec3 normal = sliceNormal(texel);
    const vec2 slope = ((floor(place) + 0.5) / size * 2 - 1) / frame.scale;
    const vec3 point = frame.apex + depth * (frame.axisW + slope.x * frame.axisU + slope.y * frame.axisV);
    const float approach = dot(direction, normal);
    if (abs(approach) < 1e-4) return found;
    distance = dot(point - origin, normal) / approach;
    if (!(distance >= least && distance <= most)) return found;
    const vec3 meeting = origin + distance * direction;
    if (dot(meeting - frame.apex, frame.axisW) <= 0) return found;
    const vec2 next = placeInFrame(frame, meeting, size);
    if (all(lessThan(abs(next - floor(place) - 0.5), vec2(i < kStepsToPlane - 1 ? 0.75 : 1.5)))) {
      found = FoundReceiver(meeting, approach > 0 ? -normal : normal, sliceAlbedo(texel), distance);
      return found;
    }
    place = next;
  }
  return found;
}

// In the sliced object images, from the nearest slice on (Iwasaki 2005, 5.3).
FoundReceiver findInSlices(vec3 origin, vec3 direction, SliceSet set, utexture2DArray texels,
                           texture2DArray depths) {
  FoundReceiver found;
  found.distance = -1;
  const float size = float(textureSize(depths, 0).x);
  const float approach = dot(direction, set.frame.axisW);
  const float start = dot(origin - set.frame.apex, set.frame.axisW);
  if (approach < 0.05) return found;
  float nearDepth = set.firstDepth;
  for (int i = 0; i < int(set.slices); ++i, nearDepth *= set.depthRatio) {
    const float farDepth = nearDepth * set.depthRatio;
    if ((set.occupied >> i & 1u) == 0 || farDepth <= start) continue;
    const float least = max(nearDepth - start, 0) / approach;
    const float most = (farDepth - start) / approach;
    const vec2 first = placeInFrame(set.frame, origin + least * direction, size);
    const vec2 last = placeInFrame(set.frame, origin + most * direction, size);
    const vec2 off = max(max(-min(first, last), max(first, last) - size), vec2(0));
    const int probes = clamp(int(distance(first, last) / 12) + 2, 2, 8);
    const float tolerance = 0.1 * (most - least);
    for (int probe = 0; probe < probes; ++probe) {
      const float t = mix(least, most, (float(probe) + 0.5) / float(probes));
      found = findNear(origin, direction, t, max(least - tolerance, 0), most + tolerance, set.frame, i,
                       texels, depths);
      if (found.distance >= 0) return found;
    }
  }
  return found;
}

uint faceToward(vec3 direction) {
  const vec3 size = abs(direction);
  if (size.x >= size.y && size.x >= size.z) return direction.x > 0 ? 0u : 1u;
  if (size.y >= size.z) return direction.y > 0 ? 2u : 3u;
  return direction.z > 0 ? 4u : 5u;
}

// In the images of receivers around `center`: the nearest that is found from places farther and farther along
// the ray.
FoundReceiver findAround(vec3 origin, vec3 direction, vec3 center, float reach, utexture2DArray texels,
                         texture2DArray depths) {
  FoundReceiver found;
  found.distance = -1;
  const float nearest = max(0.5 * distance(origin, center), 1e-3 * reach);
  for (float t = nearest; t < 8 * reach; t *= 2) {
    const vec3 point = origin + t * direction;
    const uint face = faceToward(point - center);
    const FoundReceiver here =
        findNear(origin, direction, t, 0, 4 * reach, faceOfCube(center, face), int(face), texels, depths);
    if (here.distance >= 0 && (found.distance < 0 || here.distance < found.distance)) found = here;
    if (found.distance >= 0 && found.distance < 2 * t) return found;
  }
  return found;
}

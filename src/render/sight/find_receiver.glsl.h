// Finds where a ray meets a receiver, with images of the receivers: from tangent plane to tangent plane
// (geometry/tangent_plane.h). The result is exact on flat receivers, for any size of texels.
#include "geometry/tangent_plane.h"

#include "render/sight/slice_texel.glsl.h"

struct FoundReceiver {
  float distance;  // m along the ray; negative: nothing is found
  vec3 normal;     // unit
  ivec3 texel;     // its texel and layer in the images
};

const FoundReceiver kNothing = FoundReceiver(-1, vec3(0), ivec3(0));
const int kStepsToPlane = 4;
// The search begins near the distance at which the rays of the caster's vertices met a receiver, within this
// factor.
const float kNearHint = 1.3;

struct SightRay {
  vec3 origin;     // m
  vec3 direction;  // unit
};

// One layer of the images: a frame of sight, the depths that it holds, and the texels along its sides.
struct SightLayer {
  SightFrame frame;
  vec2 depths;
  int layer;
  float size;
};

vec2 placeInFrame(SightLayer from, vec3 point) {
  const SightFrame frame = from.frame;
  const vec3 q = point - frame.apex;
  return (vec2(dot(q, frame.axisU), dot(q, frame.axisV)) * (frame.scale / dot(q, frame.axisW)) * 0.5 + 0.5) *
         from.size;
}

// Looks for a receiver near the ray's point at `distance`, within range.x to range.y (m along the ray).
FoundReceiver findNear(SightRay ray, float distance, vec2 range, SightLayer from, texture2DArray depths,
                       utexture2DArray normals) {
  const SightFrame frame = from.frame;
  vec2 place = placeInFrame(from, ray.origin + distance * ray.direction);
  for (int i = 0; i < kStepsToPlane; ++i) {
    if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(from.size)))) return kNothing;
    const ivec3 texel = ivec3(place, from.layer);
    const float value = texelFetch(depths, texel, 0).r;
    if (value == 0) return kNothing;
    const float depth = depthFromImage(value, from.depths);
    const vec3 normal = directionFromOctahedral(unpackUnorm2x16(texelFetch(normals, texel, 0).r));
    const vec2 center = floor(place) + 0.5;
    const vec2 slope = (center / from.size * 2 - 1) / frame.scale;
    const vec3 point = frame.apex + depth * (frame.axisW + slope.x * frame.axisU + slope.y * frame.axisV);
    // From the ray's origin: it may be far from the scene's, and then few digits would be left.
    const PlaneMeeting meeting =
        meetTangentPlane(vec3(0), ray.direction, tangentPlane(point - ray.origin, normal));
    distance = meeting.distance;
    const vec3 met = ray.origin + distance * ray.direction;
    if (!(distance >= range.x && distance <= range.y) || dot(met - frame.apex, frame.axisW) <= 0)
      return kNothing;
    place = placeInFrame(from, met);
    if (all(lessThan(abs(place - center), vec2(i < kStepsToPlane - 1 ? 0.75 : 1.5))))
      return FoundReceiver(distance, meeting.approach < 0 ? -normal : normal, texel);
  }
  return kNothing;
}

SightLayer faceToward(vec3 point, vec3 center, float reach, int firstLayer) {
  const vec3 direction = point - center;
  const vec3 size = abs(direction);
  uint face = direction.z > 0 ? 4u : 5u;
  if (size.x >= size.y && size.x >= size.z)
    face = direction.x > 0 ? 0u : 1u;
  else if (size.y >= size.z)
    face = direction.y > 0 ? 2u : 3u;
  return SightLayer(faceOfCube(center, face), depthsAround(reach), firstLayer + int(face),
                    float(kSurroundingSize));
}

// The steps of the search: near the hint in its slice; near the hint in the images of the cube; then through
// all slices from the nearest (Iwasaki 2005, 5.3), each at several places along the ray; then in the images
// of the cube at growing distances. All steps share one loop, because software devices execute every branch
// in the code.
const int kHintedSlice = 0, kHintedAround = 1, kSlices = 2, kAround = 3, kEnd = 4;

FoundReceiver findReceiver(SightRay ray, float hint, SliceSet set, vec3 center, float reach,
                           texture2DArray depths, utexture2DArray normals) {
  const float size = float(textureSize(depths, 0).x);
  const float approach = dot(ray.direction, set.frame.axisW);
  const float start = dot(ray.origin - set.frame.apex, set.frame.axisW);
  const bool hasSlices = set.slices > 0 && approach >= 0.05;
  int kind = hint > 0 ? (hasSlices ? kHintedSlice : kHintedAround) : (hasSlices ? kSlices : kAround);
  // Where rays at all corners of the caster's triangle met nothing, nothing is looked for.
  if (hint <= 0.999 * kNoReach) kind = kEnd;
  int slice = 0, probe = 0;
  float nearDepth = set.firstDepth;
  float t = max(0.5 * distance(ray.origin, center), 1e-3 * reach);
  while (kind != kEnd) {
    const bool isHinted = kind == kHintedSlice || kind == kHintedAround;
    float at = isHinted ? hint : t;
    vec2 range = isHinted ? vec2(1 / kNearHint, kNearHint) * hint : vec2(0.4, 2.5) * t;
    int probes = 1;
    SightLayer layer;
    if (kind == kHintedSlice || kind == kSlices) {
      float first = nearDepth;
      int i = slice;
      if (kind == kHintedSlice) {
        const float planes = log(max((start + hint * approach) / set.firstDepth, 1)) / log(set.depthRatio);
        i = min(int(planes), int(set.slices) - 1);
        first = set.firstDepth * pow(set.depthRatio, float(i));
      }
      layer = SightLayer(set.frame, depthsOfSlice(set, first), i, size);
      if (kind == kSlices) {
        const vec2 between = vec2(max(first - start, 0), max(first * set.depthRatio - start, 0)) / approach;
        probes = clamp(int(distance(placeInFrame(layer, ray.origin + between.x * ray.direction),
                                    placeInFrame(layer, ray.origin + between.y * ray.direction)) /
                           12) +
                           2,
                       2, 8);
        at = mix(between.x, between.y, (float(probe) + 0.5) / float(probes));
        range = vec2(max(1.1 * between.x - 0.1 * between.y, 0), 1.1 * between.y - 0.1 * between.x);
        if ((set.occupied >> i & 1u) == 0 || between.y == 0) probes = 0;
      }
    } else {
      layer = faceToward(ray.origin + at * ray.direction, center, reach, int(kMostSlices));
    }
    if (probes > 0) {
      const FoundReceiver found = findNear(ray, at, range, layer, depths, normals);
      if (found.distance >= 0) return found;
    }
    if (kind == kHintedSlice) {
      kind = kHintedAround;
    } else if (kind == kHintedAround) {
      kind = hasSlices ? kSlices : kAround;
    } else if (kind == kSlices) {
      if (++probe >= probes) {
        probe = 0;
        nearDepth *= set.depthRatio;
        if (++slice >= int(set.slices)) kind = kAround;
      }
    } else {
      t *= 2;
      if (t > 8 * reach) kind = kEnd;
    }
  }
  return kNothing;
}

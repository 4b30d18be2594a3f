// Where a ray of a beam arrives on what the virtual camera sees, from tangent plane to tangent plane
// (geometry/tangent_plane.h). For deposit.comp, with its constants and images.
#include "geometry/tangent_plane.h"

#include "techniques/planes/receiver_normal.glsl.h"

const int kStepsToReceiver = kGoesAlongAxis != 0 ? 4 : 6;

// A corner ray in the virtual camera's frame: meters along axisU, axisV and axisW.
struct Ray {
  vec3 start;
  vec3 direction;  // unit
};

Ray rayOf(vec3 position, vec3 direction) {
  const mat3 axes = mat3(constants.set.axisU, constants.set.axisV, constants.set.axisW);
  return Ray(position * axes, direction * axes);
}

// m along the ray; far off where it runs along the planes.
float distanceToDepth(Ray ray, float depth) {
  const float approach = ray.direction.z;
  return (depth - ray.start.z) / (approach < 0 ? min(approach, -1e-4) : max(approach, 1e-4));
}

// Where a ray meets what the virtual camera sees.
struct Arrival {
  float distance;  // m along the ray
  bool isSeen;     // there, and not only near what would be there
  TangentPlane plane;
};

Arrival arrivalOf(Ray ray, float reach) {
  const PlaneSet set = constants.set;
  const float range = set.farthestDepth - set.nearestDepth;
  const float toNearest = distanceToDepth(ray, set.nearestDepth),
              toFarthest = distanceToDepth(ray, set.farthestDepth);
  const float nearest = max(min(toNearest, toFarthest), 0), farthest = max(max(toNearest, toFarthest), 0);
  const vec2 center = set.windows[0].corner + 0.5 * set.windows[0].size / set.windows[0].texelsPerMeter;
  const float middle = set.firstDepth + 0.5 * float(set.planes - 1) * set.depthStep;
  float distance = abs(ray.direction.z) >= kLeastPlaneApproach
                       ? distanceToDepth(ray, middle)
                       : dot(vec3(center, middle) - ray.start, ray.direction);
  const bool isReachKnown = reach < kUnboundedReach;
  if (isReachKnown) distance = reach;
  distance = clamp(distance, nearest, farthest);
  float toSeen = distance;  // to the last tangent plane of what was seen
  TangentPlane plane = TangentPlane(vec3(0, 0, -1), -middle);
  float change, metersPerTexel;
  int step = 0;
  bool isSeen, isLit, isThere;
  do {
    const vec3 point = ray.start + distance * ray.direction;
    uint window = 0;
    vec2 place = texelOfWindow(set.windows[0], point.xy);
    if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(set.windows[0].size)))) {
      window = 1;
      place = texelOfWindow(set.windows[1], point.xy);
    }
    metersPerTexel = 1 / set.windows[window].texelsPerMeter;
    const vec2 texel = clamp(floor(place), vec2(0), vec2(set.windows[window].size - 1));
    const float seen = texelFetch(seenDepths, ivec3(texel, window), 0).r;
    const vec3 normal = unpackedNormal(texelFetch(seenNormals, ivec3(texel, window), 0).r);
    const float seenDepth = set.nearestDepth + seen * range;
    const TangentPlane next = tangentPlane(vec3(point.xy - (place - texel - 0.5) * metersPerTexel, seenDepth),
                                           vec3(normal.xy, -normal.z));
    const PlaneMeeting meeting = meetTangentPlane(point, ray.direction, next);
    isLit =
        meeting.approach > (kGoesAlongAxis != 0 ? 0.1 * ray.direction.z * normal.z : 0.02 * length(normal));
    const float toPlane = isLit ? distance + meeting.distance : distanceToDepth(ray, seenDepth);
    isSeen = seen < 1;
    if (isSeen) plane = next;
    if (isSeen) toSeen = clamp(toPlane, nearest, farthest);
    change = abs(toSeen - distance);
    isThere = isSeen && change < 1e-4 * metersPerTexel;
    // Past the receivers' edge, or the window's: they are nearer to where the ray comes from.
    distance = isSeen ? toSeen : 0.5 * (distance + nearest);
  } while (!isThere && ++step < kStepsToReceiver);
  // A ray that passes a receiver by goes as far as the others of its beam.
  if (!isSeen) distance = toSeen;
  const float tolerance = 2 * metersPerTexel + 1e-3 * range;
  const bool isMet = isSeen && isLit && change <= tolerance;
  if (isReachKnown)
    return Arrival(distance, isMet && abs(distance - reach) <= 0.01 * reach + tolerance, plane);
  return Arrival(distance, isMet || kGoesAlongAxis != 0, plane);
}

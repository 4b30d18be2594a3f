// Adds every beam's flux to the virtual planes. The flux is kept also where a beam is narrower than a texel.
//
// Flat planes are those of Iwasaki 2005b (eq. 3, with the flux in place of intensity times area ratio). A
// plane that follows the receivers bends, within half the distance to its neighbors, onto the surfaces that
// the virtual camera sees. Light is then stored where it arrives, and is not blurred between planes.
//
// A group is one subgroup. First each thread computes where one beam falls. Then all threads together go
// through one beam's footprint after the other, in blocks with one texel for each thread. Loops test their
// condition at the end, because a software device runs the body of a loop once even where no thread needs it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "techniques/planes/shader_data.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(constant_id = 1) const uint kFollowsReceivers = 1;
// Light goes about along axisW. So where the first surface that it meets is not known, the one that the
// virtual camera sees is used.
layout(constant_id = 2) const uint kGoesAlongAxis = 1;
layout(local_size_x_id = 3) in;
layout(push_constant, scalar) uniform Constants {
  DepositConstants constants;
};
uniform texture2DArray seenDepths;    // by the virtual camera, a layer a window
uniform utexture2DArray seenNormals;  // as receiver_normal.glsl.h packs them
layout(r32ui) uniform uimage2DArray textures;

#include "techniques/planes/arrival.glsl.h"

// Where a beam's corners are, m along the axes, on a plane or next to it.
struct Crossing {
  vec3 a, b, c;
  float part;  // of the beam's flux that comes so far
};

Crossing crossingAt(Ray rays[3], vec3 distances) {
  const vec3 meets = vec3(greaterThanEqual(distances, vec3(-1e-6)));
  distances = max(distances, vec3(0));
  Crossing crossing;
  crossing.a = rays[0].start + distances.x * rays[0].direction;
  crossing.b = rays[1].start + distances.y * rays[1].direction;
  crossing.c = rays[2].start + distances.z * rays[2].direction;
  crossing.part = dot(meets, vec3(1.0 / 3.0));
  return crossing;
}

// How far a plane reaches that follows the receivers, m to either side: half the way to its neighbors, and a
// little more because neighboring texels may be asked for that lie past the border.
float reachOf(uint window) {
  return 0.5 * constants.set.depthStep + 3 / constants.set.windows[window].texelsPerMeter;
}

// On a plane that follows the receivers, corners that arrive nearer to another one, or nowhere, go to the
// surface on which the others arrive: one beam may meet several receivers.
vec3 distancesNear(float low, float high, Ray rays[3], Arrival arrivals[3]) {
  bvec3 isWithin;
  TangentPlane surface = TangentPlane(vec3(0), 0);
  for (int i = 2; i >= 0; --i) {
    const float depth = rays[i].start.z + arrivals[i].distance * rays[i].direction.z;
    isWithin[i] = depth >= low && depth <= high && arrivals[i].isSeen;
    if (isWithin[i]) surface = arrivals[i].plane;
  }
  vec3 distances;
  for (int i = 0; i < 3; ++i) {
    const float depth = rays[i].start.z + arrivals[i].distance * rays[i].direction.z;
    const PlaneMeeting meeting = meetTangentPlane(rays[i].start, rays[i].direction, surface);
    const float toBand = distanceToDepth(rays[i], clamp(depth, low, high));
    const bool isAhead = meeting.approach > 1e-2 && meeting.distance >= 0;
    distances[i] = isWithin[i] ? arrivals[i].distance : isAhead ? meeting.distance : max(toBand, 0);
  }
  return distances;
}

Crossing crossingOf(Ray rays[3], Arrival arrivals[3], uint plane, uint window) {
  const PlaneSet set = constants.set;
  const float depth = set.firstDepth + float(plane) * set.depthStep;
  if (kFollowsReceivers == 0)
    return crossingAt(rays, vec3(distanceToDepth(rays[0], depth), distanceToDepth(rays[1], depth),
                                 distanceToDepth(rays[2], depth)));
  // The first and the last plane have all that lies before and beyond.
  const float low = plane == 0 ? -1e30 : depth - reachOf(window);
  const float high = plane == set.planes - 1 ? 1e30 : depth + reachOf(window);
  return crossingAt(rays, distancesNear(low, high, rays, arrivals));
}

float least(vec3 v) {
  return min(min(v.x, v.y), v.z);
}
float most(vec3 v) {
  return max(max(v.x, v.y), v.z);
}

// The first plane that a beam leaves light on, and how many. `depths` are those of its arrival.
uvec2 planesOf(vec3 depths, uint window) {
  const PlaneSet set = constants.set;
  const float last = float(set.planes - 1);
  if (kFollowsReceivers == 0 || set.depthStep == 0) return uvec2(0, set.planes);
  const float first =
      clamp(ceil((least(depths) - reachOf(window) - set.firstDepth) / set.depthStep), 0, last);
  return uvec2(
      first,
      clamp(floor((most(depths) + reachOf(window) - set.firstDepth) / set.depthStep), 0, last) - first + 1);
}

// Whether all that the outer window is asked for, on `planes`, lies off this beam: the inner one answers
// there, down to one and a half of the outer one's texels from its borders. Corner rays are straight: what is
// inside on both of the outermost planes is so between them.
bool isInsideInnerWindow(Ray rays[3], Arrival arrivals[3], uvec2 planes) {
  const Window window = constants.set.windows[0];
  const float border = 1 + 2 * window.texelsPerMeter / constants.set.windows[1].texelsPerMeter;
  bool isInside = true;
  for (uint end = 0; end < 2; ++end) {
    const Crossing crossing = crossingOf(rays, arrivals, end == 0 ? planes.x : planes.x + planes.y - 1, 1);
    const vec2 lower = min(min(crossing.a.xy, crossing.b.xy), crossing.c.xy);
    const vec2 upper = max(max(crossing.a.xy, crossing.b.xy), crossing.c.xy);
    isInside = isInside && all(greaterThan(texelOfWindow(window, lower), vec2(border))) &&
               all(lessThan(texelOfWindow(window, upper), vec2(window.size - border)));
  }
  return isInside;
}

// What a beam leaves on a plane. Corners are as centerFootprint leaves them, in texels from `base`; of a line
// a and c are its ends.
struct Footprint {
  vec2 a, b, c;
  vec2 base;
  vec2 lower, upper;  // the first and the last texel of the window that it may touch
  vec3 slopes;        // of a line x is where along it its peak lies
  float perArea;      // of the flux in a texel squared; 0 for a line
};

// `size` is that of the texture, corners are in its texels.
Footprint footprintOf(vec2 a, vec2 b, vec2 c, float size) {
  Footprint print;
  print.lower = floor(min(min(a, b), c));
  print.upper = floor(max(max(a, b), c));
  print.a = a;
  print.b = b;
  print.c = c;
  centerFootprint(print.a, print.b, print.c, print.base);
  print.slopes = sideSlopes(print.a, print.b, print.c);
  print.perArea = 2 / max(abs(doubledArea(print.a, print.b, print.c)), 1e-20);
  if (print.lower == print.upper || isSliver(print.a, print.b, print.c)) {
    print.slopes.x = sortSliver(a, b, c);
    print.base = print.lower;
    print.a = a - print.base;
    print.c = c - print.base;
    print.perArea = 0;
  }
  print.lower = max(print.lower, vec2(0));
  print.upper = min(print.upper, vec2(size - 1));
  return print;
}

// From the thread that found it to all.
Footprint shuffled(Footprint print, uint thread) {
  return Footprint(subgroupShuffle(print.a, thread), subgroupShuffle(print.b, thread),
                   subgroupShuffle(print.c, thread), subgroupShuffle(print.base, thread),
                   subgroupShuffle(print.lower, thread), subgroupShuffle(print.upper, thread),
                   subgroupShuffle(print.slopes, thread), subgroupShuffle(print.perArea, thread));
}

// The texture of a plane, and the beam whose light it takes.
struct Target {
  uint layer;   // of the first channel
  vec2 origin;  // of the texture in the layer, texels
  uint window;
  float fineness;  // of its texels, against those of the window
  vec3 units;      // of flux, by channel
  vec3 along;  // the beam, m along the axes for each meter that it comes nearer to or farther from the plane
};

Target shuffled(Target target, uint thread) {
  return Target(subgroupShuffle(target.layer, thread), subgroupShuffle(target.origin, thread),
                subgroupShuffle(target.window, thread), subgroupShuffle(target.fineness, thread),
                subgroupShuffle(target.units, thread), subgroupShuffle(target.along, thread));
}

// Whether a footprint, its corners in the window's texels, is wide and dim.
bool isForCoarsePart(vec2 a, vec2 b, vec2 c, float units, uint window) {
  const Window inner = constants.set.windows[0];
  const float texels = inner.size * constants.set.windows[window].texelsPerMeter / inner.texelsPerMeter;
  const vec2 extent = max(max(a, b), c) - min(min(a, b), c);
  return max(extent.x, extent.y) > kWideFootprint &&
         units * texels * texels < 0.5 * kDimFootprint * kUnitsOfAllFlux * abs(doubledArea(a, b, c));
}

// Puts a part of the beam's flux on a texel of a flat plane, as the illuminance of what the virtual camera
// sees there; and as it is on a plane that follows the receivers.
void add(vec2 texel, float part, Target target) {
  vec3 units = part * target.units;
  if (kFollowsReceivers == 0) {
    const vec3 normal =
        unpackedNormal(texelFetch(seenNormals, ivec3((texel + 0.5) / target.fineness, target.window), 0).r);
    // The beam's angle with the surface over that with the plane, as cosines.
    units *= max(target.along.z * normal.z - dot(target.along.xy, normal.xy), 0) *
             inversesqrt(dot(normal, normal));
  }
  units += 0.5;
  for (uint c = 0; c < kChannels; ++c)
    if (units[c] >= 1.0)
      imageAtomicAdd(textures,
                     ivec3(texel + target.origin, target.layer + c * layersOfChannel(constants.set)),
                     uint(units[c]));
}

// The threads of a subgroup stand in a block.
struct Block {
  uvec2 size;
  uvec2 place;  // of this thread
};

Block blockOfSubgroup() {
  const uint width = 1u << ((uint(findMSB(gl_SubgroupSize)) + 1) / 2), thread = gl_SubgroupInvocationID;
  return Block(uvec2(width, gl_SubgroupSize / width), uvec2(thread % width, thread / width));
}

// Shares out a line's flux. Texels are clipped against it side by side: nothing is left out between them.
void addLine(Footprint print, Target target, Block block) {
  const vec2 along = print.c - print.a;
  float y = print.lower.y + float(block.place.y);
  do {
    const vec2 row = lineInSlab(print.a.y, along.y, y - print.base.y);
    float x = print.lower.x + float(block.place.x);
    do {
      const vec2 column = lineInSlab(print.a.x, along.x, x - print.base.x);
      const vec2 ends = clamp(vec2(max(row.x, column.x), min(row.y, column.y)), 0, 1);
      const float part = max(tentBefore(ends.y, print.slopes.x) - tentBefore(ends.x, print.slopes.x), 0);
      if (x <= print.upper.x && y <= print.upper.y) add(vec2(x, y), part, target);
      x += float(block.size.x);
    } while (x <= print.upper.x);
    y += float(block.size.y);
  } while (y <= print.upper.y);
}

void addTriangle(Footprint print, Target target, Block block) {
  float y = print.lower.y + float(block.place.y);
  do {
    const TriangleRow row = triangleInRow(print.a, print.b, print.c, print.slopes, y - print.base.y);
    const float last = y <= print.upper.y ? min(floor(row.last) + print.base.x, print.upper.x) : -1;
    float x = max(floor(row.first) + print.base.x, print.lower.x) + float(block.place.x);
    do {
      const float part = triangleCoverage(row, x - print.base.x) * print.perArea;
      if (x <= last) add(vec2(x, y), part, target);
      x += float(block.size.x);
    } while (x <= last);
    y += float(block.size.y);
  } while (y <= print.upper.y);
}

void main() {
  const PlaneSet set = constants.set;
  const Block block = blockOfSubgroup();
  const uint index = gl_GlobalInvocationID.x;
  const Beam beam = constants.beams.beam[min(index, constants.beamCount - 1)];
  Ray rays[3];
  for (int i = 0; i < 3; ++i) rays[i] = rayOf(beam.position[i], beam.direction[i]);
  const vec3 direction = normalize(rays[0].direction + rays[1].direction + rays[2].direction);
  bool isThere = index < constants.beamCount;
  if (kGoesAlongAxis != 0) isThere = isThere && direction.z >= kLeastPlaneApproach;
  if (kFollowsReceivers == 0) isThere = isThere && abs(direction.z) >= kLeastPlaneApproach;

  Arrival arrivals[3];
  vec3 depths = vec3(0);  // m along axisW
  if (kFollowsReceivers != 0) {
    float seen = 0, distance = 0;
    for (int i = 0; i < 3; ++i) {
      arrivals[i] = arrivalOf(rays[i], beam.reach[i]);
      if (arrivals[i].isSeen) ++seen, distance += arrivals[i].distance;
    }
    for (int i = 0; i < 3; ++i) {
      // A corner that is not seen goes as far as those that are.
      if (!arrivals[i].isSeen) arrivals[i].distance = distance / max(seen, 1);
      depths[i] = rays[i].start.z + arrivals[i].distance * rays[i].direction.z;
    }
    isThere = isThere && seen > 0;
  }
  Target target;
  target.along = direction / abs(direction.z);
  target.units = beam.flux / set.luxMetersSquaredPerUnit;
  // One channel stands for all that have light; the first may have none.
  if (kChannels == 1) target.units.x = most(target.units);

  // Planes of the inner window, then of the outer one.
  const uvec2 inner = planesOf(depths, 0), outer = planesOf(depths, 1);
  const uint count = !isThere ? 0 : isInsideInnerWindow(rays, arrivals, outer) ? inner.y : inner.y + outer.y;
  uint i = 0;
  do {
    target.window = i < inner.y ? 0 : 1;
    const uint plane = i < inner.y ? inner.x + i : outer.x + i - inner.y;
    const Crossing crossing = crossingOf(rays, arrivals, plane, target.window);
    const Window window = set.windows[target.window];
    vec2 a = texelOfWindow(window, crossing.a.xy), b = texelOfWindow(window, crossing.b.xy),
         c = texelOfWindow(window, crossing.c.xy);
    const uint texture = textureIndex(set, plane, target.window);
    const bool isCoarse = isForCoarsePart(a, b, c, most(target.units), target.window);
    target.layer = isCoarse ? coarseLayer(set, texture) : texture;
    target.origin = isCoarse ? coarseTile(texture) * floor(constants.textureSize / kCoarseness) : vec2(0);
    target.fineness = isCoarse ? 1.0 / kCoarseness : 1;
    a *= target.fineness;
    b *= target.fineness;
    c *= target.fineness;
    const Footprint print = footprintOf(a, b, c, floor(window.size * target.fineness));
    Target own = target;
    own.units *= crossing.part;
    const bool isDrawn = i < count && crossing.part > 0 && all(lessThanEqual(print.lower, print.upper));
    bool waits = isDrawn && print.perArea > 0;
    uvec4 waiting = subgroupBallot(waits);
    if (waiting != uvec4(0)) {
      do {
        const uint next = subgroupBallotFindLSB(waiting);
        addTriangle(shuffled(print, next), shuffled(own, next), block);
        waits = waits && gl_SubgroupInvocationID != next;
        waiting = subgroupBallot(waits);
      } while (waiting != uvec4(0));
    }
    waits = isDrawn && print.perArea == 0;
    waiting = subgroupBallot(waits);
    if (waiting != uvec4(0)) {
      do {
        const uint next = subgroupBallotFindLSB(waiting);
        addLine(shuffled(print, next), shuffled(own, next), block);
        waits = waits && gl_SubgroupInvocationID != next;
        waiting = subgroupBallot(waits);
      } while (waiting != uvec4(0));
    }
    ++i;
  } while (subgroupBallot(i < count) != uvec4(0));
}

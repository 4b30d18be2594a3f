// Adds to each pixel the light of every beam that it lies in (Barczak and Olano, 3.1 and 3.2, without planes
// and stencils): what part of the beam's footprint on the receiver the pixel's own square there holds. So no
// flux is lost or made where beams are narrower than a pixel.
//
// A subgroup takes a block of pixels down the hierarchy of beams, its threads one bound each; beams that may
// have light in the block wait until there is one for each thread. Then each thread loads one, and each quarter
// of the block goes through those that may have light in it, a pixel a thread. A software device passes through
// all that stands under a condition, whether it has threads for it or not, so the work is kept from it by lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "techniques/light_volumes/shader_data.h"

layout(constant_id = 0) const uint kIsStill = 0;   // the flat-water approximation of the cosine
layout(constant_id = 1) const uint kIsFlat = 0;    // every beam is asked for, without the hierarchy
layout(local_size_x = kThreads) in;
layout(push_constant, scalar) uniform Constants { LightVolumeConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D receiverNormal;
layout(set = 0, binding = 2, rgba32f) uniform image2D causticsLux;

// For each thread: groups of bounds that wait to be asked, and beams that wait to be drawn.
const uint kGroupsAThread = 32, kBeamsAThread = 2;
shared uint groups[kThreads * kGroupsAThread];
shared uint beams[kThreads * kBeamsAThread];

// The square of the receiver that a pixel shows.
struct Pixel {
  vec3 point;   // m
  vec3 normal;  // unit; zero where there is no receiver
  vec3 axisU;   // pixels per metre, on the tangent plane
  vec3 axisV;
  float inverseArea;  // 1/m^2
};

// m from one pixel to the next on the tangent plane; of its two neighbours the one that lies nearer to it.
vec3 stepAlong(ivec2 at, ivec2 along, vec3 point, vec3 normal) {
  const vec4 next = imageLoad(receiverPosition, at + along), last = imageLoad(receiverPosition, at - along);
  const vec3 forward = next.xyz - point, backward = point - last.xyz;
  const vec3 onward = forward - normal * dot(forward, normal), back = backward - normal * dot(backward, normal);
  const float forwardOff = next.w != 0 ? abs(dot(forward, normal)) + 0.1 * length(onward) : 1e30;
  const float backwardOff = last.w != 0 ? abs(dot(backward, normal)) + 0.1 * length(back) : 1e30;
  if (min(forwardOff, backwardOff) == 1e30) return vec3(0);
  return forwardOff <= backwardOff ? onward : back;
}

Pixel pixelAt(ivec2 at, bool isAsked) {
  const vec4 point = imageLoad(receiverPosition, at);
  Pixel pixel = Pixel(point.xyz, vec3(0), vec3(0), vec3(0), 0);
  if (!isAsked || point.w == 0) return pixel;
  pixel.normal = normalize(imageLoad(receiverNormal, at).xyz);
  vec3 stepU = stepAlong(at, ivec2(1, 0), pixel.point, pixel.normal);
  vec3 stepV = stepAlong(at, ivec2(0, 1), pixel.point, pixel.normal);
  // A pixel without neighbours is taken for a square.
  if (stepU == vec3(0) && stepV == vec3(0)) stepU = 1e-3 * normalize(cross(pixel.normal, pixel.normal.yzx + vec3(0, 0, 1)));
  if (stepU == vec3(0)) stepU = cross(stepV, pixel.normal);
  if (stepV == vec3(0)) stepV = cross(pixel.normal, stepU);
  vec3 area = cross(stepU, stepV);
  if (dot(area, area) < 1e-8 * dot(stepU, stepU) * dot(stepV, stepV)) {
    stepV = cross(pixel.normal, stepU);
    area = cross(stepU, stepV);
  }
  const float size = dot(area, pixel.normal);
  pixel.axisU = cross(stepV, pixel.normal) / size;
  pixel.axisV = cross(pixel.normal, stepU) / size;
  pixel.inverseArea = 1 / abs(size);
  return pixel;
}

vec3 leastInSubgroup(vec3 v) {
  for (uint apart = gl_SubgroupSize / 2; apart > 0; apart /= 2) v = min(v, subgroupShuffleXor(v, apart));
  return v;
}

uint takeNext(inout uvec4 waiting) {
  const uint next = subgroupBallotFindLSB(waiting) & (gl_SubgroupSize - 1);  // of none: undefined
  const uint bit = ~(1u << (next % 32));
  const uint word = next / 32;
  waiting = uvec4(word == 0 ? waiting.x & bit : waiting.x, word == 1 ? waiting.y & bit : waiting.y,
                  word == 2 ? waiting.z & bit : waiting.z, word == 3 ? waiting.w & bit : waiting.w);
  return next;
}

// The threads' pixels, and the box of what they show.
struct Quarter {
  ivec2 place;
  Pixel pixel;
  vec3 low;
  vec3 high;
  // Where the receiver is as good as a plane: one pixel that stands for all, where in its pixels this one lies, and
  // what takes its pixels to this one's.
  bool isPlane;
  Pixel plane;
  vec2 onPlane;
  mat2 fromPlane;
  vec2 lowOnPlane;
  vec2 highOnPlane;
  vec3 lux;
};

Quarter quarterAt(uvec2 within) {
  Quarter quarter;
  quarter.place = constants.corner + ivec2(within);
  quarter.pixel = pixelAt(quarter.place, all(lessThan(ivec2(within), constants.size)));
  quarter.lux = vec3(0);
  const Pixel pixel = quarter.pixel;
  // Half a pixel to each side: the axes' duals are the steps.
  const float dualArea = dot(cross(pixel.axisU, pixel.axisV), pixel.normal);
  const vec3 stepU = cross(pixel.axisV, pixel.normal) / dualArea, stepV = cross(pixel.normal, pixel.axisU) / dualArea;
  const vec3 reach = 0.5 * (abs(stepU) + abs(stepV));
  const bool isThere = pixel.inverseArea != 0;
  quarter.low = leastInSubgroup(isThere ? pixel.point - reach : vec3(1e30));
  quarter.high = -leastInSubgroup(isThere ? -pixel.point - reach : vec3(1e30));

  uvec4 there = subgroupBallot(isThere);
  const uint chosen = takeNext(there);
  const Pixel plane = Pixel(subgroupShuffle(pixel.point, chosen), subgroupShuffle(pixel.normal, chosen),
                            subgroupShuffle(pixel.axisU, chosen), subgroupShuffle(pixel.axisV, chosen),
                            subgroupShuffle(pixel.inverseArea, chosen));
  const vec3 offset = pixel.point - plane.point;
  quarter.plane = plane;
  quarter.onPlane = vec2(dot(offset, plane.axisU), dot(offset, plane.axisV));
  const bool isOff = dot(pixel.normal, plane.normal) < 0.9999 ||
                     abs(dot(offset, plane.normal)) * sqrt(plane.inverseArea) > 0.01;  // pixels
  quarter.isPlane = subgroupBallot(isThere && isOff) == uvec4(0);
  const float planeDual = dot(cross(plane.axisU, plane.axisV), plane.normal);
  const vec3 planeU = cross(plane.axisV, plane.normal) / planeDual, planeV = cross(plane.normal, plane.axisU) / planeDual;
  quarter.fromPlane = mat2(dot(pixel.axisU, planeU), dot(pixel.axisV, planeU), dot(pixel.axisU, planeV), dot(pixel.axisV, planeV));
  const vec2 halfSize = 0.5 * (abs(vec2(dot(stepU, plane.axisU), dot(stepU, plane.axisV))) +
                           abs(vec2(dot(stepV, plane.axisU), dot(stepV, plane.axisV))));
  quarter.lowOnPlane = leastInSubgroup(isThere ? vec3(quarter.onPlane - halfSize, 0) : vec3(1e30)).xy;
  quarter.highOnPlane = -leastInSubgroup(isThere ? vec3(-quarter.onPlane - halfSize, 0) : vec3(1e30)).xy;
  return quarter;
}

// Where a beam crosses a receiver's tangent plane.
struct Crossing {
  vec2 corners[3];  // in pixels from the pixel's middle
  vec3 lit;         // 1 where a corner ray comes so far
  float cosine;     // mean of the corners'; none where a corner does not approach
};

Crossing crossingOf(Beam beam, Pixel pixel) {
  Crossing crossing;
  float steepest = 1, sum = 0;
  for (int i = 0; i < 3; ++i) {
    const float approach = -dot(beam.direction[i], pixel.normal);
    const vec3 ahead = pixel.point - beam.position[i];
    const float way = -dot(ahead, pixel.normal) / max(approach, 1e-4);
    const vec3 offset = way * beam.direction[i] - ahead;
    crossing.corners[i] = vec2(dot(offset, pixel.axisU), dot(offset, pixel.axisV));
    const float tolerance = reachTolerance(beam.reach[i], length(offset));
    crossing.lit[i] = way >= -tolerance && way <= beam.reach[i] + tolerance ? 1 : 0;
    steepest = min(steepest, approach);
    sum += approach;
  }
  crossing.cosine = steepest < 1e-3 || crossing.lit == vec3(0) ? 0 : sum / 3;
  return crossing;
}

// In place of the beam's own cosine with the receiver.
float cosineInStead(vec3 still, Crossing crossing, Pixel pixel) {
  return kIsStill != 0 ? max(-dot(still, pixel.normal), 0) / max(crossing.cosine, 1e-3) : 1;
}

// lux
vec3 illuminanceBy(Beam beam, vec3 still, Pixel pixel) {
  const Crossing crossing = crossingOf(beam, pixel);
  if (crossing.cosine == 0) return vec3(0);
  // Corners hidden by what stands before: the light fades toward them.
  const vec2 a = crossing.corners[0], b = crossing.corners[1], c = crossing.corners[2];
  const float all = doubledArea(a, b, c);
  const vec3 weights = vec3(doubledArea(vec2(0), b, c), doubledArea(a, vec2(0), c), doubledArea(a, b, vec2(0)));
  const vec3 inside = clamp(weights * sign(all), vec3(0), vec3(abs(all)));
  const float part = crossing.lit == vec3(1) ? 1 : dot(crossing.lit, inside) / max(dot(inside, vec3(1)), 1e-30);
  return beam.flux * (shareInTexel(a + 0.5, b + 0.5, c + 0.5) * part * cosineInStead(still, crossing, pixel) * pixel.inverseArea);
}

Beam beamOfThread(Beam beam, uint thread) {
  Beam own;
  for (int i = 0; i < 3; ++i) {
    own.position[i] = subgroupBroadcast(beam.position[i], thread);
    own.direction[i] = subgroupBroadcast(beam.direction[i], thread);
  }
  own.flux = subgroupBroadcast(beam.flux, thread);
  own.reach = subgroupBroadcast(beam.reach, thread);
  return own;
}

// `own` and `bounds` are a beam of this thread, one that `isReady`. On a plane each thread finds where its beam
// crosses that; beams partly in shadow, and those on other receivers, are crossed with each pixel.
void lightQuarter(inout Quarter quarter, Beam own, BeamBounds bounds, vec3 still, bool isReady) {
  const bool meets = isReady && boundsMeetBox(bounds, quarter.low, quarter.high);
  const Crossing crossing = crossingOf(own, quarter.plane);
  const vec2 lower = min(min(crossing.corners[0], crossing.corners[1]), crossing.corners[2]);
  const vec2 upper = max(max(crossing.corners[0], crossing.corners[1]), crossing.corners[2]);
  const bool isClear = quarter.isPlane && (crossing.cosine == 0 || crossing.lit == vec3(1));
  const bool isOnPlane = crossing.cosine != 0 && all(lessThanEqual(lower, quarter.highOnPlane)) &&
                         all(greaterThanEqual(upper, quarter.lowOnPlane));
  const vec3 flux = own.flux * cosineInStead(still, crossing, quarter.plane);
  uvec4 clear = subgroupBallot(meets && isClear && isOnPlane);
  while (clear != uvec4(0)) {
    const uint next = takeNext(clear);
    const vec2 u = quarter.fromPlane * (subgroupBroadcast(crossing.corners[0], next) - quarter.onPlane);
    const vec2 v = quarter.fromPlane * (subgroupBroadcast(crossing.corners[1], next) - quarter.onPlane);
    const vec2 w = quarter.fromPlane * (subgroupBroadcast(crossing.corners[2], next) - quarter.onPlane);
    quarter.lux += subgroupBroadcast(flux, next) * (shareInTexel(u + 0.5, v + 0.5, w + 0.5) * quarter.pixel.inverseArea);
  }
  uvec4 others = subgroupBallot(meets && !isClear);
  while (others != uvec4(0)) {
    const uint next = takeNext(others);
    quarter.lux += illuminanceBy(beamOfThread(own, next), kIsStill != 0 ? subgroupBroadcast(still, next) : vec3(0), quarter.pixel);
  }
}

void store(Quarter quarter) {
  if (quarter.pixel.inverseArea != 0 && quarter.lux != vec3(0))
    imageStore(causticsLux, quarter.place, imageLoad(causticsLux, quarter.place) + vec4(quarter.lux, 0));
}

void main() {
  const uint threads = gl_SubgroupSize, thread = gl_SubgroupInvocationID;
  const uint firstGroup = gl_SubgroupID * threads * kGroupsAThread, firstBeam = gl_SubgroupID * threads * kBeamsAThread;

  const uvec2 size = uvec2(threads >= 32 ? 8 : threads >= 8 ? 4 : 2, threads / (threads >= 32 ? 8 : threads >= 8 ? 4 : 2));
  const uint blocksAcross = kTileSize / (2 * size.x);
  const uvec2 block = gl_WorkGroupID.xy * kTileSize + 2 * size * uvec2(gl_SubgroupID % blocksAcross, gl_SubgroupID / blocksAcross);
  const uvec2 first = block + uvec2(thread % size.x, thread / size.x);
  Quarter a = quarterAt(first), b = quarterAt(first + uvec2(size.x, 0)), c = quarterAt(first + uvec2(0, size.y)),
          d = quarterAt(first + size);
  const vec3 low = min(min(a.low, b.low), min(c.low, d.low)), high = max(max(a.high, b.high), max(c.high, d.high));
  if (low.x > high.x) return;

  uint tested = 0, met = 0, drawn = 0;
  uint waitingGroups = 1, waitingBeams = 0;
  if (thread == 0) groups[firstGroup] = constants.root;
  subgroupMemoryBarrierShared();
  subgroupBarrier();
  do {
    if (waitingGroups > 0) {
      const uint asked = min(waitingGroups, max(threads / kChildren, 1));
      waitingGroups -= asked;
      const uint group = groups[firstGroup + waitingGroups + min(thread / kChildren, asked - 1)];
      subgroupMemoryBarrierShared();
      subgroupBarrier();
      uint begin = 0;
      do {
        const uint child = begin + thread;
        const bool isThere = child < kChildren * asked;
        const uint index = group + child % kChildren;
        const BeamBounds bounds = constants.bounds.bounds[index];
        const bool isEmpty = bounds.nearest > bounds.farthest;
        const bool isBeam = (bounds.kind & kIsBeam) != 0;
        const bool meets = isThere && !isEmpty &&
                           (boundsMeetBox(bounds, low, high) || (kIsFlat != 0 && !isBeam));
        const uvec4 inner = subgroupBallot(meets && !isBeam), ends = subgroupBallot(meets && isBeam);
        if (meets && !isBeam) groups[firstGroup + waitingGroups + subgroupBallotExclusiveBitCount(inner)] = bounds.first;
        if (meets && isBeam) beams[firstBeam + waitingBeams + subgroupBallotExclusiveBitCount(ends)] = index;
        waitingGroups += subgroupBallotBitCount(inner);
        waitingBeams += subgroupBallotBitCount(ends);
        tested += subgroupBallotBitCount(subgroupBallot(isThere && !isEmpty));
        met += subgroupBallotBitCount(inner) + subgroupBallotBitCount(ends);
        begin += threads;
      } while (begin < kChildren * asked);
      subgroupMemoryBarrierShared();
      subgroupBarrier();
    }
    while (waitingBeams > 0 && (waitingBeams >= threads || waitingGroups == 0)) {
      const uint taken = min(waitingBeams, threads);
      waitingBeams -= taken;
      const BeamBounds bounds = constants.bounds.bounds[beams[firstBeam + waitingBeams + min(thread, taken - 1)]];
      const Beam own = constants.beams.beam[bounds.first];
      const vec3 still = kIsStill != 0 ? constants.still.direction[bounds.kind >> kPortionShift].xyz : vec3(0);
      lightQuarter(a, own, bounds, still, thread < taken);
      lightQuarter(b, own, bounds, still, thread < taken);
      lightQuarter(c, own, bounds, still, thread < taken);
      lightQuarter(d, own, bounds, still, thread < taken);
      drawn += taken;
      subgroupMemoryBarrierShared();
      subgroupBarrier();
    }
  } while (waitingGroups + waitingBeams > 0);
  store(a);
  store(b);
  store(c);
  store(d);
  if (thread == 0) {
    atomicAdd(constants.counts.tested, tested);
    atomicAdd(constants.counts.culled, tested - met);
    atomicAdd(constants.counts.drawn, drawn);
  }
}

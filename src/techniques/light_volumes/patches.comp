// Finds for each tile of pixels the beams that may light it, down the hierarchy of beams, and lists them as
// squares of pixels to draw (Barczak and Olano, 3.3: culling by the view and clamping to receivers in one,
// against what is really seen).
//
// A group, which is one subgroup, has a tile, and takes it in patches: pixels that show nearly one plane,
// where a beam's footprint on that plane tells which pixels it may light. The order of one tile's draws is
// always the same, which alone matters. A software device passes at least once through each loop, and through
// all that stands under a condition: so loops follow each other and are not nested.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "techniques/light_volumes/shader_data.h"

#include "techniques/light_volumes/beam_texels.glsl.h"
#include "techniques/light_volumes/receiver_square.glsl.h"

layout(constant_id = 0) const uint kIsFlat = 0;  // every beam is asked for, without the hierarchy
layout(local_size_x_id = 1) in;
layout(push_constant, scalar) uniform Constants {
  PatchConstants constants;
};
layout(rgba32f) uniform readonly image2D receiverPosition;
layout(rgba32f) uniform readonly image2D receiverNormal;
layout(rgba32f) uniform image2D axesU;
layout(rgba32f) uniform image2D axesV;  // a: which of its tile's patches a pixel is of
uniform utexture2D boundsTexels;
uniform utexture2D beamTexels;

// For each thread: groups of bounds that wait to be asked, and beams that wait to be drawn.
const uint kGroupsAThread = 32, kBeamsAThread = 32;
shared uint groups[gl_WorkGroupSize.x * kGroupsAThread];
shared uint beams[gl_WorkGroupSize.x * kBeamsAThread];

// What pixels of one patch may differ in.
const float kMostHeight = 1;     // pixels, off the plane
const float kLeastCosine = 0.9;  // between normals

// m, what floats near a point tell well apart.
float finestStep(vec3 point) {
  const vec3 size = abs(point);
  return 1e-6 * max(max(size.x, size.y), size.z);
}

// What a pixel shows; past the image's edge what the last one shows.
vec4 receiverAt(ivec2 at) {
  return imageLoad(receiverPosition, clamp(at, ivec2(0), imageSize(receiverPosition) - 1));
}

// m from one pixel to the next on the tangent plane; of its two neighbors the one that lies nearer to it.
// None where a caster shows both of them what it shows the pixel, and for a neighbor past the image's edge.
vec3 stepAlong(ivec2 at, ivec2 along, vec3 point, vec3 normal) {
  const vec4 next = receiverAt(at + along), last = receiverAt(at - along);
  const vec3 forward = next.xyz - point, backward = point - last.xyz;
  const vec3 onward = forward - normal * dot(forward, normal),
             back = backward - normal * dot(backward, normal);
  const float forwardStep = length(onward), backwardStep = length(back), finest = finestStep(point);
  const float forwardOff =
      next.w != 0 && forwardStep > finest ? abs(dot(forward, normal)) + 0.1 * forwardStep : 1e30;
  const float backwardOff =
      last.w != 0 && backwardStep > finest ? abs(dot(backward, normal)) + 0.1 * backwardStep : 1e30;
  if (min(forwardOff, backwardOff) == 1e30) return vec3(0);
  return forwardOff <= backwardOff ? onward : back;
}

ReceiverSquare squareAt(ivec2 at) {
  const vec4 point = imageLoad(receiverPosition, at);
  ReceiverSquare square = ReceiverSquare(point.xyz, vec3(0), vec3(0), vec3(0), 0);
  if (point.w == 0) return square;
  square.normal = normalize(imageLoad(receiverNormal, at).xyz);
  vec3 stepU = stepAlong(at, ivec2(1, 0), square.point, square.normal);
  vec3 stepV = stepAlong(at, ivec2(0, 1), square.point, square.normal);
  // A pixel without neighbors is taken for a small square.
  if (stepU == vec3(0) && stepV == vec3(0))
    stepU = max(16 * finestStep(square.point), 1e-6) *
            normalize(cross(square.normal, square.normal.yzx + vec3(0, 0, 1)));
  if (stepU == vec3(0)) stepU = cross(stepV, square.normal);
  if (stepV == vec3(0)) stepV = cross(square.normal, stepU);
  vec3 area = cross(stepU, stepV);
  if (dot(area, area) < 1e-8 * dot(stepU, stepU) * dot(stepV, stepV)) {
    stepV = cross(square.normal, stepU);
    area = cross(stepU, stepV);
  }
  const float size = dot(area, square.normal);
  square.axisU = cross(stepV, square.normal) / size;
  square.axisV = cross(square.normal, stepU) / size;
  square.inverseArea = 1 / size;
  return square;
}

vec4 leastInSubgroup(vec4 v) {
  for (uint apart = gl_SubgroupSize / 2; apart > 0; apart /= 2) v = min(v, subgroupShuffleXor(v, apart));
  return v;
}

BeamBounds boundsAt(uint index) {
  const ivec2 texel = firstTexel(index, kTexelsOfBounds);
  return boundsFromTexels(
      texelFetch(boundsTexels, texel, 0), texelFetch(boundsTexels, texel + ivec2(1, 0), 0),
      texelFetch(boundsTexels, texel + ivec2(2, 0), 0), texelFetch(boundsTexels, texel + ivec2(3, 0), 0));
}

Beam beamAt(uint index) {
  const ivec2 texel = firstTexel(index, kTexelsOfBeam);
  vec4 rays[6];
  for (int i = 0; i < 6; ++i) rays[i] = uintBitsToFloat(texelFetch(beamTexels, texel + ivec2(i, 0), 0));
  return beamFromTexels(rays);
}

uint thread() {
  return gl_SubgroupInvocationID;
}

ivec2 placeInTile(uint pixel) {
  return ivec2(pixel % kTileSize, pixel / kTileSize);
}

// Whether any beam may light what a tile shows. Its pixels' squares reach half as far to one side as its
// neighbors lie to the other.
bool isWithinBeams(ivec2 tile) {
  vec4 low = vec4(1e30), high = vec4(-1e30);
  const uint width = kTileSize + 2;
  for (uint pixel = thread(); pixel < width * width; pixel += gl_SubgroupSize) {
    const vec4 point = receiverAt(tile + ivec2(pixel % width, pixel / width) - 1);
    if (point.w == 0) continue;
    low = min(low, point);
    high = max(high, point);
  }
  low = leastInSubgroup(low);
  high = -leastInSubgroup(-high);
  const vec3 margin = 0.5 * (high.xyz - low.xyz) + 1e-3;
  bool meets = false;
  for (uint child = thread(); child < kChildren; child += gl_SubgroupSize) {
    const BeamBounds bounds = boundsAt(constants.root + child);
    meets = meets ||
            (bounds.nearest <= bounds.farthest && boundsMeetBox(bounds, low.xyz - margin, high.xyz + margin));
  }
  return low.x <= high.x && subgroupBallot(meets) != uvec4(0);
}

// Of the first so many pixels of a tile. Of the thread's own, one bit each: those with a receiver.
uint storeSquares(ivec2 tile, uint pixels) {
  uint there = 0, bit = 1;
  for (uint pixel = thread(); pixel < pixels; pixel += gl_SubgroupSize, bit <<= 1) {
    const ivec2 place = tile + placeInTile(pixel);
    if (any(greaterThanEqual(place, constants.corner + constants.size))) continue;
    const ReceiverSquare square = squareAt(place);
    imageStore(axesU, place, axisUTexel(square));
    imageStore(axesV, place, axisVTexel(square, 0));
    if (square.inverseArea != 0) there |= bit;
  }
  return there;
}

// One that this thread stored.
ReceiverSquare loadSquare(ivec2 place) {
  return squareFromTexels(imageLoad(receiverPosition, place).xyz, imageLoad(axesU, place),
                          imageLoad(axesV, place));
}

// One that the thread `from` stored.
ReceiverSquare loadSquareOf(uint from, ivec2 place) {
  ReceiverSquare square;
  if (thread() == from) square = loadSquare(place);
  return ReceiverSquare(subgroupShuffle(square.point, from), subgroupShuffle(square.normal, from),
                        subgroupShuffle(square.axisU, from), subgroupShuffle(square.axisV, from),
                        subgroupShuffle(square.inverseArea, from));
}

// The boxes that what the four blocks of a tile show fills on a patch's plane, in pixels from the patch's
// own. A block without any of the patch has negative sizes.
struct Blocks {
  vec4 middleX, middleY;
  vec4 halfX, halfY;
};

// Pixels that show nearly one plane: that of the square `plane`.
struct Patch {
  ReceiverSquare plane;
  vec3 low, high;  // m, the box around the visible surfaces
  Blocks blocks;
  float heightLow, heightHigh;  // m off the plane
  float spread;                 // the most that a normal differs from the plane's
};

Blocks blocksBetween(vec4 lowX, vec4 lowY, vec4 highX, vec4 highY) {
  const float rounding = 0.01;
  return Blocks(0.5 * (lowX + highX), 0.5 * (lowY + highY), 0.5 * (highX - lowX) + rounding,
                0.5 * (highY - lowY) + rounding);
}

// Takes from `waiting` the pixels that lie well with the square `plane`, and names them.
Patch takePatch(ivec2 tile, ReceiverSquare plane, bool isLast, float id, inout uint waiting) {
  const float pixelsPerMeter = sqrt(abs(plane.inverseArea));
  vec4 low = vec4(1e30), high = vec4(-1e30);  // a: m off the plane
  vec4 lowX = vec4(1e30), lowY = vec4(1e30), highX = vec4(-1e30), highY = vec4(-1e30);
  float spread = 0;
  uint bit = 1;
  for (uint pixel = thread(); pixel < kTilePixels; pixel += gl_SubgroupSize, bit <<= 1) {
    if ((waiting & bit) == 0) continue;
    const ivec2 at = placeInTile(pixel);
    const ReceiverSquare square = loadSquare(tile + at);
    const vec3 offset = square.point - plane.point;
    const vec2 onPlane = vec2(dot(offset, plane.axisU), dot(offset, plane.axisV));
    const float height = dot(offset, plane.normal);
    const bool fits = isLast || (abs(height) * pixelsPerMeter <= kMostHeight &&
                                 dot(square.normal, plane.normal) >= kLeastCosine);
    if (!fits) continue;
    waiting &= ~bit;
    imageStore(axesV, tile + at, axisVTexel(square, id));
    // The axes' duals are the steps from pixel to pixel.
    const vec3 halfU = 0.5 * cross(square.axisV, square.normal) / square.inverseArea;
    const vec3 halfV = 0.5 * cross(square.normal, square.axisU) / square.inverseArea;
    const vec3 reach = abs(halfU) + abs(halfV);
    const vec2 reachOnPlane = abs(vec2(dot(halfU, plane.axisU), dot(halfU, plane.axisV))) +
                              abs(vec2(dot(halfV, plane.axisU), dot(halfV, plane.axisV)));
    const float reachOff = abs(dot(halfU, plane.normal)) + abs(dot(halfV, plane.normal));
    low = min(low, vec4(square.point - reach, height - reachOff));
    high = max(high, vec4(square.point + reach, height + reachOff));
    const uint block = (at.x / kBlockSize) + 2 * (at.y / kBlockSize);
    const vec4 elsewhere = 1e30 * vec4(notEqual(uvec4(block), uvec4(0, 1, 2, 3)));
    lowX = min(lowX, onPlane.x - reachOnPlane.x + elsewhere);
    lowY = min(lowY, onPlane.y - reachOnPlane.y + elsewhere);
    highX = max(highX, onPlane.x + reachOnPlane.x - elsewhere);
    highY = max(highY, onPlane.y + reachOnPlane.y - elsewhere);
    spread = max(spread, length(square.normal - plane.normal));
  }
  low = leastInSubgroup(low);
  high = -leastInSubgroup(-high);
  const Blocks blocks = blocksBetween(leastInSubgroup(lowX), leastInSubgroup(lowY), -leastInSubgroup(-highX),
                                      -leastInSubgroup(-highY));
  return Patch(plane, low.xyz, high.xyz, blocks, low.w, high.w, -leastInSubgroup(vec4(-spread)).x);
}

// 1 for blocks that reach from the side a to b of a triangle to the side that its corner c is on, else 0.
vec4 isWithin(Blocks blocks, vec2 a, vec2 b, vec2 c, float rim) {
  const vec2 across = vec2(a.y - b.y, b.x - a.x);
  const float corner = dot(across, c - a);
  const vec4 middle = across.x * (blocks.middleX - a.x) + across.y * (blocks.middleY - a.y);
  const vec4 reach = abs(across.x) * (blocks.halfX + rim) + abs(across.y) * (blocks.halfY + rim);
  return vec4(greaterThanEqual(middle + reach, vec4(min(corner, 0)))) *
         vec4(lessThanEqual(middle - reach, vec4(max(corner, 0))));
}

// Which blocks a beam may light, one bit each.
uint blocksLitBy(Beam beam, Patch shown) {
  vec2 corners[3];
  float flattest = 1, rim = 0;
  for (int i = 0; i < 3; ++i) {
    const float approach = -dot(beam.direction[i], shown.plane.normal);
    const vec3 ahead = shown.plane.point - beam.position[i];
    const vec3 perHeight = beam.direction[i] / max(approach, 1e-4);
    const vec3 offset =
        -(dot(ahead, shown.plane.normal) + 0.5 * (shown.heightLow + shown.heightHigh)) * perHeight - ahead;
    corners[i] = vec2(dot(offset, shown.plane.axisU), dot(offset, shown.plane.axisV));
    const vec2 slope = abs(vec2(dot(perHeight, shown.plane.axisU), dot(perHeight, shown.plane.axisV)));
    rim = max(rim, 0.5 * (shown.heightHigh - shown.heightLow) * max(slope.x, slope.y));
    flattest = min(flattest, approach);
  }
  const vec2 low = min(min(corners[0], corners[1]), corners[2]) - rim,
             high = max(max(corners[0], corners[1]), corners[2]) + rim;
  const Blocks blocks = shown.blocks;
  vec4 lit = vec4(greaterThanEqual(blocks.middleX + blocks.halfX, vec4(low.x))) *
             vec4(lessThanEqual(blocks.middleX - blocks.halfX, vec4(high.x))) *
             vec4(greaterThanEqual(blocks.middleY + blocks.halfY, vec4(low.y))) *
             vec4(lessThanEqual(blocks.middleY - blocks.halfY, vec4(high.y))) *
             isWithin(blocks, corners[0], corners[1], corners[2], rim) *
             isWithin(blocks, corners[1], corners[2], corners[0], rim) *
             isWithin(blocks, corners[2], corners[0], corners[1], rim);
  // Rays that run along the plane cross it anywhere.
  if (flattest < 0.1) lit = vec4(1);
  lit *= vec4(greaterThan(blocks.halfX, vec4(0)));
  if (flattest + shown.spread < 1e-3) lit = vec4(0);
  return uint(dot(lit, vec4(1, 2, 4, 8)));
}

// Adds to the list the threads' own beams: on one or two blocks, or on the whole tile.
void list(uint index, bool isThere, ivec2 tile, uint id, Patch shown) {
  const BeamBounds bounds = boundsAt(index);
  const uint blocks = isThere ? blocksLitBy(beamAt(bounds.first), shown) : 0;
  const bool isWhole = bitCount(blocks) > 2;
  const uvec4 once = subgroupBallot(blocks != 0), twice = subgroupBallot(bitCount(blocks) == 2);
  const uint count = subgroupBallotBitCount(once) + subgroupBallotBitCount(twice);
  uint begin = 0;
  if (thread() == 0 && count > 0) {
    begin = atomicAdd(constants.command.command.asked, count);
    atomicMax(constants.command.command.vertices, min(begin + count, constants.room));
    atomicAdd(constants.counts.drawn, count);
    if (begin + count > constants.room) atomicMax(constants.counts.wanted, begin + count);
  }
  const uint place = subgroupBroadcastFirst(begin) + subgroupBallotExclusiveBitCount(once) +
                     subgroupBallotExclusiveBitCount(twice);
  const uint first = isWhole ? 0 : findLSB(blocks), last = findMSB(blocks);
  const uint square = (isWhole ? kTileSize : kBlockSize) | (id << 8), portion = bounds.kind >> kPortionShift;
  const uvec2 a = uvec2(tile) + kBlockSize * uvec2(first & 1, first >> 1),
              b = uvec2(tile) + kBlockSize * uvec2(last & 1, last >> 1);
  if (blocks != 0 && place < constants.room)
    constants.draws.draw[place] = BeamDraw(bounds.first, portion, a.x | (a.y << 16), square);
  if (bitCount(blocks) == 2 && place + 1 < constants.room)
    constants.draws.draw[place + 1] = BeamDraw(bounds.first, portion, b.x | (b.y << 16), square);
}

// Takes a patch down the hierarchy, the threads one bound each.
void listBeamsOf(Patch shown, ivec2 tile, uint id, inout uint tested, inout uint met) {
  const uint threads = gl_SubgroupSize;
  const uint threadsOfGroup = min(threads, kChildren);
  uint waitingGroups = kChildren / threadsOfGroup;
  if (thread() < waitingGroups) groups[thread()] = constants.root + thread() * threadsOfGroup;
  subgroupBarrier();
  bool isCutShort = false;
  do {
    uint waitingBeams = 0;
    while (waitingGroups > 0 && waitingBeams <= threads * (kBeamsAThread - 1)) {
      const uint asked = min(waitingGroups, threads / threadsOfGroup);
      waitingGroups -= asked;
      const uint group = groups[waitingGroups + min(thread() / threadsOfGroup, asked - 1)];
      subgroupBarrier();
      const uint index = group + thread() % threadsOfGroup;
      const BeamBounds bounds = boundsAt(index);
      const bool isThere = thread() < threadsOfGroup * asked && bounds.nearest <= bounds.farthest;
      const bool isBeam = (bounds.kind & kIsBeam) != 0;
      const bool meets =
          isThere && (boundsMeetBox(bounds, shown.low, shown.high) || (kIsFlat != 0 && !isBeam));
      const uvec4 inner = subgroupBallot(meets && !isBeam), ends = subgroupBallot(meets && isBeam);
      const uint place = waitingGroups + kChildren / threadsOfGroup * subgroupBallotExclusiveBitCount(inner);
      if (meets && !isBeam) {
        groups[place] = bounds.first;
        if (threadsOfGroup < kChildren) groups[place + 1] = bounds.first + threadsOfGroup;
      }
      if (meets && isBeam) beams[waitingBeams + subgroupBallotExclusiveBitCount(ends)] = index;
      waitingGroups += kChildren / threadsOfGroup * subgroupBallotBitCount(inner);
      waitingBeams += subgroupBallotBitCount(ends);
      tested += subgroupBallotBitCount(subgroupBallot(isThere));
      met += subgroupBallotBitCount(inner) + subgroupBallotBitCount(ends);
      subgroupBarrier();
    }
    uint begin = 0;
    for (; begin < waitingBeams; begin += threads)
      list(beams[min(begin + thread(), waitingBeams - 1)], begin + thread() < waitingBeams, tile, id, shown);
    isCutShort = isCutShort || begin < waitingBeams;
    subgroupBarrier();
  } while (waitingGroups > 0);
  // A software device leaves all loops of a thread after 65,535 rounds.
  if (thread() == 0 && (isCutShort || waitingGroups > 0)) atomicAdd(constants.counts.unfinished, 1);
}

void listBeamsOfTile(uvec2 tile, inout uint tested, inout uint met) {
  const ivec2 corner = constants.corner + ivec2(tile * kTileSize);
  uint waiting = storeSquares(corner, isWithinBeams(corner) ? kTilePixels : 0);
  const uint pixelsOfThread = (kTilePixels + gl_SubgroupSize - 1) / gl_SubgroupSize;
  // Not those of the tiles about it, whose pixels a square may reach.
  uint id = 1 + kMostPatches * ((tile.x & 1) + 2 * (tile.y & 1));
  for (uint number = 1; number <= kMostPatches; ++number, ++id) {
    const uvec4 threads = subgroupBallot(waiting != 0);
    if (threads == uvec4(0)) return;
    // The middle one where it waits.
    const uint middleThread = gl_SubgroupSize / 2, middleBit = 1u << (pixelsOfThread / 2);
    const uint mine = (waiting & middleBit) != 0 ? pixelsOfThread / 2 : findLSB(waiting);
    const uint from =
        subgroupBallotBitExtract(threads, middleThread) ? middleThread : subgroupBallotFindLSB(threads);
    const ivec2 chosen = placeInTile(subgroupShuffle(mine, from) * gl_SubgroupSize + from);
    const Patch patchOfPixels =
        takePatch(corner, loadSquareOf(from, corner + chosen), number == kMostPatches, float(id), waiting);
    listBeamsOf(patchOfPixels, corner, id, tested, met);
  }
  if (subgroupBallot(waiting != 0) != uvec4(0) && thread() == 0) atomicAdd(constants.counts.unfinished, 1);
}

void main() {
  uint tested = 0, met = 0;
  listBeamsOfTile(gl_WorkGroupID.xy, tested, met);
  if (thread() == 0 && tested > 0) {
    atomicAdd(constants.counts.tested, tested);
    atomicAdd(constants.counts.culled, tested - met);
  }
}

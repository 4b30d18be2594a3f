// Leaves every beam's flux on the virtual planes, so that nothing is lost or made where a beam is narrower than a texel.
//
// Flat planes are those of Iwasaki 2005b (eq. 3, with the flux in place of intensity times area ratio). A plane that follows the
// receivers is bent, within half the distance to its neighbours, onto what the virtual camera sees: light is then left where it
// arrives, and nothing is smeared between planes.
//
// The threads that share a beam stand in a block that moves over its footprint, a texel a thread: whatever their triangles' sizes
// and shapes, neighbouring threads go the same way.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/illumination_textures/shader_data.h"

#include "techniques/illumination_textures/receiver_normal.glsl.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(constant_id = 1) const uint kFollowsReceivers = 1;
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Constants { DepositConstants constants; };
layout(set = 0, binding = 0) uniform texture2DArray seenDepths;  // by the virtual camera, a layer a window

const uint kBlockWidth = 4;
const uint kBlockHeight = kThreadsOfBeam / kBlockWidth;

uint thread;        // among those of the beam
uint firstTexel;    // of the plane in the textures, in texels
vec2 slopes;        // m along axisU and axisV that the beam goes for each metre along axisW
vec3 unitsOfFlux;   // of the beam, by channel

// Puts a part of the beam's flux on a texel of a flat plane, as the illuminance of what the virtual camera sees there; and as it
// is on a plane that follows the receivers.
void add(vec2 place, float part) {
  const uint side = constants.set.textureSize;
  if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(side)))) return;
  const uint texel = uint(place.y) * side + uint(place.x);
  vec3 units = unitsOfFlux * part;
  if (kFollowsReceivers == 0) {
    const vec3 normal = unpackedNormal(constants.normals.word[texel]);
    // The beam's angle with the surface over that with the plane, as cosines.
    units *= max(normal.z - dot(slopes, normal.xy), 0) * inversesqrt(dot(normal, normal));
  }
  units += 0.5;
  const uint word = (firstTexel + texel) * kChannels;
  for (uint c = 0; c < kChannels; ++c)
    if (units[c] >= 1.0) atomicAdd(constants.textures.units[word + c], uint(units[c]));
}

// Shares out the flux on texels along a line.
void addLine(vec2 a, vec2 c, float peak, int first, int steps, float whole) {
  for (int i = first; i < steps; i += int(kThreadsOfBeam)) {
    const float part = tentBefore(float(i + 1) / float(steps), peak) - tentBefore(float(i) / float(steps), peak);
    add(floor(a + ((float(i) + 0.5) / float(steps)) * (c - a)), whole * part);
  }
}

void addTriangle(vec2 a, vec2 b, vec2 c, vec2 base, vec2 lower, vec2 upper) {
  const float perArea = 2.0 / abs(doubledArea(a, b, c));
  const vec3 slopesOfSides = sideSlopes(a, b, c);
  const vec2 last = min(upper, vec2(constants.set.textureSize) - 1);
  for (float y = max(lower.y, 0) + float(thread / kBlockWidth); y <= last.y; y += float(kBlockHeight)) {
    const TriangleRow row = triangleInRow(a, b, c, slopesOfSides, y - base.y);
    const float lastX = min(floor(row.last) + base.x, last.x);
    for (float x = max(floor(row.first) + base.x, 0) + float(thread % kBlockWidth); x <= lastX; x += float(kBlockWidth))
      add(vec2(x, y), triangleCoverage(row, x - base.x) * perArea);
  }
}

// Where a beam meets a plane, in texels.
struct Footprint {
  vec2 a, b, c;
  bvec3 meets;  // does the corner
};

bool isInWindow(Footprint print) {
  const vec2 end = vec2(constants.set.textureSize);
  const vec2 lower = min(min(print.a, print.b), print.c), upper = max(max(print.a, print.b), print.c);
  return any(print.meets) && all(greaterThanEqual(upper, vec2(0))) && all(lessThan(lower, end));
}

// What falls on few texels is shared out as a line is: `add` stands in two places only, because the threads of a software device
// pass through all of them, whether they have anything to add there or not.
void addFootprint(Footprint print) {
  vec2 a = print.a, b = print.b, c = print.c, base;
  const vec2 lower = floor(min(min(a, b), c));
  const vec2 upper = floor(max(max(a, b), c));
  vec2 localA = a, localB = b, localC = c;
  centerFootprint(localA, localB, localC, base);
  float peak = 0.5, whole = 1;
  int first = int(thread), steps = 0;
  bool isLine = true;
  if (!all(print.meets)) {  // a third to each corner that is there
    a = c = thread == 0 ? a : thread == 1 ? b : c;
    steps = (thread == 0 ? print.meets.x : thread == 1 ? print.meets.y : thread == 2 && print.meets.z) ? 1 : 0;
    first = 0;
    whole = 1.0 / 3.0;
  } else if (lower == upper) {
    steps = 1;
  } else if (isSliver(localA, localB, localC)) {
    peak = sortSliver(a, b, c);
    steps = sliverSteps(a, c);
  } else {
    isLine = false;
  }
  addLine(a, c, peak, first, steps, whole);
  if (!isLine) addTriangle(localA, localB, localC, base, lower, upper);
}

// A corner ray in the virtual camera's frame: texels across, metres along axisW.
struct Line {
  vec2 start;
  float startDepth;
  vec2 slope;  // texels a metre
  bool meets;  // planes beyond its start
};

Line lineOf(vec3 position, vec3 direction) {
  const PlaneSet set = constants.set;
  const float approach = dot(direction, set.axisW);
  Line line;
  line.start = windowTexel(set, constants.window, position);
  line.startDepth = dot(position, set.axisW);
  line.meets = approach > 1e-4;
  line.slope = vec2(dot(direction, set.axisU), dot(direction, set.axisV)) *
               (set.windows[constants.window].texelsPerMetre / max(approach, 1e-4));
  return line;
}

vec2 placeAt(Line line, float depth) { return line.start + (depth - line.startDepth) * line.slope; }

// Depth at which the line meets what the virtual camera sees: again and again the tangent plane of what is seen next to where
// the line is by now. One step is exact on a flat receiver.
float receiverDepth(Line line) {
  const PlaneSet set = constants.set;
  const float texelsPerMetre = set.windows[constants.window].texelsPerMetre;
  const float range = set.farthestDepth - set.nearestDepth;
  float depth = max(set.firstDepth + 0.5 * float(set.planes - 1) * set.depthStep, line.startDepth);
  for (int step = 0; step < 4; ++step) {
    const vec2 place = placeAt(line, depth);
    const vec2 texel = clamp(floor(place), vec2(0), vec2(set.textureSize - 1));
    const float seen = texelFetch(seenDepths, ivec3(texel, constants.window), 0).r;
    if (seen >= 1) {  // past the receivers' edge, or the window's: they are nearer to where the line comes from
      depth = 0.5 * (depth + max(set.nearestDepth, line.startDepth));
      continue;
    }
    const float seenDepth = set.nearestDepth + seen * range;
    const vec3 normal = unpackedNormal(constants.normals.word[uint(texel.y) * set.textureSize + uint(texel.x)]);
    // Where the line stands over the tangent plane, and how fast it comes nearer.
    const float ahead = seenDepth * normal.z + dot((place - texel - 0.5) / texelsPerMetre, normal.xy) - depth * normal.z;
    const float approach = normal.z - dot(line.slope / texelsPerMetre, normal.xy);
    const float before = depth;
    depth = approach > 0.1 * normal.z ? depth + ahead / approach : seenDepth;
    depth = clamp(depth, max(set.nearestDepth, line.startDepth), set.farthestDepth);
    if (abs(depth - before) * texelsPerMetre < 1e-4) break;
  }
  return depth;
}

bool meetsAt(Line line, float depth) { return line.meets && depth >= line.startDepth; }

Footprint footprintAt(Line lines[3], vec3 depths) {
  return Footprint(placeAt(lines[0], depths.x), placeAt(lines[1], depths.y), placeAt(lines[2], depths.z),
                   bvec3(meetsAt(lines[0], depths.x), meetsAt(lines[1], depths.y), meetsAt(lines[2], depths.z)));
}

void main() {
  const uint index = gl_GlobalInvocationID.x / kThreadsOfBeam;
  if (index >= constants.beamCount) return;
  thread = gl_GlobalInvocationID.x % kThreadsOfBeam;
  const PlaneSet set = constants.set;
  const Beam beam = constants.beams.beam[index];
  const vec3 direction = beam.direction[0] + beam.direction[1] + beam.direction[2];
  const float approach = dot(direction, set.axisW);
  if (approach < kLeastApproach * length(direction)) return;
  slopes = vec2(dot(direction, set.axisU), dot(direction, set.axisV)) / approach;
  unitsOfFlux = beam.flux / set.luxMetresSquaredPerUnit;
  // One channel stands for all that have light; the first may have none.
  if (kChannels == 1) unitsOfFlux.x = max(unitsOfFlux.x, max(unitsOfFlux.y, unitsOfFlux.z));

  Line lines[3];
  vec3 arrivals = vec3(0);  // depths on the receivers
  for (int i = 0; i < 3; ++i) {
    lines[i] = lineOf(beam.position[i], beam.direction[i]);
    if (kFollowsReceivers != 0) arrivals[i] = receiverDepth(lines[i]);
  }
  // Neighbouring texels may be asked for that lie a little past the border between two planes.
  const float reach = 0.5 * set.depthStep + 3 / set.windows[constants.window].texelsPerMetre;
  // On to the next plane that matters before anything is done there: neighbouring threads skip the same.
  uint plane = 0;
  while (plane < set.planes) {
    Footprint print;
    bool reaches = false;
    for (; plane < set.planes && !reaches; ++plane) {
      vec3 depths = vec3(set.firstDepth + float(plane) * set.depthStep);
      reaches = true;
      if (kFollowsReceivers != 0) {
        // The first and the last plane have all that lies before and beyond.
        const float low = plane == 0 ? set.nearestDepth : depths.x - reach;
        const float high = plane == set.planes - 1 ? set.farthestDepth : depths.x + reach;
        reaches = any(greaterThanEqual(arrivals, vec3(low))) && any(lessThanEqual(arrivals, vec3(high)));
        depths = clamp(arrivals, low, high);
      }
      print = footprintAt(lines, depths);
      reaches = reaches && isInWindow(print);
    }
    if (!reaches) return;
    firstTexel = textureStart(set, plane - 1, constants.window, 1);
    addFootprint(print);
  }
}

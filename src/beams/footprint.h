// The footprint of a beam on a plane, which is a triangle, and the part of it in each texel of a grid on the
// plane. Written once for C++ and GLSL.
//
// Coverage is exact: the area of the triangle within the texel. So the whole flux of a beam is kept, whatever
// its size.
#ifndef NEPHROID_BEAMS_FOOTPRINT_H
#define NEPHROID_BEAMS_FOOTPRINT_H

#include "beams/beam.h"

SHARED_BEGIN

// A grid of texels on a plane. A point p lies at texel coordinates (dot(p - corner, axisU), dot(p - corner,
// axisV)).
struct PlaneGrid {
  vec3 corner;  // m, where texel (0, 0) begins
  vec3 axisU;   // texels per meter along a row
  vec3 axisV;   // texels per meter down the rows
  vec3 normal;  // unit, the way light passes through
};

// Computes the texel coordinates where a ray meets the plane, and the distance (m) along the ray. Returns
// false where the ray goes away from the plane or along it.
SHARED_FUNCTION bool meetPlane(vec3 position, vec3 direction, PlaneGrid grid, OUT(vec2) texel,
                               OUT(float) rayDistance) {
  float approach = dot(direction, grid.normal);
  rayDistance = dot(grid.corner - position, grid.normal) / max(approach, 1e-6f);
  vec3 offset = position + rayDistance * direction - grid.corner;
  texel = vec2(dot(offset, grid.axisU), dot(offset, grid.axisV));
  return approach > 1e-4f && rayDistance >= 0.0f;
}

SHARED_FUNCTION float doubledArea(vec2 a, vec2 b, vec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The parts of a triangle's three sides within one row of texels. Of each side: x where it enters the row, x
// where it leaves it, and how far it goes down in the row (texels; negative where it goes up).
struct TriangleRow {
  vec3 ab;
  vec3 bc;
  vec3 ca;
  vec3 perWidth;  // of ab, bc and ca: z / (y - x); 0 where the side is vertical
  float first;    // texels, the triangle's extent within the row
  float last;
};

// The change of x per y along the sides ab, bc and ca; 0 for a horizontal side.
SHARED_FUNCTION vec3 sideSlopes(vec2 a, vec2 b, vec2 c) {
  vec3 width = vec3(b.x - a.x, c.x - b.x, a.x - c.x);
  vec3 height = vec3(b.y - a.y, c.y - b.y, a.y - c.y);
  return vec3(height.x != 0.0f ? width.x / height.x : 0.0f, height.y != 0.0f ? width.y / height.y : 0.0f,
              height.z != 0.0f ? width.z / height.z : 0.0f);
}

SHARED_FUNCTION vec3 sideInRow(vec2 a, vec2 b, float slope, float row) {
  float y = a.y - row;
  float y0 = clamp(y, 0.0f, 1.0f);
  float y1 = clamp(b.y - row, 0.0f, 1.0f);
  return vec3(a.x + (y0 - y) * slope, a.x + (y1 - y) * slope, y1 - y0);
}

SHARED_FUNCTION float perWidthOf(vec3 side) {
  return side.x != side.y ? side.z / (side.y - side.x) : 0.0f;
}

SHARED_FUNCTION void includeSide(vec3 side, INOUT(float) first, INOUT(float) last) {
  if (side.z == 0.0f) return;
  first = min(first, min(side.x, side.y));
  last = max(last, max(side.x, side.y));
}

// `slopes` are those of sideSlopes. Where the triangle does not meet the row, `first` is greater than `last`.
SHARED_FUNCTION TriangleRow triangleInRow(vec2 a, vec2 b, vec2 c, vec3 slopes, float row) {
  TriangleRow cut;
  cut.ab = sideInRow(a, b, slopes.x, row);
  cut.bc = sideInRow(b, c, slopes.y, row);
  cut.ca = sideInRow(c, a, slopes.z, row);
  cut.perWidth = vec3(perWidthOf(cut.ab), perWidthOf(cut.bc), perWidthOf(cut.ca));
  cut.first = 1e30f;
  cut.last = -1e30f;
  includeSide(cut.ab, cut.first, cut.last);
  includeSide(cut.bc, cut.first, cut.last);
  includeSide(cut.ca, cut.first, cut.last);
  return cut;
}

// Integral over y, along a side within the row, of its distance from the column's left edge (0..1). Only ends
// of the side and of the column are subtracted, which is exact, so that the columns' parts of an almost
// vertical side add up to the whole.
SHARED_FUNCTION float sideCoverage(vec3 side, float perWidth, float column) {
  float right = column + 1.0f;
  float x0 = clamp(side.x, column, right);
  float x1 = clamp(side.y, column, right);
  float mean = 0.5f * (x0 + x1) - column;
  if (side.x == side.y) return mean * side.z;
  return ((x1 - x0) * mean + (max(side.y, right) - max(side.x, right))) * perWidth;
}

// The area of the triangle within one texel of the row, from `column` to `column` + 1; 1 is the whole texel.
SHARED_FUNCTION float triangleCoverage(TriangleRow row, float column) {
  return abs(sideCoverage(row.ab, row.perWidth.x, column) + sideCoverage(row.bc, row.perWidth.y, column) +
             sideCoverage(row.ca, row.perWidth.z, column));
}

// Moves a footprint's corners near the origin, where floats are precise enough: texel t of the grid becomes t
// - `base`. A footprint smaller than a texel is also scaled to the size of a texel. It then lies across the
// lines x = 0 and y = 0 between the texels -1 and 0, or inside texel 0 where it crosses no line. At a focus,
// footprints are a hundredth of a texel wide, and it is visible on which side of a line their flux falls.
SHARED_FUNCTION void centerFootprint(INOUT(vec2) a, INOUT(vec2) b, INOUT(vec2) c, OUT(vec2) base) {
  vec2 lower = min(min(a, b), c);
  vec2 upper = max(max(a, b), c);
  float longest = max(upper.x - lower.x, upper.y - lower.y);
  bool isSmall = longest < 1.0f;
  base = isSmall ? floor(upper) : floor(lower);
  vec2 shift = base;
  if (isSmall && lower.x >= base.x) shift.x = lower.x;
  if (isSmall && lower.y >= base.y) shift.y = lower.y;
  float scale = isSmall ? 1.0f / max(longest, 1e-20f) : 1.0f;
  a = (a - shift) * scale;
  b = (b - shift) * scale;
  c = (c - shift) * scale;
}

// Whether a centered footprint is so thin that its area is not precise. It is then treated as a line.
SHARED_FUNCTION bool isSliver(vec2 a, vec2 b, vec2 c) {
  vec2 extent = max(max(a, b), c) - min(min(a, b), c);
  float longest = max(extent.x, extent.y);
  return abs(doubledArea(a, b, c)) < 4e-3f * longest * longest;
}

// The number of pieces that a sliver's flux is divided into.
SHARED_FUNCTION int sliverSteps(vec2 a, vec2 c) {
  return int(clamp(ceil(2.0f * length(c - a)), 4.0f, 4096.0f));
}

// The flux of a sliver is spread along its longest side like a tent (a triangle function), with the peak at
// the third corner. Reorders the corners so that a and c are the ends of the longest side, and returns where
// b lies along it (0..1).
SHARED_FUNCTION float sortSliver(INOUT(vec2) a, INOUT(vec2) b, INOUT(vec2) c) {
  vec2 corners[3];
  corners[0] = a;
  corners[1] = b;
  corners[2] = c;
  float ab = dot(b - a, b - a);
  float bc = dot(c - b, c - b);
  float ca = dot(a - c, a - c);
  if (ab >= bc && ab >= ca) {
    b = corners[2];
    c = corners[1];
  } else if (bc >= ca) {
    a = corners[1];
    b = corners[0];
  }
  float lengthSquared = dot(c - a, c - a);
  return lengthSquared > 0.0f ? clamp(dot(b - a, c - a) / lengthSquared, 0.0f, 1.0f) : 0.5f;
}

// The part of a tent's flux that lies before `s` (0..1 along the longest side).
SHARED_FUNCTION float tentBefore(float s, float peak) {
  if (s <= peak) return peak > 0.0f ? s * s / peak : 0.0f;
  return 1.0f - (1.0f - s) * (1.0f - s) / (1.0f - peak);
}

// The part of a line that lies in the slab between the coordinates `low` and `low` + 1, as parameters along
// the line: 0 at its start, 1 at its end. The line begins at the coordinate `start` and ends at `start` +
// `along`. Neighboring slabs have no gap and no overlap. The result is an empty interval where the line never
// enters the slab.
SHARED_FUNCTION vec2 lineInSlab(float start, float along, float low) {
  if (along == 0.0f) return vec2(floor(start) == low ? 0.0f : 1.0f, 1.0f);
  float a = (low - start) / along;
  float b = (low + 1.0f - start) / along;
  return vec2(min(a, b), max(a, b));
}

// The part of a footprint's flux that the texel from (0, 0) to (1, 1) holds.
SHARED_FUNCTION float shareInTexel(vec2 a, vec2 b, vec2 c) {
  vec2 lower = min(min(a, b), c);
  vec2 upper = max(max(a, b), c);
  if (upper.x < 0.0f || upper.y < 0.0f || lower.x >= 1.0f || lower.y >= 1.0f) return 0.0f;
  if (lower.x >= 0.0f && lower.y >= 0.0f && upper.x < 1.0f && upper.y < 1.0f) return 1.0f;
  float longest = max(upper.x - lower.x, upper.y - lower.y);
  float area = 0.5f * abs(doubledArea(a, b, c));
  // A line, unless it is wide enough to be seen as more. Too small a triangle has too few digits.
  if (longest < 3e-3f || (isSliver(a, b, c) && area < longest)) {
    float peak = sortSliver(a, b, c);
    vec2 column = lineInSlab(a.x, c.x - a.x, 0.0f);
    vec2 row = lineInSlab(a.y, c.y - a.y, 0.0f);
    float first = clamp(max(column.x, row.x), 0.0f, 1.0f);
    float last = clamp(min(column.y, row.y), 0.0f, 1.0f);
    return max(tentBefore(last, peak) - tentBefore(first, peak), 0.0f);
  }
  return triangleCoverage(triangleInRow(a, b, c, sideSlopes(a, b, c), 0.0f), 0.0f) / area;
}

SHARED_END

#endif

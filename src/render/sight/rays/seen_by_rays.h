// What the pixels see that show casters, by rays of their own: a list of receiver points, and how much of
// the light of which of them comes to which pixel.
#pragma once

#include <vector>

#include "lights/seen_skies.h"
#include "render/sight/rays/view_tree.h"
#include "render/view.h"

namespace nephroid {

// All that it depends on.
struct RaySightInput {
  const Scene& scene;
  const RayScene& rays;                        // of the scene
  std::span<const Material* const> materials;  // of the objects
  const View& view;
  MediumStack media;                           // around the eye
  uvec2 size{0};                               // pixels of the picture
  std::span<const gpu::Region> casterRegions;  // outside all of these no pixel shows a caster
  TreeSettings trees{};
  bool interpolates = true;          // where neighbors agree; otherwise each pixel is traced
  const SeenSkies* skies = nullptr;  // with trees.tellsSky
  float sampleSpacing = 1;           // pixels between the samples of a pixel
};

struct RaySightCounts {
  uint64_t rays = 0;
  uint64_t pixels = 0;  // that show casters
  uint64_t traced = 0;  // trees; also of corners and middles of cells that show no caster
  uint64_t points = 0;
  double leftOut = 0;  // mean over the traced pixels: the weight of ways that were too weak
  double lost = 0;     // the same, of ways that found no end
};

struct SeenByRays {
  gpu::Region region;  // of the picture: holds all pixels that show casters; row by row
  // The normal of the caster, on the viewer's side; a = 1 where there is one, -1 where its inside is seen.
  std::vector<vec4> casterNormals;
  // rgb: what the pixel shows (nit) by no light: background, skies, ambient light, and surfaces that shine.
  // a: its depth as in the depth image, 0 where there is no caster.
  std::vector<vec4> rest;
  std::vector<uvec2> ranges;  // the first of the pixel's points, and their number
  // With trees.tellsWaysBeyond, of the pixels: where their ray meets the caster (m; a = its object + 1, 0
  // where there is none); and the way beyond: its start (m; a = its length) and direction.
  std::vector<vec4> casterPositions, exits, directions;
  // Of the points:
  std::vector<vec4> positions;  // m; a = 1
  std::vector<vec4> normals;    // unit, on the side that is seen
  std::vector<vec4> factors;    // rgb: luminance of the pixel (nit) for each lux at the point
  RaySightCounts counts;
  std::vector<Hit> firstHits;  // memory of seeByRays
};

// Memory of `seen` is used again. The same for any number of threads.
void seeByRays(const RaySightInput& input, SeenByRays& seen);

}  // namespace nephroid

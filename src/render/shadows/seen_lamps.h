// How much of each lamp the points of a view see, by rays toward the lamps.
//
// Points that surely see a lamp or none of it need no ray: those before which no object's box stands, and
// those that with all their neighbors in the picture saw the same in several samples. A lamp with a size is
// first looked at in a few places; where the neighbors' differ, in many.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "lights/lamp_light.h"
#include "render/shadow_maps.h"
#include "trace/ray_scene.h"

namespace nephroid {

// A light that is not a sky, and what may stand before it.
struct ShadowedLamp {
  const Light* light = nullptr;
  ShapedLight shaped;
  std::vector<Box> boxes;  // of the objects that may shadow others; none: it is seen from everywhere
};

// The lights of a scene, in their order, but for skies. The scene must outlive them. `extents`: of its
// meshes.
std::vector<ShadowedLamp> shadowedLamps(const Scene& scene, const std::vector<MeshExtent>& extents);

// The points of a view, in the picture's region that is seen.
struct ViewPoints {
  std::span<const vec4> positions;     // m; a = 1 where there is a point
  std::span<const vec4> normals;       // unit, on the side that is lit
  uvec2 corner{0}, size{0};            // pixels of the region
  std::span<const uvec2> ranges = {};  // the first of a pixel's points and their number, row by row; none:
                                       // each pixel has the one at its place
};

// The sample that points are of, and the number of samples of a pixel.
struct SampleOfMany {
  uint32_t index = 0, count = 1;
};

// Remembers what the samples of a picture saw.
class SeenLamps {
 public:
  void resize(uvec2 picture);  // pixels
  // What was seen in samples before does not hold any longer.
  void forget();

  // Looks at all lamps. The same for any number of threads.
  void look(const RayScene& rays, std::span<const ShadowedLamp> lamps, const ViewPoints& points,
            const SampleOfMany& sample);

  // The part of a lamp's light that comes to each point, 0 to 255.
  std::span<const uint8_t> parts(uint32_t lamp) const { return parts_[lamp]; }

 private:
  static constexpr uint32_t kPixelsAlongTile = 8;  // whose points are looked at together
  // What is seen of a lamp from the pixels of a tile, [row][column].
  using TileStates = std::array<std::array<uint8_t, kPixelsAlongTile>, kPixelsAlongTile>;
  // What was seen from pixels' first points, their second ones, and so on: in the samples before, and with
  // this one.
  struct Memory {
    std::vector<uint8_t> before, now;
  };
  struct Look;
  void lookAt(const Look& look);
  void lookFirst(const Look& look, uvec2 tile, uint32_t layer);
  void lookCloser(const Look& look, uvec2 tile, uint32_t layer);
  TileStates seenAround(const Look& look, uvec2 tile, uint32_t layer) const;
  static bool isSure(const TileStates& around);
  void keep(const Look& look, uvec2 tile, uint8_t state);
  std::size_t memoryAt(uvec2 pixel, uint32_t layer) const;

  uvec2 picture_{0};
  uint32_t samples_ = 0;                     // that are remembered
  std::vector<Memory> seen_;                 // of the lamps
  std::vector<std::vector<uint8_t>> parts_;  // of the lamps
};

}  // namespace nephroid

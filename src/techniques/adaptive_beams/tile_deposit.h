// Beams' light shared out among the texels of a tile: exact coverage, times the density between their
// corners.
#pragma once

#include <array>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// A beam is added along its sides alone: each texel that a side passes keeps by how much its light differs
// from that of its left neighbor. Sums along the rows, made once for all beams, are the light. (Signed area
// accumulation, as in rasterizers of fonts.)
class TileDeposit {
 public:
  // Empties a tile of `size` texels. Memory is used again.
  void begin(uvec2 size);

  // Corners in texels of the tile; density at the corners over its mean; lm, or any unit to be shared out.
  void add(vec2 a, vec2 b, vec2 c, vec3 density, vec3 flux);

  // Adds the light to red, green and blue texels, rows one after the other.
  void addTo(std::array<float*, 3> planes) const;

 private:
  // Two numbers that processors treat at once.
  using Pair = double __attribute__((vector_size(16)));
  // Red, green and blue light of a fully covered texel at column 0, and by how much they rise from one
  // column to the next. Double, since a bright beam's differences have to cancel.
  using Sums = std::array<Pair, 3>;
  using Light = std::array<double, 3>;
  // Light of a beam over the tile: at the origin, and its rise along x and y.
  struct Slope {
    double base = 1;
    double x = 0, y = 0;
  };
  // Down the tile.
  struct Side {
    glm::dvec2 from, to;
    Slope slope;
    Light flux;
    double alongX = 0;  // columns for each row
  };

  void addSide(glm::dvec2 from, glm::dvec2 to, const Slope& slope, const Light& flux);
  void addOnLeft(const Side& side, double first, double last);
  void addInside(const Side& side, double first, double last);
  void addLongSide(Sums* row, double x0, double x1, double height, const Sums& light) const;
  static Sums lightOf(const Side& side, double row);
  static void addAt(Sums& sums, double part, const Sums& light) {
    for (std::size_t i = 0; i < light.size(); ++i) sums[i] += part * light[i];
  }
  void addLine(vec2 a, vec2 b, vec2 c, vec3 flux);
  void put(int x, int y, vec3 flux);

  uvec2 size_{0};
  std::size_t stride_ = 0;
  std::vector<Sums> differences_;
};

}  // namespace nephroid

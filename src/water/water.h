// A surface of water as a moving height field: plane waves, a simulation, and the sea.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geometry/mesh.h"

namespace nephroid {

class WaveRun;

struct Wave {
  float amplitude = 0;   // m
  float wavelength = 1;  // m
  vec2 direction{1, 0};  // in (x, z)
  float speed = 0;       // m/s
  float phase = 0;       // radians
};

// A drop that falls into simulated water. It makes a hollow with a ring of displaced water around it.
struct WaterDrop {
  float time = 0;       // s
  vec2 position{0};     // m, (x, z)
  float radius = 0.1f;  // m
  float depth = 0.02f;  // m, depth of the hollow in its middle
  bool operator==(const WaterDrop&) const = default;
};

// An obstacle that moves through simulated water. It is upright and round, and its depth falls off like a
// Gaussian.
struct WaterObstacle {
  float radius = 0.1f;  // m
  float depth = 0.02f;  // m, how deep it reaches in its middle
  std::vector<vec3>
      path;  // x, z (m) and time (s), ascending; it stands still before the first and after the last
  bool operator==(const WaterObstacle&) const = default;
};

// The wave equation on the water's grid. The grid's sides reflect waves. The water is still at time 0.
struct WaveSimulation {
  float speed = 1;    // m/s, of all waves
  float damping = 0;  // 1/s
  std::vector<WaterDrop> drops;
  std::vector<WaterObstacle> obstacles;
  bool operator==(const WaveSimulation&) const = default;
};

enum class SpectrumShape { jonswap, phillips };

// The sea as a sum of waves with random phases. It is periodic: opposite sides of the water fit together.
struct OceanSpectrum {
  SpectrumShape shape = SpectrumShape::jonswap;
  vec2 wind{5, 0};                                       // m/s, in (x, z), 10 m above the water
  float fetch = 1e4f;                                    // m of water that the wind has blown over (JONSWAP)
  float depth = std::numeric_limits<float>::infinity();  // m, of the water
  float significantHeight = 0;                           // m; 0: it follows from wind and fetch
  float choppiness = 0;  // 0: sine waves; 1: crests as sharp as those of Gerstner's waves
  uint32_t seed = 0;
};

// The height field of the shape "water": y = sum of amplitude sin(2 pi / wavelength (direction . (x, z) -
// speed t) + phase), plus the simulation and the sea.
struct Water {
  vec2 size{1, 1};   // m
  uvec2 grid{2, 2};  // vertices along x and z; 0: the mesh is from a file
  std::vector<Wave> waves;
  std::optional<WaveSimulation> simulation{};
  std::optional<OceanSpectrum> ocean{};
};

// The surface y(x, z) at `time` (s); its bottom is open. Vertex (i, j) of the grid has the index j * grid.x +
// i, x and z rising. With `run`, the simulation continues from the state of the last call.
Mesh makeWater(const Water& water, double time, WaveRun* run = nullptr);

// Height (m) and slope (d/dx, d/dz) of the water at (x, z). A wave's `direction` is not normalized: if it is
// not unit, the wave is shorter or longer.
struct WaterPoint {
  double height;
  glm::dvec2 slope;
};
WaterPoint waterAt(const Water& water, glm::dvec2 xz, double time);

}  // namespace nephroid

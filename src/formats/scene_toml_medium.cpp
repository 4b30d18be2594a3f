#include <array>

#include "core/error.h"
#include "formats/scene_toml.h"
#include "formats/vdb.h"
#include "optics/air.h"
#include "scene/density_grid.h"

namespace nephroid {
namespace {

constexpr double kMostCells = 256;  // along a side
constexpr std::size_t kMostCellsInAll = std::size_t{1} << 22;

float numberOr(TomlTable& table, const char* key, Range range, double byDefault) {
  return static_cast<float>(table.number(key, range).value_or(byDefault));
}

DensityGrid readNoise(TomlTable table) {
  DensityGrid grid;
  grid.name = "noise";
  grid.corner = table.requiredVector3("corner");
  grid.size = table.requiredVector3("size", kPositive);
  NoiseSettings noise;
  noise.feature = numberOr(table, "feature", kPositive, 1);
  noise.octaves = static_cast<uint32_t>(table.integer("octaves", {1, 16}).value_or(noise.octaves));
  noise.seed = static_cast<uint32_t>(table.integer("seed", {0, 1e9}).value_or(noise.seed));
  noise.clear = numberOr(table, "clear", {0, 0.99}, double(noise.clear));
  const vec3 cells = table.vector3("cells", {1, kMostCells}).value_or(vec3(48));
  grid.cells = uvec3(cells);
  if (vec3(grid.cells) != cells) table.fail("cells", "must be three whole numbers");
  if (std::size_t{grid.cells.x} * grid.cells.y * grid.cells.z > kMostCellsInAll)
    table.fail("cells", "are more than 2^22 in all; take fewer");
  table.finish();
  fillWithNoise(grid, noise);
  return grid;
}

DensityGrid readGrid(TomlTable table, const std::filesystem::path& folder) {
  const std::string file = table.requiredText("file"), name = table.text("name").value_or("");
  const float scale = numberOr(table, "scale", kPositive, 1);
  const vec3 translation = table.vector3("translation").value_or(vec3(0));
  table.finish();
  DensityGrid grid;
  try {
    grid = loadVdb(folder / file, name);
  } catch (const InputError& error) {
    table.fail("file", std::string("is not to be used: ") + error.what());
  }
  grid.corner = scale * grid.corner + translation;
  grid.size *= scale;
  return grid;
}

// Fog is taken into the cells, so that there is one density to ask for.
void addFog(const Medium& medium, DensityGrid& grid) {
  const Air air{0, 0, 0, medium.fogBase, medium.fogHeight > 0 ? 1 / medium.fogHeight : 0};
  for (uint32_t i = 0; i < grid.densities.size(); ++i) {
    const uint32_t y = i / grid.cells.x % grid.cells.y;
    const float height = grid.corner.y + (float(y) + 0.5f) / float(grid.cells.y) * grid.size.y;
    grid.densities[i] *= fogDensity(air, height);
  }
}

}  // namespace

void readPhase(TomlTable& table, PhaseType& phase, float& g) {
  constexpr std::array kTypes{PhaseType::isotropic, PhaseType::henyeyGreenstein, PhaseType::nishita};
  phase = kTypes[table.choice("phase", {"isotropic", "henyey-greenstein", "nishita"})];
  if (phase == PhaseType::henyeyGreenstein) g = numberOr(table, "g", {-kLargestG, kLargestG}, 0);
}

Medium readMedium(TomlTable table, const std::filesystem::path& folder) {
  Medium medium;
  const auto extinction = table.number("extinction", kNotNegative);
  if (!extinction) table.fail("extinction", "is missing; a medium needs it (1/m)");
  medium.extinction = static_cast<float>(*extinction);
  medium.albedo = numberOr(table, "albedo", kFraction, 1);
  readPhase(table, medium.phase, medium.g);
  medium.fogHeight = numberOr(table, "fog_height", kPositive, 0);
  if (medium.fogHeight > 0) medium.fogBase = numberOr(table, "fog_base", kAnyNumber, 0);
  if (auto noise = table.table("noise")) medium.grid = readNoise(std::move(*noise));
  if (auto grid = table.table("grid")) {
    if (medium.grid) table.fail("grid", "and \"noise\" are both there; give one of them");
    medium.grid = readGrid(std::move(*grid), folder);
  }
  if (medium.grid) addFog(medium, *medium.grid);
  table.finish();
  return medium;
}

}  // namespace nephroid

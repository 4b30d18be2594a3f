#include "formats/scene_toml_water.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/mesh_file.h"

namespace nephroid {
namespace {

constexpr double kMostSegments = 1024;
constexpr double kMostWaterVertices = 4e6;
constexpr Range kGrid{2, 8192};
// Vertices times steps that a simulation may take up to a scene's time: some tens of seconds of one
// processor.
constexpr double kMostUpdates = 3e10;

float positive(TomlTable& table, const char* key, float byDefault) {
  return static_cast<float>(table.number(key, kPositive).value_or(double(byDefault)));
}

Wave readWave(TomlTable& table) {
  Wave wave;
  const auto amplitude = table.number("amplitude");
  if (!amplitude) table.fail("amplitude", "is missing; a wave needs it (m)");
  wave.amplitude = static_cast<float>(*amplitude);
  const auto wavelength = table.number("wavelength", kPositive);
  if (!wavelength) table.fail("wavelength", "is missing; a wave needs it (m)");
  wave.wavelength = static_cast<float>(*wavelength);
  wave.direction = table.vector2("direction").value_or(wave.direction);
  if (!(glm::dot(wave.direction, wave.direction) > 0))
    table.fail("direction", "gives no direction; its length must not be 0");
  wave.speed = static_cast<float>(table.number("speed").value_or(0));
  wave.phase = static_cast<float>(table.number("phase").value_or(0));
  table.finish();
  return wave;
}

WaterDrop readDrop(TomlTable& table) {
  WaterDrop drop;
  drop.time = static_cast<float>(table.number("time", kNotNegative).value_or(0));
  drop.position = table.vector2("position").value_or(drop.position);
  drop.radius = positive(table, "radius", drop.radius);
  drop.depth = static_cast<float>(table.number("depth").value_or(double(drop.depth)));
  table.finish();
  return drop;
}

WaterObstacle readObstacle(TomlTable& table) {
  WaterObstacle obstacle;
  obstacle.radius = positive(table, "radius", obstacle.radius);
  obstacle.depth = static_cast<float>(table.number("depth").value_or(double(obstacle.depth)));
  obstacle.path = table.vectors3("path");
  if (obstacle.path.empty()) table.fail("path", "is missing; an obstacle needs it: [[x, z, seconds], ...]");
  for (std::size_t i = 1; i < obstacle.path.size(); ++i)
    if (!(obstacle.path[i].z > obstacle.path[i - 1].z))
      table.fail("path", "must have its times, the third number of each, rise");
  table.finish();
  return obstacle;
}

WaveSimulation readSimulation(TomlTable& table) {
  WaveSimulation simulation;
  simulation.speed = positive(table, "speed", simulation.speed);
  simulation.damping = static_cast<float>(table.number("damping", kNotNegative).value_or(0));
  for (TomlTable& drop : table.tables("drops")) simulation.drops.push_back(readDrop(drop));
  for (TomlTable& obstacle : table.tables("obstacles"))
    simulation.obstacles.push_back(readObstacle(obstacle));
  table.finish();
  return simulation;
}

OceanSpectrum readOcean(TomlTable& table) {
  OceanSpectrum ocean;
  constexpr std::array kShapes{SpectrumShape::jonswap, SpectrumShape::phillips};
  ocean.shape = kShapes[table.choice("spectrum", {"jonswap", "phillips"})];
  ocean.wind = table.vector2("wind").value_or(ocean.wind);
  if (!(glm::dot(ocean.wind, ocean.wind) > 0))
    table.fail("wind", "blows nowhere; its length is its speed (m/s) and must not be 0");
  ocean.fetch = positive(table, "fetch", ocean.fetch);
  if (const auto depth = table.number("depth", kPositive)) ocean.depth = static_cast<float>(*depth);
  ocean.significantHeight = static_cast<float>(table.number("significant_height", kPositive).value_or(0));
  ocean.choppiness = static_cast<float>(table.number("choppiness", Range{0, 2}).value_or(0));
  ocean.seed = static_cast<uint32_t>(table.integer("seed", {0, 4294967295.0}).value_or(0));
  table.finish();
  return ocean;
}

uvec2 readGrid(TomlTable& table, vec2 size) {
  const auto given = table.integers2("grid", kGrid);
  const Density density = readDensity(table);
  const bool hasDensity = density.segments || density.vertices;
  if (given && hasDensity) table.fail("grid", "cannot be given together with \"segments\" or \"vertices\"");
  uvec2 grid = given.value_or(uvec2(128));
  if (hasDensity) {
    const double area = static_cast<double>(size.x) * size.y;
    const double edge = density.segments ? std::max(size.x, size.y) / static_cast<double>(density.segments)
                                         : std::sqrt(area / density.vertices);
    grid = glm::clamp(uvec2(glm::round(size / static_cast<float>(edge))) + 1u, uvec2(2), uvec2(8192));
  }
  if (static_cast<double>(grid.x) * grid.y > kMostWaterVertices)
    table.fail("grid", "is more than 4000000 vertices; make it smaller");
  return grid;
}

// The name with its row of # as the digits of the frame's number.
std::string nameOfFrame(TomlTable& table, std::string name, int64_t frame) {
  const std::size_t first = name.find('#');
  if (first == std::string::npos)
    table.fail("sequence", "has no # in \"" + name + "\", where the frames' numbers stand");
  std::size_t digits = 0;
  while (first + digits < name.size() && name[first + digits] == '#') ++digits;
  std::string number = std::to_string(frame);
  if (number.size() < digits) number.insert(0, digits - number.size(), '0');
  return name.replace(first, digits, number);
}

Mesh readSequence(TomlTable& table, const Scene& scene) {
  for (const char* key : {"size", "grid", "waves", "simulation", "ocean"})
    if (table.has(key))
      table.fail(key, "cannot be given together with \"sequence\", which is the whole surface");
  const double fps = table.number("fps", kPositive).value_or(24);
  const auto frame = static_cast<int64_t>(std::floor(std::max(scene.time, 0.0) * fps + 1e-6));
  const std::string name = nameOfFrame(table, table.requiredText("sequence"), frame);
  Mesh mesh = loadMeshFile(findModel(name, scene.file.parent_path(), table.at("sequence")));
  mesh.name = name;
  return mesh;
}

}  // namespace

Density readDensity(TomlTable& table) {
  const auto segments = table.integer("segments", {1, kMostSegments});
  const auto vertices = table.integer("vertices", {3, kMostWaterVertices});
  if (segments && vertices) table.fail("segments", "and \"vertices\" cannot both be given");
  return {static_cast<uint32_t>(segments.value_or(0)), static_cast<uint32_t>(vertices.value_or(0))};
}

Mesh readWater(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves) {
  Water water;
  if (table.has("sequence")) {
    water.grid = uvec2(0);
    object.water = water;
    return readSequence(table, scene);
  }
  water.size = table.vector2("size", kPositive).value_or(vec2(1));
  water.grid = readGrid(table, water.size);
  for (TomlTable& wave : table.tables("waves")) water.waves.push_back(readWave(wave));
  if (auto simulation = table.table("simulation")) {
    water.simulation = readSimulation(*simulation);
    if (simulationSteps(water, scene.time) * water.grid.x * water.grid.y > kMostUpdates)
      table.fail("simulation",
                 "has too far to go to this time; make \"grid\", \"speed\" or the time smaller");
  }
  if (auto ocean = table.table("ocean")) {
    if (water.grid.x < 3 || water.grid.y < 3) table.fail("ocean", "needs a \"grid\" of 3 by 3 or more");
    water.ocean = readOcean(*ocean);
  }
  object.water = water;
  return makeWater(water, scene.time, waves ? &(*waves)[scene.objects.size()] : nullptr);
}

}  // namespace nephroid

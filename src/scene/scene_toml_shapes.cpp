#include <functional>
#include <numeric>

#include "scene/scene_toml.h"
#include "scene/shapes.h"

namespace nephroid {
namespace {

constexpr double kMostSegments = 1024;
constexpr double kMostVertices = 4e6;
constexpr double kMostTurns = 64;  // of a torus knot

float length(TomlTable& table, const char* key, double byDefault) {
  return static_cast<float>(table.number(key, kPositive).value_or(byDefault));
}

Density readDensity(TomlTable& table) {
  const auto segments = table.integer("segments", {1, kMostSegments});
  const auto vertices = table.integer("vertices", {3, kMostVertices});
  if (segments && vertices) table.fail("segments", "and \"vertices\" cannot both be given");
  return {static_cast<uint32_t>(segments.value_or(0)), static_cast<uint32_t>(vertices.value_or(0))};
}

Mesh readTorus(TomlTable& table) {
  const float radius = length(table, "radius", 0.5), tube = length(table, "tube", 0.2);
  if (tube >= radius) table.fail("tube", "must be less than \"radius\", or the torus runs through itself");
  return makeTorus(radius, tube, readDensity(table));
}

Mesh readTorusKnot(TomlTable& table) {
  const auto p = static_cast<uint32_t>(table.integer("p", {1, kMostTurns}).value_or(2));
  const auto q = static_cast<uint32_t>(table.integer("q", {1, kMostTurns}).value_or(3));
  if (std::gcd(p, q) != 1)
    table.fail("p", "and \"q\" have a common divisor; a knot is one line only without one");
  const float radius = length(table, "radius", 0.5), tube = length(table, "tube", 0.1);
  if (tube >= radius / 2)
    table.fail("tube", "must be less than half of \"radius\", or the knot runs through itself");
  return makeTorusKnot(p, q, radius, tube, readDensity(table));
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

Mesh readWater(TomlTable& table, Object& object, double time) {
  Water water;
  water.size = table.vector2("size", kPositive).value_or(vec2(1));
  const auto grid = table.integers2("grid", {2, 8192});
  water.grid = grid.value_or(uvec2(128));
  if (static_cast<double>(water.grid.x) * water.grid.y > kMostVertices) {
    table.fail("grid", "is more than 4000000 vertices; make it smaller");
  }
  const Density density = readDensity(table);
  if (grid && (density.segments || density.vertices)) {
    table.fail("grid", "cannot be given together with \"segments\" or \"vertices\"");
  }
  if (!grid && (density.segments || density.vertices)) {
    const double area = static_cast<double>(water.size.x) * water.size.y;
    const double edge = density.segments
                            ? std::max(water.size.x, water.size.y) / static_cast<double>(density.segments)
                            : std::sqrt(area / density.vertices);
    water.grid =
        glm::clamp(uvec2(glm::round(water.size / static_cast<float>(edge))) + 1u, uvec2(2), uvec2(8192));
  }
  for (TomlTable& wave : table.tables("waves")) water.waves.push_back(readWave(wave));
  object.water = water;
  return makeWater(water, time);
}

}  // namespace

Mesh readShape(TomlTable& table, Object& object, double time) {
  using Reader = std::function<Mesh()>;
  const std::vector<std::pair<std::string, Reader>> shapes{
      {"sphere", [&] { return makeSphere(length(table, "radius", 0.5), readDensity(table)); }},
      {"torus", [&] { return readTorus(table); }},
      {"torus_knot", [&] { return readTorusKnot(table); }},
      {"box",
       [&] { return makeBox(table.vector3("size", kPositive).value_or(vec3(1)), readDensity(table)); }},
      {"prism",
       [&] {
         return makePrism(length(table, "radius", 0.5), length(table, "length", 1), readDensity(table));
       }},
      {"cylinder",
       [&] {
         return makeCylinder(length(table, "radius", 0.5), length(table, "height", 1), readDensity(table));
       }},
      {"ring",
       [&] {
         return makeRing(length(table, "radius", 0.5), length(table, "height", 0.25),
                         length(table, "thickness", 0.02), readDensity(table));
       }},
      {"plane",
       [&] { return makePlane(table.vector2("size", kPositive).value_or(vec2(1)), readDensity(table)); }},
      {"teapot", [&] { return makeTeapot(length(table, "size", 1), readDensity(table)); }},
      {"water", [&] { return readWater(table, object, time); }},
  };
  std::vector<std::string> names;
  for (const auto& shape : shapes) names.push_back(shape.first);
  return shapes[table.choice("shape", names)].second();
}

}  // namespace nephroid

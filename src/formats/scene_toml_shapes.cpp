#include <functional>
#include <numeric>

#include "formats/scene_toml.h"
#include "formats/scene_toml_water.h"
#include "geometry/shapes.h"

namespace nephroid {
namespace {

constexpr double kMostTurns = 64;  // of a torus knot

float length(TomlTable& table, const char* key, double byDefault) {
  return static_cast<float>(table.number(key, kPositive).value_or(byDefault));
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

}  // namespace

Mesh readShape(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves) {
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
      {"water", [&] { return readWater(table, object, scene, waves); }},
  };
  std::vector<std::string> names;
  for (const auto& shape : shapes) names.push_back(shape.first);
  return shapes[table.choice("shape", names)].second();
}

}  // namespace nephroid

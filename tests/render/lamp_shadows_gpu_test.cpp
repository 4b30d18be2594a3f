#include <algorithm>
#include <cmath>
#include <numbers>

#include "lights/lamp_irradiance.h"
#include "reference/image.h"
#include "render/view.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/test_meshes.h"

namespace nephroid {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

Object placed(uint32_t mesh, vec3 translation, quat rotation = quat(1, 0, 0, 0), float scale = 1) {
  return {"object", mesh, 0, {translation, rotation, scale}, std::nullopt};
}

// A white floor of 12 m, seen from straight above, with a sheet of 8 m over its half x < 0 at `height`: its
// edge is the z axis.
Scene floorUnderASheet(float height) {
  Scene scene;
  scene.camera.position = {0.6f, 1.2f, 0};
  scene.camera.target = {0.6f, 0, 0};
  scene.camera.verticalFov = 70;
  scene.materials.push_back({.name = "white", .color = vec3(1)});
  scene.meshes.push_back(plane(6));
  scene.meshes.push_back(plane(4));
  scene.objects.push_back(placed(0, vec3(0)));
  scene.objects.push_back(placed(1, {-4, height, 0}));
  return scene;
}

class LampShadows : public GpuTest {
 protected:
  // direct.G times pi: lux on white surfaces.
  std::vector<float> lux(const Scene& scene, uvec2 size, uint32_t samples = 1) {
    Drawing drawing(device(), scene, settingsOf("none"), {.size = size, .samples = samples});
    std::vector<float> values = *drawing.layers(scene).find("direct.G");
    for (float& value : values) value *= kPi;
    return values;
  }
};

// Where a pixel's middle sees the plane y = 0.
vec3 floorPoint(const Scene& scene, uvec2 size, std::size_t pixel) {
  const PictureRays rays = raysOf(viewOf(scene.camera, size));
  const vec2 place = (vec2(float(pixel % size.x), float(pixel / size.x)) + 0.5f) / vec2(size) * 2.0f - 1.0f;
  const vec3 direction = rays.middle + place.x * rays.right + place.y * rays.down;
  return scene.camera.position + direction * (-scene.camera.position.y / direction.y);
}

struct Penumbra {
  float largest = 0, mean = 0;  // errors, over the light without shadows
  uint32_t count = 0;           // pixels in it
};

// `expected`: lux at a point of the floor, `whole` without shadows.
template <class Expected, class Whole>
Penumbra compare(const Scene& scene, uvec2 size, const std::vector<float>& lux, const Expected& expected,
                 const Whole& whole) {
  Penumbra penumbra;
  for (std::size_t i = 0; i < lux.size(); ++i) {
    const vec3 point = floorPoint(scene, size, i);
    const float lit = expected(point), all = whole(point);
    const float error = std::abs(lux[i] - lit) / all;
    penumbra.largest = std::max(penumbra.largest, error);
    if (lit < 0.001f * all || lit > 0.999f * all) continue;
    penumbra.mean += error;
    ++penumbra.count;
  }
  penumbra.mean /= float(std::max(penumbra.count, 1u));
  return penumbra;
}

// The part of a disk on the side x > t, of a radius of 1.
float partOfDisk(float t) {
  t = std::clamp(t, -1.0f, 1.0f);
  return (std::acos(t) - t * std::sqrt(1 - t * t)) / kPi;
}

// What is seen of a ball past an edge: its disk, cut at the angle of the plane through point and edge.
TEST_F(LampShadows, ABallBehindAnEdgeIsACutDisk) {
  const uvec2 size(96, 64);
  const float edge = 1;
  Scene scene = floorUnderASheet(edge);
  scene.camera = {.position = {-0.05f, 0.9f, 0}, .target = {-0.05f, 0, 0}, .verticalFov = 20};
  Light light;
  light.position = {0.1f, 3, 0.2f};
  light.radius = 0.1f;
  light.intensity = vec3(50);
  scene.lights.push_back(light);
  const auto whole = [&](vec3 point) {
    const vec3 offset = light.position - point;
    return 50 * offset.y / std::pow(length(offset), 3.0f);
  };
  const auto expected = [&](vec3 point) {
    const vec3 offset = light.position - point;
    // The plane through the point and the edge, along z.
    const vec3 across = normalize(cross(vec3(0, 0, 1), vec3(0, edge, 0) - point));
    const float sine = dot(normalize(offset), across.x < 0 ? -across : across);
    const float sigma = light.radius / length(offset);
    return whole(point) * (1 - partOfDisk(sine / sigma));
  };
  const Penumbra penumbra = compare(scene, size, lux(scene, size, 16), expected, whole);
  EXPECT_GT(penumbra.count, 800u);
  EXPECT_LT(penumbra.largest, 0.02f);
  EXPECT_LT(penumbra.mean, 0.005f);
}

// What is seen of a panel past an edge along one of its sides is a smaller panel.
TEST_F(LampShadows, APanelBehindAnEdgeIsASmallerPanel) {
  const uvec2 size(96, 64);
  const float edge = 1;
  Scene scene = floorUnderASheet(edge);
  scene.camera.position.y = 0.9f;
  Light light;
  light.type = LightType::area;
  light.position = {-0.3f, 3, -0.4f};
  light.u = {0, 0, 0.8f};
  light.v = {0.7f, 0, 0};
  light.direction = normalize(cross(light.v, light.u));
  ASSERT_LT(light.direction.y, 0);
  light.intensity = vec3(50);
  scene.lights.push_back(light);
  const auto seen = [&](vec3 point, float from) {  // of the panel beyond x = from
    const float low = std::clamp(from, light.position.x, light.position.x + light.v.x);
    const float wide = light.position.x + light.v.x - low;
    if (wide <= 0) return 0.0f;
    return 50 / (0.8f * 0.7f) *
           panelIntegral(vec3(low, light.position.y, light.position.z) - point, light.u, {wide, 0, 0},
                         {0, 1, 0});
  };
  const auto whole = [&](vec3 point) { return seen(point, -1); };
  const auto expected = [&](vec3 point) {
    return seen(point, point.x + (0 - point.x) * light.position.y / edge);
  };
  const Penumbra penumbra = compare(scene, size, lux(scene, size, 16), expected, whole);
  EXPECT_GT(penumbra.count, 800u);
  EXPECT_LT(penumbra.largest, 0.02f);
  EXPECT_LT(penumbra.mean, 0.005f);
}

// A sun of half a degree, and a pixel as wide as a third of its shadow's edge.
TEST_F(LampShadows, ASunBehindAnEdgeIsACutDisk) {
  const uvec2 size(96, 64);
  const float edge = 1;
  Scene scene = floorUnderASheet(edge);
  scene.camera = {.position = {0.1f, 0.06f, 0}, .target = {0.1f, 0, 0}, .verticalFov = 40};
  Light light;
  light.type = LightType::directional;
  light.direction = normalize(vec3(0.1f, -1, 0));
  light.angle = kSunAngle;
  light.illuminance = vec3(100);
  scene.lights.push_back(light);
  const float sigma = std::sin(glm::radians(0.5f * kSunAngle)), whole = 100 * -light.direction.y;
  const auto expected = [&](vec3 point) {
    const vec3 across = normalize(cross(vec3(0, 0, 1), vec3(0, edge, 0) - point));
    const float sine = dot(-light.direction, across.x < 0 ? -across : across);
    return whole * (1 - partOfDisk(sine / sigma));
  };
  const Penumbra penumbra = compare(scene, size, lux(scene, size, 16), expected, [&](vec3) { return whole; });
  EXPECT_GT(penumbra.count, 300u);
  EXPECT_LT(penumbra.largest, 0.02f);
}

// Floor and wall touch; the light is behind the wall.
TEST_F(LampShadows, AClosedCornerLetsNoLightThrough) {
  const uvec2 size(160, 120);
  for (const bool isTurned : {false, true}) {
    // Turned, coordinates are rounded.
    const quat turn = isTurned ? glm::angleAxis(0.7f, normalize(vec3(1, 2, 0.5f))) : quat(1, 0, 0, 0);
    Scene scene;
    scene.camera.position = turn * vec3(1, 0.5f, 0.3f);
    scene.camera.target = vec3(0);
    scene.camera.up = turn * vec3(0, 1, 0);
    scene.materials.push_back({.name = "white", .color = vec3(1)});
    scene.meshes.push_back(plane(5));
    scene.objects.push_back(placed(0, vec3(0), turn));
    // Stands on the floor, at x = 0; it faces +x.
    scene.objects.push_back(placed(0, turn * vec3(0, 5, 0), turn * glm::angleAxis(-kPi / 2, vec3(0, 0, 1))));
    for (const float radius : {0.0f, 0.2f}) {
      Light light;
      light.position = turn * vec3(-1, 1.5f, 0.2f);
      light.radius = radius;
      light.intensity = vec3(100);
      scene.lights = {light};
      const std::vector<float> values = lux(scene, size, 4);
      const double sum = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
      EXPECT_LT(sum, 1e-3 * 100 / 2) << radius << (isTurned ? " turned" : "");
    }
  }
}

// Slats in the sun throw stripes on the floor: at each row of pixels their edges are where geometry says.
TEST_F(LampShadows, StripesOfSlatsAreStraight) {
  for (const uvec2 size : {uvec2(640, 480), uvec2(1280, 960)}) {
    Scene scene;
    scene.camera.position = {1.5f, 2, 2.5f};
    scene.camera.target = {0.5f, 0, 0};
    scene.materials.push_back({.name = "white", .color = vec3(1)});
    scene.meshes.push_back(plane(3));
    scene.objects.push_back(placed(0, vec3(0)));
    const vec3 half(0.01f, 0.05f, 1);
    scene.meshes.push_back(box(half));
    for (int i = 0; i < 8; ++i) scene.objects.push_back(placed(1, {-1, 0.8f + 0.2f * float(i), 0}));
    Light sun;
    sun.type = LightType::directional;
    sun.direction = normalize(vec3(0.8f, -0.6f, 0.15f));
    sun.illuminance = vec3(kPi);
    scene.lights.push_back(sun);
    const std::vector<float> values = lux(scene, size);
    const float whole = kPi * -sun.direction.y;
    const auto isShaded = [&](vec3 p) {
      for (int i = 0; i < 8; ++i) {
        vec2 part(0, 1e9f);
        for (int axis = 0; axis < 3; ++axis) {
          const float middle = axis == 0 ? -1 : axis == 1 ? 0.8f + 0.2f * float(i) : 0;
          const float a = (middle - half[axis] - p[axis]) / -sun.direction[axis];
          const float b = (middle + half[axis] - p[axis]) / -sun.direction[axis];
          part = {std::max(part.x, std::min(a, b)), std::min(part.y, std::max(a, b))};
        }
        if (part.x < part.y) return true;
      }
      return false;
    };
    uint32_t shaded = 0, wrong = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const vec3 p = floorPoint(scene, size, i);
      const vec2 place(float(i % size.x), float(i / size.x));
      if (p.x < -0.8f || p.x > 2.95f || std::abs(p.z) > 2.95f) continue;  // slats, or no floor
      bool isDark = isShaded(p);
      shaded += isDark;
      if ((values[i] < 0.5f * whole) == isDark) continue;
      // Within a tenth of a pixel of an edge either is right.
      const PictureRays rays = raysOf(viewOf(scene.camera, size));
      bool isNearEdge = false;
      for (const vec2 aside : {vec2(0.1f, 0), vec2(-0.1f, 0), vec2(0, 0.1f), vec2(0, -0.1f)}) {
        const vec2 at = (place + aside + 0.5f) / vec2(size) * 2.0f - 1.0f;
        const vec3 direction = rays.middle + at.x * rays.right + at.y * rays.down;
        isNearEdge |=
            isShaded(scene.camera.position - direction * (scene.camera.position.y / direction.y)) != isDark;
      }
      wrong += !isNearEdge;
    }
    EXPECT_GT(shaded, size.x * size.y / 20);
    EXPECT_EQ(wrong, 0u) << size.x;
  }
}

// The same scene from the size of a coin to that of a town.
TEST_F(LampShadows, AreTheSameAtAnyScale) {
  const uvec2 size(160, 120);
  std::vector<float> first;
  for (const float scale : {1.0f, 2e-4f, 400.0f}) {
    Scene scene;
    scene.camera.position = scale * vec3(1.2f, 1.5f, 2);
    scene.camera.target = scale * vec3(0, 0.3f, 0);
    scene.materials.push_back({.name = "white", .color = vec3(1)});
    scene.meshes.push_back(plane(2.5f));
    scene.meshes.push_back(box(vec3(0.3f)));
    const quat turn = glm::angleAxis(0.4f, vec3(0, 1, 0));
    scene.objects.push_back(placed(0, vec3(0), quat(1, 0, 0, 0), scale));
    scene.objects.push_back(placed(1, scale * vec3(0, 0.3f, 0), turn, scale));  // stands on the floor
    Light light;
    light.position = scale * vec3(1, 2, -0.5f);
    light.intensity = vec3(scale * scale);
    light.radius = scale * 0.1f;
    scene.lights.push_back(light);
    const std::vector<float> values = lux(scene, size, 4);
    if (first.empty()) {
      first = values;
      continue;
    }
    double off = 0, sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      off += std::abs(double(values[i] - first[i]));
      sum += double(first[i]);
    }
    EXPECT_LT(off / sum, 2e-3) << scale;
  }
}

// Lamps of all kinds over a box, against paths.
TEST_F(LampShadows, AreThoseOfTheReference) {
  const uvec2 size(64, 48);
  const auto shadowed = [&](const Light& light) {
    Scene scene;
    scene.camera.position = {1.2f, 2.5f, 2};
    scene.camera.target = {0, 0.2f, 0};
    scene.materials.push_back({.name = "white", .color = vec3(1)});
    scene.meshes.push_back(plane(4));
    scene.meshes.push_back(box(vec3(0.3f, 0.2f, 0.3f)));
    scene.objects.push_back(placed(0, vec3(0)));
    scene.objects.push_back(placed(1, {0, 0.5f, 0}, glm::angleAxis(0.4f, normalize(vec3(1, 1, 0)))));
    scene.lights.push_back(light);
    return scene;
  };
  Light ball, spot, line, area, sun;
  ball.position = {0.6f, 2, 0.3f};
  ball.radius = 0.3f;
  ball.intensity = vec3(10);
  spot = ball;
  spot.type = LightType::spot;
  spot.direction = normalize(vec3(-0.3f, -1, -0.1f));
  spot.innerAngle = 20;
  spot.outerAngle = 60;
  spot.radius = 0.1f;
  line = ball;
  line.radius = 0;
  line.type = LightType::line;
  line.position = {-0.8f, 1.5f, 0.3f};
  line.end = {0.8f, 1.7f, -0.2f};
  area = line;
  area.type = LightType::area;
  area.u = {0, 0, 0.8f};
  area.v = {0.9f, 0.2f, 0};
  area.direction = normalize(cross(area.v, area.u));
  sun.type = LightType::directional;
  sun.direction = normalize(vec3(-0.4f, -1, 0.2f));
  sun.angle = 8;
  sun.illuminance = vec3(3);
  int number = 0;
  for (const Light& light : {ball, spot, line, area, sun}) {
    const Scene scene = shadowed(light);
    const std::vector<float> values = lux(scene, size, 16);
    const RayScene rays(scene);
    ReferenceSettings settings;
    settings.size = size;
    ReferenceImage reference(scene, rays, settings);
    for (int pass = 0; pass < 256; ++pass) reference.pass();
    const Image truth = reference.image();
    double off = 0, whole = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double expected = double(kPi * truth.find("direct.G")->at(i));
      off += (double(values[i]) - expected) * (double(values[i]) - expected);
      whole += expected * expected;
    }
    // The noise of 256 passes, also at the edges that pixels see.
    EXPECT_LT(std::sqrt(off / whole), 0.03) << number;
    ++number;
  }
}

}  // namespace
}  // namespace nephroid

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/image_io.h"
#include "lights/emitters.h"
#include "render/metering.h"
#include "render/picture.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/test_meshes.h"

namespace nephroid {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr uvec2 kSize(160, 120);

// A floor of 12 m seen from above.
Scene floorScene() {
  Scene scene;
  scene.camera.position = {0, 4, 3};
  scene.camera.target = {0, 0, 0};
  scene.materials.push_back({.name = "gray", .color = vec3(0.5f, 0.4f, 0.3f)});
  scene.meshes.push_back(plane(6));
  scene.objects.push_back({"floor", 0, 0, {}, std::nullopt});
  return scene;
}

Light pointLight(vec3 position, vec3 intensity) {
  Light light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

class Frame : public GpuTest {
 protected:
  Image layersOf(const Scene& scene) {
    Drawing drawing(device(), scene, settingsOf("none"), {.size = kSize, .shadowMapSize = 1024});
    Image layers = drawing.layers(scene);
    picture_ = drawing.renderer.picture();
    return layers;
  }
  ByteImage picture_;
};

vec3 at(const Image& image, const char* prefix, std::size_t pixel) {
  const std::string name(prefix);
  return {image.find(name + "R")->at(pixel), image.find(name + "G")->at(pixel),
          image.find(name + "B")->at(pixel)};
}

// Where the ray through the middle of a pixel meets the plane y = `height`.
vec3 floorPoint(const Scene& scene, std::size_t pixel, float height = 0) {
  const Camera& camera = scene.camera;
  const vec3 forward = normalize(camera.target - camera.position);
  const vec3 right = normalize(cross(forward, camera.up));
  const vec3 up = cross(right, forward);
  const float tangent = std::tan(glm::radians(camera.verticalFov / 2));
  const vec2 place =
      (vec2(float(pixel % kSize.x), float(pixel / kSize.x)) + 0.5f) / vec2(kSize) * 2.0f - 1.0f;
  const vec3 direction =
      forward + tangent * (place.x * float(kSize.x) / float(kSize.y) * right - place.y * up);
  return camera.position + direction * ((height - camera.position.y) / direction.y);
}

void expectClose(vec3 value, vec3 expected, float relative, std::size_t pixel) {
  for (int c = 0; c < 3; ++c)
    ASSERT_NEAR(value[c], expected[c], relative * std::abs(expected[c]) + 1e-7f)
        << "pixel " << pixel % kSize.x << ", " << pixel / kSize.x << " channel " << c;
}

constexpr float kFloat = 2e-5f;  // a few dozen float roundings on the way

TEST_F(Frame, APointLightGivesIntensityTimesCosineOverDistanceSquared) {
  Scene scene = floorScene();
  scene.lights.push_back(pointLight({0.5f, 2, 0.3f}, {10, 20, 30}));
  const Image image = layersOf(scene);
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    const vec3 toLight = scene.lights[0].position - floorPoint(scene, i);
    const float d = length(toLight);
    const vec3 lux = scene.lights[0].intensity * (toLight.y / d) / (d * d);
    expectClose(at(image, "", i), scene.materials[0].color / kPi * lux, kFloat, i);
    expectClose(at(image, "direct.", i), at(image, "", i), 0, i);
  }
}

TEST_F(Frame, ADirectionalLightGivesIlluminanceTimesCosineAndAmbientLightAddsItself) {
  Scene scene = floorScene();
  Light sun;
  sun.type = LightType::directional;
  sun.direction = normalize(vec3(1, -2, 0));
  sun.illuminance = vec3(100, 50, 25);
  scene.lights.push_back(sun);
  scene.environment.ambient = vec3(3, 2, 1);
  const Image image = layersOf(scene);
  const vec3 reflectance = scene.materials[0].color / kPi;
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    const vec3 direct = reflectance * sun.illuminance * (2 / std::sqrt(5.0f));
    expectClose(at(image, "direct.", i), direct, kFloat, i);
    expectClose(at(image, "", i), direct + reflectance * scene.environment.ambient, kFloat, i);
  }
}

TEST_F(Frame, ASpotFallsOffAsKhrLightsPunctualSays) {
  Scene scene = floorScene();
  Light spot = pointLight({0, 3, 0}, vec3(50));
  spot.type = LightType::spot;
  spot.innerAngle = 10;
  spot.outerAngle = 25;
  spot.direction = normalize(vec3(0.1f, -1, 0));
  scene.lights.push_back(spot);
  const Image image = layersOf(scene);
  const float cosInner = std::cos(glm::radians(10.0f));
  const float cosOuter = std::cos(glm::radians(25.0f));
  const float scale = 1 / std::max(0.001f, cosInner - cosOuter);
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    const vec3 offset = floorPoint(scene, i) - spot.position;
    const float d = length(offset);
    const float cosine = dot(offset / d, spot.direction);
    const float falloff = std::pow(glm::clamp(cosine * scale - cosOuter * scale, 0.0f, 1.0f), 2.0f);
    const vec3 lux = spot.intensity * falloff * (-offset.y / d) / (d * d);
    const vec3 expected = scene.materials[0].color / kPi * lux;
    // Near the cone's edge the cosine's rounding is large beside what is left.
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(at(image, "", i)[c], expected[c], 1e-4f * expected[c] + 2e-5f) << i;
  }
}

TEST_F(Frame, ALineShinesEvenlyAlongItsLength) {
  Scene scene = floorScene();
  Light line = pointLight({-1, 2, 0}, vec3(40));
  line.type = LightType::line;
  line.end = {1, 2, 0};
  line.samples = 4;
  scene.lights.push_back(line);
  const Image image = layersOf(scene);
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    // The integral of 20 cd/m times height / distance^3.
    const vec3 low = vec3(-1, 2, 0) - floorPoint(scene, i), high = vec3(1, 2, 0) - floorPoint(scene, i);
    const float away = low.y * low.y + low.z * low.z;
    const float lux = 20 * low.y / away * (high.x / length(high) - low.x / length(low));
    expectClose(at(image, "", i), scene.materials[0].color / kPi * lux, 5 * kFloat, i);
  }
}

// A box in the air: whether the segment from the floor to the light meets it is known in closed form.
bool segmentMeetsBox(vec3 from, vec3 to, vec3 center, vec3 halfSize) {
  float enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float a = (center[axis] - halfSize[axis] - from[axis]) / (to[axis] - from[axis]);
    const float b = (center[axis] + halfSize[axis] - from[axis]) / (to[axis] - from[axis]);
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

struct ShadowCase {
  const char* name;
  Light light;
  MaterialType type;
  bool isInRoom = false;  // with a room around that can shade too: six maps
};

Light lightOf(LightType type, vec3 position, vec3 direction) {
  Light light = pointLight(position, vec3(20));
  light.type = type;
  light.direction = normalize(direction);
  light.innerAngle = 40;
  light.outerAngle = 50;
  light.samples = 1;
  return light;
}

void PrintTo(const ShadowCase& shadow, std::ostream* out) {
  *out << shadow.name;
}

class Shadow : public Frame, public testing::WithParamInterface<ShadowCase> {};

TEST_P(Shadow, LandsWhereGeometrySays) {
  Scene scene = floorScene();
  const vec3 center(0.3f, 0.6f, 0.1f), halfSize(0.31f, 0.1f, 0.23f);
  scene.materials.push_back({.name = "block", .type = GetParam().type, .color = vec3(0.5f)});
  scene.meshes.push_back(box(halfSize));
  scene.objects.push_back({"block", 1, 1, {center, quat(1, 0, 0, 0), 1}, std::nullopt});
  scene.lights.push_back(GetParam().light);
  if (GetParam().isInRoom) {
    scene.meshes.push_back(box(vec3(8)));
    scene.objects.push_back({"room", 2, 0, {vec3(0.1f), quat(1, 0, 0, 0), 1}, std::nullopt});
  }
  const Image image = layersOf(scene);
  const Light& light = scene.lights[0];
  const vec3 lightPosition = light.type == LightType::directional ? vec3(0) : light.position;
  const float margin = 0.001f;  // m
  std::size_t shaded = 0, lit = 0;
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    const vec3 p = floorPoint(scene, i);
    const vec3 to = light.type == LightType::directional ? p - 20.0f * light.direction : lightPosition;
    if (segmentMeetsBox(p, scene.camera.position, center, halfSize + margin)) continue;  // the block is seen
    const float direct = image.find("direct.G")->at(i);
    if (segmentMeetsBox(p, to, center, halfSize - margin)) {
      ASSERT_EQ(direct, 0) << "pixel " << i % kSize.x << ", " << i / kSize.x;
      ++shaded;
    } else if (!segmentMeetsBox(p, to, center, halfSize + margin)) {
      const vec3 offset = p - light.position;
      const float d = length(offset);
      const bool isSun = light.type == LightType::directional;
      if (!isSun && dot(offset / d, light.direction) < std::cos(glm::radians(39.9f)) &&
          light.type == LightType::spot)
        continue;
      const float lux = isSun ? -light.direction.y : 20 * -offset.y / (d * d * d);
      ASSERT_NEAR(direct, 0.4f / kPi * lux, kFloat * lux) << "pixel " << i % kSize.x << ", " << i / kSize.x;
      ++lit;
    }
  }
  EXPECT_GT(shaded, 150u);
  EXPECT_GT(lit, 5000u);
}

INSTANTIATE_TEST_SUITE_P(
    Lights, Shadow,
    testing::Values(
        ShadowCase{"Point", lightOf(LightType::point, {1, 3, 0.5f}, {0, -1, 0}), MaterialType::diffuse},
        ShadowCase{"Spot", lightOf(LightType::spot, {1, 3, 0.5f}, {-0.2f, -1, 0}), MaterialType::diffuse},
        ShadowCase{"Sun", lightOf(LightType::directional, {0, 0, 0}, {0.3f, -1, 0.2f}),
                   MaterialType::diffuse},
        ShadowCase{"PointOnGlass", lightOf(LightType::point, {1, 3, 0.5f}, {0, -1, 0}),
                   MaterialType::dielectric},
        ShadowCase{"PointInARoom", lightOf(LightType::point, {1, 3, 0.5f}, {0, -1, 0}), MaterialType::diffuse,
                   true},
        ShadowCase{"LowPointInARoom", lightOf(LightType::point, {-1.5f, 1.5f, -0.5f}, {0, -1, 0}),
                   MaterialType::diffuse, true}),
    [](const auto& shadow) { return shadow.param.name; });

struct LineCase {
  const char* name;
  vec3 from, to;
};

void PrintTo(const LineCase& line, std::ostream* out) {
  *out << line.name;
}

class LineShadow : public Frame, public testing::WithParamInterface<LineCase> {};

TEST_P(LineShadow, IsThatOfAllOfTheLine) {
  Scene scene = floorScene();
  const vec3 center(0.3f, 0.6f, 0.1f), halfSize(0.31f, 0.1f, 0.23f);
  scene.meshes.push_back(box(halfSize));
  scene.objects.push_back({"block", 1, 0, {center, quat(1, 0, 0, 0), 1}, std::nullopt});
  Light line = lightOf(LightType::line, GetParam().from, {0, -1, 0});
  line.end = GetParam().to;
  line.samples = 3;
  scene.lights.push_back(line);
  const Image image = layersOf(scene);
  line.samples = 96;
  const float margin = 0.05f;  // m: more than a pixel
  std::size_t partlyShaded = 0;
  double squares = 0, whole = 0;
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const vec3 p = floorPoint(scene, i);
    if (segmentMeetsBox(p, scene.camera.position, center, halfSize + margin)) continue;
    float lux = 0, unshaded = 0;
    uint32_t shading = 0;
    for (const Emitter& point : emittersOf(line)) {
      const vec3 toLight = point.position - p;
      const bool isShaded = segmentMeetsBox(p, point.position, center, halfSize);
      shading += isShaded;
      const float own = point.power.y * toLight.y / std::pow(length(toLight), 3.0f);
      unshaded += own;
      if (!isShaded) lux += own;
    }
    if (shading == 0 || shading == line.samples) continue;
    const float off = image.find("direct.G")->at(i) / (0.4f / kPi) - lux;
    squares += double(off * off);
    whole += double(unshaded * unshaded);
    ++partlyShaded;
  }
  EXPECT_GT(partlyShaded, 50u);
  EXPECT_LT(std::sqrt(squares / whole), 0.06);  // 1 / 16, of as many places
}

INSTANTIATE_TEST_SUITE_P(Lines, LineShadow,
                         testing::Values(LineCase{"Above", {-1, 2, 0.5f}, {2, 2, 0.2f}},
                                         LineCase{"Aslant", {-0.5f, 1.5f, 1}, {2, 3, 0.5f}},
                                         LineCase{
                                             "PointingAtTheBlock", {0.4f, 0.65f, 0.2f}, {1, 3.35f, 0.6f}},
                                         LineCase{"BesideTheBlock", {1.2f, 0.7f, -1}, {1.2f, 0.8f, 1}}),
                         [](const auto& line) { return std::string(line.param.name); });

// With walls all around that are not flat the light needs six maps; nothing may shade itself.
TEST_F(Frame, ALightInsideARoomShadesNoneOfItsWalls) {
  Scene scene;
  scene.camera.position = {0, 0, 1.9f};
  scene.camera.target = {0, 0, 0};
  scene.camera.verticalFov = 90;
  scene.materials.push_back({.name = "white", .color = vec3(1)});
  scene.meshes.push_back(box(vec3(2)));
  scene.objects.push_back({"room", 0, 0, {}, std::nullopt});
  scene.lights.push_back(pointLight({0.4f, 0.7f, -0.2f}, vec3(kPi)));
  const Image image = layersOf(scene);
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    const vec3 normal(image.find("normal.X")->at(i), image.find("normal.Y")->at(i),
                      image.find("normal.Z")->at(i));
    const float depth = image.find("depth.Z")->at(i);
    const vec2 place = (vec2(float(i % kSize.x), float(i / kSize.x)) + 0.5f) / vec2(kSize) * 2.0f - 1.0f;
    const vec3 p =
        scene.camera.position + depth * vec3(place.x * float(kSize.x) / float(kSize.y), -place.y, -1);
    if (dot(glm::step(vec3(1.999f), glm::abs(p)), vec3(1)) > 1) continue;  // either of two walls
    const vec3 toLight = scene.lights[0].position - p;
    const float d = length(toLight);
    ASSERT_NEAR(image.find("direct.R")->at(i), dot(toLight, normal) / (d * d * d), 1e-4f) << i;
  }
}

TEST_F(Frame, ATextureColorsADiffuseSurface) {
  Scene scene = floorScene();
  Texture halves{"halves", 64, 1, std::vector<vec4>(32, vec4(1, 0, 0, 1))};
  halves.texels.resize(64, vec4(0, 1, 0, 1));
  scene.textures.push_back(halves);
  scene.materials[0].colorTexture = 0;
  scene.environment.ambient = vec3(kPi);
  const Image image = layersOf(scene);
  for (std::size_t i = 0; i < image.pixelCount() && !HasFatalFailure(); ++i) {
    const float x = floorPoint(scene, i).x;
    if (x < -0.6f) expectClose(at(image, "", i), vec3(0.5f, 0, 0), 1e-3f, i);
    if (x > 0.6f) expectClose(at(image, "", i), vec3(0, 0.4f, 0), 1e-3f, i);
  }
}

// A slab seen face on: Beer-Lambert over its thickness, and the reflectance 0.04 of index 1.5 at both faces.
// With all that its two faces send to and fro.
TEST_F(Frame, GlassIsATintedViewStraightThroughAndAReflectionOfTheBackground) {
  Scene scene = floorScene();
  scene.camera.position = {0, 4, 0};
  scene.camera.up = {0, 0, -1};
  scene.camera.verticalFov = 4;
  scene.environment.ambient = vec3(kPi);
  scene.environment.background = vec3(2, 3, 4);
  Material glass{.name = "glass", .type = MaterialType::dielectric};
  glass.attenuationColor = vec3(0.5f, 0.7f, 0.9f);
  glass.attenuationDistance = 0.2f;
  scene.materials.push_back(glass);
  scene.meshes.push_back(box({0.5f, 0.05f, 0.5f}));
  scene.objects.push_back({"slab", 1, 1, {vec3(0, 1, 0), quat(1, 0, 0, 0), 1}, std::nullopt});
  const Image image = layersOf(scene);
  const std::size_t middle = kSize.y / 2 * kSize.x + kSize.x / 2;
  const vec3 across = glm::sqrt(glass.attenuationColor);
  const vec3 toAndFro = 0.96f * 0.96f / (1.0f - 0.0016f * across * across);
  const vec3 through = scene.materials[0].color * toAndFro * across;
  const vec3 reflected = 0.04f + 0.04f * toAndFro * across * across;
  expectClose(at(image, "", middle), through + reflected * scene.environment.background, 2e-3f, middle);
  EXPECT_NEAR(image.find("depth.Z")->at(middle), 2.95f, 1e-4f);
  EXPECT_NEAR(image.find("normal.Y")->at(middle), 1, 1e-6f);
}

TEST_F(Frame, EmissionMirrorsAndBackgroundAreSeen) {
  Scene scene = floorScene();
  scene.materials[0].emission = vec3(7, 8, 9);
  scene.environment.background = vec3(2, 3, 4);
  scene.materials.push_back(
      {.name = "mirror", .type = MaterialType::mirror, .color = vec3(0.9f, 0.5f, 0.1f)});
  scene.meshes.push_back(box(vec3(0.5f)));
  scene.objects.push_back({"cube", 1, 1, {}, std::nullopt});
  scene.camera.verticalFov = 100;
  const Image image = layersOf(scene);
  const std::size_t middle = kSize.y / 2 * kSize.x + kSize.x / 2;
  expectClose(at(image, "", middle), vec3(1.8f, 1.5f, 0.4f), kFloat, middle);
  expectClose(at(image, "", 0), scene.environment.background, 0, 0);
  const std::size_t below = (kSize.y - 8) * kSize.x + kSize.x / 2;
  expectClose(at(image, "", below), vec3(7, 8, 9), kFloat, below);
  EXPECT_EQ(image.find("depth.Z")->at(0), 0);
}

// Above black and below its shoulder the tone mapper takes 0.04 off and leaves colors as they are.
TEST_F(Frame, APictureIsExposedLuminanceInSrgb) {
  Scene scene = floorScene();
  scene.materials[0].color = vec3(0);
  scene.camera.exposure = 0.5f;
  for (int step = 0; step < 12; ++step) {
    const vec3 shown = vec3(0.1f, 0.2f, 0.3f) + 0.04f * static_cast<float>(step);
    scene.materials[0].emission = (shown + 0.04f) / *scene.camera.exposure;
    layersOf(scene);
    for (int c = 0; c < 3; ++c) {
      const double level = 255 * srgbFromLinear(shown[c]);
      double sum = 0;
      for (uint32_t i = 0; i < kSize.x; ++i) {
        const uint8_t byte = picture_.bytes[std::size_t{3} * i + std::size_t(c)];
        EXPECT_NEAR(byte, level, 1.02);
        sum += byte;
      }
      EXPECT_NEAR(sum / kSize.x, level, 0.1);  // the pattern keeps what is between two levels
    }
  }
  scene.materials[0].emission = vec3(1e6f);
  layersOf(scene);
  EXPECT_EQ(picture_.bytes[0], 255);
}

// One rounding apart: the device may round its powers and fractions another way.
TEST_F(Frame, APictureOfItsLayersIsItsPicture) {
  Scene scene = floorScene();
  scene.lights.push_back(pointLight({0, 1.5f, 0}, vec3(30, 12, 3)));
  for (const ToneCurve tone : {ToneCurve::neutral, ToneCurve::agx, ToneCurve::aces, ToneCurve::linear}) {
    scene.camera.tone = tone;
    const Image layers = layersOf(scene);
    const ByteImage picture = pictureOf(layers, toneMappingOf(scene.camera, layers));
    ASSERT_EQ(picture.bytes.size(), picture_.bytes.size());
    for (std::size_t i = 0; i < picture.bytes.size(); ++i)
      EXPECT_NEAR(picture.bytes[i], picture_.bytes[i], 1) << i;
    EXPECT_NE(*std::min_element(picture.bytes.begin(), picture.bytes.end()),
              *std::max_element(picture.bytes.begin(), picture.bytes.end()));
  }
}

// On the middle of each pixel, so that how many samples there are makes no difference, and the light is the
// same as for an exposure that is given.
TEST_F(Frame, IsMeteredOnTheSameForAnyNumberOfSamples) {
  Scene scene = floorScene();
  scene.lights.push_back(pointLight({0, 1.5f, 0}, vec3(30, 12, 3)));
  const Image one = layersOf(scene);
  const float exposure = meteredExposure(one);
  for (const uint32_t samples : {1u, 3u}) {
    const RenderSettings settings{.size = kSize, .shadowMapSize = 1024, .samples = samples};
    Drawing metered(device(), scene, settingsOf("none"), settings);
    const Image layers = metered.layers(scene);
    EXPECT_FLOAT_EQ(metered.renderer.exposure(), exposure);
    Scene given = scene;
    given.camera.exposure = exposure;
    Drawing other(device(), given, settingsOf("none"), settings);
    const Image givenLayers = other.layers(given);
    for (std::size_t i = 0; i < layers.channels.size(); ++i)
      EXPECT_EQ(layers.channels[i].values, givenLayers.channels[i].values) << layers.channels[i].name;
    EXPECT_EQ(metered.renderer.picture().bytes, other.renderer.picture().bytes);
  }
}

TEST_F(Frame, TheSameSceneGivesTheSameBytesAndAMovedLightOthers) {
  Scene scene = floorScene();
  scene.meshes.push_back(box(vec3(0.3f)));
  scene.objects.push_back({"block", 1, 0, {vec3(0, 0.5f, 0), quat(1, 0, 0, 0), 1}, std::nullopt});
  scene.lights.push_back(pointLight({1, 2, 1}, vec3(20)));
  const Image first = layersOf(scene);
  const std::vector<uint8_t> picture = picture_.bytes;
  const Image second = layersOf(scene);
  EXPECT_EQ(picture, picture_.bytes);
  for (std::size_t i = 0; i < first.channels.size(); ++i)
    EXPECT_EQ(first.channels[i].values, second.channels[i].values);
  scene.lights[0].position.x = -1;
  layersOf(scene);
  EXPECT_NE(picture, picture_.bytes);
}

}  // namespace
}  // namespace nephroid

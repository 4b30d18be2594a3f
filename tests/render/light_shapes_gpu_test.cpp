// Gobos and profiles as the frame draws them, against lightIntensity and total flux.
#include <cmath>
#include <glm/gtx/quaternion.hpp>
#include <numbers>
#include <random>

#include "formats/ies.h"
#include "formats/load.h"
#include "geometry/shapes.h"
#include "lights/light_intensity.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/shared_data.h"

namespace nephroid {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr uvec2 kSize(128, 128);

Texture randomGobo(uint32_t width, uint32_t height) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> level(0, 1);
  Texture gobo{"noise", width, height, {}};
  for (uint32_t i = 0; i < width * height; ++i)
    gobo.texels.emplace_back(level(random), level(random), level(random), 1);
  return gobo;
}

Profile randomProfile(PhotometryType type, std::vector<float> verticals, std::vector<float> horizontals) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> level(0.2f, 1);
  Profile profile{"noise", type, std::move(verticals), std::move(horizontals), {}, 100};
  for (std::size_t i = 0; i < profile.verticalAngles.size() * profile.horizontalAngles.size(); ++i)
    profile.fractions.push_back(level(random));
  return profile;
}

const std::vector<vec3> kWalls{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

// A room of white walls around the camera, which sees one of them. Walls that are objects of their own shade
// nothing.
Scene room(const Light& light) {
  Scene scene;
  scene.camera.position = {0, 0, 0};
  scene.camera.target = {0, 0, -1};
  scene.camera.verticalFov = 90;
  scene.materials.push_back({.name = "white", .color = vec3(1)});
  scene.meshes.push_back(makePlane({4, 4}));
  for (const vec3 wall : kWalls)
    scene.objects.push_back(
        {"wall", 0, 0, {2.0f * wall, glm::rotation(vec3(0, 1, 0), -wall), 1}, std::nullopt});
  scene.lights.push_back(light);
  return scene;
}

Light spot(float outerAngle) {
  Light light;
  light.type = LightType::spot;
  light.position = {0.2f, 0.1f, -0.15f};
  light.direction = normalize(vec3(0.3f, -0.5f, 0.7f));
  light.intensity = {30, 20, 10};
  light.innerAngle = outerAngle < 180 ? 0.5f * outerAngle : 180;
  light.outerAngle = outerAngle;
  return light;
}

class LightShapes : public GpuTest {
 protected:
  // The part `direct` in each of six directions, as the color at points of the walls.
  struct Sample {
    vec3 point, normal, lux;
  };
  std::vector<Sample> drawn(Scene scene) {
    Drawing drawing(device(), scene, settingsOf("none"), {.size = kSize});
    std::vector<Sample> samples;
    for (const vec3 forward : kWalls) {
      scene.camera.target = forward;
      scene.camera.up = forward.y != 0 ? vec3(0, 0, 1) : vec3(0, 1, 0);
      const Image image = drawing.layers(scene);
      const vec3 right = cross(forward, scene.camera.up);
      for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const vec2 place = (vec2(float(i % kSize.x), float(i / kSize.x)) + 0.5f) / vec2(kSize) * 2.0f - 1.0f;
        const auto channel = [&](const char* name) { return image.find(name)->at(i); };
        samples.push_back({2.0f * (forward + place.x * right - place.y * scene.camera.up), -forward,
                           kPi * vec3(channel("direct.R"), channel("direct.G"), channel("direct.B"))});
      }
    }
    return samples;
  }

  void expectAsComputed(const Scene& scene, float tolerance) {
    const ShapedLight light = shapedLight(scene, scene.lights[0]);
    const std::vector<Emitter> emitters = emittersOf(scene);
    double sum = 0;
    for (const Sample& sample : drawn(scene)) {
      vec3 lux(0);
      float peak = 0;
      for (const Emitter& emitter : emitters) {
        const vec3 offset = emitter.position - sample.point;
        const float cosine = dot(normalize(offset), sample.normal);
        lux += cosine * illuminance(light, emitter, sample.point);
        peak += cosine * emitter.power.x / dot(offset, offset);
      }
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(sample.lux[c], lux[c], tolerance * peak)
            << "at " << sample.point.x << ", " << sample.point.y << ", " << sample.point.z;
      sum += double(lux.x);
    }
    EXPECT_GT(sum, 0);
  }
};

// Devices weigh the texels of a filter in steps of 1/256, and gobos are half floats on them.
constexpr float kFilterTolerance = 1.0f / 200;
// A profile changes by its whole peak in not less than five degrees here; devices may be off by 1e-3 degrees
// in inverse trigonometric functions.
constexpr float kProfileTolerance = 3e-4f;

TEST_F(LightShapes, AGoboIsThrownAsComputed) {
  for (const uvec2 size : {uvec2(16, 16), uvec2(24, 9), uvec2(5, 11)}) {
    Light light = spot(50);
    light.goboTexture = 0;
    Scene scene = room(light);
    scene.textures.push_back(randomGobo(size.x, size.y));
    expectAsComputed(scene, kFilterTolerance);
  }
}

TEST_F(LightShapes, AProfileIsAsComputedWhateverItsTypeAndSymmetry) {
  const std::vector<float> uneven{0, 10, 17.5f, 45, 60, 65, 90};
  const struct {
    PhotometryType type;
    std::vector<float> verticals, horizontals;
  } kShapes[] = {
      {PhotometryType::c, {0, 5, 20, 90, 180}, {0}},
      {PhotometryType::c, uneven, {0, 22.5f, 45, 67.5f, 90}},
      {PhotometryType::c, {0, 45, 90, 135, 180}, {0, 10, 100, 180}},
      {PhotometryType::c, {90, 100, 150, 180}, {90, 180, 270}},
      {PhotometryType::c, uneven, {0, 30, 200, 205, 360}},
      {PhotometryType::b, {-90, -30, 0, 60, 90}, {-90, -20, 0, 20, 90}},
      {PhotometryType::b, {0, 30, 90}, {0, 10, 80}},
      {PhotometryType::a, {-90, -60, 0, 10, 90}, {-90, 0, 45, 90}},
      {PhotometryType::a, {0, 40, 90}, {0, 5, 60}},
  };
  for (const auto& shape : kShapes) {
    Light light = spot(180);
    light.profile = 0;
    Scene scene = room(light);
    scene.profiles.push_back(randomProfile(shape.type, shape.verticals, shape.horizontals));
    SCOPED_TRACE("type " + std::string(1, "CBA"[int(shape.type)]) + " of " +
                 std::to_string(shape.horizontals.size()) + " horizontal angles");
    expectAsComputed(scene, kProfileTolerance);
  }
}

TEST_F(LightShapes, AGoboAndAProfileMultiply) {
  Light light = spot(60);
  light.goboTexture = light.profile = 0;
  Scene scene = room(light);
  scene.textures.push_back(randomGobo(12, 12));
  scene.profiles.push_back(randomProfile(PhotometryType::c, {0, 20, 70, 90}, {0, 90, 180}));
  expectAsComputed(scene, kFilterTolerance);
}

TEST_F(LightShapes, APanelShinesBeforeIt) {
  Light light = spot(180);
  light.type = LightType::area;
  light.u = {0.2f, 0, 0.1f};
  light.v = {0, 0.3f, 0};
  light.direction = normalize(cross(light.v, light.u));
  light.grid = {24, 24};  // what is computed is the sum over so many points
  expectAsComputed(room(light), 1e-4f);
}

// All of the light lands on the walls, so that its lumens are the sum over the pixels' areas.
TEST_F(LightShapes, AllLumensOfMeasuredLampsArrive) {
  const auto folder = sharedData() / "data" / "ies";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".ies") continue;
    Light light = spot(180);
    light.profile = 0;
    Scene scene = room(light);
    scene.profiles.push_back(loadIes(entry.path()));
    light.intensity = vec3(scene.profiles[0].peak);
    scene.lights[0] = light;
    const float pixelArea = 4.0f / float(kSize.x) * 4.0f / float(kSize.y);  // m2
    double lumens = 0;
    for (const Sample& sample : drawn(scene)) lumens += double(sample.lux.y * pixelArea);
    const double expected = profileFlux(scene.profiles[0]);
    // A pixel's middle stands for all of it, over which a profile of a few degrees bends.
    EXPECT_NEAR(lumens, expected, 2e-3 * expected) << entry.path();
  }
}

// A technique's planes hold what the beams bring, gobo or not.
TEST_F(LightShapes, ACausticOfAGoboHasTheFluxOfItsBeams) {
  Scene scene;
  scene.materials = {{.name = "glass", .type = MaterialType::dielectric}, {.name = "floor"}};
  scene.meshes = {makeSphere(0.4f, {.segments = 48}), makePlane({8, 8})};
  scene.objects.push_back({"ball", 0, 0, {vec3(0, 0.7f, 0), quat(1, 0, 0, 0), 1}, std::nullopt});
  scene.objects.push_back({"floor", 1, 1, {}, std::nullopt});
  Light light = spot(24);
  light.position = {-0.6f, 2.4f, 0.3f};
  light.direction = normalize(vec3(0, 0.7f, 0) - light.position);
  light.goboTexture = 0;
  scene.lights.push_back(light);
  scene.textures.push_back(randomGobo(40, 40));
  scene.sensors.push_back({"floor", {-0.6f, 0, -0.7f}, {1.4f, 0, 0}, {0, 0, 1.4f}, uvec2(64)});
  const TechniqueSettings settings = settingsOf(defaultTechnique());
  const SensorLayer byTechnique = measuredBy(device(), scene, scene.sensors[0], settings);
  Progress progress;
  Stats stats;
  const RayScene rays(scene);
  const SensorLayer byBeams =
      measureBeams(scene, rays, TracedSource(scene, rays), scene.sensors[0], settings.transport.paths,
                   settings.beams.refineDepth, progress, stats);
  glm::dvec3 technique(0), beams(0);
  for (const vec3 lux : byTechnique) technique += glm::dvec3(lux);
  for (const vec3 lux : byBeams) beams += glm::dvec3(lux);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(technique[c] / beams[c], 1, 0.01);
}

}  // namespace
}  // namespace nephroid

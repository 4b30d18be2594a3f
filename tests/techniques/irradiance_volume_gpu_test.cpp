#include "techniques/irradiance_volume/scene_volumes.h"
#include "techniques/registry.h"

#include "geometry/shapes.h"
#include "gpu/command_list.h"
#include "gpu/transfer.h"
#include "irradiance_volume/lookup.h"
#include "support/gpu_fixture.h"

namespace nephroid {
namespace {

constexpr uint32_t kSide = 48;

// A caster that is turned and scaled, under a sun and a lamp.
Scene sceneWith(Mesh mesh, MaterialType type) {
  Scene scene;
  Material material;
  material.type = type;
  material.color = vec3(0.9f, 0.7f, 0.5f);
  material.attenuationColor = vec3(0.9f, 0.5f, 0.3f);
  material.attenuationDistance = 1;
  scene.meshes.push_back(std::move(mesh));
  scene.materials = {material};
  Object object;
  object.placement = {{0.2f, 1, -0.1f}, glm::angleAxis(0.7f, normalize(vec3(1, 2, 3))), 1.6f};
  scene.objects = {object};
  Light sun;
  sun.type = LightType::directional;
  sun.direction = normalize(vec3(0.4f, -0.9f, 0.2f));
  sun.illuminance = vec3(100, 90, 80);
  Light lamp;
  lamp.position = vec3(-2, 4, 1);
  lamp.intensity = vec3(300);
  scene.lights = {sun, lamp};
  return scene;
}

TechniqueSettings quickSettings() {
  TechniqueSettings settings;
  settings.technique = "irradiance-volume";
  auto& own = settings.own.of<IrradianceVolumeSettings>();
  own.kilobytes = 40;
  own.photons = 10;
  own.lightLevel = 1;
  return settings;
}

class IrradianceVolumeGpuTest : public GpuTest {
 protected:
  // A slanting square of receiver points through the caster's region, that faces up.
  static std::vector<vec4> points() {
    std::vector<vec4> places;
    for (uint32_t i = 0; i < kSide * kSide; ++i)
      places.emplace_back(4 * (float(i % kSide) + 0.5f) / kSide - 2, 0.004f * float(i % kSide),
                          4 * (float(i / kSide) + 0.5f) / kSide - 2, i % 17 == 0 ? 0 : 1);
    return places;
  }
  static gpu::Image image(const std::vector<vec4>& texels) {
    gpu::Image made = gpu::createImage(device(), "points", {.width = kSide, .height = kSide});
    const auto bytes = std::as_bytes(std::span(texels));
    gpu::uploadImage(device(), made, {{bytes.begin(), bytes.end()}});
    return made;
  }
  static std::vector<vec4> shaded(Technique& technique, GpuScene& gpuScene, vec3 normal) {
    const gpu::Image positions = image(points());
    const gpu::Image normals = image(std::vector<vec4>(kSide * kSide, vec4(normal, 0)));
    const gpu::Image caustics = image(std::vector<vec4>(kSide * kSide, vec4(0)));
    technique.update(gpuScene);
    device().submitAndWait([&](gpu::CommandList& commands) {
      technique.record(commands, gpuScene);
      technique.shade(commands, {&positions, &normals}, caustics);
    });
    return gpu::download<vec4>(device(), caustics);
  }
};

// The same look-ups, on the processor: light by light, since spherical harmonics are resolved for one at a
// time.
std::vector<vec3> expectedLux(SceneVolumes& volumes, const Scene& scene, const TechniqueSettings& settings,
                              const std::vector<vec4>& points, vec3 normal) {
  const Placement& placement = scene.objects[0].placement;
  IrradianceVolume& volume = *volumes.ofObject[0];
  const vec3 center = placement.point(volume.sphere().center), toLamp = scene.lights[1].position - center;
  std::vector<vec3> lux(points.size(), vec3(0));
  const auto add = [&](vec3 direction, vec3 power, vec3 nearness) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].w == 0) continue;
      // What crosses a surface there crosses its image.
      const vec3 x = vec3(points[i]) - center;
      const float scale = nearScale(x, nearness);
      const vec3 image = scale * scale * scale * (normal - dot(normal, x) * nearness);
      lux[i] += power * length(image) *
                volume.illuminance(placement.inversePoint(center + scale * x),
                                   placement.inverseDirection(normalize(image)),
                                   placement.inverseDirection(direction),
                                   settings.own.of<IrradianceVolumeSettings>().lightInterpolation);
    }
  };
  add(scene.lights[0].direction, scene.lights[0].illuminance, vec3(0));
  add(-normalize(toLamp), scene.lights[1].intensity / dot(toLamp, toLamp), toLamp / dot(toLamp, toLamp));
  return lux;
}

TEST_F(IrradianceVolumeGpuTest, ShowsWhatTheProcessorLooksUp) {
  struct Case {
    Mesh mesh;
    MaterialType type;
  };
  const vec3 normal = normalize(vec3(-0.1f, 1, 0.2f));
  for (const Case& item : {Case{makeSphere(0.5f, {.vertices = 1000}), MaterialType::dielectric},
                           Case{makePrism(0.5f, 1), MaterialType::dielectric},
                           Case{makeRing(0.5f, 0.3f, 0.05f, {.vertices = 1000}), MaterialType::mirror}}) {
    const Scene scene = sceneWith(item.mesh, item.type);
    for (const auto representation : {Representation::grid, Representation::shells,
                                      Representation::multiResolution, Representation::harmonics})
      for (const auto interpolation : {LightInterpolation::nearest, LightInterpolation::flow}) {
        TechniqueSettings settings = quickSettings();
        settings.own.of<IrradianceVolumeSettings>().representation = representation;
        settings.own.of<IrradianceVolumeSettings>().lightInterpolation = interpolation;
        Progress progress;
        Stats stats;
        GpuScene gpuScene(device(), scene);
        SceneTransport transport(scene, transportOf(settings), progress);
        const auto technique = makeTechnique({device(), settings, transport, stats});
        SceneVolumes volumes = sceneVolumes(scene, settings);
        const std::vector<vec4> lux = shaded(*technique, gpuScene, normal);
        const std::vector<vec4> places = points();
        double error = 0, sum = 0;
        const std::vector<vec3> expected = expectedLux(volumes, scene, settings, places, normal);
        for (std::size_t i = 0; i < places.size(); ++i) {
          error += double(length(vec3(lux[i]) - expected[i]));
          sum += double(length(expected[i]));
        }
        EXPECT_GT(sum, 1000);
        // Devices may filter images with weights of 8 bits.
        EXPECT_LT(error, sum / 256) << nameOf(representation) << ' ' << nameOf(interpolation);
      }
  }
}

// What is baked holds wherever the caster is moved.
TEST_F(IrradianceVolumeGpuTest, MovesWithTheCasterWithoutBeingMadeAgain) {
  Scene scene = sceneWith(makePrism(0.5f, 1), MaterialType::dielectric);
  scene.lights.resize(1);
  const TechniqueSettings settings = quickSettings();
  Progress progress;
  Stats stats;
  GpuScene gpuScene(device(), scene);
  SceneTransport transport(scene, transportOf(settings), progress);
  const auto technique = makeTechnique({device(), settings, transport, stats});
  const std::vector<vec4> before = shaded(*technique, gpuScene, vec3(0, 1, 0));
  const auto made = stats.counts;
  // A whole number of points further along z, which the square does not slant along.
  scene.objects[0].placement.translation.z += 4.0f * 6 / kSide;
  transport.place(scene);
  const std::vector<vec4> after = shaded(*technique, gpuScene, vec3(0, 1, 0));
  EXPECT_EQ(stats.counts, made);
  const std::vector<vec4> places = points();
  double error = 0, sum = 0;
  for (std::size_t i = 0; i + 6 * kSide < places.size(); ++i) {
    if (places[i].w == 0 || places[i + 6 * kSide].w == 0) continue;
    error += double(length(before[i] - after[i + 6 * kSide]));
    sum += double(length(before[i]));
  }
  EXPECT_GT(sum, 100);
  EXPECT_LT(error, 1e-3 * sum);
}

}  // namespace
}  // namespace nephroid

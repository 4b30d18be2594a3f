// Glass in the water, lit by the water's beams.
#include "gpu_fixture.h"
#include "reference/sensor.h"
#include "render/technique_meter.h"
#include "scene/shapes.h"
#include "sensor_blocks.h"

namespace nephroid {
namespace {

constexpr uint32_t kPasses = 16;

// A ball under waves, in slanting sunlight.
Scene ballInWaves() {
  Scene scene;
  Water water;
  water.size = {2, 2};
  water.grid = {80, 80};
  water.waves = {{.amplitude = 0.006f, .wavelength = 0.55f, .direction = {1, 0.3f}},
                 {.amplitude = 0.004f, .wavelength = 0.43f, .direction = {-0.4f, 1}, .phase = 1.3f}};
  Material ofWater = glass();
  ofWater.ior = vec3(1.33f);
  add(scene, makeWater(water, 0), ofWater);
  scene.objects.back().water = water;
  add(scene, makeSphere(0.25f, {.segments = 64}), glass(), {0, -0.5f, 0});
  add(scene, makePlane({4, 4}), diffuse(0.6f), {0, -1, 0});
  scene.lights = {sun({0.2f, -1, -0.15f})};
  return scene;
}

class GlassInWaterGpuTest : public GpuTest {};

TEST_F(GlassInWaterGpuTest, FocusesWhatTheWavesLetThrough) {
  const Scene scene = ballInWaves();
  const Sensor sensor = floorSensor({0.14f, -1, -0.1f}, 0.35f, kBlocks * kTexelsOfBlock);
  TechniqueSettings settings;
  settings.technique = "light-volumes";
  settings.source = Source::traced;
  settings.paths = Paths::transmission;
  Progress progress;
  Stats stats;
  const SensorLayer drawn = TechniqueMeter(device(), scene, sensor, settings, progress, stats).read();
  const RayScene rays(scene);
  ReferenceSettings ofReference;
  ofReference.paths = Paths::transmission;
  ofReference.photons = 1 << 17;
  ReferenceSensor meter(scene, rays, sensor, ofReference);
  const auto means = blockMeans(meter, {"caustics.G"}, kPasses, kTexelsOfBlock);
  expectMean(blocksOf(drawn, 1), means[0], "caustics");
}

}  // namespace
}  // namespace nephroid

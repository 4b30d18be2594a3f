// Techniques against the reference where light goes on, parts, or scatters all around.
#include "geometry/shapes.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/sensor_blocks.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr uint32_t kPasses = 16;

class TechniqueAgreement : public GpuTest {
 protected:
  // On a square part of a floor.
  void expectAsReference(const Scene& scene, const Sensor& sensor, const std::string& technique,
                         Source source, double modelError = kModelError) {
    TechniqueSettings settings = settingsOf(technique, source);
    settings.transport.paths = Paths::transmission;
    const SensorLayer drawn = measuredBy(device(), scene, sensor, settings);
    const RayScene rays(scene);
    ReferenceSettings ofReference;
    ofReference.paths = Paths::transmission;
    ofReference.photons = 1 << 17;
    ReferenceSensor meter(scene, rays, sensor, ofReference);
    const auto means = blockMeans(meter, {"caustics.G"}, kPasses, kTexelsOfBlock);
    expectMean(blocksOf(drawn, 1), means[0], technique.c_str(), modelError);
  }
};

TEST_F(TechniqueAgreement, OnGlassUnderWaves) {
  Scene scene;
  Water water;
  water.size = {2, 2};
  water.grid = {80, 80};
  water.waves = {{.amplitude = 0.006f, .wavelength = 0.55f, .direction = {1, 0.3f}},
                 {.amplitude = 0.004f, .wavelength = 0.43f, .direction = {-0.4f, 1}, .phase = 1.3f}};
  add(scene, makeWater(water, 0), glass(1.33f));
  scene.objects.back().water = water;
  add(scene, makeSphere(0.25f, {.segments = 64}), glass(), {0, -0.5f, 0});
  add(scene, makePlane({4, 4}), diffuse(0.6f), {0, -1, 0});
  scene.lights = {sun({0.2f, -1, -0.15f})};
  expectAsReference(scene, floorSensor({0.14f, -1, -0.1f}, 0.35f, kBlocks * kTexelsOfBlock), "light-volumes",
                    Source::traced);
}

// Half of it flat, and lit past its edges.
TEST_F(TechniqueAgreement, OnACylinderWhateverTheSource) {
  Scene scene;
  add(scene, makePlane({8, 8}), diffuse(0.6f));
  add(scene, makeCylinder(0.2f, 0.6f, {.segments = 128}), glass(), {0, 0.3f, 0});
  scene.lights = {pointLight({0.8f, 1.6f, 0.2f})};
  const Sensor sensor = floorSensor({-0.35f, 0, -0.08f}, 0.5f, kBlocks * kTexelsOfBlock);
  expectAsReference(scene, sensor, "light-volumes", Source::table);
}

// A volume knows parallel light alone.
TEST_F(TechniqueAgreement, OnABallNearItsLamp) {
  Scene scene;
  add(scene, makePlane({8, 8}), diffuse(0.6f));
  add(scene, makeSphere(0.3f, {.segments = 64}), glass(), {0, 0.5f, 0});
  scene.lights = {pointLight({0.3f, 1.6f, 0.1f})};
  const Sensor sensor = floorSensor({-0.14f, 0, -0.05f}, 0.36f, kBlocks * kTexelsOfBlock);
  expectAsReference(scene, sensor, "irradiance-volume", Source::table, 0.1);
}

TEST_F(TechniqueAgreement, OnAMirrorThatScattersLightAllAround) {
  Scene scene;
  add(scene, makePlane({8, 8}), diffuse(0.6f));
  add(scene, makeSphere(0.4f, {.segments = 96}), mirror(), {0, 0.6f, 0});
  scene.lights = {sun({0.6f, -1, 0.2f})};
  const Sensor sensor = floorSensor({-0.2f, 0, 0}, 0.9f, kBlocks * kTexelsOfBlock);
  expectAsReference(scene, sensor, "illumination-textures", Source::traced, 0.02);
}

}  // namespace
}  // namespace nephroid

// What techniques by way of virtual planes draw, held against each other and against themselves.
#include <algorithm>
#include <cmath>

#include "support/ball_over_floor.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/quantized_source.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(320, 240);

// Past the focus where the light arrives.
Scene seenBall() {
  Scene scene = ballOverFloor(1.6f, {1, 4, 0});
  scene.camera = {.position = {-0.5f, 1.5f, 3}, .target = {-0.5f, 0, 0}, .verticalFov = 30};
  scene.environment.ambient = vec3(0.5f);
  return scene;
}

class TechniquePicturesGpuTest : public GpuTest {
 protected:
  struct Drawn {
    std::vector<float> caustics;  // nit
    ByteImage picture;
  };
  Drawn draw(const Scene& scene, const char* technique, SceneTransport::SourceMaker maker = {}) {
    Drawing drawing(device(), scene, settingsOf(technique), {.size = kSize}, std::move(maker));
    const Image layers = drawing.layers(scene);
    return {*layers.find("caustics.G"), drawing.renderer.picture()};
  }

  std::vector<float> measure(const Scene& scene, const Sensor& sensor) {
    TechniqueSettings settings = settingsOf("illumination-textures");
    settings.transport.directions = 33;
    std::vector<float> lux;
    for (const vec3& texel : measuredBy(device(), scene, sensor, settings)) lux.push_back(texel.y);
    return lux;
  }
};

struct Difference {
  double flux = 0;  // of the second over the first
  double mean = 0;  // of the differences' sizes, over the mean of the first
};

Difference differenceOf(const std::vector<float>& a, const std::vector<float>& b) {
  double sumA = 0, sumB = 0, differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sumA += double(a[i]);
    sumB += double(b[i]);
    differences += std::abs(double(b[i]) - double(a[i]));
  }
  return {sumB / sumA, differences / sumA};
}

TEST_F(TechniquePicturesGpuTest, PlanesAcrossTheLightAndAcrossTheViewShowTheSame) {
  const Scene scene = seenBall();
  const Difference difference =
      differenceOf(draw(scene, "illumination-textures").caustics, draw(scene, "sliced-images").caustics);
  EXPECT_NEAR(difference.flux, 1, 0.02);
  EXPECT_LT(difference.mean, 0.05);
}

// Iwasaki 2005, figure 12: the bits that a table keeps rays in change no pixel by a hundredth of full scale.
TEST_F(TechniquePicturesGpuTest, TheBitsOfATableChangeNoPixelByAHundredth) {
  Scene scene = seenBall();
  scene.camera.exposure = 0.1f;
  for (const char* technique : {"illumination-textures", "sliced-images"}) {
    const auto drawn = [&](bool isExact) {
      return draw(scene, technique,
                  [&](const Scene& now, const TracedSource& traced) {
                    return std::make_unique<QuantizedSource>(now, traced, isExact);
                  })
          .picture;
    };
    const ByteImage exact = drawn(true), quantized = drawn(false);
    int largest = 0;
    for (std::size_t i = 0; i < exact.bytes.size(); ++i)
      largest = std::max(largest, std::abs(int(exact.bytes[i]) - int(quantized.bytes[i])));
    EXPECT_LT(largest, 0.01 * 255) << technique;
  }
}

// The points of a line light share planes, also where they shine on the caster from ways so far apart that
// they take several sets.
TEST_F(TechniquePicturesGpuTest, ALineIsItsPointsOfEqualShare) {
  const Sensor sensor{"floor", {-3, 0, -2}, {4, 0, 0}, {0, 0, 4}, {16, 16}};
  for (const float length : {0.5f, 6.0f}) {
    Scene scene = seenBall();
    Light line = scene.lights[0];
    line.type = LightType::line;
    line.end = line.position + vec3(0, 0, length);
    line.samples = 4;
    scene.lights = {line};
    const std::vector<float> together = measure(scene, sensor);
    std::vector<float> sum(together.size(), 0);
    for (uint32_t i = 0; i < line.samples; ++i) {
      Light point = line;
      point.type = LightType::point;
      point.position = mix(line.position, line.end, (float(i) + 0.5f) / float(line.samples));
      point.intensity = line.intensity / float(line.samples);
      scene.lights = {point};
      const std::vector<float> own = measure(scene, sensor);
      for (std::size_t texel = 0; texel < sum.size(); ++texel) sum[texel] += own[texel];
    }
    const Difference difference = differenceOf(sum, together);
    EXPECT_NEAR(difference.flux, 1, 0.01) << "length " << length;
    EXPECT_LT(difference.mean, 0.05) << "length " << length;
  }
}

// A lamp within a ball of glass shines all ways, which no planes across one axis hold.
TEST_F(TechniquePicturesGpuTest, LightGoesAllWays) {
  Scene scene = ballOverFloor(0.9f, {0.1f, 1, 0.05f});
  const Sensor floor{"floor", {-1.5f, 0, -1.5f}, {3, 0, 0}, {0, 0, 3}, {32, 32}};
  const auto flux = [&](const char* technique) {
    double sum = 0;
    for (const vec3& texel : measuredBy(device(), scene, floor, settingsOf(technique)))
      sum += double(texel.y);
    return sum;
  };
  EXPECT_NEAR(flux("illumination-textures") / flux("light-volumes"), 1, 0.01);
}

}  // namespace
}  // namespace nephroid

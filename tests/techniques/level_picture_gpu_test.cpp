// The picture of the levels of landed light.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "gpu/transfer.h"
#include "support/ball_over_floor.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/stats.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(320, 240);

class LevelPictureGpuTest : public GpuTest {
 protected:
  struct Shown {
    Legend legend;
    std::vector<uint8_t> isLit;  // of each pixel
    std::vector<int> level;      // in the legend; -1 for other colors, those of borders among them
    std::vector<float> lux;      // of caustics
    std::vector<vec4> position;  // m
    std::size_t cells = 0;
  };

  static Scene scene() {
    Scene scene = ballOverFloor(0.8f, {1.5f, 3.5f, 0});
    scene.camera = {.position = {0, 3, 1.5f}, .target = {0, 0, 0}, .verticalFov = 60};
    return scene;
  }

  static const PassOutput& levelsOf(const std::vector<PassOutput>& outputs) {
    return *std::ranges::find(outputs, "levels", &PassOutput::name);
  }

  static Shown shown(const Scene& scene) {
    TechniqueSettings settings = settingsOf("adaptive-beams");
    settings.transport.paths = Paths::all;  // with the faint light that the ball reflects
    Drawing drawing(device(), scene, settings, {.size = kSize});
    drawing.renderer.render(scene);
    const std::vector<PassOutput> outputs = drawing.renderer.outputs();
    Shown shown;
    const gpu::Image* image = levelsOf(outputs).make(drawing.renderer.seenPoints(), shown.legend);
    const ByteImage picture = gpu::downloadPicture(device(), *image);
    for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
      const vec3 color = vec3(picture.bytes[i], picture.bytes[i + 1], picture.bytes[i + 2]) / 255.0f;
      const auto isThis = [&](const Legend::Entry& entry) { return distance(entry.color, color) < 0.01f; };
      const auto found = std::ranges::find_if(shown.legend.entries, isThis);
      shown.level.push_back(found == shown.legend.entries.end() ? -1
                                                                : int(found - shown.legend.entries.begin()));
      shown.isLit.push_back(std::max({color.x, color.y, color.z}) - std::min({color.x, color.y, color.z}) >
                            0.05f);
    }
    const SeenImages& seen = drawing.renderer.images().seen[kSeen];
    shown.position = gpu::download<vec4>(device(), seen.position);
    for (const vec4& lux : gpu::download<vec4>(device(), seen.causticsLux)) shown.lux.push_back(lux.y);
    shown.cells = countIn(drawing.stats, "light_cells");
    return shown;
  }
};

// Of the pixels that `isMeant` is true of.
template <class IsMeant>
double meanLevel(const std::vector<int>& level, const IsMeant& isMeant) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < level.size(); ++i) {
    if (level[i] < 0 || !isMeant(i)) continue;
    sum += level[i];
    ++count;
  }
  EXPECT_GT(count, 20);
  return sum / count;
}

TEST_F(LevelPictureGpuTest, ShowsFinerCellsWhereLightIsFocused) {
  const Shown seen = shown(scene());
  ASSERT_GE(seen.legend.entries.size(), 4u);
  std::vector<float> sorted = seen.lux;
  std::ranges::sort(sorted);
  const float focused = sorted[sorted.size() * 99 / 100];
  const double fine = meanLevel(seen.level, [&](std::size_t i) { return seen.lux[i] >= focused; });
  const double coarse = meanLevel(seen.level, [&](std::size_t i) { return seen.position[i].x > 2; });
  EXPECT_EQ(fine, double(seen.legend.entries.size() - 1));
  EXPECT_GT(fine, coarse + 0.8);
}

TEST_F(LevelPictureGpuTest, HasAColorWhereverThereIsLight) {
  const Shown seen = shown(scene());
  for (std::size_t i = 0; i < seen.lux.size(); ++i)
    if (seen.lux[i] > 0) {
      EXPECT_TRUE(seen.isLit[i]) << i;
    }
}

// From coarse to fine, each with texels half as large.
TEST_F(LevelPictureGpuTest, ItsLegendTellsTexelsAndCells) {
  const Shown seen = shown(scene());
  std::size_t cells = 0;
  for (std::size_t i = 0; i < seen.legend.entries.size(); ++i) {
    const Legend::Entry& entry = seen.legend.entries[i];
    cells += entry.count;
    EXPECT_NE(entry.meaning.find(" mm"), std::string::npos);
    if (i > 0) {
      EXPECT_NEAR(2 * std::stod(entry.meaning), std::stod(seen.legend.entries[i - 1].meaning),
                  0.02 * std::stod(entry.meaning));
    }
  }
  EXPECT_GT(cells, seen.cells / 8);
  EXPECT_LT(cells, seen.cells);
}

TEST_F(LevelPictureGpuTest, IsGrayWithoutLight) {
  Scene dark = scene();
  dark.lights[0].position = {1.5f, -3.5f, 0};  // below the floor
  const Shown seen = shown(dark);
  EXPECT_TRUE(seen.legend.entries.empty());
  EXPECT_EQ(std::ranges::count(seen.isLit, 1), 0);
}

TEST_F(LevelPictureGpuTest, TakesNothingUntilItIsShown) {
  const Scene ball = scene();
  Drawing drawing(device(), ball, settingsOf("adaptive-beams"), {.size = kSize});
  drawing.renderer.render(ball);
  const uint64_t before = device().memoryBytes();
  const std::vector<PassOutput> outputs = drawing.renderer.outputs();
  EXPECT_EQ(levelsOf(outputs).image, nullptr);
  drawing.renderer.render(ball);
  EXPECT_EQ(device().memoryBytes(), before);
  Legend legend;
  levelsOf(outputs).make(drawing.renderer.seenPoints(), legend);
  EXPECT_GE(device().memoryBytes(), before + uint64_t{4} * kSize.x * kSize.y);
}

}  // namespace
}  // namespace nephroid

#include <cmath>
#include <numeric>
#include <optional>

#include "beams/deposit.h"
#include "core/random.h"
#include "gpu/command_list.h"
#include "gpu/transfer.h"
#include "shaders/techniques/planes/deposit_comp.h"
#include "support/gpu_fixture.h"
#include "support/test_meshes.h"
#include "techniques/planes/settings.h"
#include "techniques/planes/shader_data.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

constexpr uint32_t kSize = 64;
constexpr uint32_t kPlanes = 3;
constexpr float kFocus = 0.5f;  // m along axisW, where beamsThroughFocus meet
constexpr double kFluxTolerance = 1e-5;

// Planes at depths 0, 0.5 and 1 below a square meter, the outer window three times as wide. The flux is
// theirs in all. What falls inside the inner window is for the outer one to leave out: when that is `asked`,
// the inner one stands aside.
PlaneSet planesFor(const std::vector<Beam>& beams, uint32_t asked = 0) {
  PlaneSet set{};
  set.axisU = vec3(1, 0, 0);
  set.axisV = vec3(0, 0, 1);
  set.axisW = vec3(0, -1, 0);
  set.depthStep = 0.5f;
  set.planes = kPlanes;
  set.windows[0] = {vec2(asked == 0 ? -0.5f : 9.0f), float(kSize), float(kSize)};
  set.windows[1] = {vec2(-1.5f), float(kSize) / 3, float(kSize)};
  vec3 flux(0);
  for (const Beam& beam : beams) flux += beam.flux;
  set.luxMetersSquaredPerUnit = flux / kUnitsOfAllFlux;
  set.nearestDepth = -1;
  set.farthestDepth = 2;
  return set;
}

// From a meter above the first plane through these places on it, toward `target` from each or straight on.
Beam beamThrough(vec2 a, vec2 b, vec2 c, std::optional<vec3> target = std::nullopt) {
  Beam beam{};
  const vec2 places[] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const vec3 place(places[i].x, 0, places[i].y);
    beam.direction[i] = target ? normalize(*target - place) : vec3(0, -1, 0);
    beam.position[i] = place - beam.direction[i];
  }
  beam.flux = vec3(1);
  beam.reach = vec3(kUnboundedReach);
  return beam;
}

// Beams of a millimeter to a third of a meter, none of them thin, all of whose light falls inside the inner
// window.
std::vector<Beam> someBeams(uint32_t count, std::optional<vec3> target = std::nullopt) {
  Random random(3);
  std::vector<Beam> beams;
  for (uint32_t i = 0; i < count; ++i) {
    const float size = 0.1f * std::pow(10.0f, -2 * random.uniform());
    const vec2 center = 0.7f * (vec2(random.uniform(), random.uniform()) - 0.5f);
    const float turn = 6.28f * random.uniform();
    const auto corner = [&](float angle) {
      return center + size * vec2(std::cos(turn + angle), std::sin(turn + angle));
    };
    beams.push_back(beamThrough(corner(0), corner(2.1f), corner(4), target));
    beams.back().flux = vec3(1, 2, 0.5f) * (0.1f + random.uniform());
  }
  return beams;
}

class IlluminationTexturesGpuTest : public GpuTest {
 protected:
  // Units of flux by layer, as textureIndex numbers them, and texel. Flat planes, or bent onto a surface
  // across the light at `receiverDepth` (m along axisW).
  using Textures = std::vector<std::vector<uint32_t>>;
  Textures deposit(const std::vector<Beam>& beams, const PlaneSet& set, uint32_t channels = 1,
                   std::optional<float> receiverDepth = std::nullopt) {
    const gpu::Program program = gpu::createComputeProgram(
        device(), "deposit", shaders::techniques_planes_deposit_comp,
        {{"kChannels", channels}, {"kFollowsReceivers", receiverDepth.has_value()}});
    const auto image = [&](const char* name, VkFormat format, uint32_t layers) {
      return gpu::createImage(device(), name,
                              {.format = format, .width = kSize, .height = kSize, .layers = layers});
    };
    const gpu::Image depths = image("depths", VK_FORMAT_D32_SFLOAT, kWindows);
    const gpu::Image normals = image("normals", VK_FORMAT_R32_UINT, kWindows);
    const uint32_t layers = layersOfChannel(set) * channels;
    const gpu::Image textures = image("textures", VK_FORMAT_R32_UINT, layers);
    const float depth =
        (receiverDepth.value_or(0) - set.nearestDepth) / (set.farthestDepth - set.nearestDepth);
    const gpu::Buffer from = gpu::upload(device(), "beams", beams);
    const auto count = uint32_t(beams.size());
    device().submitAndWait([&](gpu::CommandList& commands) {
      commands.clear(textures, vec4(0));
      commands.clear(normals, vec4(0));
      for (uint32_t window = 0; window < kWindows; ++window)
        commands.render({.colors = {}, .depth = gpu::DepthAttachment{&depths, window, depth}}, [] {});
      commands.barrier();
      commands.dispatch(program, {count, 1, 1}, DepositConstants{set, from.address(), count, float(kSize)},
                        {{"seenDepths", depths}, {"seenNormals", normals}, {"textures", textures}});
    });
    Textures units;
    for (uint32_t layer = 0; layer < layers; ++layer)
      units.push_back(gpu::download<uint32_t>(device(), textures, layer));
    return units;
  }

  // Part of all flux that a plane's texture holds and its coarse part, where there is one channel.
  static double fluxOn(const Textures& units, const PlaneSet& set, uint32_t plane, uint32_t window) {
    const uint32_t index = textureIndex(set, plane, window);
    const std::vector<uint32_t>& coarse = units[coarseLayer(set, index)];
    const uvec2 tile = uvec2(coarseTile(index)) * (kSize / kCoarseness);
    double sum = std::accumulate(units[index].begin(), units[index].end(), 0.0);
    for (uint32_t y = tile.y; y < tile.y + kSize / kCoarseness; ++y)
      for (uint32_t x = tile.x; x < tile.x + kSize / kCoarseness; ++x) sum += coarse[y * kSize + x];
    return sum / double(kUnitsOfAllFlux);
  }
};

TEST_F(IlluminationTexturesGpuTest, HoldWhatTheHostDeposits) {
  const std::vector<Beam> beams = someBeams(300, vec3(0.1f, -3, 0));
  for (const uint32_t channels : {1u, 3u})
    for (uint32_t window = 0; window < kWindows; ++window) {
      const PlaneSet set = planesFor(beams, window);
      const Textures units = deposit(beams, set, channels);
      for (uint32_t plane = 0; plane < kPlanes; ++plane) {
        const auto expected = depositFlux(beams, planeGrid(set, plane, window), {kSize, kSize});
        for (uint32_t texel = 0; texel < kSize * kSize; ++texel)
          for (uint32_t c = 0; c < channels; ++c) {
            const double wanted = expected[texel][int(c)] / double(set.luxMetersSquaredPerUnit[int(c)]);
            // Half a unit for each beam that may meet the texel, and what float leaves of the corners'
            // digits.
            ASSERT_NEAR(units[textureIndex(set, plane, window) + c * layersOfChannel(set)][texel], wanted,
                        0.5 * double(beams.size()) + 1e-3 * wanted + 1e-6 * double(kUnitsOfAllFlux))
                << "window " << window << ", plane " << plane << ", texel " << texel;
          }
      }
    }
}

TEST_F(IlluminationTexturesGpuTest, HoldAllFluxBeforeAtAndPastAFocus) {
  const std::vector<Beam> beams = someBeams(1000, vec3(0.011f, -kFocus, 0.007f));
  for (uint32_t window = 0; window < kWindows; ++window) {
    const PlaneSet set = planesFor(beams, window);
    const Textures units = deposit(beams, set);
    for (uint32_t plane = 0; plane < kPlanes; ++plane)
      EXPECT_NEAR(fluxOn(units, set, plane, window), 1, kFluxTolerance)
          << "window " << window << ", plane " << plane;
  }
}

TEST_F(IlluminationTexturesGpuTest, LeaveOutOfTheOuterWindowWhatTheInnerOneHolds) {
  const std::vector<Beam> beams = {beamThrough({-0.1f, -0.1f}, {0.1f, -0.1f}, {-0.1f, 0.1f}),
                                   beamThrough({0.4f, -0.1f}, {0.8f, -0.1f}, {0.4f, 0.1f})};
  const PlaneSet set = planesFor(beams);
  const Textures units = deposit(beams, set);
  EXPECT_NEAR(fluxOn(units, set, 1, 1), 0.5, kFluxTolerance);
}

TEST_F(IlluminationTexturesGpuTest, HoldAllFluxOfDegenerateBeams) {
  const vec2 place(0.13f, -0.21f), other(0.33f, 0.17f);
  const std::vector<std::vector<Beam>> cases = {{beamThrough(place, place, place)},
                                                {beamThrough(place, other, place)},
                                                {beamThrough(place, other, 0.5f * (place + other))},
                                                {beamThrough(place, other, 0.501f * (place + other))}};
  for (const std::vector<Beam>& beams : cases) {
    const PlaneSet set = planesFor(beams);
    const Textures units = deposit(beams, set);
    for (uint32_t plane = 0; plane < kPlanes; ++plane)
      EXPECT_NEAR(fluxOn(units, set, plane, 0), 1, kFluxTolerance) << "case " << &beams - cases.data();
  }
}

TEST_F(IlluminationTexturesGpuTest, HoldTheirPartOfABeamLargerThanThem) {
  const std::vector<Beam> beams = {beamThrough({-40, -40}, {60, -40}, {-40, 60})};
  const PlaneSet set = planesFor(beams);
  const Textures units = deposit(beams, set);
  for (uint32_t window = 0; window < kWindows; ++window) {
    const double side = kSize / set.windows[window].texelsPerMeter;
    const double halfUnits = 0.5 * kSize * kSize / double(kUnitsOfAllFlux);
    EXPECT_NEAR(fluxOn(units, set, 1, window), side * side / 5000, halfUnits + 1e-4 * side * side / 5000);
  }
}

TEST_F(IlluminationTexturesGpuTest, AreTheSameBytesEachTime) {
  const std::vector<Beam> beams = someBeams(2000, vec3(0, -kFocus, 0));
  const PlaneSet set = planesFor(beams);
  EXPECT_EQ(deposit(beams, set), deposit(beams, set));
}

TEST_F(IlluminationTexturesGpuTest, HoldLightWhereItArrivesWhenTheyFollowReceivers) {
  const std::vector<Beam> beams = someBeams(300, vec3(0.1f, -3, 0));
  const float depth = 0.6f;  // nearest to the middle one of the planes
  for (uint32_t window = 0; window < kWindows; ++window) {
    PlaneSet set = planesFor(beams, window);
    const Textures units = deposit(beams, set, 1, depth);
    set.firstDepth = depth - set.depthStep;
    const auto expected = depositFlux(beams, planeGrid(set, 1, window), {kSize, kSize});
    for (uint32_t texel = 0; texel < kSize * kSize; ++texel) {
      const double wanted = expected[texel].x / double(set.luxMetersSquaredPerUnit.x);
      ASSERT_NEAR(units[textureIndex(set, 1, window)][texel], wanted,
                  0.5 * double(beams.size()) + 1e-3 * wanted + 1e-6 * double(kUnitsOfAllFlux))
          << "window " << window << ", texel " << texel;
    }
    EXPECT_EQ(fluxOn(units, set, 0, window), 0);
    EXPECT_EQ(fluxOn(units, set, 2, window), 0);
  }
}

Scene glassBoxAboveFloor() {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].type = MaterialType::dielectric;
  scene.meshes = {plane(2), box(vec3(0.3f))};
  scene.objects.resize(2);
  scene.objects[1].mesh = 1;
  scene.objects[1].material = 1;
  scene.objects[1].placement.translation = vec3(0, 0.8f, 0);
  scene.lights.resize(1);
  scene.lights[0].type = LightType::point;
  scene.lights[0].position = vec3(0.2f, 3, 0.1f);
  scene.lights[0].intensity = vec3(10);
  return scene;
}

// What lights the floor, point by point, is asked for before and after the camera moves, and in a part of it.
TEST_F(IlluminationTexturesGpuTest, DependNeitherOnTheCameraNorOnThePartAskedFor) {
  Scene scene = glassBoxAboveFloor();
  GpuScene gpuScene(device(), scene);
  TechniqueSettings settings;
  settings.technique = "illumination-textures";
  settings.own.of<PlaneSettings>().textureSize = 128;
  Progress progress;
  Stats stats;
  SceneTransport transport(scene, transportOf(settings), progress);
  const std::unique_ptr<Technique> technique = makeTechnique({device(), settings, transport, stats});
  const auto image = [&](const char* name) {
    return gpu::createImage(device(), name, {.width = kSize, .height = kSize});
  };
  const gpu::Image positions = image("positions"), normals = image("normals"), caustics = image("caustics");
  std::vector<vec4> points;
  for (uint32_t i = 0; i < kSize * kSize; ++i)
    points.emplace_back((float(i % kSize) + 0.5f) / kSize - 0.5f, 0, (float(i / kSize) + 0.5f) / kSize - 0.5f,
                        1);
  const auto send = [&](const gpu::Image& to, const std::vector<vec4>& texels) {
    const auto bytes = std::as_bytes(std::span(texels));
    gpu::uploadImage(device(), to, {{bytes.begin(), bytes.end()}});
  };
  send(positions, points);
  send(normals, std::vector<vec4>(points.size(), vec4(0, 1, 0, 0)));

  const auto lit = [&](const std::optional<gpu::Region>& region = {}) {
    transport.place(scene);
    technique->update(gpuScene);
    device().submitAndWait([&](gpu::CommandList& commands) {
      technique->record(commands, gpuScene);
      commands.pass("clear", [&] { commands.clear(caustics, vec4(0)); });
      technique->shade(commands, {&positions, &normals, region}, caustics);
    });
    return gpu::download<vec4>(device(), caustics);
  };
  std::vector<vec4> before = lit();
  scene.camera.position = vec3(-3, 2, 1);
  EXPECT_EQ(lit(), before);
  EXPECT_GT(std::accumulate(before.begin(), before.end(), vec4(0)).y, 0);
  for (uint32_t i = 0; i < kSize * kSize; ++i)
    if (i % kSize < kSize / 2 || i / kSize >= kSize / 4) before[i] = vec4(0);
  EXPECT_EQ(lit(gpu::Region{{kSize / 2, 0}, {kSize / 2, kSize / 4}}), before);
  EXPECT_GT(std::accumulate(before.begin(), before.end(), vec4(0)).y, 0);
}

}  // namespace
}  // namespace nephroid

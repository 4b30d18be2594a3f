#include "beams/light_layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "transport/outgoing_ray.h"

namespace nephroid {
namespace {

constexpr LayerSettings kSettings{.layers = 9, .texels = 40, .farthest = 2, .relief = 0};

// Half a square meter of light of 3 lm, as (1, 2, 0) on the mean of its channels.
Beam halfSquare(vec3 direction, float reach) {
  Beam beam{};
  const vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) {
    beam.position[i] = corners[i];
    beam.direction[i] = normalize(direction);
    beam.reach[i] = reach;
  }
  beam.flux = {3, 6, 0};
  return beam;
}

glm::dvec4 sumOfLayer(const LightLayers& light, uint32_t layer) {
  const auto texels = std::size_t(light.grid.size.x * light.grid.size.y);
  glm::dvec4 sum(0);
  for (std::size_t i = 0; i < texels; ++i) sum += glm::dvec4(light.texels[layer * texels + i]);
  return sum / double(light.grid.texelsPerMeter * light.grid.texelsPerMeter);
}

TEST(LightLayers, HaveAllTheFluxOfSlantedLightOnEachWithItsSlopeAndItsWay) {
  const std::vector<Beam> beams{halfSquare({0.5f, -1, -0.25f}, kUnboundedReach)};
  const LightLayers light = lightInLayers(beams, {0, -1, 0}, kSettings);
  const LayerGrid& grid = light.grid;
  EXPECT_NEAR(glm::distance(light.color, vec3(1, 2, 0)), 0, 1e-5f);
  const double perDepth = std::sqrt(1 + 0.25 + 0.0625);
  EXPECT_NEAR((grid.layers - 1) / grid.layersPerMeter, 2 / perDepth, 1e-5);
  for (uint32_t layer = 0; layer < 9; ++layer) {
    const glm::dvec4 sum = sumOfLayer(light, layer);
    EXPECT_NEAR(sum.x, 3 * perDepth, 1e-4) << layer;
    const vec3 along = grid.axisW + float(sum.y / sum.x) * grid.axisU + float(sum.z / sum.x) * grid.axisV;
    EXPECT_NEAR(glm::distance(normalize(along), normalize(vec3(0.5f, -1, -0.25f))), 0, 1e-5f) << layer;
    EXPECT_NEAR(sum.w / sum.x, layer / 8.0 * 2, 1e-4) << layer;
  }
  // What goes on with the light stays on its texel.
  const vec3 at(0.3f, 0, 0.3f), later = at + 0.6f * vec3(0.5f, -1, -0.25f);
  EXPECT_NEAR(glm::distance(vec2(placeInLayers(grid, at)), vec2(placeInLayers(grid, later))), 0, 1e-3f);
  EXPECT_NEAR(placeInLayers(grid, later).z, 0.6f * grid.layersPerMeter, 1e-3f);
}

TEST(LightLayers, KeepTheFluxOfLightThatComesToAFocusAndGoesOn) {
  Beam beam = halfSquare({0, -1, 0}, kUnboundedReach);
  for (int i = 0; i < 3; ++i) {
    const vec3 toFocus = vec3(0.3f, -1, 0.3f) - beam.position[i];
    beam.direction[i] = normalize(toFocus);
    beam.reach[i] = 1.5f * length(toFocus);
  }
  const LightLayers light = lightInLayers(std::vector{beam}, {0, -1, 0}, kSettings);
  const double first = sumOfLayer(light, 0).x;
  for (uint32_t layer = 1; layer < 9; ++layer) EXPECT_NEAR(sumOfLayer(light, layer).x, first, 1e-4) << layer;
}

TEST(LightLayers, EndALayerBehindWhatLightMeets) {
  // The deeper one makes the grid two meters deep: a layer each quarter.
  const std::vector<Beam> beams{halfSquare({0, -1, 0}, kUnboundedReach), halfSquare({0, -1, 0}, 0.6f)};
  const LightLayers light = lightInLayers(beams, {0, -1, 0}, kSettings);
  for (uint32_t layer = 0; layer < 9; ++layer)
    EXPECT_NEAR(sumOfLayer(light, layer).x, layer <= 3 ? 6 : 3, 1e-4) << layer;
}

TEST(LightLayers, BeginAsFarBeforeABeamAsTheSurfaceIsRough) {
  Beam low = halfSquare({0, -1, 0}, kUnboundedReach);
  for (vec3& position : low.position) position.y -= 1;
  const std::vector<Beam> beams{halfSquare({0, -1, 0}, kUnboundedReach), low};
  for (const float relief : {0.0f, 1.0f}) {
    LayerSettings settings = kSettings;
    settings.relief = relief;
    const LightLayers light = lightInLayers(beams, {0, -1, 0}, settings);  // 3 m deep
    for (uint32_t layer = 0; layer < 5; ++layer)
      EXPECT_NEAR(sumOfLayer(light, layer).x, layer >= (relief > 0 ? 0 : 2) ? 6 : 3, 1e-4) << layer;
  }
}

TEST(LightLayers, LeaveOutWhatGoesAside) {
  EXPECT_TRUE(lightInLayers(std::vector{halfSquare({1, -0.1f, 0}, 1)}, {0, -1, 0}, kSettings).texels.empty());
  EXPECT_TRUE(lightInLayers({}, {0, -1, 0}, kSettings).texels.empty());
}

}  // namespace
}  // namespace nephroid

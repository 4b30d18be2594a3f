#include "scene/load.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "shared_data.h"

namespace nephroid {
namespace {

TEST(Scene, LoadsWhatTheIndependentAnswersAreFor) {
  const auto truth = sharedData() / "truth";
  if (!std::filesystem::exists(truth)) GTEST_SKIP() << "no " << truth;
  for (const auto& entry : std::filesystem::directory_iterator(truth)) {
    if (entry.path().extension() != ".toml") continue;
    if (entry.path().stem() == "bunny-point" &&
        !std::filesystem::exists("/usr/share/glmark2/models/bunny.obj"))
      continue;
    const Scene scene = loadScene(entry.path());
    EXPECT_EQ(scene.objects.size(), 2u) << entry.path();
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.sensors.size(), 1u);
    for (const Object& object : scene.objects) {
      EXPECT_EQ(scene.meshOf(object).isClosed, scene.isCaster(object) && !object.water) << entry.path();
    }
  }
}

}  // namespace
}  // namespace nephroid

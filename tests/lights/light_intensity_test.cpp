// Gobos, profiles and cones of spotlights, as a scene file gives them.
#include "lights/light_intensity.h"

#include <cmath>

#include "core/image_io.h"
#include "formats/load.h"
#include "lights/emitters.h"
#include "report/diagnose.h"
#include "support/scratch_files.h"
#include "support/shared_data.h"

namespace nephroid {
namespace {

const vec3 kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kWhite(1);

// Upper left, upper right, lower left, lower right.
const std::vector<uint8_t> kQuarters{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

const std::string kDown =
    "[[light]]\nname = \"lamp\"\ntype = \"spot\"\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\n";

const std::string kProfile =
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 4 1 2 0 0 0\n1 1 5\n0 90 180\n0 90 180 270\n"
    "40 30 20  40 10 20  40 20 20  40 20 20\n";

class SpotLight : public ScratchFiles {
 protected:
  Scene load(const std::string& toml) const { return loadScene(write("scene.toml", toml)); }
  std::string errorOf(const std::string& toml) const {
    return inputErrorOf([&] { load(toml); });
  }
  void writeQuarters() const { writePng(folder() / "gobo.png", {2, 2, 3, kQuarters}); }
};

void expectColor(vec3 actual, vec3 expected, double tolerance = 1e-5) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(actual[k], expected[k], tolerance) << "channel " << k;
}

// Where a point of the image, x and y in -1 to 1 with y up, is thrown.
vec3 thrown(const Light& light, float x, float y) {
  const LightFrame frame = lightFrame(light.direction);
  const float tangent = std::tan(glm::radians(light.outerAngle));
  return normalize(frame.forward + tangent * (x * frame.right + y * frame.up));
}

TEST(LightFrame, IsAViewersWhoLooksAlongTheLight) {
  const LightFrame level = lightFrame({0, 0, -1});
  expectColor(level.right, {1, 0, 0});
  expectColor(level.up, {0, 1, 0});
  const LightFrame down = lightFrame({0, -1, 0}), up = lightFrame({0, 1, 0});
  expectColor(down.right, {1, 0, 0});
  expectColor(down.up, {0, 0, -1});
  expectColor(up.right, {1, 0, 0});
  expectColor(up.up, {0, 0, 1});
}

TEST(LightFrame, IsOrthonormalAndContinuousOffTheVertical) {
  for (float azimuth = 0; azimuth < 6.3f; azimuth += 0.1f) {
    for (float height = -1.57f; height < 1.57f; height += 0.02f) {
      const auto at = [&](float around) {
        return lightFrame(
            {std::cos(height) * std::cos(around), std::sin(height), std::cos(height) * std::sin(around)});
      };
      const LightFrame frame = at(azimuth);
      EXPECT_NEAR(dot(frame.right, frame.up), 0, 1e-5);
      EXPECT_NEAR(dot(frame.up, frame.forward), 0, 1e-5);
      expectColor(cross(frame.forward, frame.up), frame.right);
      EXPECT_NEAR(frame.right.y, 0, 1e-5);
      EXPECT_GE(frame.up.y, 0);
      EXPECT_LT(length(frame.up - at(azimuth + 1e-3f).up), 2e-3f);
    }
  }
}

TEST_F(SpotLight, AGoboStandsUprightForWhoLooksAlongTheLight) {
  writeQuarters();
  for (const char* direction : {"[0, -1, 0]", "[0, 1, 0]", "[0, 0, -1]", "[0.3, -0.2, 0.9]"}) {
    const Scene scene = load(
        "[[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\nintensity = 1\ngobo = \"gobo.png\"\n"
        "inner_angle = 30\nouter_angle = 30\ndirection = " +
        std::string(direction) + "\n");
    const Light& light = scene.lights[0];
    const auto at = [&](float x, float y) { return lightIntensity(scene, light, thrown(light, x, y)); };
    expectColor(at(-0.6f, 0.6f), kRed);
    expectColor(at(0.6f, 0.6f), kGreen);
    expectColor(at(-0.6f, -0.6f), kBlue);
    expectColor(at(0.6f, -0.6f), kWhite);
    // Bilinear: between the centers of the texels at -0.5 and 0.5 the middle is the mean of all four.
    expectColor(at(0, 0), 0.25f * (kRed + kGreen + kBlue + kWhite), 1e-4);
    expectColor(at(0.25f, 0.6f), 0.25f * kRed + 0.75f * kGreen, 1e-4);
  }
}

TEST_F(SpotLight, TheConeMasksTheCornersOfAGobo) {
  writeQuarters();
  const Scene scene =
      load(kDown + "intensity = 5\ngobo = \"gobo.png\"\nouter_angle = 40\ninner_angle = 39\n");
  const Light& light = scene.lights[0];
  expectColor(lightIntensity(scene, light, thrown(light, -0.6f, 0.6f)), 5.0f * kRed, 1e-4);
  expectColor(lightIntensity(scene, light, thrown(light, -0.72f, 0.72f)), vec3(0));
  expectColor(lightIntensity(scene, light, thrown(light, 0.9f, -0.9f)), vec3(0));
  expectColor(lightIntensity(scene, light, {0, 1, 0}), vec3(0));
}

TEST_F(SpotLight, TheShorterSideOfAGoboFillsTheCone) {
  writePng(folder() / "wide.png", {4, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255,  //
                                             255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}});
  const Scene scene =
      load(kDown + "intensity = 1\ngobo = \"wide.png\"\nouter_angle = 40\ninner_angle = 40\n");
  const Light& light = scene.lights[0];
  expectColor(lightIntensity(scene, light, thrown(light, -0.5f, 0.2f)), kGreen, 1e-4);
  expectColor(lightIntensity(scene, light, thrown(light, 0.5f, -0.2f)), kBlue, 1e-4);
}

TEST_F(SpotLight, AGobosTexelsAreLinearAndWhatIsNotCoveredIsDark) {
  writePng(folder() / "gray.png", {2, 1, 4, {188, 188, 188, 255, 255, 255, 255, 0}});
  const Scene scene = load(kDown + "intensity = 1\ngobo = \"gray.png\"\n");
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_NEAR(scene.textures[0].texels[0].x, 0.5, 0.005);  // sRGB 188 is half the light
  EXPECT_EQ(vec3(scene.textures[0].texels[1]), vec3(0));
}

TEST_F(SpotLight, LightsOfOneFileShareIt) {
  writeQuarters();
  write("lamp.ies", kProfile);
  std::string second = kDown;
  second.replace(second.find("lamp"), 4, "next");
  const std::string shape = "gobo = \"gobo.png\"\nies = \"lamp.ies\"\n";
  const Scene scene = load(kDown + shape + second + shape);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.profiles.size(), 1u);
  EXPECT_EQ(scene.lights[1].goboTexture, 0u);
  EXPECT_EQ(scene.lights[1].profile, 0u);
}

TEST_F(SpotLight, AProfileAloneGivesItsOwnCandelaAllAround) {
  write("lamp.ies", kProfile);
  const Scene scene = load(kDown + "ies = \"lamp.ies\"\n");
  const Light& light = scene.lights[0];
  const auto at = [&](vec3 direction) { return lightIntensity(scene, light, direction); };
  expectColor(at({0, -1, 0}), vec3(40), 1e-4);
  expectColor(at({0, 1, 0}), vec3(20), 1e-4);
  expectColor(at({0, 0, -1}), vec3(30), 1e-4);  // horizontal 0 is up, which is -z for a light straight down
  expectColor(at({-1, 0, 0}), vec3(10), 1e-4);  // 90 to the left
  expectColor(at({0, 0, 1}), vec3(20), 1e-4);
  expectColor(at({1, 0, 0}), vec3(20), 1e-4);
  expectColor(peakIntensity(light), vec3(40), 1e-4);
}

TEST_F(SpotLight, AnIntensityIsTheProfilesPeakAndAnAngleCutsIt) {
  write("lamp.ies", kProfile);
  const Scene scene =
      load(kDown + "ies = \"lamp.ies\"\nintensity = [4, 8, 0]\nouter_angle = 60\ninner_angle = 50\n");
  const Light& light = scene.lights[0];
  expectColor(lightIntensity(scene, light, {0, -1, 0}), {4, 8, 0});
  const vec3 at45 = lightIntensity(scene, light, normalize(vec3(0, -1, -1)));
  expectColor(at45, vec3(4, 8, 0) * (35.0f / 40.0f), 1e-4);
  expectColor(lightIntensity(scene, light, {0, 0, -1}), vec3(0));
}

TEST_F(SpotLight, WithoutShapesIsWhatTheEmittersGive) {
  const Scene scene = load(kDown + "intensity = [1, 2, 3]\nouter_angle = 50\ninner_angle = 10\n");
  const Emitter emitter = emittersOf(scene.lights[0]).front();
  for (float angle = 0; angle < 3.1f; angle += 0.05f) {
    const vec3 direction(std::sin(angle), -std::cos(angle), 0);
    expectColor(lightIntensity(scene, scene.lights[0], direction), emitterPower(emitter, direction));
  }
}

TEST_F(SpotLight, WrongShapesAreToldInOneLine) {
  writeQuarters();
  write("lamp.ies", kProfile);
  write("text.png", "not a picture");
  write("text.ies", "not a profile");
  const struct {
    std::string toml, says;
  } kWrong[] = {
      {"intensity = 1\ngobo = \"none.png\"\n", "scene.toml:7"},
      {"intensity = 1\ngobo = \"text.png\"\n", "text.png"},
      {"intensity = 1\ngobo = \".\"\n", "PNG"},
      {"ies = \"none.ies\"\n", "not there"},
      {"ies = \"text.ies\"\n", "text.ies:1"},
      {"ies = \".\"\n", "not a regular file"},
      {"gobo = \"gobo.png\"\n", "intensity"},
      {"intensity = 1\ngobo = \"gobo.png\"\nouter_angle = 90\n", "outer_angle"},
  };
  for (const auto& [toml, says] : kWrong) {
    const std::string error = errorOf(kDown + toml);
    EXPECT_NE(error.find(says), std::string::npos) << toml << "\ngave: " << error << "\nwithout: " << says;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST_F(SpotLight, IsDescribed) {
  writeQuarters();
  write("lamp.ies", kProfile);
  const Scene scene = load(kDown + "gobo = \"gobo.png\"\nies = \"lamp.ies\"\n");
  const std::string text = describe(scene, diagnose(scene));
  for (const char* part : {"gobo.png (2 x 2)", "lamp.ies (type C, 3 vertical x 5 horizontal", "40 cd"})
    EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks " << part;
}

TEST(SpotLightData, GobosOfStageLightsLoad) {
  const auto folder = sharedData() / "data" / "stage" / "gobos";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const auto file =
      std::filesystem::temp_directory_path() / ("nephroid-gobos-" + std::to_string(getpid()) + ".toml");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".png") continue;
    std::ofstream(file) << kDown << "intensity = 1\ngobo = '"
                        << std::filesystem::absolute(entry.path()).string() << "'\n";
    const Scene scene = loadScene(file);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].width, 512u);
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace nephroid

#include "report/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "geometry/shapes.h"
#include "report/report_folder.h"
#include "report/report_json.h"
#include "report/seen_directly.h"
#include "support/example_comparison.h"
#include "support/temporary_folder.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr ToneMapping kToneMapping{1, kToneNeutral};

const LayerErrors& layerNamed(const Errors& errors, const std::string& name) {
  for (const LayerResult& layer : errors.layers)
    if (layer.name == name) return layer.errors;
  throw std::out_of_range(name);
}

TEST(Comparison, TellsEachLayerOfEachTechnique) {
  const SideBySide view = exampleSide(64, 48, "");
  const std::vector<Errors> errors = errorsOf(view, kToneMapping);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(layerNamed(errors[0], "caustics").fluxRatio, 0.97, 0.002);
  EXPECT_EQ(layerNamed(errors[0], "direct").relativeRmse, 0);
  EXPECT_EQ(layerNamed(errors[1], "caustics").fluxRatio, 0);
  EXPECT_GT(errors[1].flip->mean, errors[0].flip->mean);
  EXPECT_GT(errors[0].flip->mean, 0);
  EXPECT_TRUE(layerNamed(errors[0], "caustics").noiseFloor);
}

TEST(Comparison, LooksAtWhatIsSeenDirectlyByItself) {
  SideBySide view = exampleSide(64, 48, "");
  // A technique that is wrong only behind the first pixel.
  view.techniques[0].image = view.reference.image;
  view.techniques[0].image.channel("caustics.R")[0] += 7;
  view.seesReceiver[0] = 0;
  const Errors errors = errorsOf(view, kToneMapping)[0];
  EXPECT_GT(layerNamed(errors, "caustics").relativeRmse, 0);
  EXPECT_EQ(layerNamed(errors, "caustics seen directly").relativeRmse, 0);
}

TEST(Comparison, RefusesImagesOfDifferentSizes) {
  SideBySide view = exampleSide(64, 48, "");
  view.techniques[1].image = exampleImage({48, 64});
  EXPECT_THROW(errorsOf(view, kToneMapping), InputError);
}

// A ball of radius r at a distance d hides the directions within asin(r / d); pixels that its edge crosses
// are hidden as well, and there are about eight of them for each pixel of its radius.
TEST(Comparison, KnowsWhatCastersHide) {
  Scene scene;
  scene.camera.position = {0, 0, 4};
  scene.meshes.push_back(makeSphere(1, {.vertices = 20000}));
  scene.materials.push_back({.name = "glass", .type = MaterialType::dielectric});
  scene.objects.push_back({"ball", 0, 0, {}, std::nullopt});
  const uvec2 size(200, 100);
  const std::vector<uint8_t> sees = seesReceiver(scene, RayScene(scene), size);
  const auto hidden = double(std::count(sees.begin(), sees.end(), 0));
  const double radius = std::tan(std::asin(0.25)) / (2 * std::tan(glm::radians(20.0)) / size.y);  // pixels
  const double disc = M_PI * radius * radius;
  EXPECT_GT(hidden, disc);
  EXPECT_LT(hidden, disc + 8 * radius);
  EXPECT_EQ(sees[50 * size.x + 100], 0);
  EXPECT_EQ(sees[0], 1);

  scene.materials[0].type = MaterialType::diffuse;
  for (const uint8_t seen : seesReceiver(scene, RayScene(scene), size)) EXPECT_EQ(seen, 1);
}

TEST(Report, HoldsItsNumbersAsJson) {
  const Comparison comparison = exampleComparison();
  const auto json = nlohmann::json::parse(reportJson(comparison, errorsOf(comparison), {"index.html"}));
  EXPECT_EQ(json["scene"], comparison.scene);
  EXPECT_EQ(json["view"]["reference"]["passes"], 64);
  const auto& technique = json["view"]["techniques"][0];
  EXPECT_EQ(technique["frame_ms"], 98.25);
  EXPECT_NEAR(technique["layers"]["caustics"]["flux_ratio"].get<double>(), 0.97, 0.002);
  EXPECT_GT(technique["ldr_flip"]["mean"], 0);
  const auto& sensor = json["sensors"][0];
  EXPECT_EQ(sensor["unit"], "lux");
  EXPECT_FALSE(sensor["techniques"][0].contains("ldr_flip"));
  EXPECT_GT(sensor["techniques"][0]["layers"]["caustics"]["z_score_rms"], 1);
  // Every number has its unit.
  for (const auto& layer : technique["layers"])
    for (const auto& [name, value] : layer.items()) EXPECT_TRUE(json["units"].contains(name)) << name;
}

TEST(Report, IsAFolderOfFilesThatItKnows) {
  const TemporaryFolder folder;
  const Comparison comparison = exampleComparison();
  writeReport(folder / "report", comparison);
  const auto json = nlohmann::json::parse(std::ifstream(folder / "report/report.json"));
  std::size_t found = 0;
  for (const auto& entry : fs::directory_iterator(folder / "report")) {
    const auto& files = json["files"];
    EXPECT_NE(std::find(files.begin(), files.end(), entry.path().filename().string()), files.end()) << entry;
    ++found;
  }
  EXPECT_EQ(found, json["files"].size());
  const Image image = readExr(folder / "report/sensor1-the-floor-1.reference.exr");
  EXPECT_EQ(image.width, 64u);
  EXPECT_EQ(*image.find("caustics.G"), *comparison.sensors[0].reference.image.find("caustics.G"));
  EXPECT_EQ(readPng(folder / "report/illumination-textures.png").width, 320u);
}

TEST(Report, ReplacesAReportButNothingElse) {
  const TemporaryFolder folder;
  Comparison comparison = exampleComparison();
  writeReport(folder / "report", comparison);
  comparison.sensors.clear();
  writeReport(folder / "report", comparison);
  EXPECT_FALSE(fs::exists(folder / "report/sensor1-the-floor-1.reference.exr"));
  EXPECT_EQ(folder.fileCount(), 1u);

  std::ofstream(folder / "report/mine.txt") << "mine";
  EXPECT_THROW(checkReportFolder(folder / "report"), InputError);
  EXPECT_THROW(writeReport(folder / "report", comparison), InputError);
  EXPECT_TRUE(fs::exists(folder / "report/index.html"));
  fs::create_directory(folder / "empty");
  EXPECT_NO_THROW(checkReportFolder(folder / "empty"));
  EXPECT_THROW(checkReportFolder(folder / "none/report"), RuntimeFailure);
  std::ofstream(folder / "file") << "mine";
  EXPECT_THROW(checkReportFolder(folder / "file"), RuntimeFailure);
}

}  // namespace
}  // namespace nephroid

#include "geometry/mesh_checks.h"
#include "report/diagnose.h"
#include "report/missing_light.h"
#include "scene/framing.h"
#include "support/photons.h"
#include "support/scene_file.h"
#include "support/shared_data.h"

namespace nephroid {
namespace {

TEST_F(SceneFile, ReadsEverySection) {
  const Scene scene = load(R"(
[camera]
position = [0, 1.5, 3]
target = [0, 0.4, 0]
fov = 35
exposure = 2
[environment]
ambient = 0.5
background = [0.1, 0.2, 0.3]
[[material]]
name = "glass"
type = "dielectric"
ior = [1.5, 1.51, 1.52]
attenuation_color = [0.8, 1.0, 0.9]
attenuation_distance = 0.5
scattering = 0.2
phase = "henyey-greenstein"
g = 0.7
[[material]]
name = "gold"
type = "mirror"
color = [0.9, 0.8, 0.6]
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
radius = 0.25
translation = [0, 1, 0]
rotation = [90, 0, 90]
scale = 2
[[object]]
name = "dish"
material = "gold"
shape = "plane"
[[light]]
type = "point"
position = [2, 4, 1]
intensity = [1, 2, 3]
[[light]]
type = "spot"
position = [0, 4, 0]
target = [0, 0, 0]
intensity = 100
inner_angle = 10
outer_angle = 20
[[light]]
type = "directional"
direction = [0, -2, 0]
illuminance = 1000
[[light]]
type = "line"
from = [0, 1, 0]
to = [1, 1, 0]
intensity = 10
samples = 5
[medium]
extinction = 0.05
albedo = 0.9
phase = "henyey-greenstein"
g = 0.3
[[sensor]]
name = "floor"
corner = [-2, 0, -2]
u = [4, 0, 0]
v = [0, 0, 4]
resolution = [32, 16]
)");
  EXPECT_EQ(scene.camera.position, vec3(0, 1.5f, 3));
  EXPECT_EQ(scene.camera.verticalFov, 35);
  EXPECT_EQ(scene.camera.exposure, 2);
  EXPECT_EQ(scene.camera.tone, ToneCurve::neutral);
  EXPECT_EQ(scene.environment.ambient, vec3(0.5f));
  EXPECT_EQ(scene.environment.background, vec3(0.1f, 0.2f, 0.3f));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_TRUE(scene.materials[0].isDispersive());
  EXPECT_EQ(scene.materials[0].attenuationDistance, 0.5f);
  EXPECT_EQ(scene.materials[0].scattering, vec3(0.2f));
  EXPECT_EQ(scene.materials[0].phase, PhaseType::henyeyGreenstein);
  EXPECT_EQ(scene.materials[0].g, 0.7f);
  EXPECT_EQ(scene.materials[1].type, MaterialType::mirror);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_TRUE(scene.isCaster(scene.objects[0]));
  // X first: y goes to z, which the turn about Z leaves alone; then the scale, then the translation.
  EXPECT_LT(glm::distance(scene.objects[0].placement.point({0, 1, 0}), vec3(0, 1, 2)), 1e-5f);
  EXPECT_LT(glm::distance(scene.objects[0].placement.point({1, 0, 0}), vec3(0, 3, 0)), 1e-5f);
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[0].intensity, vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[1].type, LightType::spot);
  EXPECT_EQ(scene.lights[1].direction, vec3(0, -1, 0));
  EXPECT_EQ(scene.lights[1].outerAngle, 20);
  EXPECT_EQ(scene.lights[2].direction, vec3(0, -1, 0));
  EXPECT_EQ(scene.lights[2].illuminance, vec3(1000));
  EXPECT_EQ(scene.lights[3].samples, 5u);
  ASSERT_TRUE(scene.medium);
  EXPECT_EQ(scene.medium->phase, PhaseType::henyeyGreenstein);
  ASSERT_EQ(scene.sensors.size(), 1u);
  EXPECT_EQ(scene.sensors[0].resolution, uvec2(32, 16));
  EXPECT_EQ(scene.sensors[0].normal(), vec3(0, 1, 0));
}

TEST_F(SceneFile, ReadsHowPicturesAreShown) {
  const std::string camera = "[camera]\nposition = [0, 0, 1]\n";
  EXPECT_FALSE(load(camera).camera.exposure);
  EXPECT_FALSE(load(kMaterials).camera.exposure);
  EXPECT_FALSE(load(camera + "exposure = \"auto\"\n").camera.exposure);
  EXPECT_FLOAT_EQ(*load(camera + "ev100 = 15\n").camera.exposure, float(1 / (1.2 * 32768)));
  EXPECT_EQ(load(camera + "tone = \"agx\"\n").camera.tone, ToneCurve::agx);
  expectError(camera + "exposure = \"automatic\"\n", {"scene.toml:3", "\"exposure\"", "\"auto\""});
  expectError(camera + "exposure = 0\n", {"scene.toml:3", "\"exposure\"", "1e-12"});
  expectError(camera + "exposure = [1]\n", {"scene.toml:3", "\"exposure\""});
  expectError(camera + "ev100 = 100\n", {"scene.toml:3", "\"ev100\"", "39"});
  expectError(camera + "ev100 = 3\nexposure = 1\n", {"scene.toml:3", "\"ev100\"", "\"exposure\""});
  expectError(camera + "tone = \"agxx\"\n", {"scene.toml:3", "\"tone\"", "\"agx\""});
}

TEST_F(SceneFile, LampsHaveASize) {
  const Scene scene = load(R"(
[[light]]
type = "point"
position = [2, 4, 1]
intensity = 1
radius = 0.25
[[light]]
type = "spot"
position = [0, 4, 0]
target = [0, 0, 0]
intensity = 1
radius = 0.5
[[light]]
type = "directional"
direction = [0, -2, 0]
illuminance = 1
angle = "sun"
[[light]]
type = "directional"
direction = [0, -2, 0]
illuminance = 1
angle = 12.5
)");
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[0].radius, 0.25f);
  EXPECT_EQ(scene.lights[1].radius, 0.5f);
  EXPECT_EQ(scene.lights[2].angle, 0.53f);
  EXPECT_EQ(scene.lights[3].angle, 12.5f);
  const std::string told = describe(scene, diagnose(scene));
  EXPECT_NE(told.find("a ball of radius 0.25 m"), std::string::npos);
  EXPECT_NE(told.find("a disk, seen under 12.5 degrees"), std::string::npos);
}

TEST_F(SceneFile, UnknownKeysAreNamedWithTheirLineAndTheNearest) {
  expectError("[camera]\nposition = [0, 0, 1]\nfovv = 3\n", {"scene.toml:3", "\"fovv\"", "\"fov\""});
  expectError("[camra]\n", {"scene.toml:1", "\"camra\"", "\"camera\""});
  expectError(
      kMaterials + "[[object]]\nname = \"ball\"\nmaterial = \"glass\"\nshape = \"sphere\"\nradus = 1\n",
      {"scene.toml:11", "\"radus\"", "\"radius\"", "\"ball\""});
  expectError(kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"box\"\nradius = 1\n", {"\"radius\""});
  expectError("[medium]\nextinction = 1\nphase = \"nishita\"\ng = 0.3\n", {"\"g\""});
}

TEST_F(SceneFile, NamesThatMatchNothingAreNamedWithTheNearest) {
  expectError(kMaterials + "[[object]]\nmaterial = \"glas\"\nshape = \"sphere\"\n",
              {":8", "\"glas\"", "\"glass\""});
  expectError(kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"spere\"\n",
              {":9", "\"spere\"", "\"sphere\""});
  expectError("[[material]]\nname = \"a\"\ntype = \"dielectrc\"\n", {":3", "\"dielectric\""});
  expectError("[[light]]\ntype = \"pont\"\n", {":2", "\"point\""});
  expectError("[medium]\nextinction = 1\nphase = \"henyey\"\n", {":3", "\"henyey\""});
  expectError(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"none.obj\"\n",
              {":9", "none.obj", "NEPHROID_MODELS"});
}

TEST_F(SceneFile, ValuesOutOfRangeAreRefused) {
  const auto object = [](const std::string& line) {
    return kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"sphere\"\n" + line + "\n";
  };
  const auto light = [](const std::string& lines) { return "[[light]]\n" + lines + "\n"; };
  const auto sensor = [](const std::string& lines) {
    return "[[sensor]]\nname = \"s\"\ncorner = [0, 0, 0]\n" + lines + "\n";
  };
  for (const std::string& wrong : {
           object("radius = 0"),
           object("radius = -1"),
           object("radius = nan"),
           object("radius = inf"),
           object("radius = \"1\""),
           object("radius = 1e300"),
           object("vertices = 1.5"),
           object("vertices = 9999999999"),
           object("vertices = 9223372036854775807"),
           object("segments = 0"),
           object("segments = 10\nvertices = 10"),
           object("scale = 0"),
           object("scale = -1"),
           object("scale = 1\nfit = 1"),
           object("translation = [0, 0]"),
           object("translation = [0, 0, nan]"),
           object("rotation = [0, 0, \"x\"]"),
           object("mesh = \"a.obj\""),
           light("type = \"point\"\nposition = [0, 1, 0]\nintensity = -1"),
           light("type = \"point\"\nposition = [0, 1, 0]\nintensity = [1, -1, 1]"),
           light("type = \"point\"\nposition = [0, 1, 0]"),
           light("type = \"point\"\nintensity = 1"),
           light("position = [0, 1, 0]\nintensity = 1"),
           light("type = \"directional\"\ndirection = [0, 0, 0]\nilluminance = 1"),
           light("type = \"spot\"\nposition = [0, 1, 0]\nintensity = 1"),
           light("type = \"spot\"\nposition = [0, 1, 0]\nintensity = 1\ndirection = [0, -1, 0]\ntarget = [0, "
                 "0, 0]"),
           light("type = \"spot\"\nposition = [0, 1, 0]\nintensity = 1\ndirection = [0, -1, 0]\ninner_angle "
                 "= 50"),
           light("type = \"spot\"\nposition = [0, 1, 0]\nintensity = 1\ndirection = [0, -1, 0]\nouter_angle "
                 "= 91"),
           light("type = \"line\"\nfrom = [0, 1, 0]\nto = [0, 1, 0]\nintensity = 1"),
           light("type = \"point\"\nposition = [0, 1, 0]\nintensity = 1\nradius = -0.1"),
           light("type = \"point\"\nposition = [0, 1, 0]\nintensity = 1\nradius = nan"),
           light("type = \"point\"\nposition = [0, 1, 0]\nintensity = 1\nangle = 1"),
           light("type = \"directional\"\ndirection = [0, -1, 0]\nilluminance = 1\nangle = 180"),
           light("type = \"directional\"\ndirection = [0, -1, 0]\nilluminance = 1\nangle = -1"),
           light("type = \"directional\"\ndirection = [0, -1, 0]\nilluminance = 1\nangle = \"moon\""),
           light("type = \"directional\"\ndirection = [0, -1, 0]\nilluminance = 1\nradius = 1"),
           sensor("u = [0, 0, 0]\nv = [0, 0, 1]"),
           sensor("u = [1, 0, 0]\nv = [2, 0, 0]"),
           sensor("u = [1, 0, 0]\nv = [0, 0, 1]\nresolution = [0, 8]"),
           sensor("u = [1, 0, 0]\nv = [0, 0, 1]\nresolution = [-8, 8]"),
           sensor("u = [1, 0, 0]\nv = [0, 0, 1]\nresolution = [100000, 8]"),
           sensor("u = [1, 0, 0]\nv = [0, 0, 1]\nresolution = [16384, 16384]"),
           sensor("u = [1, 0, 0]"),
           std::string("[[material]]\nname = \"g\"\ntype = \"dielectric\"\nior = 0\n"),
           std::string("[[material]]\nname = \"g\"\ntype = \"dielectric\"\nior = [1.5, 1.5, -1]\n"),
           std::string("[[material]]\nname = \"g\"\ntype = \"dielectric\"\nattenuation_color = [1, 1, 1]\n"),
           std::string("[[material]]\nname = \"g\"\ntype = \"dielectric\"\nphase = \"isotropic\"\n"),
           std::string("[[material]]\nname = \"g\"\ntype = \"dielectric\"\nscattering = -1\n"),
           std::string("[[material]]\nname = \"g\"\ntype = \"diffuse\"\ncolor = [1, 2, 1]\n"),
           std::string("[[material]]\ntype = \"diffuse\"\n"),
           std::string("[[material]]\nname = \"g\"\n"),
           std::string("[camera]\nposition = [0, 0, 0]\n"),
           std::string("[camera]\nposition = [0, 0, 1]\nfov = 180\n"),
           std::string("[environment]\nambient = -1\n"),
           std::string("[medium]\nextinction = -1\n"),
           std::string("[medium]\nextinction = 1\nalbedo = 1.5\n"),
           std::string("[medium]\nalbedo = 0.5\n"),
           std::string("[[medium]]\nextinction = 1\n"),
           std::string("[light]\ntype = \"point\"\n"),
           std::string("object = [1, 2]\n"),
           std::string("camera = 3\n"),
           std::string("camera = [\n"),
           std::string("[camera]\n[camera]\n"),
           std::string("\xff\xfe\x00x"),
           kMaterials + "[[object]]\nmaterial = \"glass\"\n",
           kMaterials + "[[object]]\nshape = \"sphere\"\n",
           kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"torus\"\nradius = 0.1\ntube = 0.2\n",
           kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"torus_knot\"\np = 2\nq = 4\n",
           kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"water\"\ngrid = [1, 5]\n",
           kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"water\"\nwaves = [{amplitude = 1}]\n",
           kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"water\"\nwaves = [{amplitude = 1, "
                        "wavelength = 1, heigth = 1}]\n",
       }) {
    expectError(wrong, {"scene.toml"});
  }
}

TEST_F(SceneFile, NamesMustDiffer) {
  expectError(kMaterials + kMaterials, {"\"glass\"", "taken"});
  const std::string ball = "[[object]]\nname = \"b\"\nmaterial = \"glass\"\nshape = \"box\"\n";
  expectError(kMaterials + ball + ball, {"\"b\"", "taken"});
}

TEST_F(SceneFile, MissingOrOddFilesAreTold) {
  EXPECT_NE(inputErrorOf([&] { loadScene(folder() / "none.toml"); }).find("no such file"), std::string::npos);
  EXPECT_NE(inputErrorOf([&] { loadScene(folder()); }), "");
  EXPECT_NE(inputErrorOf([&] { loadScene(write("a.blend", "x")); }), "");
}

class Diagnosis : public SceneFile {
 protected:
  std::vector<std::string> obstacles(const std::string& toml) const {
    return diagnose(load(kMaterials + toml)).casterReports.at(0).obstacles;
  }
  static bool mentions(const std::vector<std::string>& lines, const std::string& part) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(part) != line.npos; });
  }
  const std::string floor_ = "[[object]]\nname = \"floor\"\nmaterial = \"white\"\nshape = \"plane\"\n";
  const std::string ball_ =
      "[[object]]\nname = \"ball\"\nmaterial = \"glass\"\nshape = \"sphere\"\nradius = 0.5\n";
  const std::string lamp_ = "[[light]]\ntype = \"point\"\nposition = [0, 3, 0]\nintensity = 1\n";
};

TEST_F(Diagnosis, AGoodSceneHasNothingInTheWay) {
  const Scene scene = load(kMaterials + ball_ + floor_ + lamp_);
  const SceneReport report = diagnose(scene);
  EXPECT_TRUE(report.casterReports.at(0).obstacles.empty());
  EXPECT_EQ(report.casters, 1u);
  EXPECT_EQ(report.receivers, 1u);
  EXPECT_EQ(report.lights, 1u);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_NE(describe(scene, report).find("makes caustics"), std::string::npos);
}

TEST_F(Diagnosis, SaysWhyThereWillBeNoCaustics) {
  write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  write("inward.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const std::string mesh = "[[object]]\nmaterial = \"glass\"\nmesh = ";
  EXPECT_TRUE(mentions(obstacles(mesh + "\"open.obj\"\n" + floor_ + lamp_), "open (3 boundary edges)"));
  EXPECT_TRUE(obstacles(mesh + "\"inward.obj\"\n" + floor_ + lamp_).empty());
  EXPECT_TRUE(mentions(obstacles(ball_ + floor_ + lamp_ + "dimmer = 0\n"), "no light"));
  EXPECT_TRUE(mentions(obstacles(ball_ + lamp_), "receives"));
  EXPECT_TRUE(mentions(
      obstacles(ball_ + floor_ + "[[light]]\ntype = \"point\"\nposition = [0, 3, 0]\nintensity = 0\n"),
      "intensity"));
  const std::string spot =
      "[[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\nintensity = 1\nouter_angle = 20\n";
  EXPECT_TRUE(mentions(obstacles(ball_ + floor_ + spot + "direction = [1, 0, 0]\n"), "cone"));
  EXPECT_TRUE(obstacles(ball_ + floor_ + spot + "direction = [0, -1, 0]\n").empty());
}

TEST_F(Diagnosis, ASpotReachesABallAtTheEdgeOfItsCone) {
  Light spot;
  spot.type = LightType::spot;
  spot.direction = {0, -1, 0};
  spot.outerAngle = 30;
  // At a distance of 2 a ball of radius 1 fills half an angle of 30 degrees: together 60.
  const auto at = [](float degrees) {
    return 2.0f * vec3(std::sin(glm::radians(degrees)), -std::cos(glm::radians(degrees)), 0);
  };
  EXPECT_TRUE(reaches(spot, at(59.5f), 1));
  EXPECT_FALSE(reaches(spot, at(60.5f), 1));
}

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
    for (const CasterReport& caster : diagnose(scene).casterReports)
      EXPECT_TRUE(caster.obstacles.empty()) << entry.path();
  }
}

TEST(Scene, LoadsTheScenesOfTheRepository) {
  if (kIsSanitized)
    GTEST_SKIP() << "it takes minutes under the sanitizers, in code that other tests go through too";
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    if (text.str().find("mesh = ") != std::string::npos &&
        !std::filesystem::exists("/usr/share/glmark2/models/bunny.obj"))
      continue;
    const Scene scene = loadScene(entry.path());
    if (entry.path().stem() == "coloured-horse") continue;  // some of its edges have more than two faces
    for (const CasterReport& caster : diagnose(scene).casterReports)
      EXPECT_TRUE(caster.obstacles.empty()) << entry.path();
  }
}

}  // namespace
}  // namespace nephroid

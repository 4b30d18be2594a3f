#include "scene/checks.h"

#include <gtest/gtest.h>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/progress.h"
#include "geometry/mesh_checks.h"
#include "geometry/shapes.h"
#include "lights/sky.h"
#include "report/diagnose.h"
#include "scene/framing.h"
#include "transport/scene_transport.h"

namespace nephroid {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

Light lightOf(LightType type, const char* name) {
  Light light;
  light.type = type;
  light.name = name;
  light.position = {0, 3, 0};
  return light;
}

// One of everything that a scene may hold.
Scene fullScene() {
  Scene scene;
  scene.textures.push_back({"checks", 2, 1, {vec4(0.2f), vec4(0.8f)}});
  scene.profiles.push_back({"lamp", PhotometryType::c, {0, 90, 180}, {0}, {1, 0.5f, 0}, 100});
  scene.skies.push_back(evenSky());
  Material floor, glass;
  floor.name = "floor";
  floor.colorTexture = 0;
  glass.name = "glass";
  glass.type = MaterialType::dielectric;
  scene.materials = {floor, glass};
  const Water water{{2, 2}, {8, 8}, {{0.01f, 1}}};
  scene.meshes = {makePlane({4, 4}), makeSphere(0.5f, {.vertices = 100}), makeWater(water, 0)};
  scene.objects = {
      {"floor", 0, 0, {}, {}}, {"ball", 1, 1, {{0, 1, 0}}, {}}, {"pool", 2, 1, {{0, 2, 0}}, water}};
  Light spot = lightOf(LightType::spot, "spot"), line = lightOf(LightType::line, "tube"),
        area = lightOf(LightType::area, "panel"), sky = lightOf(LightType::sky, "sky");
  spot.goboTexture = 0;
  spot.profile = 0;
  line.end = {1, 3, 0};
  area.u = {1, 0, 0};
  area.v = {0, 0, 1};
  area.direction = normalize(cross(area.v, area.u));
  sky.skyMap = 0;
  sky.sky = skyParts(scene.skies[0], 4);
  scene.lights = {
      lightOf(LightType::point, "bulb"), lightOf(LightType::directional, "sun"), spot, line, area, sky};
  scene.medium = Medium{.extinction = 0.1f, .albedo = 0.5f};
  scene.medium->grid = DensityGrid{"cloud", {0, 0, 0}, vec3(1), uvec3(2), std::vector<float>(8, 0.5f)};
  scene.sensors.push_back({.name = "meter", .resolution = {4, 4}});
  return scene;
}

std::string errorOf(const std::function<void()>& take) {
  try {
    take();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Mistake {
  std::string says;
  std::function<void(Scene&)> make;
};

// What may be wrong at each frame.
const std::vector<Mistake> kMoving{
    {"time is not finite", [](Scene& s) { s.time = double(kNaN); }},
    {"camera: position is (nan, 0, 4)", [](Scene& s) { s.camera.position.x = kNaN; }},
    {"camera: position is the target", [](Scene& s) { s.camera.target = s.camera.position; }},
    {"camera: up is 0", [](Scene& s) { s.camera.up = vec3(0); }},
    {"camera: up lies along the view",
     [](Scene& s) {
       s.camera.up = {0, 0, 1};
     }},
    {"camera: verticalFov is 0", [](Scene& s) { s.camera.verticalFov = 0; }},
    {"camera: exposure is -1", [](Scene& s) { s.camera.exposure = -1; }},
    {"environment: ambient is (-1, 0, 0)", [](Scene& s) { s.environment.ambient.x = -1; }},
    {"environment: background", [](Scene& s) { s.environment.background.y = kInfinite; }},
    {"material \"glass\": color is (2, 2, 2)", [](Scene& s) { s.materials[1].color = vec3(2); }},
    {"material \"floor\": texture 7 is not there", [](Scene& s) { s.materials[0].colorTexture = 7; }},
    {"material \"floor\": emission", [](Scene& s) { s.materials[0].emission.x = kNaN; }},
    {"material \"glass\": ior is (0, 1.5, 1.5)", [](Scene& s) { s.materials[1].ior.x = 0; }},
    {"material \"glass\": dispersion", [](Scene& s) { s.materials[1].dispersion = -1; }},
    {"material \"glass\": attenuationColor", [](Scene& s) { s.materials[1].attenuationColor.z = -0.5f; }},
    {"material \"glass\": attenuationDistance is -1",
     [](Scene& s) { s.materials[1].attenuationDistance = -1; }},
    {"material \"glass\": attenuationDistance is nan",
     [](Scene& s) { s.materials[1].attenuationDistance = kNaN; }},
    {"material \"glass\": scattering", [](Scene& s) { s.materials[1].scattering.x = -1; }},
    {"material \"glass\": g is 1", [](Scene& s) { s.materials[1].g = 1; }},
    {"object \"ball\": mesh 3 is not there; the scene has 3", [](Scene& s) { s.objects[1].mesh = 3; }},
    {"object 1: material 9 is not there",
     [](Scene& s) { s.objects[1].material = 9, s.objects[1].name = ""; }},
    {"object \"ball\": translation", [](Scene& s) { s.objects[1].placement.translation.y = kNaN; }},
    {"object \"ball\": rotation", [](Scene& s) { s.objects[1].placement.rotation = quat(0, 0, 0, 0); }},
    {"object \"ball\": scale is 0", [](Scene& s) { s.objects[1].placement.scale = 0; }},
    {"object \"pool\": grid of its water is 1", [](Scene& s) { s.objects[2].water->grid.x = 1; }},
    {"object \"pool\": width of its water", [](Scene& s) { s.objects[2].water->size.x = -1; }},
    {"object \"pool\": its mesh is not that of its water", [](Scene& s) { s.objects[2].water->grid.x = 9; }},
    {"object \"pool\": amplitude of a wave", [](Scene& s) { s.objects[2].water->waves[0].amplitude = kNaN; }},
    {"object \"pool\": wavelength of a wave", [](Scene& s) { s.objects[2].water->waves[0].wavelength = 0; }},
    {"object \"pool\": direction of a wave",
     [](Scene& s) { s.objects[2].water->waves[0].direction = vec2(0); }},
    {"object \"pool\": speed of its waves", [](Scene& s) { s.objects[2].water->simulation = {.speed = 0}; }},
    {"light \"bulb\": intensity is (-1, 1, 1)", [](Scene& s) { s.lights[0].intensity.x = -1; }},
    {"light \"bulb\": position is (0, nan, 0)", [](Scene& s) { s.lights[0].position.y = kNaN; }},
    {"light \"sun\": illuminance", [](Scene& s) { s.lights[1].illuminance.z = kInfinite; }},
    {"light \"sun\": direction is (0, -2, 0); it must be of length 1",
     [](Scene& s) { s.lights[1].direction *= 2; }},
    {"light \"spot\": direction", [](Scene& s) { s.lights[2].direction = vec3(0); }},
    {"light \"spot\": innerAngle is 60; it must be from 0 to 45",
     [](Scene& s) { s.lights[2].innerAngle = 60; }},
    {"light \"spot\": outerAngle is nan", [](Scene& s) { s.lights[2].outerAngle = kNaN; }},
    {"light \"spot\": outerAngle is 90; with a gobo", [](Scene& s) { s.lights[2].outerAngle = 90; }},
    {"light \"spot\": goboRotation", [](Scene& s) { s.lights[2].goboRotation = kNaN; }},
    {"light \"spot\": texture 1 is not there", [](Scene& s) { s.lights[2].goboTexture = 1; }},
    {"light \"spot\": profile 1 is not there", [](Scene& s) { s.lights[2].profile = 1; }},
    {"light \"tube\": end is where it begins", [](Scene& s) { s.lights[3].end = s.lights[3].position; }},
    {"light \"tube\": samples is 0", [](Scene& s) { s.lights[3].samples = 0; }},
    {"light \"panel\": u and v span no area", [](Scene& s) { s.lights[4].u = s.lights[4].v; }},
    {"light \"panel\": direction", [](Scene& s) { s.lights[4].direction *= -1; }},
    {"light \"panel\": grid is 0", [](Scene& s) { s.lights[4].grid.y = 0; }},
    {"light \"sky\": sky kNone is not there", [](Scene& s) { s.lights[5].skyMap = kNone; }},
    {"light \"sky\": direction of a part", [](Scene& s) { s.lights[5].sky[0].direction = vec3(0); }},
    {"light \"sky\": illuminance of a part", [](Scene& s) { s.lights[5].sky[0].illuminance.x = kNaN; }},
    {"medium: extinction is -1", [](Scene& s) { s.medium->extinction = -1; }},
    {"medium: albedo is 2", [](Scene& s) { s.medium->albedo = 2; }},
    {"medium: g is nan", [](Scene& s) { s.medium->g = kNaN; }},
    {"medium: fogHeight", [](Scene& s) { s.medium->fogHeight = -1; }},
};

// And what is looked at once.
const std::vector<Mistake> kStanding{
    {"mesh 1: the mesh has no vertices", [](Scene& s) { s.meshes[1] = {}; }},
    {"mesh \"sphere\": the mesh is not finished; call finishMesh",
     [](Scene& s) { s.meshes[1].isFinished = false; }},
    {"mesh \"sphere\": the mesh has no triangles", [](Scene& s) { s.meshes[1].triangles.clear(); }},
    {"mesh \"sphere\": vertex 5 is not finite", [](Scene& s) { s.meshes[1].positions[5].x = kNaN; }},
    {"mesh \"sphere\": triangle 0 refers to vertex 1000000",
     [](Scene& s) { s.meshes[1].triangles[0].x = 1000000; }},
    {"mesh \"sphere\": 0 normals for", [](Scene& s) { s.meshes[1].normals.clear(); }},
    {"mesh \"sphere\": the normal of vertex 3 is not of length 1",
     [](Scene& s) { s.meshes[1].normals[3] *= 2; }},
    {"mesh \"sphere\": the normal of vertex 3 is not of length 1",
     [](Scene& s) { s.meshes[1].normals[3].y = kNaN; }},
    {"mesh \"sphere\": 1 texture coordinates for",
     [](Scene& s) { s.meshes[1].texcoords.assign(1, vec2(0)); }},
    {"mesh \"sphere\": the texture coordinate of vertex 0 is not finite",
     [](Scene& s) { s.meshes[1].texcoords.assign(s.meshes[1].positions.size(), vec2(kNaN)); }},
    {"texture \"checks\": width is 0", [](Scene& s) { s.textures[0].width = 0; }},
    {"texture \"checks\": texels holds 2 values; it must hold 4", [](Scene& s) { s.textures[0].height = 2; }},
    {"texture \"checks\": texel 1 is (nan", [](Scene& s) { s.textures[0].texels[1].x = kNaN; }},
    {"profile \"lamp\": verticalAngles holds 1", [](Scene& s) { s.profiles[0].verticalAngles = {0}; }},
    {"profile \"lamp\": verticalAngles must ascend", [](Scene& s) { s.profiles[0].verticalAngles[1] = 0; }},
    {"profile \"lamp\": horizontalAngles holds 0", [](Scene& s) { s.profiles[0].horizontalAngles.clear(); }},
    {"profile \"lamp\": fractions holds 2", [](Scene& s) { s.profiles[0].fractions.pop_back(); }},
    {"profile \"lamp\": fraction 1 is 2", [](Scene& s) { s.profiles[0].fractions[1] = 2; }},
    {"profile \"lamp\": peak is 0", [](Scene& s) { s.profiles[0].peak = 0; }},
    {"sky \"even\": luminance holds", [](Scene& s) { s.skies[0].name = "even", s.skies[0].size.x += 1; }},
    {"luminance 0 is (-1", [](Scene& s) { s.skies[0].luminance[0].x = -1; }},
    {"light \"sky\": its sky is in no parts", [](Scene& s) { s.lights[5].sky.clear(); }},
    {"density grid \"cloud\": corner", [](Scene& s) { s.medium->grid->corner.x = kNaN; }},
    {"density grid \"cloud\": size", [](Scene& s) { s.medium->grid->size.x = 0; }},
    {"density grid \"cloud\": cells is 0", [](Scene& s) { s.medium->grid->cells.x = 0; }},
    {"density grid \"cloud\": densities holds 8", [](Scene& s) { s.medium->grid->cells.x = 3; }},
    {"density grid \"cloud\": density 7 is 2", [](Scene& s) { s.medium->grid->densities[7] = 2; }},
    {"sensor \"meter\": corner", [](Scene& s) { s.sensors[0].corner.x = kNaN; }},
    {"sensor \"meter\": u and v span no area", [](Scene& s) { s.sensors[0].u = vec3(0); }},
    {"sensor \"meter\": resolution is 0", [](Scene& s) { s.sensors[0].resolution.y = 0; }},
};

void expectSays(const std::string& message, const std::string& says) {
  EXPECT_NE(message.find(says), std::string::npos) << "says '" << message << "' and not '" << says << "'";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(SceneChecks, TakeAScene) {
  EXPECT_NO_THROW(checkScene(fullScene()));
  EXPECT_NO_THROW(checkScene(Scene{}));
  EXPECT_NO_THROW(checkMoved(fullScene(), fullScene()));
}

TEST(SceneChecks, NameWhatIsWrong) {
  for (const std::vector<Mistake>& mistakes : {kMoving, kStanding})
    for (const Mistake& mistake : mistakes) {
      Scene scene = fullScene();
      mistake.make(scene);
      expectSays(errorOf([&] { checkScene(scene); }), mistake.says);
    }
}

TEST(SceneChecks, NameWhatBecameWrong) {
  const Scene before = fullScene();
  for (const Mistake& mistake : kMoving) {
    Scene scene = before;
    mistake.make(scene);
    expectSays(errorOf([&] { checkMoved(scene, before); }), mistake.says);
  }
}

TEST(SceneChecks, HoldWhatIsDrawnAnewToWhatItWas) {
  const std::vector<Mistake> mistakes{
      {"the scene has 2 objects and had 3", [](Scene& s) { s.objects.pop_back(); }},
      {"the scene has 4 meshes and had 3", [](Scene& s) { s.meshes.push_back(s.meshes[0]); }},
      {"the scene has 3 materials and had 2", [](Scene& s) { s.materials.emplace_back(); }},
      {"object \"ball\": it has another mesh", [](Scene& s) { s.objects[1].mesh = 0; }},
      {"object \"pool\": its water has another mesh", [](Scene& s) {
         s.objects[2].water->grid = uvec2(5);
         s.meshes[2] = makeWater(*s.objects[2].water, 0);
       }}};
  const Scene before = fullScene();
  for (const Mistake& mistake : mistakes) {
    Scene scene = before;
    mistake.make(scene);
    expectSays(errorOf([&] { checkMoved(scene, before); }), mistake.says);
  }
}

// The doors that a scene is taken by.
TEST(SceneChecks, StandAtTheDoors) {
  const TechniqueSettings settings;
  Progress progress;
  for (const std::vector<Mistake>& mistakes : {kMoving, kStanding})
    for (const Mistake& mistake : mistakes) {
      Scene scene = fullScene();
      mistake.make(scene);
      expectSays(errorOf([&] { RayScene{scene}; }), mistake.says);
      expectSays(errorOf([&] { diagnose(scene); }), mistake.says);
      expectSays(errorOf([&] { SceneTransport(scene, transportOf(settings), progress); }), mistake.says);
    }
  Mesh bare = makeSphere(0.5f, {.vertices = 100});
  bare.isFinished = false;
  expectSays(errorOf([&] { RayScene{bare}; }), "mesh \"sphere\": the mesh is not finished");
  finishMesh(bare, "bare");
  EXPECT_NO_THROW(RayScene{bare});

  const Scene right = fullScene();
  SceneTransport transport(right, transportOf(settings), progress);
  for (const Mistake& mistake : kMoving) {
    Scene scene = right;
    mistake.make(scene);
    expectSays(errorOf([&] { transport.place(scene); }), mistake.says);
  }
  EXPECT_NO_THROW(transport.place(right));
}

// A camera is asked for while there may be none that is right, nor lights.
TEST(SceneChecks, OfObjectsAloneStandBeforeACameraThatFramesThem) {
  int wrongObjects = 0;
  for (const std::vector<Mistake>& mistakes : {kMoving, kStanding})
    for (const Mistake& mistake : mistakes) {
      Scene scene = fullScene();
      mistake.make(scene);
      const bool isOfObjects = mistake.says.starts_with("object") || mistake.says.starts_with("mesh");
      wrongObjects += isOfObjects;
      if (isOfObjects)
        expectSays(errorOf([&] { framingCamera(scene); }), mistake.says);
      else
        EXPECT_NO_THROW(framingCamera(scene)) << mistake.says;
    }
  EXPECT_GE(wrongObjects, 20);
}

}  // namespace
}  // namespace nephroid

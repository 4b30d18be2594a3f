#include "render/technique_meter.h"

#include "gpu/command_list.h"
#include "gpu/transfer.h"
#include "scene/checks.h"

namespace nephroid {
namespace {

// Points looked up along each side of a texel, and averaged: an illumination texture may be much finer than
// the sensor.
constexpr uint32_t kPointsAlongTexel = 4;  // at once
constexpr uint32_t kPasses = 4;            // times, between them

uint32_t pointsAlongTexel(const Technique& technique) {
  return technique.traits().coversSquares ? 1 : kPointsAlongTexel;
}

// The scene and a diffuse quad on the sensor, since techniques light receivers; and a camera that looks at it
// along the sensor's normal, for those that ask where receivers are seen from.
Scene withReceiver(Scene scene, const Sensor& sensor) {
  checkScene(scene);
  checkSensor(sensor);
  Mesh quad;
  quad.name = sensor.name;
  quad.positions = {sensor.corner, sensor.corner + sensor.v, sensor.corner + sensor.v + sensor.u,
                    sensor.corner + sensor.u};
  quad.normals.assign(4, sensor.normal());
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  quad.isFinished = true;
  Object object;
  object.name = sensor.name;
  object.mesh = uint32_t(scene.meshes.size());
  object.material = uint32_t(scene.materials.size());
  scene.meshes.push_back(std::move(quad));
  scene.materials.emplace_back();
  scene.objects.push_back(std::move(object));
  scene.camera.target = sensor.corner + 0.5f * (sensor.u + sensor.v);
  scene.camera.position = scene.camera.target + 100 * length(sensor.u + sensor.v) * sensor.normal();
  return scene;
}

gpu::Image pointImage(gpu::Device& device, const char* name, const Sensor& sensor,
                      const Technique& technique) {
  const uvec2 size = sensor.resolution * pointsAlongTexel(technique);
  return gpu::createImage(device, name, {.width = size.x, .height = size.y});
}

std::vector<std::vector<std::byte>> bytesOf(const std::vector<vec4>& texels) {
  const auto bytes = std::as_bytes(std::span(texels));
  return {{bytes.begin(), bytes.end()}};
}

}  // namespace

TechniqueMeter::TechniqueMeter(gpu::Device& deviceToUse, const Scene& sceneToRead, const Sensor& sensorToRead,
                               const TechniqueSettings& settings, Progress& progress, Stats& stats)
    : device_(deviceToUse),
      sensor_(sensorToRead),
      scene_(withReceiver(sceneToRead, sensorToRead)),
      gpuScene_(device_, scene_),
      transport_(scene_, transportOf(settings), progress),
      technique_(makeTechnique({device_, settings, transport_, stats})),
      positions_(pointImage(device_, "sensor positions", sensor_, *technique_)),
      normals_(pointImage(device_, "sensor normals", sensor_, *technique_)),
      caustics_(pointImage(device_, "sensor caustics", sensor_, *technique_)) {
  technique_->reserve({positions_.width(), positions_.height()});
  uploadNormals();
}

void TechniqueMeter::uploadNormals() {
  const std::vector<vec4> texels(std::size_t(normals_.width()) * normals_.height(),
                                 vec4(sensor_.normal(), 0));
  gpu::uploadImage(device_, normals_, bytesOf(texels));
}

void TechniqueMeter::uploadPoints(vec2 offset) {
  const uint32_t width = positions_.width(), height = positions_.height();
  std::vector<vec4> points(std::size_t(width) * height);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const vec2 at = (vec2(float(x), float(y)) + offset) / vec2(float(width), float(height));
      points[std::size_t(y) * width + x] = vec4(sensor_.corner + at.x * sensor_.u + at.y * sensor_.v, 1);
    }
  gpu::uploadImage(device_, positions_, bytesOf(points));
}

void TechniqueMeter::addShaded(SensorLayer& layer) {
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("clear", [&] { commands.clear(caustics_, vec4(0)); });
    technique_->shade(commands, {&positions_, &normals_}, caustics_);
  });
  const std::vector<vec4> points = gpu::download<vec4>(device_, caustics_);
  const uint32_t along = pointsAlongTexel(*technique_);
  for (uint32_t y = 0; y < caustics_.height(); ++y)
    for (uint32_t x = 0; x < caustics_.width(); ++x)
      layer[std::size_t(y / along) * sensor_.resolution.x + x / along] +=
          vec3(points[std::size_t(y) * caustics_.width() + x]);
}

SensorLayer TechniqueMeter::read() {
  transport_.place(scene_);
  gpuScene_.place(scene_);
  technique_->update(gpuScene_);
  SensorLayer layer;
  const uint32_t passes = technique_->traits().coversSquares ? 1 : kPasses;
  device_.submitAndWait([&](gpu::CommandList& commands) { technique_->record(commands, gpuScene_); });
  do {
    layer.assign(std::size_t(sensor_.resolution.x) * sensor_.resolution.y, vec3(0));
    for (uint32_t pass = 0; pass < passes * passes; ++pass) {
      uploadPoints((vec2(float(pass % passes), float(pass / passes)) + 0.5f) / float(passes));
      addShaded(layer);
    }
  } while (!technique_->finish());
  const float points = float(pointsAlongTexel(*technique_) * passes);
  for (vec3& lux : layer) lux /= points * points;
  return layer;
}

}  // namespace nephroid

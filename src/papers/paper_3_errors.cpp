#include "papers/paper_3_errors.h"

#include <array>
#include <cmath>
#include <numbers>

#include "irradiance_volume/photons.h"
#include "papers/paper_scenes.h"
#include "papers/volume_sensor.h"
#include "render/picture.h"
#include "report/flip.h"
#include "techniques/irradiance_volume/settings.h"

namespace nephroid {
namespace {

constexpr std::array<uint32_t, 3> kRepresentations{kRepresentationGrid, kRepresentationShells,
                                                   kRepresentationMultiResolution};
// The finest grid of a multi-resolution volume may take so many times what is left of it.
constexpr uint32_t kFinestTimes = 4;
// A floor of reflectance 0.8, as the scenes are exposed.
constexpr float kExposurePerLux = 0.7f * 0.8f / std::numbers::pi_v<float>;

VolumeSettings settingsFor(uint32_t representation, uint32_t kilobytes) {
  VolumeSettings settings;
  settings.representation = representation;
  settings.kilobytes = kilobytes;
  if (representation == kRepresentationMultiResolution) settings.error = IrradianceVolumeSettings{}.error;
  return settings;
}

const char* nameOfKept(uint32_t representation) {
  return nameOf(Representation(representation));
}

ByteImage pictureOf(const SensorLayer& layer, uvec2 size) {
  Image image;
  image.width = size.x;
  image.height = size.y;
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& values = image.channel(std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < layer.size(); ++i) values[i] = layer[i][c];
  }
  return pictureOf(image, {kExposurePerLux, kToneNeutral}, "", Rounding::nearest);
}

double flipOf(const SensorLayer& truth, const SensorLayer& layer, uvec2 size) {
  double sum = 0;
  for (const float value : ldrFlip(pictureOf(truth, size), pictureOf(layer, size))) sum += double(value);
  return sum / double(layer.size());
}

// Of the samples around the scene's light.
double kilobytesOf(const Scene& scene, IrradianceVolume& volume) {
  std::size_t bytes = 0;
  const vec3 light = casterOf(scene).placement.inverseDirection(scene.lights[0].direction);
  for (const SampleShare& share : volume.lightSamples().around(light, LightInterpolation::rotated))
    bytes = std::max(bytes, volume.sample(share.sample).words.size_bytes());
  return double(bytes) / 1000;
}

// Kilobytes of shells in figure 11, and of the multi-resolution volumes that the paper finds as good.
struct MemoryRow {
  uint32_t kilobytes;
  double shells, multiResolution;
};
constexpr std::array<MemoryRow, 5> kMemoryRows{
    {{6, 5.7, 4.8}, {23, 22.5, 12.6}, {90, 90.1, 29.5}, {360, 360, 70.4}, {1440, 1440, 179}}};

double paperKilobytes(const MemoryRow& row, uint32_t representation) {
  if (representation == kRepresentationShells) return row.shells;
  return representation == kRepresentationMultiResolution ? row.multiResolution : kNoFigure;
}

// Light of the paths through a square, `half` its side, across the unit vector `axis`; and the same read from
// the volume.
struct Square {
  vec3 center{0};
  mat3 frame{1};  // its normal last
  float half = 1;
};

double tracedThrough(const CasterTracer& tracer, const std::vector<PhotonPath>& paths, const mat3& lightFrame,
                     const Square& square) {
  const float radius = tracer.sphere().radius;
  double flux = 0;
  for (const PhotonPath& path : paths) {
    const vec3 origin = tracer.sphere().center + radius * (lightFrame * path.origin);
    const vec3 direction = lightFrame * path.direction;
    const float toward = dot(direction, square.frame[2]);
    const float along = dot(square.center - origin, square.frame[2]) / toward;
    if (toward <= 0 || along < 0 || along > radius * path.length) continue;
    const vec3 place = glm::transpose(square.frame) * (origin + along * direction - square.center);
    if (std::max(std::abs(place.x), std::abs(place.y)) < square.half)
      flux += double(path.flux.y * radius * radius);
  }
  return flux;
}

double readThrough(IrradianceVolume& volume, vec3 light, const Square& square) {
  constexpr int kPoints = 160;
  double sum = 0;
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x) {
      const vec2 place = square.half * ((vec2(float(x), float(y)) + 0.5f) * (2.0f / kPoints) - 1.0f);
      const vec3 point = square.center + square.frame * vec3(place, 0);
      sum += double(
          volume.illuminance(point, -square.frame[2], light, IrradianceVolumeSettings{}.lightInterpolation)
              .y);
    }
  return sum * double(4 * square.half * square.half) / (kPoints * kPoints);
}

}  // namespace

void addMemoryErrors(PaperTable& table, const std::filesystem::path& scenes, Progress& progress) {
  constexpr uint32_t kReferencePasses = 16;
  for (const std::string name : {"sphere", "ring"}) {
    const Scene scene = loadPaper3(scenes, name);
    progress.begin("reference of " + name, 1);
    const SensorLayer truth = readReference(scene, kReferencePasses);
    progress.finish();
    const uvec2 size = scene.sensors[0].resolution;
    for (const MemoryRow& row : kMemoryRows)
      for (const uint32_t representation : kRepresentations) {
        const uint32_t times = representation == kRepresentationMultiResolution ? kFinestTimes : 1;
        IrradianceVolume volume = volumeOf(scene, settingsFor(representation, times * row.kilobytes));
        const SensorLayer layer = readVolume(scene, volume, IrradianceVolumeSettings{}.lightInterpolation, 3);
        const std::string what =
            name + ", " + std::to_string(row.kilobytes) + " kB, " + nameOfKept(representation);
        table.figures.push_back(
            {what, "size", "kB", paperKilobytes(row, representation), kilobytesOf(scene, volume)});
        table.figures.push_back(
            {what, "error", "%", kNoFigure, 100 * rootMeanSquare(truth, layer) / meanOf(truth)});
        table.figures.push_back({what, "FLIP", "", kNoFigure, flipOf(truth, layer, size)});
      }
  }
}

void addFluxes(PaperTable& table, const std::filesystem::path& scenes) {
  constexpr float kReach = 20;  // bounding radii, beyond all planes
  constexpr uint32_t kPhotons = 400000;
  for (const std::string name : {"sphere", "ring", "prism"}) {
    const Scene scene = loadPaper3(scenes, name);
    const Object& caster = casterOf(scene);
    const Material material = materialInOwnSpace(scene.materialOf(caster), caster.placement.scale);
    const CasterTracer tracer(scene.meshOf(caster), material, Paths::transmission);
    const vec3 light = caster.placement.inverseDirection(scene.lights[0].direction);
    const mat3 frame = sampleFrame(light);
    const std::vector<PhotonPath> paths = tracer.trace(frame, kPhotons, kReach);
    for (const uint32_t representation : kRepresentations) {
      IrradianceVolume volume = volumeOf(scene, settingsFor(representation, 360));
      for (const float distance : {1.3f, 2.0f, 3.0f, 5.0f}) {
        const float radius = tracer.sphere().radius;
        const Square square{tracer.sphere().center + radius * distance * light, frame,
                            1.5f * radius * distance};
        char plane[16];
        std::snprintf(plane, sizeof plane, "%.1f", double(distance));
        table.figures.push_back(
            {name + ", plane at " + plane + " radii, " + nameOfKept(representation), "flux", "%", kNoFigure,
             100 * readThrough(volume, light, square) / tracedThrough(tracer, paths, frame, square)});
      }
    }
  }
}

void addMotionErrors(PaperTable& table, const std::filesystem::path& scenes, Progress& progress) {
  constexpr int kFrames = 11;
  constexpr float kDegreesPerFrame = 1;
  for (const std::string name : {"sphere", "cube", "prism", "ring", "bunny"}) {
    Scene scene = loadPaper3(scenes, name);
    const quat turn = glm::angleAxis(glm::radians(kDegreesPerFrame), normalize(vec3(1, 0.5f, 3)));
    std::vector<Scene> frames;
    std::vector<SensorLayer> truth;
    for (int frame = 0; frame < kFrames; ++frame) {
      frames.push_back(scene);
      truth.push_back(readBeams(scene, progress));
      scene.lights[0].direction = turn * scene.lights[0].direction;
    }
    IrradianceVolume volume =
        volumeOf(scene, settingsFor(uint32_t(IrradianceVolumeSettings{}.representation), 360));
    for (std::size_t i = 0; i < namesOf(LightInterpolation{}).size(); ++i) {
      double steps = 0, errors = 0, mean = 0;
      SensorLayer before;
      for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        SensorLayer difference = readVolume(frames[frame], volume, LightInterpolation(i), 2);
        for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= truth[frame][k];
        if (!before.empty()) steps += std::pow(rootMeanSquare(difference, before), 2) / (kFrames - 1);
        errors += std::pow(rootMeanSquare(difference, SensorLayer(difference.size(), vec3(0))), 2) / kFrames;
        mean += meanOf(truth[frame]) / kFrames;
        before = std::move(difference);
      }
      const std::string what = name + ", light turning, " + nameOf(LightInterpolation(i));
      table.figures.push_back({what, "error", "%", kNoFigure, 100 * std::sqrt(errors) / mean});
      table.figures.push_back({what, "frame to frame", "%", kNoFigure, 100 * std::sqrt(steps) / mean});
    }
  }
}

}  // namespace nephroid

#include <algorithm>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>

#include "command.h"
#include "drawing.h"
#include "formats/load.h"
#include "reference/image.h"
#include "refining.h"
#include "render/metering.h"
#include "report/missing_light.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

struct FrameRange {
  uint32_t first = 0;
  uint32_t last = 0;
};

struct RenderOptions : CommonOptions {
  PictureSettings picture;
  ToneChoice tone;
  uvec2 size{640, 480};  // pixels
  std::optional<FrameRange> frames;
  double framesPerSecond = 60;
  ReferenceOptions reference;
};

// A frame to be drawn: when, and where to.
struct FrameJob {
  double time = 0;  // s
  fs::path output;
};

// What one frame of a film leaves to the next.
struct Film {
  ToneChoice tone;
  WaveRuns waves;
  void keep(float exposure) {
    tone.isExposureChosen = true;
    tone.exposure = exposure;
  }
};

// out.png becomes out.0007.png.
fs::path numbered(const fs::path& output, uint32_t frame) {
  std::ostringstream number;
  number << '.' << std::setw(4) << std::setfill('0') << frame;
  fs::path named = output;
  return named.replace_extension(number.str() + output.extension().string());
}

std::vector<FrameJob> jobsOf(const RenderOptions& options) {
  if (!options.frames) return {{options.time, options.output}};
  std::vector<FrameJob> jobs;
  for (uint32_t frame = options.frames->first; frame <= options.frames->last; ++frame)
    jobs.push_back({options.time + frame / options.framesPerSecond, numbered(options.output, frame)});
  return jobs;
}

std::vector<ImageAttribute> attributesOf(const Renderer& renderer, const PictureSettings& settings) {
  std::vector<ImageAttribute> attributes = imageAttributes(settings, "nit");
  addToneAttributes(renderer.toneMapping(), attributes);
  return attributes;
}

void writePicture(Renderer& renderer, const PictureSettings& settings, const fs::path& output) {
  if (output.extension() == ".png")
    writePng(output, renderer.picture());
  else
    writeExr(output, renderer.layers(), attributesOf(renderer, settings));
}

// Draws and writes a frame; returns the times of all its repetitions. All frames after the first have its
// exposure.
std::vector<FrameTime> drawJob(const RenderOptions& options, const FrameJob& job, gpu::Device& device,
                               Progress& progress, Stats& stats, Film& film) {
  const ToneChoice tone = film.tone;
  const FrameRequest request{options.scene,
                             job.time,
                             options.picture,
                             tone,
                             options.size,
                             options.repeat,
                             job.output.filename().string(),
                             &film.waves};
  return drawFrame(request, device, progress, stats, [&](Renderer& renderer) {
    film.keep(renderer.exposure());
    writePicture(renderer, options.picture, job.output);
  });
}

void renderReference(const RenderOptions& options, const std::vector<FrameJob>& jobs) {
  Progress progress(progressDisplay(options.isQuiet));
  Stats stats;
  stats.technique = kReferenceName;
  stats.device = "host";
  Film film{options.tone, {}};
  const StopRule stop = stopRule(options.reference, options.picture);
  for (const FrameJob& job : jobs) {
    const Stopwatch preparing;
    CommonOptions common = options;
    common.time = job.time;
    common.output = job.output;
    Scene scene = loadScene(options.scene, job.time, &film.waves);
    applyTo(scene.camera, film.tone);
    warnOf(scene, stats);
    stats.notes = missingLight(scene, std::nullopt);
    const RayScene rays(scene);
    const ReferenceSettings settings = referenceSettings(options.reference, options.picture, options.size);
    ReferenceImage image(scene, rays, settings);
    stats.prepareMilliseconds += preparing.milliseconds();
    refineToFile(image, {common, options.reference, settings, stop, scene, "nit", ""}, progress, stats);
    film.keep(toneMappingOf(scene.camera, image.image()).exposure);
    stats.exposure = double(*film.tone.exposure);
  }
  reportStats(options.stats, stats);
}

void runRender(const RenderOptions& options) {
  const std::vector<FrameJob> jobs = jobsOf(options);
  checkOutput(jobs.front().output, options.scene, {".png", ".exr"});
  if (!options.stats.empty()) checkOutput(options.stats, options.scene);
  if (isReference(options.picture)) return renderReference(options, jobs);

  Progress progress(progressDisplay(options.isQuiet));
  Stats stats;
  // Errors in the scene are reported before a device is opened.
  warnOf(loadScene(options.scene, options.time), stats);
  gpu::Device device({.device = options.device});
  stats.device = device.info().name;
  describeSettings(options.picture, stats);

  std::vector<FrameTime> times;
  Film film{options.tone, {}};
  for (const FrameJob& job : jobs) {
    std::vector<FrameTime> part = drawJob(options, job, device, progress, stats, film);
    std::move(part.begin(), part.end(), std::back_inserter(times));
  }
  addMedianFrame(std::move(times), stats);
  reportStats(options.stats, stats);
}

void addFrames(CLI::App& command, RenderOptions& options) {
  command
      .add_option_function<std::string>(
          "--frames",
          [&options](const std::string& text) {
            const std::optional<uvec2> pair = pairOf(text, ':');
            if (!pair || pair->y < pair->x || pair->y - pair->x >= 1000000)
              throw CLI::ValidationError("--frames", "'" + text + "' is not FIRST:LAST, such as 0:59");
            options.frames = FrameRange{pair->x, pair->y};
          },
          "A picture for each frame from A to B, at --time + frame / --fps, as OUT.0000.png and so on")
      ->type_name("A:B");
  command.add_option("--fps", options.framesPerSecond, "Frames a second")
      ->check(CLI::Range(0.001, 100000.0))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

Command addRender(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("render", "Draws a picture of a scene, as PNG or as EXR with layers");
  const auto options = std::make_shared<RenderOptions>();
  addScene(*command, options->scene);
  addOutput(
      *command, options->output,
      "OUT.png: exposed and tone-mapped. OUT.exr: 32-bit float luminance in nit: R,G,B the total; "
      "direct.R,G,B and caustics.R,G,B its parts by light that met no caster, and by light that met one; "
      "depth.Z in meters and normal.X,Y,Z of the sample nearest to the pixel's middle");
  addSize(*command, options->size);
  addTime(*command, options->time);
  addFrames(*command, *options);
  addTone(*command, options->tone);
  addTechnique(*command, options->picture);
  addReference(*command, options->reference);
  addResume(*command, options->reference);
  addDevice(*command, options->device);
  addRepeat(*command, options->repeat);
  addStats(*command, options->stats);
  addQuiet(*command, options->isQuiet);
  const CLI::Option *samples = command->get_option("--samples"), *repeat = command->get_option("--repeat");
  return {command, [=] {
            // Frames that are timed are those of a window in which something moves.
            if (repeat->count() > 0 && samples->count() == 0) options->picture.samples.count = 1;
            runRender(*options);
          }};
}

}  // namespace nephroid

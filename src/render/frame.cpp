#include "render/frame.h"

#include <algorithm>

#include "core/stopwatch.h"
#include "render/frame_data.h"
#include "scene/volume.h"

namespace nephroid {
namespace {

// Runs `work` and notes its time under `name`.
template <class Work>
void onHost(std::vector<PassTime>& passes, const char* name, const Work& work) {
  const Stopwatch watch;
  work();
  passes.push_back({name, watch.milliseconds()});
}

// Passes that run several times in a frame as one each, where they first ran.
std::vector<PassTime> summedByName(const std::vector<PassTime>& passes) {
  std::vector<PassTime> sums;
  for (const PassTime& pass : passes) {
    const auto found = std::ranges::find(sums, pass.name, &PassTime::name);
    if (found == sums.end())
      sums.push_back(pass);
    else
      found->milliseconds += pass.milliseconds;
  }
  return sums;
}

void clearRegion(gpu::CommandList& commands, const gpu::Image& image,
                 const std::optional<gpu::Region>& region) {
  if (region)
    commands.render({.colors = {{&image, 0, vec4(0)}}, .region = region}, [] {});
  else
    commands.clear(image, vec4(0));
}

uint32_t shadowMapSizeOf(const RenderSettings& settings) {
  return settings.shadowMapSize > 0 ? settings.shadowMapSize : std::max(settings.size.x, settings.size.y);
}

bool hasTurbidWater(const Scene& scene) {
  return std::ranges::any_of(scene.objects, [&](const Object& object) {
    return object.water && extinctionOf(scene.materialOf(object)) != vec3(0);
  });
}

bool hasEmission(const Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [](const Material& material) { return material.emission != vec3(0); });
}

}  // namespace

Renderer::Renderer(gpu::Device& device, SceneTransport& transport, const RenderSettings& settings,
                   Technique& technique)
    : device_(device),
      transport_(transport),
      technique_(technique),
      settings_(settings),
      hasTurbidWater_(hasTurbidWater(transport.scene())),
      gpuScene_(device, transport.scene()),
      programs_(createFramePrograms(
          device, {hasEmission(transport.scene()), transport.scene().medium.has_value(), hasTurbidWater_})),
      images_(createFrameImages(device, settings.size.x, settings.size.y)),
      isByRays_(settings.sight.method == SightMethod::rays && !technique.traits().coversSquares),
      sight_(device, settings.sight),
      raySight_(device, hasTurbidWater_),
      waysInWater_(device, isByRays_),
      directLight_(device, transport.scene(), shadowMapSizeOf(settings)),
      shafts_(device, transport.scene(), settings.size, settings.shafts) {
  for (const Mesh& mesh : transport.scene().meshes) extents_.push_back(extentOf(mesh));
  technique_.reserve(settings.size);
}

void Renderer::resize(uvec2 size) {
  settings_.size = size;
  lastScene_ = {};
  images_ = createFrameImages(device_, size.x, size.y);
  directLight_.resize(shadowMapSizeOf(settings_));
  shafts_.resize(size);
  technique_.reserve(size);
}

std::vector<PassTime> Renderer::render(const Scene& scene) {
  std::vector<PassTime> passes;
  onHost(passes, "placement", [&] { place(scene); });
  const Remade remade = lastScene_.replace(scene, settings_.keepsLight, technique_.traits().followsCamera);
  onHost(passes, "shadow projections", [&] { directLight_.update(scene, extents_, shafts_.lightsInAir()); });
  if (remade.beams) onHost(passes, "beams", [&] { technique_.update(gpuScene_); });
  if (remade.sight)
    onHost(passes, "sight", [&] {
      if (isByRays_)
        raySight_.update(transport_, view_, settings_.size, extents_);
      else
        sight_.update(transport_, view_, settings_.size, extents_);
      waysInWater_.update(transport_, view_, settings_.size, extents_, casterRegion());
    });
  ensureImages();

  drawFrame(remade, passes);
  constexpr Remade kShadedAlone{.sight = false, .shadowMaps = false, .beams = false};
  while (!technique_.finish()) drawFrame(kShadedAlone, passes);
  return summedByName(passes);
}

void Renderer::place(const Scene& scene) {
  transport_.place(scene);
  view_ = viewOf(scene.camera, settings_.size);
  shafts_.update(scene, view_);
  environment_ = scene.environment;
  exposure_ = scene.camera.exposure;
  gpuScene_.place(scene);
  surfaces_.clear();
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Material& material = scene.materialOf(object);
    if (object.water) extents_[object.mesh] = extentOf(scene.meshOf(object));
    Surface surface{!material.isCaster(), material.colorTexture != kNone, {}};
    surface.constants.vertices = gpuScene_.vertices();
    surface.constants.objects = gpuScene_.objects();
    surface.constants.worldToClip = view_.worldToClip;
    surface.constants.object = i;
    surface.constants.color = material.color;
    surface.constants.material = object.material;
    surfaces_.push_back(surface);
  }
}

void Renderer::ensureImages() {
  const uvec2 size = settings_.size;
  const auto ensure = [&](uint32_t which) {
    if (!images_.seen[which].position) images_.seen[which] = createSeenImages(device_, size.x, size.y);
  };
  if (sight_.reflects()) ensure(kSeenReflected);
  if (sight_.disperses())
    for (const uint32_t channel : {kSeenGreen, kSeenBlue}) ensure(channel);
  if (hasTurbidWater_ && !images_.scattered)
    for (gpu::Image* image : {&images_.wayStart, &images_.wayDirection, &images_.scattered})
      *image = gpu::createImage(device_, "light in water", {.width = size.x, .height = size.y});
}

void Renderer::drawFrame(const Remade& remade, std::vector<PassTime>& passes) {
  const auto onDevice = [&](const std::function<void(gpu::CommandList&)>& record) {
    const std::vector<PassTime> some = device_.submitAndWait(record);
    passes.insert(passes.end(), some.begin(), some.end());
  };
  onDevice([&](gpu::CommandList& commands) {
    if (remade.shadowMaps)
      commands.pass("shadow maps", [&] { directLight_.recordShadowMaps(commands, gpuScene_); });
    if (remade.beams) technique_.record(commands, gpuScene_);
    if (shafts_) commands.pass("depths of the air", [&] { shafts_.recordDepths(commands); });
    if (remade.sight) {
      commands.pass("receivers", [&] { drawReceivers(commands); });
      if (isByRays_)
        raySight_.record(commands, images_);
      else
        sight_.record(commands, gpuScene_, images_);
    }
    if (!shafts_) illuminate(commands);
  });
  if (!shafts_) return;
  onHost(passes, "planes in the air", [&] { shafts_.choosePlanes(directLight_, gpuScene_, images_.depth); });
  onDevice([&](gpu::CommandList& commands) { illuminate(commands); });
}

void Renderer::drawReceivers(gpu::CommandList& commands) {
  const vec4 nothing(0);
  const SeenImages& seen = images_.seen[kSeen];
  commands.render(
      {.colors = {{&seen.position, 0, nothing}, {&seen.normal, 0, nothing}, {&seen.albedo, 0, nothing}},
       .depth = gpu::DepthAttachment{&images_.depth, 0, 0.0f}},
      [&] {
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
          const Surface& surface = surfaces_[i];
          const SceneDraw& draw = gpuScene_.draws()[i];
          if (surface.isReceiver)
            commands.drawIndexed(surface.isTextured ? programs_.texturedReceiver : programs_.receiver,
                                 gpuScene_.indices(), draw.range, 1, surface.constants,
                                 {{"colorTexture", *draw.colorTexture, gpuScene_.textureSampler()}});
        }
      });
}

// What the frame has found is lit, and put together.
void Renderer::illuminate(gpu::CommandList& commands) {
  if (hasTurbidWater_) {
    commands.clear(images_.wayStart, vec4(0));
    commands.clear(images_.scattered, vec4(0));
  }
  const auto lightSeen = [&](uint32_t which, const std::optional<gpu::Region>& region) {
    const SeenImages& seen = images_.seen[which];
    light(commands, {&seen.position, &seen.normal, region}, seen.directLux, seen.causticsLux);
  };
  lightSeen(kSeen, std::nullopt);
  if (isByRays_ && raySight_.hasPoints())
    light(commands, raySight_.points(), raySight_.directLux(), raySight_.causticsLux());
  if (sight_.reflects()) lightSeen(kSeenReflected, sight_.region());
  if (sight_.disperses())
    for (const uint32_t channel : {kSeenGreen, kSeenBlue}) lightSeen(channel, sight_.region());
  const CasterImages casters = isByRays_ ? raySight_.casterImages() : sight_.casterImages();
  for (const WaterInSight& water : waysInWater_.waters()) {
    commands.pass("ways in water", [&] {
      waysInWater_.record(commands, water, images_, casters, images_.wayStart, images_.wayDirection);
    });
    technique_.scatter(commands, {&images_.wayStart, &images_.wayDirection, water.object}, images_.scattered);
  }
  if (shafts_)
    commands.pass("shafts", [&] { shafts_.record(commands, directLight_, gpuScene_, images_.depth); });
  commands.pass("composite", [&] { composite(commands, programs_.picture, {&images_.picture}); });
}

void Renderer::light(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& directLux,
                     const gpu::Image& causticsLux) {
  commands.pass("direct light", [&] {
    clearRegion(commands, causticsLux, points.region);
    directLight_.record(commands, gpuScene_, points, directLux);
  });
  technique_.shade(commands, points, causticsLux);
}

// Everywhere as if there were no casters, then again where there may be.
void Renderer::composite(gpu::CommandList& commands, const std::map<CasterTraits, gpu::Program>& programs,
                         const std::vector<const gpu::Image*>& targets) {
  const SeenImages& seen = images_.seen[kSeen];
  // For those that are not there, and not read, the first stand in.
  const auto ofEach = [&](gpu::Image SeenImages::*image) {
    std::vector<const gpu::Image*> all;
    for (const SeenImages& one : images_.seen) all.push_back(one.position ? &(one.*image) : &(seen.*image));
    return all;
  };
  const auto draw = [&](const CasterTraits& traits, const gpu::Region& region) {
    gpu::RenderTargets rendered;
    for (const gpu::Image* target : targets) rendered.colors.push_back({target, 0, std::nullopt});
    rendered.region = region;
    commands.render(rendered, [&] {
      commands.draw(programs.at(traits), 3, 1,
                    CompositeConstants{gpuScene_.materials(), environment_.ambient, environment_.background,
                                       exposure_, waysInWater_.extinctionAtEye()},
                    {{"normal", ofEach(&SeenImages::normal)},
                     {"albedo", ofEach(&SeenImages::albedo)},
                     {"transmittance", ofEach(&SeenImages::transmittance)},
                     {"directLux", ofEach(&SeenImages::directLux)},
                     {"causticsLux", ofEach(&SeenImages::causticsLux)},
                     {"sightRest", raySight_.rest()},
                     {"sightRanges", raySight_.ranges()},
                     {"pointFactors", raySight_.factors()},
                     {"pointDirectLux", raySight_.directLux()},
                     {"pointCausticsLux", raySight_.causticsLux()},
                     {"shafts", shafts_ ? shafts_.image() : seen.albedo},
                     {"wayStart", hasTurbidWater_ ? images_.wayStart : seen.albedo},
                     {"scattered", hasTurbidWater_ ? images_.scattered : seen.albedo}});
    });
  };
  draw({}, {{0, 0}, settings_.size});
  if (casterRegion().size.x == 0) return;
  commands.barrier();
  draw({true, sight_.reflects() || sight_.disperses(), sight_.disperses(), isByRays_}, casterRegion());
}

}  // namespace nephroid

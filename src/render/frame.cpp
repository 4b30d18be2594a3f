#include "render/frame.h"

#include <algorithm>
#include <cmath>

#include "core/interrupt.h"
#include "core/stopwatch.h"
#include "render/frame_data.h"
#include "render/metering.h"
#include "render/samples/sample_places.h"
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

// Passes that run several times in a sample as one each, where they first ran.
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

// Adds the passes of one more sample to those of the samples before.
void addSampleTimes(const std::vector<PassTime>& sample, std::vector<PassTime>& all) {
  for (const PassTime& pass : summedByName(sample)) {
    const auto found = std::ranges::find(all, pass.name, &PassTime::name);
    if (found == all.end()) {
      all.push_back(pass);
    } else {
      found->milliseconds += pass.milliseconds;
      ++found->samples;
    }
  }
}

// What is made again for another sample of the same frame.
constexpr Remade kSightAlone{.sight = true, .lamps = false, .shadowMaps = false, .beams = false};

// The parts of a picture outside of `inner`, in at most four rectangles.
std::vector<gpu::Region> around(const gpu::Region& inner, uvec2 size) {
  if (inner.size.x == 0) return {{{0, 0}, size}};
  const ivec2 low = inner.corner, high = inner.corner + ivec2(inner.size), end(size);
  std::vector<gpu::Region> parts;
  const auto add = [&](ivec2 from, ivec2 to) {
    if (from.x < to.x && from.y < to.y) parts.push_back({from, uvec2(to - from)});
  };
  add({0, 0}, {end.x, low.y});
  add({0, low.y}, {low.x, high.y});
  add({high.x, low.y}, {end.x, high.y});
  add({0, high.y}, end);
  return parts;
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
      isByRays_(settings.sight.method == SightMethod::rays && !technique.traits().coversSquares),
      luminance_{hasEmission(transport.scene()), transport.scene().medium.has_value(), hasTurbidWater_,
                 isByRays_},
      tone_(transport.scene().camera.tone),
      programs_(createFramePrograms(device, luminance_, tone_)),
      images_(createFrameImages(device, settings.size.x, settings.size.y)),
      sight_(device, settings.sight),
      raySight_(device, hasTurbidWater_),
      waysInWater_(device, isByRays_),
      lampShadows_(device),
      sky_(device, transport.scene()),
      directLight_(device, transport.scene(), shadowMapSizeOf(settings)),
      shafts_(device, transport.scene(), settings.size, settings.shafts),
      sums_(device, tone_) {
  sums_.resize(settings.size);
  lampShadows_.resize(settings.size);
  for (const Mesh& mesh : transport.scene().meshes) extents_.push_back(extentOf(mesh));
  technique_.reserve(settings.size);
}

void Renderer::resize(uvec2 size) {
  settings_.size = size;
  lastScene_ = {};
  images_ = createFrameImages(device_, size.x, size.y);
  directLight_.resize(shadowMapSizeOf(settings_));
  shafts_.resize(size);
  lampShadows_.resize(size);
  sums_.resize(size);
  seenAt_.reset();
  technique_.reserve(size);
}

std::vector<PassTime> Renderer::render(const Scene& scene) {
  try {
    return draw(scene);
  } catch (...) {
    lastScene_ = {};
    seenAt_.reset();
    throw;
  }
}

std::vector<PassTime> Renderer::draw(const Scene& scene) {
  std::vector<PassTime> passes;
  onHost(passes, "placement", [&] { place(scene); });
  sums_.begin();
  Remade remade = lastScene_.replace(scene, settings_.keepsLight, technique_.traits().followsCamera);
  remade.sight |= hasOtherSky_;
  onHost(passes, "shadow projections", [&] {
    lampShadows_.update(transport_.scene(), extents_);
    directLight_.update(scene, extents_, shafts_.lightsInAir(), lampShadows_);
  });
  if (remade.beams) onHost(passes, "beams", [&] { technique_.update(gpuScene_); });
  arePlanesInAirChosen_ = false;
  const bool isMetered = !scene.camera.exposure;
  sample_ = {};
  if (isMetered || settings_.samples == 1) drawSample(vec2(0), 1, remade, passes);
  if (isMetered) meter(passes);
  if (settings_.samples > 1) {
    places_ = samplePlaces(settings_.samples);
    addSample(isMetered ? kSightAlone : remade, passes);
    std::vector<PassTime> all = summedByName(passes);
    while (sums_.count() < settings_.samples) {
      throwIfInterrupted();
      passes.clear();
      addSample(kSightAlone, passes);
      addSampleTimes(passes, all);
    }
    drawMean(all);
    return all;
  }
  const std::vector<PassTime> last = device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("composite", [&] { composite(commands, programs_.picture, {&images_.picture}, {}); });
  });
  passes.insert(passes.end(), last.begin(), last.end());
  return summedByName(passes);
}

std::vector<PassTime> Renderer::gather(uint32_t samples) {
  if (places_.size() != samples) {
    places_ = samplePlaces(samples);
    sums_.begin();
  }
  std::vector<PassTime> passes;
  addSample(kSightAlone, passes);
  drawMean(passes);
  return summedByName(passes);
}

// The next one of those in `places_`.
void Renderer::addSample(const Remade& remade, std::vector<PassTime>& passes) {
  sample_ = {sums_.count(), uint32_t(places_.size())};
  drawSample(places_.at(sample_.index), 1 / std::sqrt(float(places_.size())), remade, passes);
  for (const PassTime& pass : addLayers()) passes.push_back(pass);
}

void Renderer::drawMean(std::vector<PassTime>& passes) {
  const std::vector<PassTime> last = device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("mean of samples", [&] { sums_.recordMean(commands, exposure_, images_.picture); });
  });
  passes.insert(passes.end(), last.begin(), last.end());
}

// Of the sample that was drawn last. The planes in the air are then chosen as if it had not been.
void Renderer::meter(std::vector<PassTime>& passes) {
  for (const PassTime& pass : addLayers()) passes.push_back(pass);
  onHost(passes, "metering", [&] { exposure_ = meteredExposure(sums_.luminances()); });
  sums_.begin();
  arePlanesInAirChosen_ = false;
}

// Finds and lights what the pixels see at this place (pixels, from their middles), where the pixels have
// places that are so far apart (pixels).
void Renderer::drawSample(vec2 at, float spacing, Remade remade, std::vector<PassTime>& passes) {
  remade.sight = remade.sight || seenAt_ != at;
  if (remade.sight) {
    look(at, spacing);
    onHost(passes, "sight", [&] {
      if (isByRays_)
        raySight_.update(transport_, view_, settings_.size, extents_, sky_);
      else
        sight_.update(transport_, view_, settings_.size, extents_);
      if (hasTurbidWater_) waysInWater_.update(transport_, view_, settings_.size, extents_, casterRegion());
    });
  }
  ensureImages();
  drawFrame(remade, passes);
  constexpr Remade kShadedAlone{.sight = false, .lamps = false, .shadowMaps = false, .beams = false};
  while (!technique_.finish()) drawFrame(kShadedAlone, passes);
}

void Renderer::look(vec2 at, float spacing) {
  seenAt_ = at;
  view_ = at == vec2(0) ? middleView_ : viewAt(middleView_, at, settings_.size);
  shafts_.look(view_);
  sky_.look(view_, settings_.size, spacing);
  for (Surface& surface : surfaces_) surface.constants.worldToClip = view_.worldToClip;
}

void Renderer::place(const Scene& scene) {
  transport_.place(scene);
  middleView_ = viewOf(scene.camera, settings_.size);
  shafts_.update(scene, middleView_);
  environment_ = scene.environment;
  exposure_ = scene.camera.exposure.value_or(1.0f);
  setTone(scene.camera.tone);
  hasOtherSky_ = sky_.update(scene);
  gpuScene_.place(scene);
  surfaces_.clear();
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Material& material = scene.materialOf(object);
    if (object.water) extents_[object.mesh] = extentOf(scene.meshOf(object));
    Surface surface{!material.isCaster(), material.colorTexture != kNone, {}};
    surface.constants.vertices = gpuScene_.vertices();
    surface.constants.objects = gpuScene_.objects();
    surface.constants.object = i;
    surface.constants.color = material.color;
    surface.constants.material = object.material;
    surfaces_.push_back(surface);
  }
}

void Renderer::setTone(ToneCurve tone) {
  if (tone == tone_) return;
  programs_.picture = createPicturePrograms(device_, luminance_, tone);
  sums_.setTone(tone);
  tone_ = tone;
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
    for (const PassTime& pass : device_.submitAndWait(record)) passes.push_back(pass);
  };
  // What the host has to do before the surfaces can be lit.
  const bool looksAtLamps = lampShadows_.isAny() && (remade.sight || remade.lamps);
  const bool choosesPlanes = shafts_ && !std::exchange(arePlanesInAirChosen_, true);
  onDevice([&](gpu::CommandList& commands) {
    if (remade.shadowMaps)
      commands.pass("shadow maps", [&] { directLight_.recordShadowMaps(commands, gpuScene_); });
    if (remade.beams) technique_.record(commands, gpuScene_);
    if (shafts_) commands.pass("depths of the air", [&] { shafts_.recordDepths(commands); });
    if (remade.sight) {
      commands.pass("receivers", [&] { drawReceivers(commands); });
      if (sky_.isSeen()) commands.pass("sky", [&] { sky_.record(commands, images_); });
      if (isByRays_)
        raySight_.record(commands, images_);
      else
        sight_.record(commands, gpuScene_, images_, sky_);
    }
    if (looksAtLamps)
      commands.pass("points to be lit", [&] {
        for (const LitView& lit : litViews())
          if (lit.view != kSeenByRays) lampShadows_.recordPoints(commands, lit.view, lit.points);
      });
    if (!looksAtLamps && !choosesPlanes) illuminate(commands);
  });
  if (!looksAtLamps && !choosesPlanes) return;
  if (looksAtLamps) onHost(passes, "shadows", [&] { lookAtLamps(); });
  if (choosesPlanes)
    onHost(passes, "planes in the air",
           [&] { shafts_.choosePlanes(directLight_, gpuScene_, images_.depth); });
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

// What the frame has found is lit.
void Renderer::illuminate(gpu::CommandList& commands) {
  if (hasTurbidWater_) {
    commands.clear(images_.wayStart, vec4(0));
    commands.clear(images_.scattered, vec4(0));
  }
  const std::vector<LitView> views = litViews();
  if (lampShadows_.isAny()) commands.pass("direct light", [&] { lampShadows_.recordParts(commands); });
  for (const LitView& lit : views) {
    commands.pass("direct light", [&] {
      clearRegion(commands, *lit.causticsLux, lit.points.region);
      directLight_.record(commands, gpuScene_, lit.view, lit.points, *lit.directLux);
    });
    technique_.shade(commands, lit.points, *lit.causticsLux);
  }
  const CasterImages casters = isByRays_ ? raySight_.casterImages() : sight_.casterImages();
  for (const WaterInSight& water : waysInWater_.waters()) {
    commands.pass("ways in water", [&] {
      waysInWater_.record(commands, water, images_, casters, images_.wayStart, images_.wayDirection);
    });
    technique_.scatter(commands, {&images_.wayStart, &images_.wayDirection, water.object}, images_.scattered);
  }
  if (shafts_)
    commands.pass("shafts", [&] { shafts_.record(commands, directLight_, gpuScene_, images_.depth); });
}

// Where there are no casters as if there were none at all, which is less work.
void Renderer::composite(gpu::CommandList& commands, const std::map<CasterTraits, gpu::Program>& programs,
                         const std::vector<const gpu::Image*>& targets, const std::optional<vec4>& clear) {
  const SeenImages& seen = images_.seen[kSeen];
  // For those that are not there, and not read, the first stand in.
  const auto ofEach = [&](gpu::Image SeenImages::*image) {
    std::vector<const gpu::Image*> all;
    for (const SeenImages& one : images_.seen) all.push_back(one.position ? &(one.*image) : &(seen.*image));
    return all;
  };
  const auto draw = [&](const CasterTraits& traits, const gpu::Region& region) {
    gpu::RenderTargets rendered;
    for (const gpu::Image* target : targets) rendered.colors.push_back({target, 0, clear});
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
  for (const gpu::Region& part : around(casterRegion(), settings_.size)) {
    draw({}, part);
    commands.barrier();
  }
  if (casterRegion().size.x == 0) return;
  draw({true, sight_.reflects() || sight_.disperses(), sight_.disperses(), isByRays_}, casterRegion());
}

// Adds what was seen and lit last to the sums.
std::vector<PassTime> Renderer::addLayers() {
  const std::optional<vec4> nothing = sums_.count() == 0 ? std::optional(vec4(0)) : std::nullopt;
  const std::vector<const gpu::Image*> sums = sums_.add();
  return device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("composite", [&] { composite(commands, programs_.layers, sums, nothing); });
  });
}

}  // namespace nephroid

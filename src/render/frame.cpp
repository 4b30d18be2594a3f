#include "render/frame.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "core/stopwatch.h"
#include "gpu/transfer.h"
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

RenderSettings renderSettings(const TechniqueSettings& settings, uvec2 size) {
  RenderSettings render;
  render.size = size;
  render.sight.slices = settings.slices;
  render.shafts = {settings.airPlanes, settings.airSubplanes, float(settings.airError) / 1000};
  return render;
}

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
      sight_(device, settings.sight),
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
  const Remade remade = lastScene_.replace(scene, settings_.keepsLight, technique_.followsCamera());
  onHost(passes, "placement", [&] { place(scene); });
  onHost(passes, "shadow projections", [&] { directLight_.update(scene, extents_, shafts_.lightsInAir()); });
  if (remade.beams) onHost(passes, "beams", [&] { technique_.update(gpuScene_); });
  if (remade.sight)
    onHost(passes, "sight", [&] { sight_.update(transport_, view_, settings_.size, extents_); });
  ensureImages();

  drawFrame(remade, passes);
  constexpr Remade kShadedAlone{.sight = false, .shadowMaps = false, .beams = false};
  while (!technique_.finish()) drawFrame(kShadedAlone, passes);
  return summedByName(passes);
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
      sight_.record(commands, gpuScene_, images_);
    }
    if (!shafts_) illuminate(commands);
  });
  if (!shafts_) return;
  onHost(passes, "planes in the air", [&] { shafts_.choosePlanes(directLight_, gpuScene_, images_.depth); });
  onDevice([&](gpu::CommandList& commands) { illuminate(commands); });
}

// What the frame has found is lit, and put together.
void Renderer::illuminate(gpu::CommandList& commands) {
  if (hasTurbidWater_) {
    commands.clear(images_.wayStart, vec4(0));
    commands.clear(images_.scattered, vec4(0));
  }
  light(commands, images_.seen[kSeen], std::nullopt);
  if (sight_.reflects()) light(commands, images_.seen[kSeenReflected], sight_.region());
  if (sight_.disperses())
    for (const uint32_t channel : {kSeenGreen, kSeenBlue})
      light(commands, images_.seen[channel], sight_.region());
  for (const WaterInSight& water : sight_.waters()) {
    commands.pass("ways in water", [&] {
      sight_.recordWays(commands, water, images_, images_.wayStart, images_.wayDirection);
    });
    technique_.scatter(commands, {&images_.wayStart, &images_.wayDirection, water.object}, images_.scattered);
  }
  if (shafts_)
    commands.pass("shafts", [&] { shafts_.record(commands, directLight_, gpuScene_, images_.depth); });
  commands.pass("composite", [&] { composite(commands, programs_.picture, {&images_.picture}); });
}

void Renderer::place(const Scene& scene) {
  view_ = viewOf(scene.camera, settings_.size);
  shafts_.update(scene, view_);
  environment_ = scene.environment;
  exposure_ = scene.camera.exposure;
  transport_.place(scene);
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

void Renderer::light(gpu::CommandList& commands, const SeenImages& seen,
                     const std::optional<gpu::Region>& region) {
  const ReceiverPoints points{&seen.position, &seen.normal, region};
  commands.pass("direct light", [&] {
    clearRegion(commands, seen.causticsLux, region);
    directLight_.record(commands, gpuScene_, points, seen.directLux);
  });
  technique_.shade(commands, points, seen.causticsLux);
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
  const bool isEyeInWater = !sight_.waters().empty() && sight_.waters().back().constants.kind == kWayFromEye;
  const vec3 extinctionAtEye = isEyeInWater ? sight_.waters().back().extinction : vec3(0);
  const auto draw = [&](const CasterTraits& traits, const gpu::Region& region) {
    gpu::RenderTargets rendered;
    for (const gpu::Image* target : targets) rendered.colors.push_back({target, 0, std::nullopt});
    rendered.region = region;
    commands.render(rendered, [&] {
      commands.draw(programs.at(traits), 3, 1,
                    CompositeConstants{gpuScene_.materials(), environment_.ambient, environment_.background,
                                       exposure_, extinctionAtEye},
                    {{"normal", ofEach(&SeenImages::normal)},
                     {"albedo", ofEach(&SeenImages::albedo)},
                     {"transmittance", ofEach(&SeenImages::transmittance)},
                     {"directLux", ofEach(&SeenImages::directLux)},
                     {"causticsLux", ofEach(&SeenImages::causticsLux)},
                     {"shafts", shafts_ ? shafts_.image() : seen.albedo},
                     {"wayStart", hasTurbidWater_ ? images_.wayStart : seen.albedo},
                     {"scattered", hasTurbidWater_ ? images_.scattered : seen.albedo}});
    });
  };
  draw({}, {{0, 0}, settings_.size});
  if (sight_.region().size.x == 0) return;
  commands.barrier();
  draw({true, sight_.reflects() || sight_.disperses(), sight_.disperses()}, sight_.region());
}

ByteImage Renderer::picture() const {
  const auto texels = gpu::download<std::array<uint8_t, 4>>(device_, images_.picture);
  ByteImage picture{settings_.size.x, settings_.size.y, 3, {}};
  picture.bytes.reserve(3 * texels.size());
  for (const auto& texel : texels)
    picture.bytes.insert(picture.bytes.end(), texel.begin(), texel.begin() + 3);
  return picture;
}

std::vector<PassOutput> Renderer::outputs() const {
  const float exposure = exposure_ / glm::pi<float>();  // of lux, as white paper shows them
  const SeenImages& seen = images_.seen[kSeen];
  std::vector<PassOutput> all;
  for (const gpu::Image* map : directLight_.shadowMaps())
    all.push_back({"shadow maps", "depths from a light", map, kShowDepth});
  for (const PassOutput& output : technique_.outputs()) all.push_back(output);
  all.insert(all.end(), {{"receivers", "albedo", &seen.albedo, kShowFactor},
                         {"receivers", "normals", &seen.normal, kShowDirection},
                         {"receivers", "positions", &seen.position, kShowPlace},
                         {"receivers", "depth", &images_.depth, kShowNearness}});
  if (sight_.region().size.x > 0)
    all.insert(all.end(), {{"casters", "normals", &images_.casterNormal, kShowDirection},
                           {"seen through casters", "transmittance", &seen.transmittance, kShowFactor}});
  if (sight_.reflects())
    all.insert(all.end(),
               {{"reflected by casters", "albedo", &images_.seen[kSeenReflected].albedo, kShowFactor},
                {"reflected by casters", "normals", &images_.seen[kSeenReflected].normal, kShowDirection}});
  all.insert(all.end(), {{"direct light", "lux", &seen.directLux, kShowLight, exposure},
                         {"caustics", "lux", &seen.causticsLux, kShowLight, exposure}});
  if (hasTurbidWater_)
    all.push_back({"light in water", "luminance", &images_.scattered, kShowLight, exposure_});
  if (shafts_) all.push_back({"shafts", "luminance", &shafts_.image(), kShowLight, exposure_});
  all.push_back({"composite", "picture", &images_.picture, kShowPicture});
  return all;
}

namespace {

void writeChannels(Image& layers, const std::string& prefix, std::string_view names,
                   const std::vector<vec4>& texels) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::vector<float>& values = layers.channel(prefix + names[c]);
    for (std::size_t i = 0; i < texels.size(); ++i) values[i] = texels[i][static_cast<int>(c)];
  }
}

}  // namespace

std::vector<vec4> Renderer::shaftsLuminance() const {
  const std::size_t pixels = std::size_t{settings_.size.x} * settings_.size.y;
  std::vector<vec4> luminance =
      shafts_ ? gpu::download<vec4>(device_, shafts_.image()) : std::vector<vec4>(pixels, vec4(0, 0, 0, 1));
  if (!hasTurbidWater_) return luminance;
  const auto inWater = gpu::download<vec4>(device_, images_.scattered);
  for (std::size_t i = 0; i < pixels; ++i) luminance[i] += luminance[i].a * inWater[i];
  return luminance;
}

Image Renderer::layers() {
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("layers", [&] {
      composite(commands, programs_.layers,
                {&images_.luminance, &images_.directLuminance, &images_.causticsLuminance});
    });
  });
  Image layers;
  layers.width = settings_.size.x;
  layers.height = settings_.size.y;
  writeChannels(layers, "", "RGB", gpu::download<vec4>(device_, images_.luminance));
  writeChannels(layers, "direct.", "RGB", gpu::download<vec4>(device_, images_.directLuminance));
  writeChannels(layers, "caustics.", "RGB", gpu::download<vec4>(device_, images_.causticsLuminance));
  writeChannels(layers, "shafts.", "RGB", shaftsLuminance());

  auto normals = gpu::download<vec4>(device_, images_.seen[kSeen].normal);
  const auto casterNormals = gpu::download<vec4>(device_, images_.casterNormal);
  const gpu::Region& region = sight_.region();
  const uvec2 first(region.corner);
  for (uint32_t y = first.y; y < first.y + region.size.y; ++y)
    for (uint32_t x = first.x; x < first.x + region.size.x; ++x) {
      const std::size_t i = std::size_t{y} * settings_.size.x + x;
      if (casterNormals[i].a != 0) normals[i] = casterNormals[i];
    }
  std::vector<vec4> depths;
  for (const float depth : gpu::download<float>(device_, images_.depth))
    depths.emplace_back(depth > 0 ? view_.nearest / depth : 0.0f);
  writeChannels(layers, "depth.", "Z", depths);
  writeChannels(layers, "normal.", "XYZ", normals);
  return layers;
}

}  // namespace nephroid

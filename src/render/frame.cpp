#include "render/frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/transfer.h"
#include "render/frame_data.h"

namespace nephroid {
namespace {

// Infinitely far, and near enough for anything beyond a ten-thousandth of the distance to what is looked at.
View viewOf(const Camera& camera, uvec2 size) {
  View view;
  view.eye = camera.position;
  view.forward = normalize(camera.target - camera.position);
  const float tangent = std::tan(0.5f * glm::radians(camera.verticalFov));
  const vec3 up = std::abs(dot(view.forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
  const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
  view.nearest = 1e-4f * distance(camera.target, camera.position);
  mat4 projection(0);
  projection[0][0] = 1 / (tangent * aspect);
  projection[1][1] = -1 / tangent;
  projection[2][3] = -1;
  projection[3][2] = view.nearest;
  view.worldToClip = projection * glm::lookAtRH(camera.position, camera.target, up);
  return view;
}

// The pixels that the boxes of casters may cover.
gpu::Region casterRegion(const Scene& scene, const std::vector<MeshExtent>& extents, const View& view,
                         uvec2 size) {
  vec2 low(std::numeric_limits<float>::infinity());
  vec2 high = -low;
  for (const Object& object : scene.objects) {
    if (!scene.isCaster(object)) continue;
    const MeshExtent& extent = extents[object.mesh];
    for (int i = 0; i < 8; ++i) {
      const vec3 corner((i & 1 ? extent.high : extent.low).x, (i & 2 ? extent.high : extent.low).y,
                        (i & 4 ? extent.high : extent.low).z);
      const vec4 clip = view.worldToClip * vec4(object.placement.point(corner), 1);
      if (clip.w < view.nearest) return {{0, 0}, size};
      const vec2 pixel = (0.5f * vec2(clip) / clip.w + 0.5f) * vec2(size);
      low = glm::min(low, pixel);
      high = glm::max(high, pixel);
    }
  }
  const vec2 first = glm::clamp(glm::floor(low) - 1.0f, vec2(0), vec2(size));
  const vec2 last = glm::clamp(glm::ceil(high) + 1.0f, vec2(0), vec2(size));
  if (!(first.x < last.x && first.y < last.y)) return {};
  return {ivec2(first), uvec2(last - first)};
}

// Runs `work` and notes its time under `name`.
template <class Work>
void onHost(std::vector<PassTime>& passes, const char* name, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  passes.push_back(
      {name, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()});
}

vec3 surfaceColor(const Material& material) {
  if (material.type != MaterialType::dielectric) return material.color;
  return -glm::log(glm::max(material.attenuationColor, vec3(1e-6f))) * material.inverseAttenuationDistance();
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
      gpuScene_(device, transport.scene()),
      programs_(createFramePrograms(device, hasEmission(transport.scene()))),
      images_(createFrameImages(device, settings.size.x, settings.size.y)),
      directLight_(device, settings.shadowMapSize) {
  for (const Mesh& mesh : transport.scene().meshes) extents_.push_back(extentOf(mesh));
}

std::vector<PassTime> Renderer::render(const Scene& scene) {
  std::vector<PassTime> passes;
  onHost(passes, "placement", [&] { place(scene); });
  onHost(passes, "shadow projections", [&] { directLight_.update(scene, extents_); });
  onHost(passes, "beams", [&] { technique_.update(gpuScene_); });

  const std::vector<PassTime> onDevice = device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("shadow maps", [&] { directLight_.recordShadowMaps(commands, gpuScene_); });
    technique_.record(commands, gpuScene_);
    commands.pass("receivers", [&] { drawReceivers(commands); });
    commands.pass("casters", [&] { drawCasters(commands); });
    const ReceiverPoints points{&images_.receiverPosition, &images_.receiverNormal};
    commands.pass("direct light", [&] {
      commands.clear(images_.causticsLux, vec4(0));
      directLight_.record(commands, points, images_.directLux);
    });
    technique_.shade(commands, points, images_.causticsLux);
    commands.pass("composite", [&] { composite(commands, false); });
  });
  passes.insert(passes.end(), onDevice.begin(), onDevice.end());
  return passes;
}

void Renderer::place(const Scene& scene) {
  view_ = viewOf(scene.camera, settings_.size);
  environment_ = scene.environment;
  exposure_ = scene.camera.exposure;
  transport_.place(scene);
  gpuScene_.place(scene);
  surfaces_.clear();
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Material& material = scene.materialOf(object);
    if (object.water) extents_[object.mesh] = extentOf(scene.meshOf(object));
    Surface surface{material.type, material.colorTexture != kNone, {}};
    surface.constants.vertices = gpuScene_.vertices();
    surface.constants.objects = gpuScene_.objects();
    surface.constants.worldToClip = view_.worldToClip;
    surface.constants.eye = view_.eye;
    surface.constants.object = i;
    surface.constants.color = surfaceColor(material);
    surface.constants.ior = material.ior.y;
    surface.constants.material = object.material;
    surfaces_.push_back(surface);
  }
  casterRegion_ = casterRegion(scene, extents_, view_, settings_.size);
}

void Renderer::drawSurfaces(gpu::CommandList& commands, const gpu::Program& program, MaterialType type) {
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const Surface& surface = surfaces_[i];
    const SceneDraw& draw = gpuScene_.draws()[i];
    if (surface.type != type) continue;
    const auto drawWith = [&](const gpu::Program& chosen, gpu::Bindings bindings) {
      commands.drawIndexed(chosen, gpuScene_.indices(), draw.range, 1, surface.constants, bindings);
    };
    if (type == MaterialType::diffuse)
      drawWith(surface.isTextured ? programs_.texturedReceiver : program,
               {{*draw.colorTexture, gpuScene_.textureSampler()}});
    else if (&program == &programs_.dielectric)
      drawWith(program, {images_.receiverPosition});
    else
      drawWith(program, {});
  }
}

void Renderer::drawReceivers(gpu::CommandList& commands) {
  const vec4 nothing(0);
  commands.render({.colors = {{&images_.receiverPosition, 0, nothing},
                              {&images_.receiverNormal, 0, nothing},
                              {&images_.receiverAlbedo, 0, nothing}},
                   .depth = gpu::DepthAttachment{&images_.depth, 0, 0.0f}},
                  [&] { drawSurfaces(commands, programs_.receiver, MaterialType::diffuse); });
}

// Mirrors first, then all the glass in front of them and of the receivers.
void Renderer::drawCasters(gpu::CommandList& commands) {
  if (casterRegion_.size.x == 0) return;
  commands.render({.colors = {{&images_.opticalDepth, 0, vec4(0)}, {&images_.casterReflectance, 0, vec4(0)}},
                   .depth = gpu::DepthAttachment{&images_.depth, 0, std::nullopt},
                   .region = casterRegion_},
                  [&] {
                    drawSurfaces(commands, programs_.mirror, MaterialType::mirror);
                    drawSurfaces(commands, programs_.dielectric, MaterialType::dielectric);
                  });
}

void Renderer::drawNearestCasters(gpu::CommandList& commands) {
  if (casterRegion_.size.x == 0) return;
  commands.render({.colors = {{&images_.casterNormal, 0, vec4(0)}},
                   .depth = gpu::DepthAttachment{&images_.depth, 0, std::nullopt},
                   .region = casterRegion_},
                  [&] {
                    drawSurfaces(commands, programs_.nearestCaster, MaterialType::mirror);
                    drawSurfaces(commands, programs_.nearestCaster, MaterialType::dielectric);
                  });
}

// Everywhere as if there were no casters, then again where there may be.
void Renderer::composite(gpu::CommandList& commands, bool writesLayers) {
  const gpu::Region whole{{0, 0}, settings_.size};
  for (const bool seesCasters : {false, true}) {
    const gpu::Region region = seesCasters ? casterRegion_ : whole;
    if (seesCasters) commands.barrier();
    commands.dispatch(programs_.composite[writesLayers][seesCasters], {region.size, 1},
                      CompositeConstants{gpuScene_.materials(), region.corner, ivec2(region.size),
                                         environment_.ambient, environment_.background, exposure_},
                      {images_.receiverAlbedo, images_.directLux, images_.causticsLux,
                       images_.casterReflectance, images_.opticalDepth, images_.picture, images_.luminance,
                       images_.directLuminance, images_.causticsLuminance});
  }
}

ByteImage Renderer::picture() const {
  const auto texels = gpu::download<std::array<uint8_t, 4>>(device_, images_.picture);
  ByteImage picture{settings_.size.x, settings_.size.y, 3, {}};
  picture.bytes.reserve(3 * texels.size());
  for (const auto& texel : texels)
    picture.bytes.insert(picture.bytes.end(), texel.begin(), texel.begin() + 3);
  return picture;
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

Image Renderer::layers() {
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("layers", [&] {
      composite(commands, true);
      drawNearestCasters(commands);
    });
  });
  Image layers;
  layers.width = settings_.size.x;
  layers.height = settings_.size.y;
  writeChannels(layers, "", "RGB", gpu::download<vec4>(device_, images_.luminance));
  writeChannels(layers, "direct.", "RGB", gpu::download<vec4>(device_, images_.directLuminance));
  writeChannels(layers, "caustics.", "RGB", gpu::download<vec4>(device_, images_.causticsLuminance));

  auto normals = gpu::download<vec4>(device_, images_.receiverNormal);
  const auto casterNormals = gpu::download<vec4>(device_, images_.casterNormal);
  const uvec2 first(casterRegion_.corner);
  for (uint32_t y = first.y; y < first.y + casterRegion_.size.y; ++y)
    for (uint32_t x = first.x; x < first.x + casterRegion_.size.x; ++x) {
      const std::size_t i = std::size_t{y} * settings_.size.x + x;
      if (casterNormals[i].a > 0) normals[i] = casterNormals[i];
    }
  std::vector<vec4> depths;
  for (const float depth : gpu::download<float>(device_, images_.depth))
    depths.emplace_back(depth > 0 ? view_.nearest / depth : 0.0f);
  writeChannels(layers, "depth.", "Z", depths);
  writeChannels(layers, "normal.", "XYZ", normals);
  return layers;
}

}  // namespace nephroid

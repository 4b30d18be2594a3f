#include "render/frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/transfer.h"

namespace nephroid {
namespace {

// Infinitely far, and near enough for anything beyond a ten-thousandth of the distance to what is looked at.
View viewOf(const Camera& camera, uvec2 size) {
  View view;
  view.eye = camera.position;
  view.forward = normalize(camera.target - camera.position);
  const float tangent = std::tan(0.5f * glm::radians(camera.verticalFov));
  const vec3 up = std::abs(dot(view.forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
  const vec3 right = normalize(cross(view.forward, up));
  const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
  view.right = tangent * aspect * right;
  view.up = tangent * cross(right, view.forward);

  const float nearest = 1e-4f * distance(camera.target, camera.position);
  mat4 projection(0);
  projection[0][0] = 1 / (tangent * aspect);
  projection[1][1] = -1 / tangent;
  projection[2][3] = -1;
  projection[3][2] = nearest;
  view.worldToClip = projection * glm::lookAtRH(camera.position, camera.target, up);
  return view;
}

// Runs `work` and notes its time under `name`.
template <class Work>
void onHost(std::vector<PassTime>& passes, const char* name, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  passes.push_back(
      {name, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()});
}

// Grows `buffer` to hold `values` and writes them.
template <class T>
void writeList(gpu::Device& device, gpu::Buffer& buffer, const char* name, const std::vector<T>& values) {
  const std::size_t bytes = values.size() * sizeof(T);
  if (!buffer || buffer.size() < bytes)
    buffer = gpu::createBuffer(device, name, bytes, gpu::MemoryKind::upload);
  buffer.write(values);
}

}  // namespace

Renderer::Renderer(gpu::Device& device, const Scene& scene, const RenderSettings& settings,
                   Technique& technique)
    : device_(device),
      technique_(technique),
      settings_(settings),
      gpuScene_(device, scene),
      programs_(createFramePrograms(device)),
      images_(createFrameImages(device, settings.size.x, settings.size.y)),
      shadowSampler_(gpu::createSampler(device, {.compare = VK_COMPARE_OP_LESS_OR_EQUAL})) {
  for (const Mesh& mesh : scene.meshes) extents_.push_back(extentOf(mesh));
}

std::vector<PassTime> Renderer::render(const Scene& scene) {
  std::vector<PassTime> passes;
  view_ = viewOf(scene.camera, settings_.size);
  environment_ = scene.environment;
  exposure_ = scene.camera.exposure;
  onHost(passes, "placement", [&] { gpuScene_.place(scene); });
  onHost(passes, "shadow projections", [&] { planShadows(scene); });
  onHost(passes, "beams", [&] { technique_.update(scene, gpuScene_); });

  const std::vector<PassTime> onDevice = device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("shadow maps", [&] { drawShadowMaps(commands); });
    technique_.record(commands, gpuScene_);
    commands.pass("receivers", [&] { drawReceivers(commands); });
    commands.pass("casters", [&] { drawCasters(commands); });
    commands.pass("direct light", [&] { lightDirectly(commands); });
    technique_.shade(commands, {&images_.receiverPosition, &images_.receiverNormal}, images_.causticsLux);
    commands.pass("composite", [&] { composite(commands, programs_.composite); });
    commands.pass("tone mapping", [&] { toneMap(commands); });
  });
  passes.insert(passes.end(), onDevice.begin(), onDevice.end());
  return passes;
}

void Renderer::planShadows(const Scene& scene) {
  for (const Object& object : scene.objects)
    if (object.water) extents_[object.mesh] = extentOf(scene.meshOf(object));
  shadows_ = planShadowMaps(scene, extents_, settings_.shadowMapSize);

  std::vector<mat4> projections;
  for (const ShadowMap& map : shadows_.maps) projections.push_back(map.worldToMap);
  writeList(device_, emitters_, "emitters", shadows_.emitters);
  writeList(device_, shadowProjections_, "shadow projections", projections);
  const auto layers = std::max<uint32_t>(static_cast<uint32_t>(shadows_.maps.size()), 1);
  if (!shadowMaps_ || shadowMaps_.layerCount() < layers)
    shadowMaps_ = gpu::createImage(device_, "shadow maps",
                                   {.format = VK_FORMAT_D32_SFLOAT,
                                    .width = settings_.shadowMapSize,
                                    .height = settings_.shadowMapSize,
                                    .layers = layers});
}

void Renderer::drawShadowMaps(gpu::CommandList& commands) {
  for (uint32_t layer = 0; layer < shadows_.maps.size(); ++layer) {
    const ShadowMap& map = shadows_.maps[layer];
    commands.render({.colors = {}, .depth = gpu::DepthAttachment{&shadowMaps_, layer, 1.0f}}, [&] {
      for (const uint32_t object : map.objects)
        commands.drawIndexed(
            programs_.shadow, gpuScene_.indices(), gpuScene_.draws()[object].range, 1,
            ShadowConstants{gpuScene_.vertices(), gpuScene_.objects(), map.worldToMap, object});
    });
  }
}

void Renderer::drawSurfaces(gpu::CommandList& commands, const gpu::Program& program, MaterialType type) {
  for (const SceneDraw& draw : gpuScene_.draws()) {
    if (draw.type != type) continue;
    const SurfaceConstants constants{gpuScene_.vertices(), gpuScene_.objects(), gpuScene_.materials(),
                                     view_.worldToClip,    view_.eye,           draw.object};
    const auto drawWith = [&](gpu::Bindings bindings) {
      commands.drawIndexed(program, gpuScene_.indices(), draw.range, 1, constants, bindings);
    };
    if (&program == &programs_.receiver)
      drawWith({{*draw.colorTexture, gpuScene_.textureSampler()}});
    else if (&program == &programs_.viewTransmittance)
      drawWith({images_.receiverPosition});
    else
      drawWith({});
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

// Mirrors first, then all that glass in front of them and of the receivers takes away, then the nearest
// glass.
void Renderer::drawCasters(gpu::CommandList& commands) {
  const vec4 nothing(0);
  const gpu::DepthAttachment depth{&images_.depth, 0, std::nullopt};
  commands.render({.colors = {{&images_.casterPosition, 0, nothing}, {&images_.casterNormal, 0, nothing}},
                   .depth = depth},
                  [&] { drawSurfaces(commands, programs_.mirror, MaterialType::mirror); });
  commands.barrier();
  commands.render({.colors = {{&images_.opticalDepth, 0, nothing}}, .depth = depth},
                  [&] { drawSurfaces(commands, programs_.viewTransmittance, MaterialType::dielectric); });
  commands.barrier();
  commands.render(
      {.colors = {{&images_.casterPosition, 0, std::nullopt}, {&images_.casterNormal, 0, std::nullopt}},
       .depth = depth},
      [&] { drawSurfaces(commands, programs_.dielectric, MaterialType::dielectric); });
}

void Renderer::lightDirectly(gpu::CommandList& commands) {
  commands.dispatch(
      programs_.direct, {settings_.size, 1},
      DirectConstants{emitters_.address(), shadowProjections_.address(),
                      static_cast<uint32_t>(shadows_.emitters.size())},
      {images_.receiverPosition, images_.receiverNormal, {shadowMaps_, shadowSampler_}, images_.directLux});
  commands.clear(images_.causticsLux, vec4(0));
}

void Renderer::composite(gpu::CommandList& commands, const gpu::Program& program) {
  commands.dispatch(
      program, {settings_.size, 1},
      CompositeConstants{gpuScene_.materials(), view_.forward, view_.right, view_.up, environment_.ambient,
                         environment_.background},
      {images_.receiverAlbedo, images_.directLux, images_.causticsLux, images_.casterNormal,
       images_.opticalDepth, images_.luminance, images_.directLuminance, images_.causticsLuminance});
}

void Renderer::toneMap(gpu::CommandList& commands) {
  commands.dispatch(programs_.toneMapping, {settings_.size, 1}, ToneConstants{exposure_},
                    {images_.luminance, images_.picture});
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
    commands.pass("layers", [&] { composite(commands, programs_.compositeLayers); });
  });
  Image layers;
  layers.width = settings_.size.x;
  layers.height = settings_.size.y;
  writeChannels(layers, "", "RGB", gpu::download<vec4>(device_, images_.luminance));
  writeChannels(layers, "direct.", "RGB", gpu::download<vec4>(device_, images_.directLuminance));
  writeChannels(layers, "caustics.", "RGB", gpu::download<vec4>(device_, images_.causticsLuminance));

  auto positions = gpu::download<vec4>(device_, images_.receiverPosition);
  auto normals = gpu::download<vec4>(device_, images_.receiverNormal);
  const auto casterPositions = gpu::download<vec4>(device_, images_.casterPosition);
  const auto casterNormals = gpu::download<vec4>(device_, images_.casterNormal);
  std::vector<vec4> depths(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (casterPositions[i].a > 0) {
      positions[i] = casterPositions[i];
      normals[i] = casterNormals[i];
    }
    if (positions[i].a > 0) depths[i].x = dot(vec3(positions[i]) - view_.eye, view_.forward);
  }
  writeChannels(layers, "depth.", "Z", depths);
  writeChannels(layers, "normal.", "XYZ", normals);
  return layers;
}

}  // namespace nephroid

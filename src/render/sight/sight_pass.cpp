#include "render/sight/sight_pass.h"

#include <algorithm>

#include "shaders/nearest_caster_frag.h"
#include "shaders/reflection_frag.h"
#include "shaders/sight_frag.h"
#include "shaders/sight_vert.h"
#include "shaders/slice_frag.h"
#include "shaders/slice_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat kTexel = VK_FORMAT_R32G32B32A32_UINT;
constexpr uint32_t kFaces = 6;

// Draws where the depth pass found the caster nearest; channels that are cut differently differ in depth by
// rounding, which the bias makes up for.
gpu::RasterState overDepth(std::size_t targets) {
  gpu::RasterState state;
  state.colors.assign(targets, {kFloats});
  state.depthFormat = kDepth;
  state.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  state.depthWrite = false;
  state.depthBiasConstant = 32;
  return state;
}

gpu::RasterState intoDepth() {
  gpu::RasterState state;
  state.depthFormat = kDepth;
  state.depthCompare = VK_COMPARE_OP_GREATER;
  return state;
}

gpu::Program sliceProgram(gpu::Device& device, const char* name, uint32_t hasTexture) {
  gpu::RasterState state;
  state.colors = {{kTexel}};
  state.depthFormat = kDepth;
  return gpu::createRasterProgram(device, name, shaders::slice_vert, shaders::slice_frag, state,
                                  {{0, hasTexture}});
}

std::array<vec3, 8> cornersOf(const Object& object, const MeshExtent& extent) {
  std::array<vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] =
        object.placement.point({(i & 1 ? extent.high : extent.low).x, (i & 2 ? extent.high : extent.low).y,
                                (i & 4 ? extent.high : extent.low).z});
  return corners;
}

void ensure(gpu::Device& device, gpu::Buffer& buffer, const char* name, std::size_t bytes) {
  // Half as much again, so that a caster that comes nearer does not ask for memory in each frame.
  if (buffer.size() < bytes)
    buffer = gpu::createBuffer(device, name, bytes + bytes / 2, gpu::MemoryKind::upload);
}

}  // namespace

SightPass::SightPass(gpu::Device& device, const SightSettings& settings)
    : device_(device),
      settings_(settings),
      depthProgram_(gpu::createRasterProgram(device, "casters' depth", shaders::sight_vert, {}, intoDepth())),
      sightProgram_(
          gpu::createRasterProgram(device, "sight", shaders::sight_vert, shaders::sight_frag, overDepth(4))),
      reflectionProgram_(gpu::createRasterProgram(device, "reflection", shaders::sight_vert,
                                                  shaders::reflection_frag, overDepth(3))),
      normalProgram_(gpu::createRasterProgram(device, "nearest caster", shaders::sight_vert,
                                              shaders::nearest_caster_frag, overDepth(1))),
      sliceProgram_(sliceProgram(device, "slice", VK_FALSE)),
      texturedSliceProgram_(sliceProgram(device, "textured slice", VK_TRUE)) {}

void SightPass::update(SceneTransport& transport, const View& view, uvec2 pictureSize,
                       const std::vector<MeshExtent>& extents) {
  const Scene& scene = transport.scene();
  casters_.clear();
  meshes_.clear();
  receivers_.clear();
  receiverColors_.clear();
  receiverMaterials_.clear();
  isTextured_.clear();
  region_ = {};
  disperses_ = reflects_ = false;
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Material& material = scene.materialOf(object);
    receiverColors_.push_back(material.color);
    receiverMaterials_.push_back(object.material);
    isTextured_.push_back(material.colorTexture != kNone);
    if (!scene.isCaster(object) && !scene.meshOf(object).positions.empty())
      receivers_.push_back({i, cornersOf(object, extents[object.mesh])});
  }
  const MediumStack media = transport.mediaAround(sightQuery(0, view.eye, 0, {}).emitter);
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!scene.isCaster(object)) continue;
    const gpu::Region region = regionOf(view, pictureSize, cornersOf(object, extents[object.mesh]));
    if (region.size.x > 0) add(transport, view, i, extents[object.mesh], region, media);
  }
  upload(view);
}

void SightPass::add(SceneTransport& transport, const View& view, uint32_t index, const MeshExtent& extent,
                    const gpu::Region& region, const MediumStack& media) {
  const Scene& scene = transport.scene();
  const Object& object = scene.objects[index];
  const Material& material = scene.materialOf(object);
  SeenCaster caster;
  caster.region = region;
  caster.isMirror = material.type == MaterialType::mirror;
  caster.disperses = !caster.isMirror && material.isDispersive();
  SightConstants& constants = caster.constants;
  constants.eye = view.eye;
  constants.ior = material.ior.y;
  constants.center = object.placement.point(0.5f * (extent.low + extent.high));
  const float radius = extent.radius * object.placement.scale;
  for (const ReceiverBounds& receiver : receivers_)
    for (const vec3 corner : receiver.corners)
      constants.reach = std::max(constants.reach, distance(corner, constants.center));
  constants.marks = kSightCaster | (caster.disperses ? kSightDisperses : 0u) |
                    (material.thinWalled ? kSightThinWalled : 0u);
  for (uint32_t channel = 0; channel < (caster.disperses ? 3u : 1u); ++channel) {
    meshes_.push_back(
        sightMesh(scene, transport.source(), sightQuery(index, view.eye, channel, media), view.pixelAngle));
    caster.ranges[channel].count = uint32_t(meshes_.back().indices.size());
    caster.slices[channel] =
        planSlices(meshes_.back(), constants.center, radius, receivers_, settings_.slices);
  }
  region_ = unionOf(region_, region);
  disperses_ |= caster.disperses;
  reflects_ |= !caster.isMirror;
  casters_.push_back(caster);
}

void SightPass::upload(const View& view) {
  if (casters_.empty()) return;
  std::size_t vertexCount = 0, indexCount = 0;
  for (const SightMesh& mesh : meshes_) {
    vertexCount += mesh.vertices.size();
    indexCount += mesh.indices.size();
  }
  ensure(device_, vertices_, "sight's vertices", vertexCount * sizeof(SightVertex));
  ensure(device_, indices_, "sight's indices", indexCount * sizeof(uint32_t));
  ensure(device_, camera_, "camera", sizeof(mat4));
  camera_.write(std::span<const mat4>(&view.worldToClip, 1));
  std::size_t vertex = 0, index = 0, next = 0;
  for (SeenCaster& caster : casters_)
    for (uint32_t channel = 0; channel < (caster.disperses ? 3u : 1u); ++channel) {
      const SightMesh& mesh = meshes_[next++];
      vertices_.write(mesh.vertices, vertex * sizeof(SightVertex));
      indices_.write(mesh.indices, index * sizeof(uint32_t));
      caster.ranges[channel].first = uint32_t(index);
      caster.ranges[channel].vertexOffset = int32_t(vertex);
      vertex += mesh.vertices.size();
      index += mesh.indices.size();
      caster.constants.vertices = vertices_.address();
      caster.constants.camera = camera_.address();
    }
  if (slices_) return;
  const auto create = [&](const char* name, VkFormat format, uint32_t size, uint32_t layers) {
    return gpu::createImage(device_, name,
                            {.format = format, .width = size, .height = size, .layers = layers});
  };
  const uint32_t layers = settings_.slices > 0 ? settings_.slices : kMostSlices;
  slices_ = create("sliced object images", kTexel, settings_.sliceSize, layers);
  sliceDepths_ = create("depths of sliced object images", kDepth, settings_.sliceSize, layers);
  surroundings_ = create("surroundings", kTexel, settings_.surroundingSize, kFaces);
  surroundingDepths_ = create("depths of surroundings", kDepth, settings_.surroundingSize, kFaces);
}

void SightPass::drawDepth(gpu::CommandList& commands, const FrameImages& images) {
  commands.render(
      {.colors = {}, .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt}, .region = region_}, [&] {
        for (const SeenCaster& caster : casters_)
          if (caster.ranges[0].count > 0)
            commands.drawIndexed(depthProgram_, indices_, caster.ranges[0], 1, caster.constants);
      });
}

void SightPass::drawReceivers(gpu::CommandList& commands, const GpuScene& gpuScene, const SightFrame& frame,
                              vec2 depths, const gpu::Image& texels, const gpu::Image& texelDepths,
                              uint32_t layer) {
  // Stale texels stay where the depth says that nothing is.
  commands.render(
      {.colors = {{&texels, layer, std::nullopt}}, .depth = gpu::DepthAttachment{&texelDepths, layer, 1.0f}},
      [&] {
        for (const ReceiverBounds& receiver : receivers_) {
          if (!isSeen(frame, depths, receiver)) continue;
          const SceneDraw& draw = gpuScene.draws()[receiver.object];
          commands.drawIndexed(isTextured_[receiver.object] ? texturedSliceProgram_ : sliceProgram_,
                               gpuScene.indices(), draw.range, 1,
                               SliceConstants{gpuScene.vertices(), gpuScene.objects(), frame, depths.x,
                                              depths.y, receiverColors_[receiver.object], receiver.object,
                                              receiverMaterials_[receiver.object]},
                               {{*draw.colorTexture, gpuScene.textureSampler()}});
        }
      });
}

void SightPass::drawSlices(gpu::CommandList& commands, const GpuScene& gpuScene, const SliceSet& set) {
  float depth = set.firstDepth;
  for (uint32_t i = 0; i < set.slices; ++i, depth *= set.depthRatio)
    if (set.occupied >> i & 1u)
      drawReceivers(commands, gpuScene, set.frame,
                    {depth * (1 - kSliceOverlap), depth * set.depthRatio * (1 + kSliceOverlap)}, slices_,
                    sliceDepths_, i);
}

void SightPass::drawSurroundings(gpu::CommandList& commands, const GpuScene& gpuScene,
                                 const SeenCaster& caster) {
  const float reach = std::max(caster.constants.reach, 1e-6f);
  for (uint32_t face = 0; face < kFaces; ++face)
    drawReceivers(commands, gpuScene, faceOfCube(caster.constants.center, face),
                  {1e-4f * reach, 1.01f * reach}, surroundings_, surroundingDepths_, face);
}

void SightPass::drawSeen(gpu::CommandList& commands, const SeenCaster& caster, uint32_t channel,
                         const SeenImages& seen, const gpu::Image& depth) {
  if (caster.ranges[channel].count == 0) return;
  SightConstants constants = caster.constants;
  constants.slices = caster.slices[channel];
  commands.render({.colors = {{&seen.position, 0, std::nullopt},
                              {&seen.normal, 0, std::nullopt},
                              {&seen.albedo, 0, std::nullopt},
                              {&seen.transmittance, 0, std::nullopt}},
                   .depth = gpu::DepthAttachment{&depth, 0, std::nullopt},
                   .region = caster.region},
                  [&] {
                    commands.drawIndexed(sightProgram_, indices_, caster.ranges[channel], 1, constants,
                                         {slices_, sliceDepths_, surroundings_, surroundingDepths_});
                  });
}

void SightPass::drawReflected(gpu::CommandList& commands, const SeenCaster& caster,
                              const FrameImages& images) {
  const SeenImages& seen = images.reflected;
  if (caster.ranges[0].count == 0) return;
  commands.render({.colors = {{&seen.position, 0, std::nullopt},
                              {&seen.normal, 0, std::nullopt},
                              {&seen.albedo, 0, std::nullopt}},
                   .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt},
                   .region = caster.region},
                  [&] {
                    commands.drawIndexed(reflectionProgram_, indices_, caster.ranges[0], 1, caster.constants,
                                         {surroundings_, surroundingDepths_});
                  });
}

void SightPass::clear(gpu::CommandList& commands, const SeenImages& seen) const {
  commands.render({.colors = {{&seen.position, 0, vec4(0)},
                              {&seen.normal, 0, vec4(0)},
                              {&seen.albedo, 0, vec4(0)},
                              {&seen.transmittance, 0, vec4(0)}},
                   .region = region_},
                  [] {});
}

void SightPass::record(gpu::CommandList& commands, const GpuScene& gpuScene, const FrameImages& images) {
  if (casters_.empty()) return;
  commands.pass("casters", [&] {
    drawDepth(commands, images);
    commands.render({.colors = {{&images.seen.transmittance, 0, vec4(0)}}, .region = region_}, [] {});
    if (reflects_) clear(commands, images.reflected);
    if (disperses_)
      for (const SeenImages& seen : images.dispersed) clear(commands, seen);
  });
  for (const SeenCaster& caster : casters_) {
    commands.pass("surroundings", [&] { drawSurroundings(commands, gpuScene, caster); });
    for (uint32_t channel = 0; channel < (caster.disperses ? 3u : 1u); ++channel) {
      commands.pass("sliced object images", [&] { drawSlices(commands, gpuScene, caster.slices[channel]); });
      commands.pass("seen through casters", [&] {
        drawSeen(commands, caster, channel, channel == 0 ? images.seen : images.dispersed[channel - 1],
                 images.depth);
      });
    }
    if (!caster.isMirror)
      commands.pass("reflected by casters", [&] { drawReflected(commands, caster, images); });
  }
}

void SightPass::recordNormals(gpu::CommandList& commands, const FrameImages& images) {
  if (casters_.empty()) return;
  commands.render({.colors = {{&images.casterNormal, 0, vec4(0)}},
                   .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt},
                   .region = region_},
                  [&] {
                    for (const SeenCaster& caster : casters_)
                      if (caster.ranges[0].count > 0)
                        commands.drawIndexed(normalProgram_, indices_, caster.ranges[0], 1, caster.constants);
                  });
}

}  // namespace nephroid

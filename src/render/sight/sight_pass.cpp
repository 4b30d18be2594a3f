#include "render/sight/sight_pass.h"

#include <algorithm>
#include <optional>

#include "geometry/bounds.h"
#include "shaders/render/sight/caster_frag.h"
#include "shaders/render/sight/caster_vert.h"
#include "shaders/render/sight/reflected_frag.h"
#include "shaders/render/sight/seen_frag.h"
#include "shaders/render/sight/slice_frag.h"
#include "shaders/render/sight/slice_vert.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kSightFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat kNormals = VK_FORMAT_R32_UINT;
constexpr VkFormat kReceivers = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kAlbedos = VK_FORMAT_R32G32_UINT;
constexpr uint32_t kFaces = 6;

gpu::Program casterProgram(gpu::Device& device, const char* name, const gpu::RasterState& depth) {
  gpu::RasterState state = depth;
  state.colors.assign(5, {kSightFormat});
  state.colors.push_back({kReceivers});
  state.depthFormat = kDepth;
  return gpu::createRasterProgram(device, name, shaders::render_sight_caster_vert,
                                  shaders::render_sight_caster_frag, state);
}

gpu::Program lookingProgram(gpu::Device& device, const char* name, std::span<const uint32_t> fragment) {
  return gpu::createRasterProgram(device, name, shaders::techniques_whole_picture_vert, fragment,
                                  {.colors = {{kSightFormat}, {kSightFormat}, {kSightFormat}}});
}

gpu::Program sliceProgram(gpu::Device& device, const char* name, uint32_t hasTexture) {
  gpu::RasterState state;
  state.colors = {{kNormals}, {kAlbedos}};
  state.depthFormat = kDepth;
  state.depthCompare = VK_COMPARE_OP_GREATER;
  return gpu::createRasterProgram(device, name, shaders::render_sight_slice_vert,
                                  shaders::render_sight_slice_frag, state, {{"kHasTexture", hasTexture}});
}

}  // namespace

SightPass::SightPass(gpu::Device& device, const SightSettings& settings)
    : device_(device),
      settings_(settings),
      casterProgram_(casterProgram(device, "caster", {.depthCompare = VK_COMPARE_OP_GREATER})),
      // Channels that are cut differently differ in depth by rounding, which the bias makes up for.
      channelProgram_(casterProgram(
          device, "caster in a channel",
          {.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL, .depthWrite = false, .depthBiasConstant = 32})),
      seenProgram_(lookingProgram(device, "seen by way of a caster", shaders::render_sight_seen_frag)),
      reflectedProgram_(
          lookingProgram(device, "reflected by a caster", shaders::render_sight_reflected_frag)),
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
    if (!scene.isCaster(object))
      receivers_.push_back({i, placedCorners(extents[object.mesh].box, object.placement)});
  }
  const MediumStack media = transport.mediaAround(sightQuery(0, view.eye, 0, {}).emitter);
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!scene.isCaster(object)) continue;
    const gpu::Region region =
        regionOf(view, pictureSize, placedCorners(extents[object.mesh].box, object.placement));
    if (region.size.x > 0) add(transport, view, i, extents[object.mesh], region, media);
  }
  upload(view);
  ensureImages(pictureSize);
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
  constants.center = object.placement.point(extent.box.center());
  const float radius = extent.radius * object.placement.scale;
  for (const ReceiverBounds& receiver : receivers_)
    for (const vec3 corner : receiver.corners)
      constants.reach = std::max(constants.reach, distance(corner, constants.center));
  constants.number = index + 1;
  constants.isThinWalled = material.thinWalled;
  for (uint32_t channel = 0; channel < caster.channels(); ++channel) {
    meshes_.push_back(sightMesh(scene, transport.source(), transport.rayScene(),
                                sightQuery(index, view.eye, channel, media), view));
    caster.ranges[channel].count = uint32_t(meshes_.back().indices.size());
    caster.slices[channel] =
        planSlices(meshes_.back(), constants.center, radius, receivers_, settings_.slices);
  }
  constants.reach = std::max(constants.reach, 1e-6f);
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
  gpu::ensureBuffer(device_, vertices_, "sight's vertices", vertexCount * sizeof(SightVertex),
                    gpu::MemoryKind::upload);
  gpu::ensureBuffer(device_, indices_, "sight's indices", indexCount * sizeof(uint32_t),
                    gpu::MemoryKind::upload);
  gpu::ensureBuffer(device_, camera_, "camera", sizeof(mat4), gpu::MemoryKind::upload);
  camera_.write(std::span<const mat4>(&view.worldToClip, 1));
  std::size_t vertex = 0, index = 0, next = 0;
  for (SeenCaster& caster : casters_)
    for (uint32_t channel = 0; channel < caster.channels(); ++channel) {
      const SightMesh& mesh = meshes_[next++];
      vertices_.write(mesh.vertices, vertex * sizeof(SightVertex));
      indices_.write(mesh.indices, index * sizeof(uint32_t));
      caster.ranges[channel].first = uint32_t(index);
      caster.ranges[channel].vertexOffset = int32_t(vertex);
      vertex += mesh.vertices.size();
      index += mesh.indices.size();
    }
}

std::vector<Lattice> SightPass::lattices() const {
  std::vector<Lattice> all;
  for (const SeenCaster& caster : casters_)
    for (uint32_t channel = 0; channel < caster.channels(); ++channel) {
      const SliceSet& set = caster.slices[channel];
      for (uint32_t i = 0; i < set.slices; ++i) {
        if ((set.occupied >> i & 1u) == 0) continue;
        const float depth = set.firstDepth * std::pow(set.depthRatio, float(i));
        const vec3 right = depth / set.frame.scale * set.frame.axisU;
        const vec3 down = depth / set.frame.scale * set.frame.axisV;
        all.push_back({LatticeKind::slices,
                       set.frame.apex + depth * set.frame.axisW - right - down,
                       {2.0f * right, 2.0f * down, vec3(0)}});
      }
    }
  return all;
}

void SightPass::ensureImages(uvec2 pictureSize) {
  if (casters_.empty()) return;
  const auto picture = [&](const char* name, VkFormat format = kSightFormat) {
    return gpu::createImage(device_, name,
                            {.format = format, .width = pictureSize.x, .height = pictureSize.y});
  };
  if (!position_ || uvec2(position_.width(), position_.height()) != pictureSize) {
    position_ = picture("casters' positions");
    exit_ = picture("where sight leaves casters");
    direction_ = picture("directions of sight");
    receiver_ = picture("receivers that sight ends at", kReceivers);
  }
  if (receiverImages_.depths) return;
  const auto create = [&](const char* name, VkFormat format) {
    return gpu::createImage(device_, name,
                            {.format = format,
                             .width = settings_.sliceSize,
                             .height = settings_.sliceSize,
                             .layers = kMostSlices + kFaces});
  };
  receiverImages_ = {create("receivers' depths", kDepth), create("receivers' normals", kNormals),
                     create("receivers' albedos", kAlbedos)};
}

// Of the casters given, in one channel.
void SightPass::drawCasters(gpu::CommandList& commands, std::span<const SeenCaster> casters, uint32_t channel,
                            const FrameImages& images) {
  const std::optional<vec4> nothing = channel == 0 ? std::optional(vec4(0)) : std::nullopt;
  commands.render({.colors = {{&position_, 0, nothing},
                              {&images.casterNormal, 0, nothing},
                              {&exit_, 0, std::nullopt},
                              {&direction_, 0, std::nullopt},
                              {&images.seen[channel].transmittance, 0, nothing},
                              {&receiver_, 0, std::nullopt}},
                   .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt},
                   .region = region_},
                  [&] {
                    for (const SeenCaster& caster : casters)
                      if (caster.ranges[channel].count > 0)
                        commands.drawIndexed(
                            channel == 0 ? casterProgram_ : channelProgram_, indices_, caster.ranges[channel],
                            1,
                            CasterConstants{vertices_.address(), camera_.address(), caster.constants.number,
                                            kSightCaster | (caster.disperses ? kSightDisperses : 0u)});
                  });
}

void SightPass::drawReceivers(gpu::CommandList& commands, const GpuScene& gpuScene, const SightFrame& frame,
                              vec2 depths, uint32_t layer, uint32_t size) {
  const ReceiverImages& images = receiverImages_;
  const float part = float(size) / float(settings_.sliceSize);
  // Stale texels stay where the depth says that nothing is.
  commands.render({.colors = {{&images.normals, layer, std::nullopt}, {&images.albedos, layer, std::nullopt}},
                   .depth = gpu::DepthAttachment{&images.depths, layer, 0.0f},
                   .region = gpu::Region{{0, 0}, uvec2(size)}},
                  [&] {
                    for (const ReceiverBounds& receiver : receivers_) {
                      if (!isSeen(frame, depths, receiver)) continue;
                      const SceneDraw& draw = gpuScene.draws()[receiver.object];
                      commands.drawIndexed(
                          isTextured_[receiver.object] ? texturedSliceProgram_ : sliceProgram_,
                          gpuScene.indices(), draw.range, 1,
                          SliceConstants{gpuScene.vertices(), gpuScene.objects(), frame, depths, part,
                                         receiverColors_[receiver.object], receiver.object,
                                         receiverMaterials_[receiver.object]},
                          {{"colorTexture", *draw.colorTexture, gpuScene.textureSampler()}});
                    }
                  });
}

void SightPass::drawSlices(gpu::CommandList& commands, const GpuScene& gpuScene, const SliceSet& set) {
  float depth = set.firstDepth;
  for (uint32_t i = 0; i < set.slices; ++i, depth *= set.depthRatio)
    if (set.occupied >> i & 1u)
      drawReceivers(commands, gpuScene, set.frame, depthsOfSlice(set, depth), i, settings_.sliceSize);
}

void SightPass::drawSurroundings(gpu::CommandList& commands, const GpuScene& gpuScene,
                                 const SeenCaster& caster) {
  for (uint32_t face = 0; face < kFaces; ++face)
    drawReceivers(commands, gpuScene, faceOfCube(caster.constants.center, face),
                  depthsAround(caster.constants.reach), kMostSlices + face, kSurroundingSize);
}

// The images that are looked into the first time in a frame hold nothing wherever casters may be.
void SightPass::look(gpu::CommandList& commands, const gpu::Program& program, const SeenCaster& caster,
                     uint32_t channel, gpu::Bindings bindings, const SeenImages& seen, bool isFirst) {
  SightConstants constants = caster.constants;
  constants.slices = caster.slices[channel];
  const std::optional<vec4> nothing = isFirst ? std::optional(vec4(0)) : std::nullopt;
  commands.render(
      {.colors = {{&seen.position, 0, nothing}, {&seen.normal, 0, nothing}, {&seen.albedo, 0, nothing}},
       .region = isFirst ? region_ : caster.region},
      [&] { commands.draw(program, 3, 1, constants, bindings); });
}

void SightPass::lookThrough(gpu::CommandList& commands, const SeenCaster& caster, uint32_t channel,
                            const SeenImages& seen, bool isFirst) {
  look(commands, seenProgram_, caster, channel,
       {{"casterPosition", position_},
        {"casterExit", exit_},
        {"casterDirection", direction_},
        {"casterReceiver", receiver_},
        {"depths", receiverImages_.depths},
        {"normals", receiverImages_.normals},
        {"albedos", receiverImages_.albedos}},
       seen, isFirst);
}

void SightPass::lookAtReflected(gpu::CommandList& commands, const SeenCaster& caster,
                                const FrameImages& images, bool isFirst) {
  look(commands, reflectedProgram_, caster, 0,
       {{"casterPosition", position_},
        {"casterNormal", images.casterNormal},
        {"casterDirection", direction_},
        {"depths", receiverImages_.depths},
        {"normals", receiverImages_.normals},
        {"albedos", receiverImages_.albedos}},
       images.seen[kSeenReflected], isFirst);
}

void SightPass::record(gpu::CommandList& commands, const GpuScene& gpuScene, const FrameImages& images,
                       const SkyPass& sky) {
  if (casters_.empty()) return;
  const auto addSky = [&](const SeenCaster& caster, uint32_t way, const SeenImages& seen) {
    if (sky.isSeen())
      commands.pass("sky", [&] {
        sky.record(commands, way,
                   {caster.constants.number, position_, images.casterNormal, direction_, caster.region},
                   seen);
      });
  };
  commands.pass("casters", [&] { drawCasters(commands, casters_, 0, images); });
  bool isFirstReflected = true, isFirstDispersed = true;
  for (const SeenCaster& caster : casters_) {
    commands.pass("surroundings", [&] { drawSurroundings(commands, gpuScene, caster); });
    for (uint32_t channel = 0; channel < caster.channels(); ++channel) {
      if (channel > 0)
        commands.pass("casters", [&] { drawCasters(commands, {&caster, 1}, channel, images); });
      commands.pass("sliced object images", [&] { drawSlices(commands, gpuScene, caster.slices[channel]); });
      commands.pass("seen through casters", [&] {
        const bool isFirst = channel > 0 && isFirstDispersed;
        lookThrough(commands, caster, channel, images.seen[channel], isFirst);
        if (channel == 2) isFirstDispersed = false;
      });
      addSky(caster, kSkyThrough, images.seen[channel]);
      if (channel > 0 || caster.isMirror) continue;
      commands.pass("reflected by casters", [&] {
        lookAtReflected(commands, caster, images, isFirstReflected);
        isFirstReflected = false;
      });
      addSky(caster, kSkyReflected, images.seen[kSeenReflected]);
    }
  }
}

}  // namespace nephroid

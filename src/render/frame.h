// The frame: from a scene as it stands to luminance and a picture.
#pragma once

#include "core/image.h"
#include "core/stats.h"
#include "render/direct_light.h"
#include "render/frame_data.h"
#include "render/frame_resources.h"
#include "techniques/sources.h"
#include "techniques/technique.h"

namespace nephroid {

struct RenderSettings {
  uvec2 size{640, 480};           // pixels
  uint32_t shadowMapSize = 1024;  // texels along a side
};

// A pinhole camera as passes are told of it. World space.
struct View {
  mat4 worldToClip;  // y down; depth is `nearest` over the distance along `forward`
  vec3 eye;          // m
  vec3 forward;      // unit
  float nearest;     // m
};

// An object as the passes of a frame draw it.
struct Surface {
  MaterialType type = MaterialType::diffuse;
  bool isTextured = false;
  SurfaceConstants constants{};
};

class Renderer {
 public:
  // Device, transport and technique outlive it; the technique was made with that transport. Objects, meshes
  // and textures are those of the transport's scene; what moves is taken at each `render`.
  Renderer(gpu::Device& device, SceneTransport& transport, const RenderSettings& settings,
           Technique& technique);

  // A whole frame, with all that a moved light, camera or object would change. Returns the time in each pass,
  // on the host and on the device, in the order in which they ran.
  std::vector<PassTime> render(const Scene& scene);

  // Of the last frame: exposed, tone-mapped, sRGB, RGB.
  ByteImage picture() const;

  // Of the last frame: R,G,B luminance (nit); direct.R,G,B and caustics.R,G,B, the
  // parts of it that came from light that met no caster and from light that met one; depth.Z (m along the
  // view, 0 where there is nothing) and normal.X,Y,Z of the nearest surface.
  Image layers();

  GpuScene& gpuScene() { return gpuScene_; }

 private:
  void place(const Scene& scene);
  void drawReceivers(gpu::CommandList& commands);
  void drawCasters(gpu::CommandList& commands);
  void drawNearestCasters(gpu::CommandList& commands);
  void composite(gpu::CommandList& commands, bool writesLayers);
  void drawSurfaces(gpu::CommandList& commands, const gpu::Program& program, MaterialType type);

  gpu::Device& device_;
  SceneTransport& transport_;
  Technique& technique_;
  RenderSettings settings_;
  GpuScene gpuScene_;
  FramePrograms programs_;
  FrameImages images_;
  DirectLight directLight_;

  // Of the frame being made.
  View view_{};
  std::vector<Surface> surfaces_;  // of the objects
  Environment environment_;
  float exposure_ = 1;
  std::vector<MeshExtent> extents_;  // of the meshes
  gpu::Region casterRegion_;         // pixels outside it see no caster
};

}  // namespace nephroid

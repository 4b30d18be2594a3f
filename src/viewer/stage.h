// A scene on the device, ready to be drawn again and again.
#pragma once

#include <memory>
#include <vector>

#include "render/frame.h"
#include "techniques/technique.h"
#include "viewer/preparation.h"
#include "viewer/show/edge_smoothing.h"

namespace nephroid {

class Stage {
 public:
  // The device must outlive it. `keepsLight`: as in RenderSettings.
  Stage(gpu::Device& device, std::shared_ptr<Prepared> prepared, uvec2 size, bool keepsLight);

  // As Renderer::render, with one sample of each pixel and then smoothed edges. `scene` must have the same
  // objects, meshes and lights as the prepared one.
  std::vector<PassTime> render(const Scene& scene);
  // As Renderer::gather. Until there are enough samples for smooth edges, the picture stays the one of
  // `render`.
  std::vector<PassTime> gather(uint32_t samples);
  float exposure() const { return renderer_->exposure(); }  // of the last frame
  uint32_t gathered() const { return renderer_->gathered(); }
  const gpu::Image& picture() const { return *picture_; }  // that is shown
  void resize(uvec2 size);                                 // the picture is black until the next `render`
  uvec2 size() const { return renderer_->size(); }
  // Creates everything on the device again, with the present shaders. Where that fails it throws, and nothing
  // has changed.
  void remake();

  Renderer& renderer() { return *renderer_; }
  // Its progress is that of the host's work of a frame, too.
  const std::shared_ptr<Prepared>& prepared() const { return prepared_; }
  const PictureSettings& settings() const { return prepared_->settings; }
  const Stats& stats() const { return stats_; }  // counts of the last frame
  const RayScene& rayScene() const { return prepared_->transport->rayScene(); }
  SceneTransport& transport() { return *prepared_->transport; }
  const Scene& scene() const { return prepared_->scene; }  // in the state in which it was prepared
  const RayMesh* rayMesh() const { return technique_->rayMesh(); }
  // The grids of the last frame, of the technique and of the view through casters.
  std::vector<Lattice> lattices() const;

 private:
  std::unique_ptr<Technique> newTechnique();
  std::unique_ptr<Renderer> newRenderer(Technique& technique, uvec2 size) const;

  gpu::Device& device_;
  std::shared_ptr<Prepared> prepared_;
  bool keepsLight_;
  Stats stats_;
  std::unique_ptr<Technique> technique_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<EdgeSmoothing> edges_;
  const gpu::Image* picture_ = nullptr;
};

}  // namespace nephroid

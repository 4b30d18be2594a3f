// A scene on the device, ready to be drawn again and again.
#pragma once

#include <memory>
#include <vector>

#include "render/frame.h"
#include "techniques/technique.h"
#include "viewer/preparation.h"

namespace nephroid {

class Stage {
 public:
  // The device outlives it. `keepsLight` as RenderSettings has it.
  Stage(gpu::Device& device, std::unique_ptr<Prepared> prepared, uvec2 size, bool keepsLight);

  // As Renderer::render. `scene` has the objects, meshes and lights that this was made of.
  std::vector<PassTime> render(const Scene& scene) { return renderer_->render(scene); }
  void resize(uvec2 size) { renderer_->resize(size); }
  uvec2 size() const { return renderer_->size(); }
  // All of it on the device made anew, of the shaders as they are now. Throws, and stays as it was, where
  // they do not fit.
  void remake();

  Renderer& renderer() { return *renderer_; }
  const PictureSettings& settings() const { return prepared_->settings; }
  const Stats& stats() const { return stats_; }  // of the last frame: counts
  const RayScene& rayScene() const { return prepared_->transport->rayScene(); }
  SceneTransport& transport() { return *prepared_->transport; }
  const Scene& scene() const { return prepared_->scene; }  // as it was prepared
  // Of the last frame: where the technique and the frame compute.
  std::vector<Lattice> lattices() const;

 private:
  std::unique_ptr<Technique> newTechnique();
  std::unique_ptr<Renderer> newRenderer(Technique& technique, uvec2 size) const;

  gpu::Device& device_;
  std::unique_ptr<Prepared> prepared_;
  bool keepsLight_;
  Stats stats_;
  std::unique_ptr<Technique> technique_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace nephroid

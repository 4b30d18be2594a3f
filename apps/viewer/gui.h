// Dear ImGui in the window, drawn by the device that draws the scene.
#pragma once

#include <imgui.h>

#include <filesystem>

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "window.h"

namespace nephroid {

// A texture for ImGui. The image must exist until the panels are drawn.
struct GuiImage {
  const gpu::Image* image = nullptr;
  bool isSmooth = false;  // linear filtering; otherwise the nearest texel
  ImTextureID id() { return static_cast<ImTextureID>(this); }
};

class Gui {
 public:
  // Window and device must outlive it. Only one Gui may exist at a time.
  Gui(gpu::Device& device, DesktopWindow& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // Call begin, then ImGui's functions for the panels, then draw, which draws the panels over `screen`
  // (rgba8).
  void begin();
  void draw(const gpu::Image& screen);

  float scale() const { return scale_; }  // factor by which panels are enlarged: 1 on an ordinary screen
  bool wantsMouse() const;
  bool wantsKeyboard() const;  // the user types into a field

 private:
  void loadFont();
  void upload(const ImDrawData& data);
  void record(gpu::CommandList& commands, const ImDrawData& data, const gpu::Image& screen);

  gpu::Device& device_;
  float scale_ = 1;
  gpu::Program program_;
  gpu::Sampler nearest_, linear_;
  gpu::Image fontImage_;
  GuiImage font_;
  gpu::Buffer vertices_, indices_;
};

}  // namespace nephroid

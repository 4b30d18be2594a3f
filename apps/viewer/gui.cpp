#include "gui.h"

#include <imgui_impl_glfw.h>

#include <algorithm>
#include <cstddef>

#include "gpu/transfer.h"
#include "gui_data.h"
#include "shaders/apps/viewer/gui_frag.h"
#include "shaders/apps/viewer/gui_vert.h"

namespace nephroid {
namespace {

constexpr float kFontSize = 15;  // pixels on an ordinary screen

// What Debian and Ubuntu have where a desktop is; without them ImGui's own letters do.
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                  "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"};

static_assert(sizeof(GuiVertex) == sizeof(ImDrawVert) &&
              offsetof(GuiVertex, color) == offsetof(ImDrawVert, col));

ImVec4 gray(float value, float alpha = 1) {
  return {value, value, 1.06f * value, alpha};
}

void chooseStyle(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
  style.WindowBorderSize = 0;
  style.WindowPadding = {10, 8};
  style.FramePadding = {6, 3};
  style.ItemSpacing = {8, 5};
  style.ScrollbarSize = 12;
  const ImVec4 accent{0.20f, 0.52f, 0.72f, 1};
  const auto set = [&](ImGuiCol color, ImVec4 value) { style.Colors[color] = value; };
  set(ImGuiCol_WindowBg, gray(0.11f));
  set(ImGuiCol_PopupBg, gray(0.15f, 0.98f));
  set(ImGuiCol_FrameBg, gray(0.20f));
  set(ImGuiCol_FrameBgHovered, gray(0.27f));
  set(ImGuiCol_FrameBgActive, gray(0.31f));
  set(ImGuiCol_Header, gray(0.19f));
  set(ImGuiCol_HeaderHovered, gray(0.27f));
  set(ImGuiCol_HeaderActive, gray(0.31f));
  set(ImGuiCol_Button, gray(0.24f));
  set(ImGuiCol_ButtonHovered, accent);
  set(ImGuiCol_ButtonActive, {0.16f, 0.42f, 0.58f, 1});
  set(ImGuiCol_SliderGrab, accent);
  set(ImGuiCol_SliderGrabActive, {0.30f, 0.66f, 0.88f, 1});
  set(ImGuiCol_CheckMark, {0.36f, 0.74f, 0.96f, 1});
  set(ImGuiCol_PlotHistogram, accent);
  style.ScaleAllSizes(scale);
}

}  // namespace

Gui::Gui(gpu::Device& device, DesktopWindow& window)
    : device_(device),
      scale_(window.contentScale()),
      program_(gpu::createRasterProgram(device, "panels", shaders::apps_viewer_gui_vert,
                                        shaders::apps_viewer_gui_frag,
                                        {.colors = {{VK_FORMAT_R8G8B8A8_UNORM, gpu::Blend::over}}})),
      nearest_(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST})),
      linear_(gpu::createSampler(device)) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // panels have their places
  io.BackendRendererName = "nephroid";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  chooseStyle(scale_);
  loadFont();
  ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
}

Gui::~Gui() {
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::loadFont() {
  ImGuiIO& io = ImGui::GetIO();
  const auto* found =
      std::ranges::find_if(kFonts, [](const char* file) { return std::filesystem::exists(file); });
  if (found != std::end(kFonts)) {
    io.Fonts->AddFontFromFileTTF(*found, kFontSize * scale_);
  } else {
    ImFontConfig config;
    config.SizePixels = 13 * scale_;
    io.Fonts->AddFontDefault(&config);
  }
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  const std::span<const std::byte> bytes =
      std::as_bytes(std::span(pixels, std::size_t(4) * std::size_t(width) * std::size_t(height)));
  fontImage_ = gpu::createImage(device_, "letters",
                                {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                 .width = static_cast<uint32_t>(width),
                                 .height = static_cast<uint32_t>(height)});
  gpu::uploadImage(device_, fontImage_, {std::vector<std::byte>(bytes.begin(), bytes.end())});
  font_ = {&fontImage_, true};
  io.Fonts->SetTexID(font_.id());
}

bool Gui::wantsMouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wantsKeyboard() const {
  return ImGui::GetIO().WantTextInput;
}

void Gui::begin() {
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::upload(const ImDrawData& data) {
  const auto vertexCount = static_cast<std::size_t>(data.TotalVtxCount);
  const auto indexCount = static_cast<std::size_t>(data.TotalIdxCount);
  gpu::ensureBuffer(device_, vertices_, "vertices of panels", vertexCount * sizeof(GuiVertex),
                    gpu::MemoryKind::upload);
  gpu::ensureBuffer(device_, indices_, "indices of panels", indexCount * sizeof(uint32_t),
                    gpu::MemoryKind::upload);
  VkDeviceSize vertexBytes = 0;
  uint32_t* index = indices_.as<uint32_t>().data();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    const std::span vertices(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.Size));
    vertices_.writeBytes(std::as_bytes(vertices), vertexBytes);
    vertexBytes += vertices.size_bytes();
    index = std::copy_n(list.IdxBuffer.Data, list.IdxBuffer.Size, index);
  }
}

void Gui::record(gpu::CommandList& commands, const ImDrawData& data, const gpu::Image& screen) {
  const vec2 framebufferScale(data.FramebufferScale.x, data.FramebufferScale.y);
  const vec2 extent(screen.width(), screen.height());
  uint32_t firstIndex = 0;
  int32_t firstVertex = 0;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const vec2 low =
          glm::clamp(vec2(command.ClipRect.x, command.ClipRect.y) * framebufferScale, vec2(0), extent);
      const vec2 high =
          glm::clamp(vec2(command.ClipRect.z, command.ClipRect.w) * framebufferScale, vec2(0), extent);
      if (!(low.x < high.x && low.y < high.y)) continue;
      const VkRect2D scissor{{static_cast<int32_t>(low.x), static_cast<int32_t>(low.y)},
                             {static_cast<uint32_t>(high.x) - static_cast<uint32_t>(low.x),
                              static_cast<uint32_t>(high.y) - static_cast<uint32_t>(low.y)}};
      vkCmdSetScissor(commands.handle(), 0, 1, &scissor);
      const auto& image = *static_cast<const GuiImage*>(command.GetTexID());
      commands.drawIndexed(program_, indices_,
                           {firstIndex + command.IdxOffset, command.ElemCount,
                            firstVertex + static_cast<int32_t>(command.VtxOffset)},
                           1, GuiConstants{vertices_.address(), 2.0f * framebufferScale / extent},
                           {{"image", *image.image, image.isSmooth ? linear_ : nearest_}});
    }
    firstIndex += static_cast<uint32_t>(list.IdxBuffer.Size);
    firstVertex += list.VtxBuffer.Size;
  }
}

void Gui::draw(const gpu::Image& screen) {
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  upload(data);
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("panels", [&] {
      commands.render({.colors = {{&screen, 0, vec4(0.05f, 0.05f, 0.055f, 1)}}},
                      [&] { record(commands, data, screen); });
    });
  });
}

}  // namespace nephroid

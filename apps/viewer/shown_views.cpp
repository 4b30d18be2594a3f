#include "shown_views.h"

#include <algorithm>

#include "viewer.h"

namespace nephroid {
namespace {

constexpr NamedView kViews[]{{"beams", Overlay::beams},           {"planes", Overlay::planes},
                             {"slices", Overlay::slices},         {"cells", Overlay::cells},
                             {"culled", Overlay::culled},         {"normals", {}, "receivers", "normals"},
                             {"caustics", {}, "caustics"},        {"direct-light", {}, "direct light"},
                             {"depth", {}, "receivers", "depth"}, {"levels", {}, "landed light", "levels"}};

}  // namespace

std::vector<std::string> viewNames() {
  std::vector<std::string> names;
  for (const NamedView& view : kViews) names.emplace_back(view.name);
  return names;
}

NamedView viewNamed(const std::string& name) {
  return *std::ranges::find(kViews, name, &NamedView::name);
}

const PassOutput* outputOf(const ViewerState& state, const std::string& pass, const std::string& output) {
  const auto found = std::ranges::find_if(state.outputs, [&](const PassOutput& one) {
    return one.pass == pass && (output.empty() || one.name == output);
  });
  return found == state.outputs.end() ? nullptr : &*found;
}

void showView(const NamedView& view, ViewerState& state) {
  if (view.overlay) {
    state.overlays[static_cast<std::size_t>(*view.overlay)] = true;
    return;
  }
  state.shown = Shown::output;
  state.shownPass = view.pass;
  state.shownOutput = view.output;
}

}  // namespace nephroid

// What is shown in place of the picture, and over it.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"
#include "shown_views.h"
#include "techniques/registry.h"
#include "viewer/mesh_lines.h"
#include "viewer_loop.h"

namespace nephroid {
namespace {

constexpr double kSecondsAtRest = 0.25;  // before the reference begins anew from where the camera is
constexpr std::size_t kMostLines = 700;
constexpr std::size_t kMostMeshBeams = 30'000, kMostMeshWays = 150;
constexpr float kDimmed = 0.5f;  // the picture behind the mesh of rays

ImU32 colorOf(vec3 color, float alpha) {
  return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, alpha});
}

// A line in the picture, cut where it runs behind the camera.
struct PictureLine {
  vec2 from, to;  // pixels
};

std::optional<PictureLine> inPicture(const View& view, vec2 size, const SceneLine& line) {
  vec4 a = view.worldToClip * vec4(line.from, 1), b = view.worldToClip * vec4(line.to, 1);
  const float nearest = 10 * view.nearest;
  if (a.w < nearest && b.w < nearest) return std::nullopt;
  if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
  if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));
  const auto pixel = [&](vec4 clip) { return (0.5f * vec2(clip) / clip.w + 0.5f) * size; };
  return PictureLine{pixel(a), pixel(b)};
}

}  // namespace

void Viewer::show(const std::string& view) {
  const NamedView wanted = viewNamed(view);
  const bool isShown =
      state_.shown == Shown::output && state_.shownPass == wanted.pass && state_.shownOutput == wanted.output;
  if (isShown || !outputOf(state_, wanted.pass, wanted.output))
    state_.shown = Shown::picture;
  else
    showView(wanted, state_);
}

bool Viewer::seeTheSame(Drawn a, const Drawn& b) {
  a.stage = b.stage;
  a.samples = b.samples;
  return a == b;
}

// Begins when it is asked for and the picture is at rest, and goes on until the picture is another one.
void Viewer::refineReference() {
  const bool isWanted = state_.isReferenceHeld || state_.shown == Shown::error;
  const bool isThat = referenceOf_ && seeTheSame(*referenceOf_, drawn_);
  if (referenceWorker_.isRunning() && !isThat) {
    referenceWorker_.stop();
    referenceOf_.reset();
    state_.reference.reset();
  }
  if (!graphics_->stage || !state_.isOpen || drawn_.stage == 0 || isStageBusy()) return;
  // Not while what is to be drawn is another scene than what is shown.
  if (!isPictureWhole() || stateOf(state_.scene) != drawn_.state || state_.scene.time != drawn_.time) return;
  const double atRest = std::chrono::duration<double>(Clock::now() - lastChange_).count();
  if (isWanted && !isThat && atRest >= kSecondsAtRest) {
    referenceWorker_.start(exposed(state_.scene), referenceSettingsFor(drawn_.paths, drawn_.size));
    referenceOf_ = drawn_;
    comparedOf_.reset();
  }
  if (!referenceWorker_.isRunning()) return;
  if (state_.shown == Shown::error && comparedOf_ != drawn_ && !isGathering()) {
    referenceWorker_.compare(graphics_->stage->renderer().layers());
    comparedOf_ = drawn_;
  }
  const auto newest = referenceWorker_.newest();
  if (newest == state_.reference) return;
  state_.reference = newest;
  framesToGo_ = std::max(framesToGo_, 1);
  if (newest && !newest->failure.empty()) tell(state_, newest->failure, true);
}

void Viewer::showOutput() {
  const PassOutput* found = outputOf(state_, state_.shownPass, state_.shownOutput);
  if (!found) {
    state_.shown = Shown::picture;
    return;
  }
  Stage& stage = *graphics_->stage;
  PassOutput output = *found;
  state_.outputLegend = {};
  if (output.make) output.image = output.make(stage.renderer().seenPoints(), state_.outputLegend);
  picture_.image = &graphics_->outputView().show(output, stage.size());
}

void Viewer::chooseShownImage() {
  if (!graphics_->stage || isStageBusy()) return;
  picture_ = {&graphics_->stage->picture(), false};
  const auto& reference = state_.reference;
  const bool isError = !state_.isReferenceHeld && state_.shown == Shown::error;
  if (reference && reference->passes > 0 && (state_.isReferenceHeld || (isError && reference->error))) {
    if (uploaded_ != reference || isErrorUploaded_ != isError)
      graphics_->upload(isError ? reference->error->picture : reference->picture);
    uploaded_ = reference;
    isErrorUploaded_ = isError;
    picture_.image = &graphics_->uploaded();
  } else if (state_.shown == Shown::output && !state_.isReferenceHeld) {
    showOutput();
  }
}

// Where there is a mesh of rays.
void Viewer::addMeshLines() {
  const Stage& stage = *graphics_->stage;
  const RayMesh* mesh = stage.rayMesh();
  if (!mesh || mesh->beams.empty()) return;
  MeshLines some = meshLines(*mesh, kMostMeshBeams, kMostMeshWays);
  removeHidden(stage.rayScene(), state_.scene.camera.position, some.sides);
  for (const std::vector<SceneLine>* part : {&some.ways, &some.sides})
    lines_.insert(lines_.end(), part->begin(), part->end());
  state_.meshLegend = meshLegend(*mesh);
}

void Viewer::updateLines() {
  if (isStageBusy()) return;
  if (!graphics_->stage || std::ranges::count(state_.overlays, true) == 0) {
    lines_.clear();
    linesOf_.reset();
    state_.meshLegend = {};
    return;
  }
  if (linesOf_ && linesOf_->first == drawn_ && linesOf_->second == state_.overlays) return;
  linesOf_ = {drawn_, state_.overlays};
  framesToGo_ = std::max(framesToGo_, 1);
  lines_.clear();
  state_.meshLegend = {};
  Stage& stage = *graphics_->stage;
  const auto add = [&](const std::vector<SceneLine>& some) {
    lines_.insert(lines_.end(), some.begin(), some.end());
  };
  const TechniqueSettings& settings = stage.settings().technique;
  const Paths paths = settings.transport.paths;
  const bool beams = techniqueNamed(settings.technique).traits.usesBeams;
  if (state_.isOverlaid(Overlay::beams) && beams) add(beamLines(stage.transport(), paths, kMostLines));
  if (state_.isOverlaid(Overlay::beams)) addMeshLines();
  if (state_.isOverlaid(Overlay::culled) && beams)
    add(culledLines(stage.transport(), paths, kMostLines, state_.beamCounts));
  const std::vector<Lattice> lattices = stage.lattices();
  if (state_.isOverlaid(Overlay::planes)) add(latticeLines(lattices, LatticeKind::planes));
  if (state_.isOverlaid(Overlay::slices)) add(latticeLines(lattices, LatticeKind::slices));
  if (state_.isOverlaid(Overlay::cells)) add(latticeLines(lattices, LatticeKind::cells));
  if (lines_.empty())
    tell(state_, "There is nothing of this kind to show with " + settings.technique + " here");
}

void Viewer::drawLines(vec2 corner, vec2 size) const {
  if (lines_.empty()) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({corner.x, corner.y}, {corner.x + size.x, corner.y + size.y});
  const View view = viewOf(state_.scene.camera, uvec2(size));
  if (!state_.meshLegend.entries.empty())
    list.AddRectFilled({corner.x, corner.y}, {corner.x + size.x, corner.y + size.y},
                       colorOf(vec3(0), kDimmed));
  for (const SceneLine& line : lines_)
    if (const auto seen = inPicture(view, size, line)) {
      const vec2 from = corner + seen->from, to = corner + seen->to;
      list.AddLine({from.x, from.y}, {to.x, to.y}, colorOf(line.color, line.opacity), 1);
    }
  list.PopClipRect();
}

// Where lights are held; the one that is chosen with all its handles, and a box about an object.
void Viewer::drawHandles(vec2 corner, vec2 size) const {
  if (!state_.isOpen || !state_.arePanelsShown || state_.isReferenceHeld) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float scale = graphics_->gui().scale();
  list.PushClipRect({corner.x, corner.y}, {corner.x + size.x, corner.y + size.y});
  const Selection& selection = state_.selection;
  std::optional<vec2> body;
  for (const Handle& handle : handlesOf(state_.scene)) {
    const bool isChosen = selection == Selection{Chosen::light, handle.light};
    const auto pixel = pixelOf(state_.scene.camera, uvec2(size), handle.position);
    if (handle.part == HandlePart::body) body = pixel;
    if (!pixel || (handle.part != HandlePart::body && !isChosen)) continue;
    const vec2 at = corner + *pixel;
    const vec3 color = isChosen ? vec3(1, 0.8f, 0.25f) : vec3(1, 1, 0.8f);
    if (handle.part != HandlePart::body && body)
      list.AddLine({corner.x + body->x, corner.y + body->y}, {at.x, at.y}, colorOf(color, 0.8f),
                   1.5f * scale);
    list.AddCircleFilled({at.x, at.y}, 5 * scale, colorOf(color, 0.9f));
    list.AddCircle({at.x, at.y}, 6 * scale, colorOf(vec3(0), 0.7f), 0, 1.5f * scale);
  }
  if (selection.what == Chosen::object) {
    const Object& object = state_.scene.objects[selection.index];
    const Box bounds = boundingBox(state_.scene.meshOf(object));
    const vec3 extent = bounds.size();
    const vec3 x = object.placement.direction({extent.x, 0, 0}),
               y = object.placement.direction({0, extent.y, 0}),
               z = object.placement.direction({0, 0, extent.z});
    const float s = object.placement.scale;
    const Lattice box{
        LatticeKind::planes, object.placement.point(bounds.low), {s * x, s * y, s * z}, uvec3(1)};
    const View view = viewOf(state_.scene.camera, uvec2(size));
    for (const SceneLine& line : latticeLines({&box, 1}, LatticeKind::planes))
      if (const auto seen = inPicture(view, size, line)) {
        const vec2 from = corner + seen->from, to = corner + seen->to;
        list.AddLine({from.x, from.y}, {to.x, to.y}, colorOf({1, 0.8f, 0.25f}, 0.6f), 1.5f * scale);
      }
  }
  list.PopClipRect();
}

}  // namespace nephroid

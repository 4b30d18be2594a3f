#include "transport/scene_transport.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "scene/checks.h"
#include "transport/table/table_file.h"
#include "transport/table/table_source.h"

namespace nephroid {
namespace {

// Which tables a scene needs, and which of them each object uses.
struct TablePlan {
  std::vector<TableKey> keys;
  std::vector<uint32_t> owners;                      // an object that each was planned for
  std::vector<std::optional<std::size_t>> ofObject;  // none where an object is traced
};

TablePlan planTables(const Scene& scene, const TableSettings& settings) {
  TablePlan plan;
  plan.ofObject.resize(scene.objects.size());
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!hasTable(scene, object)) continue;
    const TableKey key = tableKey(scene.meshOf(object), scene.materialOf(object).ior, settings);
    const auto found = std::find(plan.keys.begin(), plan.keys.end(), key);
    plan.ofObject[i] = static_cast<std::size_t>(found - plan.keys.begin());
    if (found != plan.keys.end()) continue;
    plan.keys.push_back(key);
    plan.owners.push_back(i);
  }
  return plan;
}

std::vector<TransportTable> makePlanned(const Scene& scene, const TablePlan& plan,
                                        const TableSettings& settings, Progress& progress) {
  std::vector<TransportTable> tables;
  for (const uint32_t owner : plan.owners) {
    const Object& object = scene.objects[owner];
    tables.push_back(
        loadOrBuildTable(scene.meshOf(object), scene.materialOf(object).ior, settings, progress));
  }
  return tables;
}

}  // namespace

std::vector<TransportTable> makeTables(const Scene& scene, const TransportSettings& settings,
                                       Progress& progress) {
  const TableSettings tableSettings{settings.directions};
  return makePlanned(scene, planTables(scene, tableSettings), tableSettings, progress);
}

std::unique_ptr<TransportSource> makeTableSource(const Scene& scene, const TransportSettings& settings,
                                                 const TracedSource& traced, Progress& progress) {
  const TableSettings tableSettings{settings.directions};
  const TablePlan plan = planTables(scene, tableSettings);
  const std::vector<TransportTable> tables = settings.baked.empty()
                                                 ? makePlanned(scene, plan, tableSettings, progress)
                                                 : openTables(settings.baked, plan.keys);
  std::vector<std::optional<TransportTable>> ofObject(scene.objects.size());
  for (std::size_t i = 0; i < ofObject.size(); ++i)
    if (plan.ofObject[i]) ofObject[i] = tables[*plan.ofObject[i]];
  return std::make_unique<TableSource>(scene, std::move(ofObject), traced);
}

SceneTransport::SceneTransport(const Scene& scene, const TransportSettings& settingsToUse,
                               Progress& progressToShow, SourceMaker maker)
    : settings_(settingsToUse),
      progress_(progressToShow),
      now_(scene),
      rays_(now_),
      traced_(now_, rays_),
      makeSource_(std::move(maker)) {}

void SceneTransport::place(const Scene& scene) {
  checkMoved(scene, now_);
  now_.time = scene.time;
  now_.camera = scene.camera;
  now_.environment = scene.environment;
  now_.objects = scene.objects;
  now_.materials = scene.materials;
  now_.lights = scene.lights;
  for (const Object& object : scene.objects) {
    if (!object.water || now_.meshes[object.mesh].positions == scene.meshOf(object).positions) continue;
    now_.meshes[object.mesh] = scene.meshOf(object);
    rays_.reshape(object.mesh);
  }
  rays_.place(now_);
}

const TransportSource& SceneTransport::source() {
  if (!makeSource_ && settings_.source == Source::traced) return traced_;
  if (!made_)
    made_ = makeSource_ ? makeSource_(now_, traced_) : makeTableSource(now_, settings_, traced_, progress_);
  return *made_;
}

}  // namespace nephroid

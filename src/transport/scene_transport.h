// How light, and sight, goes through the casters of a scene that moves.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/progress.h"
#include "scene/scene.h"
#include "transport/settings.h"
#include "transport/source.h"
#include "transport/table/table.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

// Returns the light transport tables of a scene's casters. Casters with the same mesh and index of refraction
// share a table. Tables are taken from the cache, or built and stored there.
std::vector<TransportTable> makeTables(const Scene& scene, const TransportSettings& settings,
                                       Progress& progress);

// Makes the source "table", with the tables in `settings.baked` or those of makeTables. It uses `traced` for
// everything that no table contains. Scene and `traced` must outlive it. Throws InputError where the baked
// file is not for this scene.
std::unique_ptr<TransportSource> makeTableSource(const Scene& scene, const TransportSettings& settings,
                                                 const TracedSource& traced, Progress& progress);

// How light, and sight, goes through the casters of a scene that moves.
class SceneTransport {
 public:
  using SourceMaker = std::function<std::unique_ptr<TransportSource>(const Scene&, const TracedSource&)>;

  // `progress` must outlive it. With `maker`, the source is made by `maker`, and not by the settings. Throws
  // InputError as checkScene does.
  SceneTransport(const Scene& scene, const TransportSettings& settings, Progress& progress,
                 SourceMaker maker = {});

  // Takes the state of `scene`, which must have the same objects and meshes as before; water may have another
  // shape. Throws InputError as checkMoved does; nothing has changed then.
  void place(const Scene& scene);

  const Scene& scene() const { return now_; }
  // The first call loads or builds the tables.
  const TransportSource& source();
  const TracedSource& traced() const { return traced_; }
  const RayScene& rayScene() const { return rays_; }
  MediumStack mediaAround(const Emitter& emitter) const { return traced_.mediaAround(emitter); }

 private:
  const TransportSettings settings_;
  Progress& progress_;
  Scene now_;  // the sources refer to it, so it must not be moved in memory
  RayScene rays_;
  TracedSource traced_;
  SourceMaker makeSource_;
  std::unique_ptr<TransportSource> made_;
};

}  // namespace nephroid

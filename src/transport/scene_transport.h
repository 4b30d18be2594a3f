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

// A table for each caster that can have one, casters of one mesh and one index of refraction sharing theirs:
// from the cache, or built and left there.
std::vector<TransportTable> makeTables(const Scene& scene, const TransportSettings& settings,
                                       Progress& progress);

// The source "table": of the tables in `settings.baked`, or of makeTables; what no table holds goes to
// `traced`. Scene and `traced` must outlive it. Throws InputError where the baked file is not of this scene.
std::unique_ptr<TransportSource> makeTableSource(const Scene& scene, const TransportSettings& settings,
                                                 const TracedSource& traced, Progress& progress);

// How light, and sight, goes through the casters of a scene that moves.
class SceneTransport {
 public:
  using SourceMaker = std::function<std::unique_ptr<TransportSource>(const Scene&, const TracedSource&)>;

  // Progress must outlive it. With `maker` the source is that one's, whatever the settings say. Throws
  // InputError as checkScene does.
  SceneTransport(const Scene& scene, const TransportSettings& settings, Progress& progress,
                 SourceMaker maker = {});

  // Moves all to where `scene` has it, with the objects and meshes that this was made with; water may have
  // another shape. Throws InputError as checkMoved does, and then moves nothing.
  void place(const Scene& scene);

  const Scene& scene() const { return now; }
  // Tables are found or made when it is first called.
  const TransportSource& source();
  const RayScene& rayScene() const { return rays; }
  MediumStack mediaAround(const Emitter& emitter) const { return traced.mediaAround(emitter); }

 private:
  const TransportSettings settings;
  Progress& progress;
  Scene now;  // the sources look at it, and it stays where it is
  RayScene rays;
  TracedSource traced;
  SourceMaker makeSource;
  std::unique_ptr<TransportSource> made;
};

}  // namespace nephroid

// The light transport table of a caster (Iwasaki 2005, "A Method for Fast Rendering of Caustics from
// Refraction by Transparent Objects"): for each vertex and each sampled direction of incoming light the ray
// that leaves the caster. It is computed in the mesh's own space, so it holds wherever the caster stands,
// whatever the light and whatever the colour of the material.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/shared_language.h"
#include "lights/emitter.h"
#include "scene/scene.h"
#include "transport/outgoing_ray.h"
#include "transport/table/lookup.h"

namespace nephroid {

struct TableSettings {
  uint32_t directions =
      129;  // per vertex; the nearest 1 + rings * azimuths with twice as many azimuths as rings is used
};

// Of positions, normals, triangles and whether the surface bends.
uint64_t geometryHash(const Mesh& mesh);

// What a table was computed for. A table is only ever used where its key is the one asked for.
struct TableKey {
  uint64_t geometry = 0;  // geometryHash
  vec3 ior{0};            // per channel
  uint32_t vertices = 0;
  uint32_t rings = 0;
  uint32_t azimuths = 0;
  bool operator==(const TableKey&) const = default;
  uint32_t directions() const { return 1 + rings * azimuths; }
  uint32_t bands() const { return ior.x == ior.y && ior.y == ior.z ? 1 : 3; }
  uint64_t words() const { return uint64_t{blockWordsFor(directions())} * vertices * bands(); }
};

// Whether a table of this key can exist: its numbers of rings and azimuths go together, and 32 bits address
// all of it.
bool isAddressable(const TableKey& key);

// The part of a table's layout that follows from its key; the rest is 0.
TableLayout layoutOf(const TableKey& key);

// InputError when there are fewer than 9 directions, or so many that the table could not be addressed.
TableKey tableKey(const Mesh& mesh, vec3 ior, const TableSettings& settings = {});

// Read-only; copies share their words, which are in memory or mapped from a file.
class TransportTable {
 public:
  TransportTable(const TableKey& tableKey, const TableView& tableView, std::shared_ptr<const void> wordsOwner)
      : itsKey(tableKey), itsView(tableView), owner(std::move(wordsOwner)) {}

  const TableKey& key() const { return itsKey; }
  // What look-ups and the GPU need; the words live as long as the table.
  const TableView& view() const { return itsView; }
  std::span<const uint32_t> words() const;
  std::size_t sizeInBytes() const { return words().size_bytes(); }

 private:
  TableKey itsKey;
  TableView itsView;
  std::shared_ptr<const void> owner;
};

// Traces every sampled ray, in parallel; the same table whatever the number of threads. RuntimeFailure when
// it does not fit in memory.
TransportTable buildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress);

// In mesh space; `direction` is the unit way the light travels, in the frame of the vertex (vertexFrame of
// its normal). `band` is a colour channel; a table without dispersion answers the same for all.
OutgoingRay lookUp(const TransportTable& table, uint32_t vertex, vec3 direction, uint32_t band = 0);

// World-space rays of all vertices of a caster lit by `emitter`, absorption included. In parallel; traces
// nothing.
void tableRays(const TransportTable& table, const Mesh& mesh, const Placement& placement,
               const Material& material, const Emitter& emitter, uint32_t band, std::span<OutgoingRay> rays);

}  // namespace nephroid

// The light transport table of a caster (Iwasaki 2005, "A Method for Fast Rendering of Caustics from
// Refraction by Transparent Objects"): for each vertex and each sampled direction of incoming light the ray
// that leaves the caster. It is computed in the mesh's own space, so it is valid for every placement of the
// caster, for every light, and for every color of the material.
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

// A hash of positions, normals, triangles and isCurved.
uint64_t geometryHash(const Mesh& mesh);

// Everything that a table depends on. A stored table is used only where its key is equal to the wanted one.
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

// Whether a table with this key can exist: its numbers of rings and azimuths fit together, and 32 bits are
// enough to address its words.
bool isAddressable(const TableKey& key);

// The part of a table's layout that follows from its key; the rest is 0.
TableLayout layoutOf(const TableKey& key);

// Throws InputError where there are fewer than 9 directions, or so many that the table cannot be addressed.
TableKey tableKey(const Mesh& mesh, vec3 ior, const TableSettings& settings = {});

// A table. It is read-only. Copies share their words, which are in memory or mapped from a file.
class TransportTable {
 public:
  TransportTable(const TableKey& tableKey, const TableView& tableView, std::shared_ptr<const void> wordsOwner)
      : itsKey_(tableKey), itsView_(tableView), owner_(std::move(wordsOwner)) {}

  const TableKey& key() const { return itsKey_; }
  // For look-ups and for the GPU. The words exist as long as the table.
  const TableView& view() const { return itsView_; }
  std::span<const uint32_t> words() const;
  std::size_t sizeInBytes() const { return words().size_bytes(); }

 private:
  TableKey itsKey_;
  TableView itsView_;
  std::shared_ptr<const void> owner_;
};

// Traces every sampled ray, in parallel. The table does not depend on the number of threads. Throws
// RuntimeFailure where it does not fit in memory.
TransportTable buildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress);

// Looks up a ray, in mesh space. `direction`: unit, in which the light travels, in the frame of the vertex
// (vertexFrame of its normal). `band`: color channel; without dispersion the result is the same for all.
OutgoingRay lookUp(const TransportTable& table, uint32_t vertex, vec3 direction, uint32_t band = 0);

// The outgoing rays (world space) of all vertices of a caster that `emitter` lights, with absorption. Runs in
// parallel and traces no rays.
void tableRays(const TransportTable& table, const Mesh& mesh, const Placement& placement,
               const Material& material, const Emitter& emitter, uint32_t band, std::span<OutgoingRay> rays);

}  // namespace nephroid

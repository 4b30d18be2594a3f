#include "transport/table/table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/hash.h"

namespace nephroid {
namespace {

constexpr uint32_t kFewestRings = 2;
constexpr uint32_t kMostRings = 1024;
constexpr uint64_t kMostWords = uint64_t{1} << 32;  // an entry is addressed by 32 bits, in C++ and GLSL

uint32_t directionsOf(uint32_t rings) {
  return 1 + rings * 2 * rings;
}

}  // namespace

uint64_t geometryHash(const Mesh& mesh) {
  Hasher hasher;
  hasher.add(mesh.positions.size());
  hasher.add(uint32_t{mesh.isCurved});
  hasher.add(std::as_bytes(std::span(mesh.positions)));
  hasher.add(std::as_bytes(std::span(mesh.normals)));
  hasher.add(std::as_bytes(std::span(mesh.triangles)));
  return hasher.value();
}

bool isAddressable(const TableKey& key) {
  return key.rings >= kFewestRings && key.rings <= kMostRings && key.azimuths == 2 * key.rings &&
         key.words() <= kMostWords;
}

TableLayout layoutOf(const TableKey& key) {
  TableLayout layout{};
  layout.vertices = key.vertices;
  layout.bands = key.bands();
  layout.rings = key.rings;
  layout.azimuths = key.azimuths;
  layout.blockWords = blockWordsFor(key.directions());
  layout.ior = key.ior;
  return layout;
}

TableKey tableKey(const Mesh& mesh, vec3 ior, const TableSettings& settings) {
  if (settings.directions < directionsOf(kFewestRings) || settings.directions > directionsOf(kMostRings)) {
    throw InputError("--directions " + std::to_string(settings.directions) + ": a table needs from " +
                     std::to_string(directionsOf(kFewestRings)) + " to " +
                     std::to_string(directionsOf(kMostRings)) + " directions a vertex");
  }
  TableKey key;
  key.geometry = geometryHash(mesh);
  key.ior = ior;
  key.vertices = static_cast<uint32_t>(mesh.positions.size());
  key.rings = static_cast<uint32_t>(std::lround(std::sqrt((settings.directions - 1) / 2.0)));
  key.azimuths = 2 * key.rings;
  if (!isAddressable(key)) {
    throw InputError("mesh '" + mesh.name + "': a light transport table of " + std::to_string(key.vertices) +
                     " vertices with " + std::to_string(key.directions()) + " directions would take " +
                     std::to_string(key.words() * 4 / 1000000) + " MB, over the limit of " +
                     std::to_string(kMostWords * 4 / 1000000) + " MB; give fewer --directions");
  }
  return key;
}

std::span<const uint32_t> TransportTable::words() const {
  return {itsView_.words, static_cast<std::size_t>(itsKey_.words())};
}

}  // namespace nephroid

// Irradiance volumes on disk: versioned, checksummed, and memory-mapped when read. Little-endian.
#pragma once

#include <functional>

#include "core/progress.h"
#include "irradiance_volume/volume.h"

namespace nephroid {

// Light samples `first` to `last` - 1 of each volume.
struct SampleRange {
  uint32_t first = 0;
  uint32_t last = std::numeric_limits<uint32_t>::max();
};

// Writes one volume after another, each light sample as soon as it is computed. Samples that an interrupted
// run left in the cache are not computed again. The file is written beside its destination and then renamed.
// Throws RuntimeFailure where it cannot be written, InputError where a volume has no sample in the range.
void writeVolumes(std::span<IrradianceVolume* const> volumes, SampleRange range,
                  const std::filesystem::path& file, Progress& progress);

// Returns a volume for each key of `expected`, in that order. The data stays in the mapped file. Throws
// InputError, with the reason, where the file is missing, holds no irradiance volumes, has another version,
// is truncated or damaged, or was baked for other meshes, materials or settings.
std::vector<StoredVolume> openVolumes(const std::filesystem::path& file, std::span<const VolumeKey> expected);

// Joins parts of a bake, which hold different ranges of light samples. The result has the same bytes as a
// bake in one run. Throws InputError where a part is missing, damaged, or of another bake.
void mergeVolumes(std::span<const std::filesystem::path> parts, const std::filesystem::path& file);

// cachedSample returns a light sample from the cache folder if a complete one is there; keepSample
// stores one there. Errors in that folder are ignored. The least recently used samples are removed when the
// folder holds more than 2 GiB of them.
std::optional<SampleView> cachedSample(const std::filesystem::path& folder, const VolumeKey& key,
                                       const Symmetry& symmetry, uint32_t index);
void keepSample(const std::filesystem::path& folder, const StoredVolume& one);

}  // namespace nephroid

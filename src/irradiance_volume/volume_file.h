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

// One volume after another, each light sample written as soon as it is made: those that a run left in the
// cache before it was interrupted are not made again. Written beside its place and renamed. RuntimeFailure
// when that cannot be done, InputError where a volume has no sample in the range.
void writeVolumes(std::span<IrradianceVolume* const> volumes, SampleRange range,
                  const std::filesystem::path& file, Progress& progress);

// A volume for each of `expected`, in that order, served straight from the mapped file. InputError, saying
// which, when the file is missing, holds no irradiance volumes, is of another version, truncated or damaged,
// or was baked for other meshes, materials or settings.
std::vector<StoredVolume> openVolumes(const std::filesystem::path& file, std::span<const VolumeKey> expected);

// Joins the parts of one bake, by ranges of light samples, into what one run would have written, byte for
// byte. InputError where a part is missing, damaged, or of another bake.
void mergeVolumes(std::span<const std::filesystem::path> parts, const std::filesystem::path& file);

// A light sample from the cache folder, if it is there and whole; and one left there. Nothing in that folder
// is an error. The least recently used samples go when the folder holds more than 2 GiB of them.
std::optional<SampleView> cachedSample(const std::filesystem::path& folder, const VolumeKey& key,
                                       const Symmetry& symmetry, uint32_t index);
void keepSample(const std::filesystem::path& folder, const StoredVolume& one);

}  // namespace nephroid

#include "irradiance_volume/volume_file.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "core/atomic_file.h"
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/mapped_file.h"
#include "irradiance_volume/harmonics.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "volumes are written as they lie in memory");

constexpr char kMagic[8] = {'n', 'e', 'p', 'h', 'I', 'R', 'V', '\n'};
constexpr uint32_t kVersion = 2;  // goes up with every change to what is stored or to how light is followed
constexpr uint64_t kCacheBytes = uint64_t{2} << 30;
constexpr const char* kExtension = ".light";
constexpr uint32_t kSamplesBetweenTrims = 32;

// What each volume of a file begins with; its light samples follow, a layout and its words each.
struct FileHeader {
  char magic[8];
  uint32_t version;
  uint32_t index;    // of this volume in the file
  uint32_t volumes;  // in the file
  uint32_t firstSample;
  uint32_t samples;     // in the file
  uint32_t allSamples;  // of the volume
  VolumeSettings settings;
  uint32_t isBall;
  uint32_t axis;
  uint32_t mirrors;  // a bit each
  uint32_t reserved;
  uint64_t geometry;
  uint64_t material;
  uint64_t bodyBytes;
  uint64_t bodyHash;
  uint64_t headerHash;  // of all before it
};
static_assert(sizeof(FileHeader) == 120 && offsetof(FileHeader, headerHash) == 112);
static_assert(sizeof(SampleLayout) == 48);

uint64_t hashOf(const FileHeader& header) {
  return hashBytes(std::as_bytes(std::span(&header, 1)).first(offsetof(FileHeader, headerHash)));
}

FileHeader headerOf(const VolumeKey& key, const Symmetry& symmetry) {
  FileHeader header{};
  std::copy(std::begin(kMagic), std::end(kMagic), header.magic);
  header.version = kVersion;
  header.volumes = 1;
  header.settings = key.settings;
  header.geometry = key.geometry;
  header.material = key.material;
  header.isBall = symmetry.isBall;
  header.axis = symmetry.axis;
  for (uint32_t axis = 0; axis < 3; ++axis) header.mirrors |= uint32_t{symmetry.mirrors[axis]} << axis;
  return header;
}

VolumeKey keyOf(const FileHeader& header) {
  return {header.geometry, header.material, header.settings};
}

Symmetry symmetryOf(const FileHeader& header) {
  Symmetry symmetry;
  symmetry.isBall = header.isBall != 0;
  symmetry.axis = header.axis;
  for (uint32_t axis = 0; axis < 3; ++axis) symmetry.mirrors[axis] = (header.mirrors >> axis & 1u) != 0;
  return symmetry;
}

// Writes a volume's samples as they come, then its header before them.
class VolumeWriter {
 public:
  VolumeWriter(std::ofstream& stream, const FileHeader& header) : stream_(stream), header_(header) {
    start_ = stream_.tellp();
    stream_.write(reinterpret_cast<const char*>(&header_), sizeof header_);
  }
  void add(const SampleView& sample) {
    write(std::as_bytes(std::span(&sample.layout, 1)));
    write(std::as_bytes(sample.words));
    ++header_.samples;
  }
  void finish() {
    header_.bodyHash = hasher_.value();
    header_.headerHash = hashOf(header_);
    const auto end = stream_.tellp();
    stream_.seekp(start_);
    stream_.write(reinterpret_cast<const char*>(&header_), sizeof header_);
    stream_.seekp(end);
  }

 private:
  void write(std::span<const std::byte> bytes) {
    stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    hasher_.add(bytes);
    header_.bodyBytes += bytes.size();
  }

  std::ofstream& stream_;
  FileHeader header_;
  std::streampos start_;
  Hasher hasher_;
};

void finishFile(std::ofstream& stream, AtomicFile& output, const fs::path& file) {
  stream.close();
  if (!stream) throw RuntimeFailure("cannot write '" + file.string() + "': " + std::strerror(errno));
  output.commit();
}

[[noreturn]] void reject(const fs::path& file, const std::string& what) {
  throw InputError("irradiance volume '" + file.string() + "' " + what);
}

void checkHeader(const fs::path& file, const FileHeader& header, std::size_t index) {
  if (!std::equal(std::begin(kMagic), std::end(kMagic), header.magic))
    reject(
        file,
        "is not one; `nephroid bake SCENE --technique irradiance-volume -o FILE` writes irradiance volumes");
  if (header.version != kVersion)
    reject(file, "has format version " + std::to_string(header.version) + ", this program reads version " +
                     std::to_string(kVersion) + "; bake it again");
  if (header.headerHash != hashOf(header) || header.index != index || header.axis > 3 ||
      header.settings.lightLevel > kMostLightLevels || header.settings.order > kMostHarmonicOrder)
    reject(file, "is damaged: a header's checksum does not fit; bake it again");
}

// A volume of a file, with what its header says of the whole.
struct FileVolume {
  FileHeader header;
  StoredVolume stored;
};

std::vector<SampleView> samplesOf(const fs::path& file, const FileHeader& header, const std::byte* body,
                                  const std::shared_ptr<const void>& owner) {
  std::vector<SampleView> samples;
  uint64_t offset = 0;
  for (uint32_t i = 0; i < header.samples; ++i) {
    SampleView sample;
    if (header.bodyBytes - offset < sizeof sample.layout) reject(file, "is damaged; bake it again");
    std::memcpy(&sample.layout, body + offset, sizeof sample.layout);
    offset += sizeof sample.layout;
    if ((header.bodyBytes - offset) / sizeof(uint32_t) < sample.layout.words)
      reject(file, "is damaged; bake it again");
    sample.words = {reinterpret_cast<const uint32_t*>(body + offset), sample.layout.words};
    sample.owner = owner;
    offset += sample.words.size_bytes();
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::vector<FileVolume> readVolumes(const fs::path& file) {
  const MappedFile mapped = mapFile(file, "irradiance volume", sizeof(FileHeader));
  const auto* bytes = static_cast<const std::byte*>(mapped.bytes.get());
  std::vector<FileVolume> volumes;
  uint64_t offset = 0;
  uint64_t count = 1;
  while (volumes.size() < count) {
    FileHeader header;
    if (mapped.size - offset < sizeof header)
      reject(file, "is truncated: it ends within a header; bake it again");
    std::memcpy(&header, bytes + offset, sizeof header);
    checkHeader(file, header, volumes.size());
    offset += sizeof header;
    if (mapped.size - offset < header.bodyBytes)
      reject(file, "is truncated: " + std::to_string(mapped.size) + " of at least " +
                       std::to_string(offset + header.bodyBytes) + " bytes; bake it again");
    if (hashBytes({bytes + offset, header.bodyBytes}) != header.bodyHash)
      reject(file, "is damaged: the checksum does not fit; bake it again");
    volumes.push_back({header,
                       {keyOf(header), symmetryOf(header), header.firstSample,
                        samplesOf(file, header, bytes + offset, mapped.bytes)}});
    count = header.volumes;
    offset += header.bodyBytes;
  }
  if (offset != mapped.size) reject(file, "is damaged: it is longer than its volumes; bake it again");
  return volumes;
}

[[noreturn]] void rejectForeign(const fs::path& file, std::span<const FileVolume> volumes,
                                const VolumeKey& expected) {
  const auto sameMesh = std::ranges::find_if(
      volumes, [&](const FileVolume& volume) { return volume.stored.key.geometry == expected.geometry; });
  if (sameMesh == volumes.end()) reject(file, "was baked for another mesh; bake it again from this scene");
  const VolumeKey& key = sameMesh->stored.key;
  if (key.material != expected.material)
    reject(file,
           "was baked for another material or another scale of an absorbing one; bake it again from "
           "this scene");
  const VolumeSettings& have = key.settings;
  const VolumeSettings& want = expected.settings;
  const auto compare = [&](const char* flag, uint32_t has, uint32_t wants) {
    if (has != wants)
      reject(file, std::string("was baked with --") + flag + " " + std::to_string(has) + ", not " +
                       std::to_string(wants) + "; bake it again or give --" + flag + " " +
                       std::to_string(has));
  };
  if (have.representation != want.representation || have.paths != want.paths)
    reject(file, "was baked with another --representation or --paths; bake it again or give the same");
  compare("volume-kilobytes", have.kilobytes, want.kilobytes);
  compare("light-level", have.lightLevel, want.lightLevel);
  compare("volume-radius", have.radius, want.radius);
  compare("volume-photons", have.photons, want.photons);
  compare("harmonic-order", have.order, want.order);
  compare("volume-error", have.error, want.error);
  reject(file, "was baked with other settings; bake it again");
}

fs::path cacheFile(const fs::path& folder, const VolumeKey& key, uint32_t index) {
  Hasher hasher;
  hasher.add(kVersion);
  hasher.add(key.geometry);
  hasher.add(key.material);
  hasher.add(std::as_bytes(std::span(&key.settings, 1)));
  hasher.add(index);
  std::ostringstream name;
  name << std::hex << std::setfill('0') << std::setw(16) << hasher.value() << kExtension;
  return folder / name.str();
}

}  // namespace

void writeVolumes(std::span<IrradianceVolume* const> volumes, SampleRange range, const fs::path& file,
                  Progress& progress) {
  uint64_t total = 0;
  for (IrradianceVolume* volume : volumes) {
    const auto all = volume->sampleCount();
    if (range.first >= all)
      throw InputError("--light-range: a caster has the light samples 0:" + std::to_string(all) + " alone");
    total += std::min(range.last, all) - range.first;
  }
  AtomicFile output(file);
  std::ofstream stream(output.temporary(), std::ios::binary);
  progress.begin("light samples", total);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    IrradianceVolume& volume = *volumes[i];
    FileHeader header = headerOf(volume.key(), volume.symmetry());
    header.index = uint32_t(i);
    header.volumes = uint32_t(volumes.size());
    header.firstSample = range.first;
    header.allSamples = volume.sampleCount();
    VolumeWriter writer(stream, header);
    for (uint32_t s = range.first; s < std::min(range.last, header.allSamples); ++s) {
      writer.add(volume.makeSample(s));
      progress.advance();
    }
    writer.finish();
  }
  progress.finish();
  finishFile(stream, output, file);
}

std::vector<StoredVolume> openVolumes(const fs::path& file, std::span<const VolumeKey> expected) {
  const std::vector<FileVolume> volumes = readVolumes(file);
  std::vector<StoredVolume> found;
  for (const VolumeKey& key : expected) {
    const auto match =
        std::ranges::find_if(volumes, [&](const FileVolume& volume) { return volume.stored.key == key; });
    if (match == volumes.end()) rejectForeign(file, volumes, key);
    found.push_back(match->stored);
  }
  return found;
}

void mergeVolumes(std::span<const fs::path> parts, const fs::path& file) {
  struct Part {
    fs::path file;
    std::vector<FileVolume> volumes;
  };
  std::vector<Part> all;
  for (const fs::path& part : parts) all.push_back({part, readVolumes(part)});
  std::ranges::sort(all, {}, [](const Part& part) { return part.volumes[0].header.firstSample; });
  AtomicFile output(file);
  std::ofstream stream(output.temporary(), std::ios::binary);
  for (std::size_t i = 0; i < all[0].volumes.size(); ++i) {
    FileHeader header = all[0].volumes[i].header;
    header.firstSample = 0;
    header.samples = 0;
    header.bodyBytes = 0;
    uint32_t next = 0;
    VolumeWriter writer(stream, header);
    for (const Part& part : all) {
      if (part.volumes.size() != all[0].volumes.size() ||
          part.volumes[i].stored.key != all[0].volumes[i].stored.key)
        reject(part.file, "is not a part of the bake that '" + all[0].file.string() + "' is of");
      const FileVolume& volume = part.volumes[i];
      if (volume.header.firstSample != next)
        reject(part.file, "begins at light sample " + std::to_string(volume.header.firstSample) +
                              ", where sample " + std::to_string(next) + " is wanted next");
      for (const SampleView& sample : volume.stored.samples) writer.add(sample);
      next += uint32_t(volume.stored.samples.size());
    }
    if (next != header.allSamples)
      throw InputError("the parts end at light sample " + std::to_string(next) + " of " +
                       std::to_string(header.allSamples) + "; name the part with the others too");
    writer.finish();
  }
  finishFile(stream, output, file);
}

std::optional<SampleView> cachedSample(const fs::path& folder, const VolumeKey& key, const Symmetry& symmetry,
                                       uint32_t index) {
  if (folder.empty()) return std::nullopt;
  const fs::path file = cacheFile(folder, key, index);
  try {
    StoredVolume stored = openVolumes(file, {&key, 1})[0];
    if (stored.firstSample != index || stored.samples.size() != 1 || stored.symmetry != symmetry)
      return std::nullopt;
    touchCached(file);
    return stored.samples[0];
  } catch (const std::runtime_error&) {
    return std::nullopt;  // not there yet, or no longer usable
  }
}

void keepSample(const fs::path& folder, const StoredVolume& one) {
  if (folder.empty()) return;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  const fs::path file = cacheFile(folder, one.key, one.firstSample);
  try {
    AtomicFile output(file);
    std::ofstream stream(output.temporary(), std::ios::binary);
    FileHeader header = headerOf(one.key, one.symmetry);
    header.firstSample = one.firstSample;
    VolumeWriter writer(stream, header);
    writer.add(one.samples[0]);
    writer.finish();
    finishFile(stream, output, file);
    if (one.firstSample % kSamplesBetweenTrims == 0) trimCache(folder, kExtension, kCacheBytes);
  } catch (const RuntimeFailure&) {
    // A folder that cannot be written costs a bake the next time and nothing else.
  }
}

}  // namespace nephroid

// Irradiance volumes in files.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/atomic_file.h"
#include "core/error.h"
#include "geometry/shapes.h"
#include "irradiance_volume/volume_file.h"
#include "support/irradiance_volumes.h"
#include "support/temporary_folder.h"

namespace nephroid {
namespace {

class VolumeFile : public testing::Test {
 protected:
  VolumeFile() { bake(file, {}); }

  void bake(const std::filesystem::path& to, SampleRange range) {
    IrradianceVolume volume(mesh, glass(), settings(), {});
    IrradianceVolume* const one = &volume;
    Progress progress;
    writeVolumes({&one, 1}, range, to, progress);
  }
  static VolumeSettings settings() {
    VolumeSettings few = someSettings();
    few.lightLevel = 0;
    few.kilobytes = 8;
    few.photons = 2;
    return few;
  }
  std::string rejectionOf(const VolumeKey& expected) const {
    try {
      openVolumes(file, {&expected, 1});
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  std::string rejectionOf(const std::string& bytes) const {
    writeFileAtomically(file, bytes);
    return rejectionOf(key);
  }

  const Mesh mesh = makeBox(vec3(1, 0.7f, 0.4f));
  const VolumeKey key = volumeKey(mesh, glass(), settings());
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "box.volume";
};

TEST_F(VolumeFile, ComesBackBitForBit) {
  IrradianceVolume made(mesh, glass(), settings(), {});
  IrradianceVolume read(mesh, openVolumes(file, {&key, 1})[0]);
  ASSERT_EQ(read.lightSamples().directions().size(), made.lightSamples().directions().size());
  for (uint32_t i = 0; i < made.lightSamples().directions().size(); ++i) {
    EXPECT_EQ(read.sample(i).layout, made.sample(i).layout);
    EXPECT_TRUE(std::ranges::equal(read.sample(i).words, made.sample(i).words));
  }
}

TEST_F(VolumeFile, PartsMergeToTheSameBytes) {
  const auto count = uint32_t(LightSamples(symmetryOf(mesh), 0).directions().size());
  ASSERT_GE(count, 3u);
  const std::filesystem::path first = folder / "first", second = folder / "second",
                              merged = folder / "merged";
  bake(first, {0, 1});
  bake(second, {1, count});
  const std::filesystem::path parts[] = {second, first};
  mergeVolumes(parts, merged);
  EXPECT_EQ(readAll(merged), readAll(file));
  EXPECT_THROW(mergeVolumes(std::span(parts).first(1), merged), InputError);
  EXPECT_THROW(mergeVolumes(std::span(parts).last(1), merged), InputError);
  IrradianceVolume part(mesh, openVolumes(first, {&key, 1})[0]);
  EXPECT_NO_THROW(part.sample(0));
  EXPECT_THROW(part.sample(1), InputError);
}

TEST_F(VolumeFile, IsRejectedWhereItDoesNotFit) {
  EXPECT_NE(rejectionOf(volumeKey(makeBox(vec3(1)), glass(), settings())).find("another mesh"),
            std::string::npos);
  EXPECT_NE(rejectionOf(volumeKey(mesh, silver(), settings())).find("another material"), std::string::npos);
  VolumeSettings finer = settings();
  finer.kilobytes = 9;
  EXPECT_NE(rejectionOf(volumeKey(mesh, glass(), finer)).find("give --volume-kilobytes 8"),
            std::string::npos);
  finer = settings();
  finer.paths = uint32_t(Paths::all);
  EXPECT_NE(rejectionOf(volumeKey(mesh, glass(), finer)).find("--paths"), std::string::npos);
}

TEST_F(VolumeFile, IsRejectedWhereItIsDamaged) {
  const std::string whole = readAll(file);
  EXPECT_NE(rejectionOf(whole.substr(0, 50)).find("truncated"), std::string::npos);
  EXPECT_NE(rejectionOf(whole.substr(0, whole.size() - 1)).find("truncated"), std::string::npos);
  EXPECT_NE(rejectionOf(whole + "x").find("longer"), std::string::npos);
  EXPECT_NE(rejectionOf(std::string(2000, 'x')).find("is not one"), std::string::npos);
  for (const std::size_t place : {std::size_t{40}, std::size_t{100}, whole.size() / 2, whole.size() - 3}) {
    std::string damaged = whole;
    damaged[place] = char(damaged[place] ^ 4);
    EXPECT_NE(rejectionOf(damaged).find("damaged"), std::string::npos) << place;
  }
  std::string other = whole;
  other[8] = char(77);
  EXPECT_NE(rejectionOf(other).find("version"), std::string::npos);
}

TEST_F(VolumeFile, TheCacheKeepsWhatIsMade) {
  const std::filesystem::path cache = folder / "cache";
  IrradianceVolume made(mesh, glass(), settings(), cache);
  EXPECT_FALSE(cachedSample(cache, key, made.symmetry(), 1));
  const SampleView sample = made.sample(1);
  const std::optional<SampleView> kept = cachedSample(cache, key, made.symmetry(), 1);
  ASSERT_TRUE(kept);
  EXPECT_TRUE(std::ranges::equal(kept->words, sample.words));
}

}  // namespace
}  // namespace nephroid

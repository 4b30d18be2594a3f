#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/stats.h"
#include "support/temporary_folder.h"

namespace nephroid {
namespace {

TEST(Error, EditDistanceCountsInsertionsDeletionsAndSubstitutions) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("same", "same"), 0u);
}

TEST(Error, NearestNameIsEmptyWhenNothingIsNear) {
  const std::array<const char*, 3> known{"position", "target", "fov"};
  EXPECT_EQ(nearestName("positon", known), "position");
  EXPECT_EQ(nearestName("zzzzzzzz", known), "");
}

// The numbers that the generator's author prints for seed 42, sequence 54 (pcg32-demo).
TEST(Random, IsPcg32) {
  Random random(42, 54);
  for (const uint32_t expected :
       {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, UniformStaysInItsRangeAndHasItsMean) {
  Random random(1);
  constexpr int kCount = 100000;
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    const float u = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 5 / std::sqrt(12.0 * kCount));
}

TEST(Hash, OfPiecesIsThatOfTheWhole) {
  const std::array<uint32_t, 4> values{1, 2, 3, 4};
  Hasher hasher;
  for (const uint32_t value : values) hasher.add(value);
  EXPECT_EQ(hasher.value(), hashBytes(std::as_bytes(std::span(values))));
  EXPECT_NE(hasher.value(), hashBytes(std::as_bytes(std::span(values).first(3))));
  EXPECT_EQ(hashBytes({}), 0x2D06800538D394C2u);  // XXH3's published value for no bytes
}

TEST(AtomicFile, IsThereWholeAfterCommit) {
  const TemporaryFolder folder;
  writeFileAtomically(folder / "a.txt", "first");
  writeFileAtomically(folder / "a.txt", "second");
  EXPECT_EQ(readAll(folder / "a.txt"), "second");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(AtomicFile, LeavesWhatStoodThereWhenItIsNotCommitted) {
  const TemporaryFolder folder;
  writeFileAtomically(folder / "a.txt", "first");
  {
    const AtomicFile file(folder / "a.txt");
    std::ofstream(file.temporary()) << "half of it";
    EXPECT_EQ(folder.fileCount(), 2u);
  }
  EXPECT_EQ(readAll(folder / "a.txt"), "first");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(AtomicFolder, TakesThePlaceOfTheOneBefore) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) {
    AtomicFolder made(folder / "report/");
    std::ofstream(made.temporary() / name) << name;
    made.commit();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "report/a"));
  EXPECT_EQ(readAll(folder / "report/b"), "b");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(AtomicFolder, LeavesWhatStoodThereWhenItIsNotCommitted) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "report");
  std::ofstream(folder / "report/a") << "kept";
  {
    const AtomicFolder made(folder / "report");
    std::ofstream(made.temporary() / "b") << "half of it";
  }
  EXPECT_EQ(readAll(folder / "report/a"), "kept");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(AtomicFolder, IsNotMadeInPlaceOfAFileOrWithoutAParent) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "kept";
  EXPECT_THROW(AtomicFolder(folder / "file"), RuntimeFailure);
  EXPECT_THROW(AtomicFolder(folder / "none/report"), RuntimeFailure);
  EXPECT_THROW(checkFolderWritable(folder / "none/report"), RuntimeFailure);
  EXPECT_NO_THROW(checkFolderWritable(folder / "report"));
}

TEST(AtomicFile, RefusesAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeFileAtomically(folder / "none" / "a.txt", ""), RuntimeFailure);
  EXPECT_THROW(checkWritable(folder.path()), RuntimeFailure);
}

TEST(Progress, CountsFromManyStepsWithoutATerminal) {
  Progress progress;
  progress.begin("step", 10);
  for (int i = 0; i < 10; ++i) progress.advance();
  progress.finish();
}

TEST(Progress, SaysDurationsAsPeopleDo) {
  EXPECT_EQ(describeDuration(0.2), "1 s");
  EXPECT_EQ(describeDuration(200), "3 min 20 s");
  EXPECT_EQ(describeDuration(7500), "2 h 05 min");
}

TEST(Stats, AreTheDocumentedFields) {
  const Stats stats{"llvmpipe \xff",
                    "none",
                    "traced",
                    {{"planes", "4"}},
                    12.5,
                    3,
                    {{"shade", 2.5}},
                    {{"beams", 7}},
                    1024,
                    0.02,
                    {},
                    0.25,
                    "few beams",
                    {},
                    {"open"},
                    {"dark"}};
  const auto json = nlohmann::json::parse(statsJson(stats));
  EXPECT_EQ(json["prepare_ms"], 12.5);
  EXPECT_EQ(json["frame_ms"], 3);
  EXPECT_EQ(json["passes"][0]["name"], "shade");
  EXPECT_EQ(json["passes"][0]["ms"], 2.5);
  EXPECT_EQ(json["counts"]["beams"], 7);
  EXPECT_EQ(json["settings"]["planes"], "4");
  EXPECT_EQ(json["memory_bytes"], 1024);
  EXPECT_EQ(json["schema"], "nephroid stats 2");
  EXPECT_EQ(json["error"], 0.02);
  EXPECT_TRUE(json["left_out"].is_null());
  EXPECT_EQ(json["exposure"], 0.25);
  EXPECT_EQ(json["shortfall"], "few beams");
  EXPECT_EQ(json["notes"], (nlohmann::json{"open", "dark"}));
  EXPECT_EQ(json.size(), 15u);
}

TEST(Stats, MedianIsTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
}

// In a process of its own, since being interrupted is for good.
TEST(Interrupt, StopsTheWorkAndLeavesNoFile) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    catchInterrupts();
    try {
      const AtomicFile file(folder / "a.txt");
      std::ofstream(file.temporary()) << "half of it";
      Progress progress;
      progress.begin("step", 2);
      progress.advance();
      std::raise(SIGINT);
      progress.advance();
    } catch (const Interrupted&) {
      _exit(42);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(Interrupt, EndsTheProcessTheSecondTime) {
  const pid_t child = fork();
  if (child == 0) {
    catchInterrupts();
    std::raise(SIGINT);
    std::raise(SIGINT);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
}

}  // namespace
}  // namespace nephroid

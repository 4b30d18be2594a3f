#include "transport/table/table_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/atomic_file.h"
#include "core/error.h"
#include "support/table_meshes.h"
#include "support/temporary_folder.h"
#include "trace/ray_scene.h"

namespace nephroid {
namespace {

constexpr TableSettings kFew{33};

TransportTable build(const Mesh& mesh, float ior = 1.5f) {
  Progress progress;
  return buildTable(mesh, vec3(ior), kFew, progress);
}

bool sameWords(const TransportTable& a, const TransportTable& b) {
  return std::equal(a.words().begin(), a.words().end(), b.words().begin(), b.words().end());
}

// The message with which the file is rejected; empty when it is not.
std::string rejection(const std::filesystem::path& file, const TableKey& key) {
  try {
    openTables(file, {&key, 1});
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

class TableFile : public testing::Test {
 protected:
  TableFile() { writeTables({&table, 1}, file); }

  std::string rejectionOf(const std::string& bytes) {
    writeFileAtomically(file, bytes);
    return rejection(file, table.key());
  }

  const Mesh ball = ballMesh(6);
  const TransportTable table = build(ball);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "ball.table";
};

TEST_F(TableFile, ComesBackBitForBit) {
  const TransportTable read = openTables(file, {&table.key(), 1})[0];
  EXPECT_EQ(read.key(), table.key());
  EXPECT_TRUE(sameWords(read, table));
  EXPECT_EQ(read.view().boxMinimum, table.view().boxMinimum);
  EXPECT_EQ(read.view().boxExtent, table.view().boxExtent);
  EXPECT_EQ(read.view().pathScale, table.view().pathScale);
  const vec3 local = normalize(vec3(0.2f, 0.5f, -1));
  EXPECT_EQ(lookUp(read, 20, local).position, lookUp(table, 20, local).position);
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST_F(TableFile, HoldsTheTablesOfSeveralCasters) {
  const Mesh larger = ballMesh(7);
  const std::vector<TransportTable> tables{table, build(larger), build(larger, 1.6f)};
  writeTables(tables, file);
  const std::vector<TableKey> keys{tables[2].key(), tables[0].key()};
  const std::vector<TransportTable> read = openTables(file, keys);
  EXPECT_TRUE(sameWords(read[0], tables[2]));
  EXPECT_TRUE(sameWords(read[1], tables[0]));
}

TEST_F(TableFile, OutlivesItsName) {
  const TransportTable read = openTables(file, {&table.key(), 1})[0];
  std::filesystem::remove(file);
  EXPECT_TRUE(sameWords(read, table));
}

TEST_F(TableFile, TruncatedAnywhereIsRejected) {
  const std::string bytes = readAll(file);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{95},
                                 std::size_t{96}, std::size_t{97}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_NE(rejectionOf(bytes.substr(0, size)).find("truncated"), std::string::npos) << size;
  EXPECT_NE(rejectionOf(bytes + "x").find("damaged"), std::string::npos);
}

TEST_F(TableFile, AnyFlippedBitIsNoticed) {
  const std::string bytes = readAll(file);
  for (std::size_t at = 0; at < bytes.size(); at += at < 200 ? 1 : 101) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    EXPECT_NE(rejectionOf(flipped), "") << at;
  }
  EXPECT_EQ(rejectionOf(bytes), "");
}

TEST_F(TableFile, OfSomethingElseIsRejectedSayingWhat) {
  EXPECT_NE(rejection(file, tableKey(ballMesh(7), vec3(1.5f), kFew)).find("another mesh"), std::string::npos);
  Mesh moved = ball;
  moved.positions[5].x += 1e-3f;
  EXPECT_NE(rejection(file, tableKey(moved, vec3(1.5f), kFew)).find("another mesh"), std::string::npos);
  Mesh curved = ball;
  curved.isCurved = true;
  EXPECT_NE(rejection(file, tableKey(curved, vec3(1.5f), kFew)).find("another mesh"), std::string::npos);
  Mesh bent = ball;
  bent.normals[5] = normalize(bent.normals[5] + vec3(0.01f, 0, 0));
  EXPECT_NE(rejection(file, tableKey(bent, vec3(1.5f), kFew)).find("another mesh"), std::string::npos);
  EXPECT_NE(rejection(file, tableKey(ball, vec3(1.6f), kFew)).find("1.6"), std::string::npos);
  EXPECT_NE(rejection(file, tableKey(ball, vec3(1.5f), {129})).find("--directions 33"), std::string::npos);
  std::string newer = readAll(file);
  newer[8] = 99;
  EXPECT_NE(rejectionOf(newer).find("version 99"), std::string::npos);
}

TEST_F(TableFile, ThatIsNoTableIsRejected) {
  EXPECT_NE(rejectionOf(std::string(5000, 'x')).find("not a light transport table"), std::string::npos);
  EXPECT_NE(rejection(folder.path(), table.key()), "");
  EXPECT_NE(rejection(folder / "missing", table.key()).find("No such file"), std::string::npos);
}

TEST_F(TableFile, CannotBeWrittenWhereThereIsNoFolder) {
  EXPECT_THROW(writeTables({&table, 1}, folder / "none/ball.table"), RuntimeFailure);
}

TEST(TableCache, BuildsOnceAndAgainWhenDamaged) {
  const Mesh ball = ballMesh(6);
  const TemporaryFolder folder;
  const std::filesystem::path cache = folder / "made/as/needed";
  Progress progress;
  const TransportTable built = loadOrBuildTable(ball, vec3(1.5f), kFew, progress, cache);
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(cache), {}), 1);

  uint64_t before = raysTraced();
  EXPECT_TRUE(sameWords(loadOrBuildTable(ball, vec3(1.5f), kFew, progress, cache), built));
  EXPECT_EQ(raysTraced(), before);

  const std::filesystem::path file = std::filesystem::directory_iterator(cache)->path();
  std::string bytes = readAll(file);
  bytes[bytes.size() / 2] ^= 1;
  writeFileAtomically(file, bytes);
  before = raysTraced();
  EXPECT_TRUE(sameWords(loadOrBuildTable(ball, vec3(1.5f), kFew, progress, cache), built));
  EXPECT_GT(raysTraced(), before);
  before = raysTraced();
  loadOrBuildTable(ball, vec3(1.5f), kFew, progress, cache);
  EXPECT_EQ(raysTraced(), before);
  loadOrBuildTable(ball, vec3(1.6f), kFew, progress, cache);
  EXPECT_GT(raysTraced(), before);
}

TEST(TableCache, ThatCannotBeWrittenIsDoneWithout) {
  const Mesh ball = ballMesh(4);
  const TemporaryFolder folder;
  writeFileAtomically(folder / "file", "in the way");
  Progress progress;
  EXPECT_GT(loadOrBuildTable(ball, vec3(1.5f), kFew, progress, folder / "file/cache").sizeInBytes(), 0u);
  EXPECT_GT(loadOrBuildTable(ball, vec3(1.5f), kFew, progress, "").sizeInBytes(), 0u);
  EXPECT_EQ(folder.fileCount(), 1u);
}

}  // namespace
}  // namespace nephroid

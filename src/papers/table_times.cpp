#include "papers/table_times.h"

#include <algorithm>

#include "core/stats.h"
#include "core/stopwatch.h"
#include "transport/table/table.h"
#include "transport/table/table_source.h"

namespace nephroid {
namespace {

constexpr int kRuns = 3;

}  // namespace

TableTimes timeTable(const Mesh& mesh, vec3 ior, Progress& progress) {
  TableTimes times;
  times.vertices = mesh.positions.size();
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    const Stopwatch watch;
    times.bytes = buildTable(mesh, ior, {}, progress).sizeInBytes();
    seconds.push_back(watch.seconds());
  }
  times.seconds = median(seconds);
  return times;
}

TableTimes timeTables(const Scene& scene, Progress& progress) {
  TableTimes sum;
  std::vector<TableKey> done;
  for (const Object& object : scene.objects) {
    if (!hasTable(scene, object)) continue;
    const vec3 ior = scene.materialOf(object).ior;
    const TableKey key = tableKey(scene.meshOf(object), ior);
    if (std::ranges::find(done, key) != done.end()) continue;
    done.push_back(key);
    const TableTimes one = timeTable(scene.meshOf(object), ior, progress);
    sum = {sum.vertices + one.vertices, sum.bytes + one.bytes, sum.seconds + one.seconds};
  }
  return sum;
}

}  // namespace nephroid

#include "formats/vdb.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "formats/mesh_file.h"

namespace nephroid {
namespace {

constexpr int kMostCells = 256;  // along a side; finer grids are looked up at as many places

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw InputError(oneLine("cannot read '" + file.string() + "' as OpenVDB: " + reason));
}

openvdb::FloatGrid::Ptr openGrid(const std::filesystem::path& path, const std::string& name) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open(false);  // all of it now: what is wrong is not found later
  std::string found;
  for (auto each = file.beginName(); each != file.endName(); ++each) {
    found += (found.empty() ? "" : ", ") + each.gridName();
    if (!name.empty() && each.gridName() != name) continue;
    if (auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(each.gridName()))) return grid;
  }
  fail(path, (name.empty() ? "it has no grid of floats" : "it has no grid of floats called '" + name + "'") +
                 "; it has: " + (found.empty() ? "none" : found));
}

vec3 toVec3(const openvdb::Vec3d& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

DensityGrid dense(const std::filesystem::path& path, const openvdb::FloatGrid& grid) {
  const openvdb::math::Transform& transform = grid.transform();
  const openvdb::Vec3d origin = transform.indexToWorld(openvdb::Vec3d(0));
  for (int axis = 0; axis < 3; ++axis) {
    openvdb::Vec3d step(0);
    step[axis] = 1;
    step = transform.indexToWorld(step) - origin;
    if (!transform.isLinear() || !(step[axis] > 0.999999 * step.length()))
      fail(path, "its axes are turned or bent; they must be those of the world");
  }
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) fail(path, "its grid is empty");
  DensityGrid result;
  result.name = path.string();
  const openvdb::Vec3d low = box.min().asVec3d() - openvdb::Vec3d(0.5);
  const openvdb::Vec3d size = box.dim().asVec3d();
  result.corner = toVec3(transform.indexToWorld(low));
  result.size = toVec3(transform.indexToWorld(low + size)) - result.corner;
  for (int axis = 0; axis < 3; ++axis)
    result.cells[axis] = static_cast<uint32_t>(std::clamp(box.dim()[axis], 1, kMostCells));
  const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(grid);
  float most = 0;
  for (uint32_t z = 0; z < result.cells.z; ++z)
    for (uint32_t y = 0; y < result.cells.y; ++y)
      for (uint32_t x = 0; x < result.cells.x; ++x) {
        const openvdb::Vec3d part((x + 0.5) / result.cells.x, (y + 0.5) / result.cells.y,
                                  (z + 0.5) / result.cells.z);
        result.densities.push_back(std::max(sampler.isSample(low + part * size), 0.0f));
        most = std::max(most, result.densities.back());
      }
  if (!(most > 0 && std::isfinite(most))) fail(path, "its grid has no density above 0");
  for (float& density : result.densities) density /= most;
  return result;
}

}  // namespace

DensityGrid loadVdb(const std::filesystem::path& file, const std::string& name) {
  try {
    return dense(file, *openGrid(file, name));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    fail(file, error.what());
  }
}

}  // namespace nephroid

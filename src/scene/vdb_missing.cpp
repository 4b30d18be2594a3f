#include "core/error.h"
#include "scene/mesh_file.h"
#include "scene/vdb.h"

namespace nephroid {

DensityGrid loadVdb(const std::filesystem::path& file, const std::string&) {
  throw InputError(
      oneLine("cannot read '" + file.string() +
              "': this program was built without OpenVDB (libopenvdb-dev); give [medium.noise] instead"));
}

}  // namespace nephroid

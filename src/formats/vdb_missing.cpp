#include "core/error.h"
#include "formats/mesh_file.h"
#include "formats/vdb.h"

namespace nephroid {

DensityGrid loadVdb(const std::filesystem::path& file, const std::string&) {
  throw InputError(
      oneLine("cannot read '" + file.string() +
              "': this program was built without OpenVDB (libopenvdb-dev); give [medium.noise] instead"));
}

}  // namespace nephroid

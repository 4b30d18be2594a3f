#include "core/error.h"
#include "viewer.h"

namespace nephroid {

void runViewer(const ViewerOptions&) {
  throw InputError(
      "this program was built without a viewer: install libglfw3-dev and libimgui-dev, and build it again");
}

}  // namespace nephroid

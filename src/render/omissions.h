// What every picture leaves out, because of the frame that caustics are drawn in.
#pragma once

#include "techniques/omissions.h"

namespace nephroid {

std::span<const Omission> omissionsOfFrame();

}  // namespace nephroid

// What every picture leaves out, for any technique.
#pragma once

#include "techniques/omissions.h"

namespace nephroid {

std::span<const Omission> omissionsOfFrame();

}  // namespace nephroid

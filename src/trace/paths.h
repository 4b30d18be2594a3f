#pragma once

namespace nephroid {

// transmission: refraction alone; light that would be totally reflected is lost. all: reflection outside and
// inside as well.
enum class Paths { transmission, all };

}  // namespace nephroid

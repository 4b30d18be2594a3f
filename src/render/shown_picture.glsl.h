// What a pixel of a picture shows. The curve is chosen when the program is made: software devices would go
// through all of them.
#include "render/tone_mapping.h"

layout(constant_id = 7) const uint kToneCurve = 0;  // kTone...

vec4 pictureOf(vec3 luminance, float exposure, vec4 fragment) {
  const vec3 shown = displayed(luminance, ToneMapping(exposure, kToneCurve));
  return vec4(levelsOf(shown, uint(fragment.x), uint(fragment.y)) / 255, 1);
}

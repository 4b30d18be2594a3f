// The data of the shaders that draw the panels, for C++ and GLSL.
#ifndef NEPHROID_VIEWER_GUI_DATA_H
#define NEPHROID_VIEWER_GUI_DATA_H

#include "core/shared_language.h"
#include "gpu/buffer_address.h"

SHARED_BEGIN

// As ImDrawVert.
struct GuiVertex {
  vec2 position;  // units of the panels
  vec2 texcoord;
  uint color;  // rgba8, red lowest, sRGB
};

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer GuiVertices {
  GuiVertex v[];
};
#endif

struct GuiConstants {
  BUFFER_ADDRESS(GuiVertices) vertices;
  vec2 scale;  // from units to clip space
};

SHARED_END

#endif

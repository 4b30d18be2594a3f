// Moving a camera by hand. World space; +Y is up, and a camera that is turned stands upright.
#pragma once

#include "geometry/box.h"
#include "scene/scene.h"

namespace nephroid {

// Around its target. Radians: to the right and up, as the camera moves; it stops short of looking straight up
// or down, where a camera that is loaded from a file is given another upward direction.
void orbit(Camera& camera, vec2 turn);

// About itself. Radians: to the right and up, as the view moves.
void look(Camera& camera, vec2 turn);

// Sideways, so that what is as far away as the target follows a pointer moved by `pixels` (y down) in a
// picture of `height` pixels.
void pan(Camera& camera, vec2 pixels, float height);

// Toward the target, which it does not reach: each step by an eighth of the way.
void zoom(Camera& camera, float steps);

// By metres to its right, along +Y, and ahead; the target goes with it.
void fly(Camera& camera, vec3 metres);

// Backward or forward, and with it its target, until the box (m) just fits into the picture.
void frameBox(Camera& camera, const Box& box);

}  // namespace nephroid

// Moving a camera by hand. World space; +Y is up, and a camera that is turned stands upright.
#pragma once

#include "geometry/box.h"
#include "scene/scene.h"

namespace nephroid {

// Moves the camera around its target. `turn`: radians to the right and up. It stops before the view is
// vertical, where a camera from a file would get another upward direction.
void orbit(Camera& camera, vec2 turn);

// Turns the camera in its place. `turn`: radians to the right and up.
void look(Camera& camera, vec2 turn);

// Moves the camera sideways, so that things at the target's distance follow the pointer. `pixels`: the
// pointer's movement (y down). `height`: of the picture, pixels.
void pan(Camera& camera, vec2 pixels, float height);

// Moves the camera toward the target. Each step is an eighth of the distance, so the target is never reached.
void zoom(Camera& camera, float steps);

// Moves the camera and its target. `meters`: to the right, along +Y, and ahead.
void fly(Camera& camera, vec3 meters);

// Moves the camera and its target so that the box (m) just fits into the picture.
void frameBox(Camera& camera, const Box& box);

}  // namespace nephroid

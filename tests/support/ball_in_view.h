// The scene that tests of the viewer open, as its file has it.
#pragma once

namespace nephroid {

// With comments and blank lines, which have to be there still when it was saved.
inline constexpr const char* kBallInView = R"(# A ball over a floor
[camera]
position = [0, 1.5, 3]
target = [0, 0.4, 0]
exposure = 0.22

[environment]
ambient = 1.2

[[material]]
name = "glass"
type = "dielectric"

[[material]]
name = "floor"
type = "diffuse"

[[object]]
name = "floor"
shape = "plane"
size = [6, 6]
material = "floor"

[[object]]
name = "ball"
shape = "sphere"
radius = 0.5
vertices = 200
material = "glass"
translation = [0, 0.8, 0]

[[light]] # moved by hand
type = "point"
position = [0.6, 1.5, 0.4]
intensity = 20
)";

}  // namespace nephroid

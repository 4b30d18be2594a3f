// How bright a place of a picture looks.
uniform sampler2D picture;  // sRGB

float lumaAt(vec2 place) {
  return dot(textureLod(picture, place, 0).rgb, vec3(0.299, 0.587, 0.114));
}

// Air in a box whose density is given in cells.
layout(constant_id = 8) const bool kHasBox = false;

vec2 wayThroughBox(AirBox box, vec3 from, vec3 direction, float length) {
  return wayThroughBox(box.corner, box.corner + 1 / box.inverseSize, from, direction, length);
}

// Interpolates between two layers of the box's images, which begin at the layer `first`. `place`: 0..1 along
// x and y. `layer`: with a fraction, from `first`.
float inLayers(sampler2DArray image, vec2 place, float layer, float first) {
  const float low = floor(layer);
  return mix(textureLod(image, vec3(place, first + low), 0).r,
             textureLod(image, vec3(place, first + low + 1), 0).r, layer - low);
}

// The density (0..1) at a point inside the box.
float boxDensity(sampler2DArray density, AirBox box, vec3 point) {
  const vec3 place = clamp((point - box.corner) * box.inverseSize, 0, 1);
  const float layers = float(textureSize(density, 0).z);
  return inLayers(density, place.xy, clamp(place.z * layers - 0.5, 0, max(layers - 1.001, 0)), 0);
}

// The integral of the density (m) from the light whose images begin at `first` to a point in the box.
float boxDepth(sampler2DArray depths, AirBox box, vec3 point, float first) {
  const float cells = float(kAirNodes - 1u);
  const vec3 at = clamp((point - box.corner) * box.inverseSize, 0, 1) * cells;
  return inLayers(depths, (at.xy + 0.5) / float(kAirNodes), min(at.z, cells - 0.001), first);
}

// The same to any point. `from`: the place of the light.
float boxDepthBetween(sampler2DArray depths, AirBox box, vec3 from, vec3 to, float first) {
  const float way = distance(from, to);
  const vec3 direction = (to - from) / max(way, 1e-9);
  const vec2 part = wayThroughBox(box, from, direction, way);
  return part.y > part.x ? boxDepth(depths, box, from + part.y * direction, first) : 0;
}

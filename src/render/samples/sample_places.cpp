#include "render/samples/sample_places.h"

#include <algorithm>
#include <numeric>

#include "core/pixel_filter.h"

namespace nephroid {
namespace {

// The coordinate of a point of the sequence, in 2^-32 (Kollig and Keller 2002).
uint32_t sobol(uint32_t index, int axis) {
  uint32_t result = 0;
  for (uint32_t column = 1u << 31; index != 0;
       index >>= 1, column = axis == 0 ? column >> 1 : column ^ column >> 1)
    if (index & 1u) result ^= column;
  return result;
}

// The filter's offset for the middle of the part that each point is in.
std::vector<float> offsetsAlong(int axis, uint32_t count) {
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [axis](uint32_t index) { return sobol(index, axis); });
  std::vector<float> offsets(count);
  for (uint32_t rank = 0; rank < count; ++rank)
    offsets[order[rank]] = float(filteredOffset((rank + 0.5) / count));
  return offsets;
}

}  // namespace

std::vector<vec2> samplePlaces(uint32_t count) {
  const std::vector<float> x = offsetsAlong(0, count), y = offsetsAlong(1, count);
  std::vector<vec2> places;
  for (uint32_t i = 0; i < count; ++i) places.emplace_back(x[i], y[i]);
  const auto nearest = std::ranges::min_element(places, {}, [](vec2 place) { return dot(place, place); });
  std::rotate(nearest, nearest + 1, places.end());
  return places;
}

}  // namespace nephroid

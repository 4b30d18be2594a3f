// Caustics drawn across the view (Iwasaki, Yoshimoto, Dobashi and Nishita 2005): on sample planes that the
// camera looks along.
#include <algorithm>
#include <bit>
#include <cmath>

#include "techniques/planes/plane_technique.h"
#include "techniques/sliced_images/settings.h"

namespace nephroid {
namespace {

// When their number is not given, slices are no thicker than this part of the width that most light falls on;
// a power of two of them, so that small motions seldom change it.
constexpr float kThicknessOverWidth = 0.25f;
constexpr float kMostAutomaticSlices = 16;
constexpr float kRoomBeforeReceivers = 1e-3f;  // of their distance from the camera

// Unit: the mean over the light of the direction in which the camera sees where it arrives.
vec3 meanViewingDirection(const Camera& camera, std::span<const Arrival> arrivals) {
  glm::dvec3 mean(0);
  for (const Arrival& arrival : arrivals) {
    const vec3 toward = arrival.point - camera.position;
    const float distance = length(toward);
    if (distance > 0) mean += glm::dvec3(toward / distance) * double(arrival.flux);
  }
  const vec3 axis(mean);
  return length(axis) > 0 ? normalize(axis) : normalize(camera.target - camera.position);
}

uint32_t automaticSlices(const PlaneSet& pair) {
  const float width = pair.windows[0].size / pair.windows[0].texelsPerMeter;
  const float slices = std::ceil(pair.depthStep / (kThicknessOverWidth * width));
  return std::bit_ceil(uint32_t(std::clamp(slices, 1.0f, kMostAutomaticSlices)));
}

PlaneSet planSlices(const Scene& scene, const LightPortion& portion, std::span<const ReceiverBox> boxes,
                    uint32_t slices, uint32_t textureSize) {
  const std::vector<Beam>& beams = portion.beams;
  const std::vector<Arrival> arrivals = findArrivals(beams, boxes);
  const vec3 axis = meanViewingDirection(scene.camera, arrivals);
  const float eye = dot(scene.camera.position, axis), receivers = nearestAlong(axis, boxes);
  // Receivers across the axis lie on this side of where the virtual camera begins to see.
  const float nearest = std::max(eye, receivers - kRoomBeforeReceivers * std::abs(receivers - eye));
  PlaneOrder order{axis, nearest, slices, textureSize};
  if (order.planes > 0) return planPlanes(order, beams, arrivals);
  order.planes = 2;
  const PlaneSet pair = planPlanes(order, beams, arrivals);
  if (pair.planes < 2) return pair;
  order.planes = automaticSlices(pair);
  return planPlanes(order, beams, arrivals);
}

constexpr TechniqueTraits kTraits{.followsCamera = true, .usesBeams = true};

constexpr Setting kSettings[] = {
    wholeSetting<&SlicedImageSettings::slices>("slices", 0, 256,
                                               "Number of sample planes across the view, on which caustics "
                                               "are drawn; 0: a number that fits the receivers' depth"),
};
constexpr SettingsOwner kOwners[] = {settingsOwner<SlicedImageSettings>("sliced-images", kSettings),
                                     kPlaneSettingsOwner};

constexpr Omission kOmissions[] = {
    omissions::kReflection,
    omissions::kSpectrum,
    omissions::kSizeOfLamps,
    {"Light that the camera does not see along the mean direction in which it sees the light: on surfaces "
     "that another receiver hides there or that face away, as glass and mirrors may show them",
     hasCaster},
    {"With --interpolation blend, light that runs within 15 degrees along the sample planes", hasCaster},
    omissions::kPlaneDetail,
    omissions::kScattering,
};

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  const uint32_t slices = context.settings.own.of<SlicedImageSettings>().slices;
  return std::make_unique<PlaneTechnique>(
      context,
      PlaneTechniqueKind{kTraits, planSlices, slices, false, "receivers across the view", "caustics maps"});
}

}  // namespace

extern const TechniqueInfo kSlicedImages;
constinit const TechniqueInfo kSlicedImages{
    .name = "sliced-images",
    .summary = "Maps of caustics on sample planes across the view (paper 1)",
    .make = make,
    .traits = kTraits,
    .settings = kOwners,
    .omissions = kOmissions,
    .prepare = prepareTransport,
    .isStillPrepared = isTransportStillPrepared,
};

}  // namespace nephroid

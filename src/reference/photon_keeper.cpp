#include "reference/photon_keeper.h"

#include <algorithm>
#include <cmath>

#include "core/pixel_filter.h"
#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kPlaces = 4;  // of a segment, at which it is seen

StoredPhoton stored(const PhotonSegment& segment, vec3 flux) {
  StoredPhoton photon;
  photon.flux = flux;
  photon.index = segment.photon;
  photon.band = uint16_t(segment.band);
  photon.isDispersed = segment.isDispersed;
  return photon;
}

}  // namespace

void PhotonKeeper::segment(const PhotonSegment& segment) {
  const Boundaries& boundaries = *settings_.boundaries;
  if (!segment.metCaster || !boundaries.isScattering(segment.medium)) return;
  const float extinction = segment.isWeakened ? boundaries.meanExtinction(segment.medium) : 0;
  for (uint32_t i = 0; i < kPlaces; ++i) {
    const DistanceSample sample =
        sampleExtinction((float(i) + segment.sample) / float(kPlaces), extinction, segment.length);
    StoredPhoton photon = stored(segment, segment.flux);
    photon.position = segment.ray.origin + sample.distance * segment.ray.direction;
    photon.flux *= segment.transmittance(boundaries, sample.distance) / (sample.density * float(kPlaces));
    photon.direction = segment.ray.direction;
    photon.object = segment.medium;
    keep(photon, inVolumes);
    if (!settings_.splats || segment.medium != settings_.mediumOfCamera) continue;
    const auto seen = settings_.camera->project(photon.position, float(kFilterRadius));
    if (!seen) continue;
    const vec3 scattered = boundaries.scattering(segment.medium, photon.position) *
                           boundaries.phase(segment.medium, dot(photon.direction, seen->direction));
    splat(segment, photon.position, photon.flux * scattered, 0, true, *seen);
  }
}

void PhotonKeeper::landing(const PhotonSegment& segment, const Hit& hit, vec3 flux) {
  const vec3 arriving = segment.ray.direction;
  StoredPhoton photon = stored(segment, flux);
  photon.direction = dot(arriving, hit.geometricNormal) < 0 ? hit.geometricNormal : -hit.geometricNormal;
  const vec3 smooth = dot(hit.normal, photon.direction) < 0 ? -hit.normal : hit.normal;
  // Receivers are lit by their smooth normals, photons land on triangles.
  photon.flux *= glm::clamp(dot(arriving, smooth) / dot(arriving, photon.direction), 0.0f, 4.0f);
  photon.position = hit.flatPosition;
  photon.object = hit.object;
  keep(photon, onSurfaces);
  if (!settings_.splats) return;
  const auto seen = settings_.camera->project(photon.position, float(kFilterRadius));
  const float cosine = seen ? dot(photon.direction, seen->direction) : 0;
  if (cosine <= 0) return;
  const vec3 reflected = photon.flux * diffuseReflectance(*settings_.scene, hit) * (cosine / kPi);
  const float clearance =
      settings_.boundaries->rayScene().clearance(hit.object, photon.direction, seen->direction);
  splat(segment, photon.position, reflected, clearance, false, *seen);
}

void PhotonKeeper::keep(StoredPhoton photon, std::vector<StoredPhoton>& photons) const {
  photon.flux *= float(settings_.pass->parts);
  photons.push_back(photon);
}

// `reflected`: cd toward the camera. `clearance`: m, the beginning of the way there that is not tested.
void PhotonKeeper::splat(const PhotonSegment& segment, vec3 place, vec3 reflected, float clearance,
                         bool isScattered, const Pinhole::Projection& seen) {
  if (reflected == vec3(0)) return;
  const RayScene& rays = settings_.boundaries->rayScene();
  if (rays.occluded({place, seen.direction, clearance, seen.distance})) return;
  vec3 luminance = reflected * (seen.perSteradian / (seen.distance * seen.distance));
  luminance *=
      settings_.boundaries->transmittance(settings_.mediumOfCamera, place, seen.direction, seen.distance);
  if (segment.isDispersed) luminance *= settings_.pass->bands[segment.band].weight;
  splats.push_back({seen.place, segment.photon, isScattered, luminance});
}

}  // namespace nephroid

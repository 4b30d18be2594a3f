#include "beams/light_beams.h"

#include <algorithm>

#include "beams/plane_plan.h"
#include "geometry/bounds.h"
#include "lights/emitters.h"

namespace nephroid {
namespace {

// Cosine between the directions from which points of a line light that share planes shine.
constexpr float kNearlyOneDirection = 0.8f;
// How many times a cell of water may be divided more often than a triangle of glass, where glass stands in
// it.
constexpr uint32_t kCutsBeyondWaves = 2;

// Past the last emitter that shines on `center` together with the emitter `first`.
std::size_t endOfLamp(vec3 center, std::span<const Emitter> emitters, std::size_t first) {
  const vec3 direction = emitterDirection(emitters[first], center);
  std::size_t last = first + 1;
  while (last < emitters.size() && emitters[last].light == emitters[first].light &&
         dot(emitterDirection(emitters[last], center), direction) >= kNearlyOneDirection)
    ++last;
  return last;
}

bool hasOtherCasters(const Scene& scene, const Object& object) {
  return std::ranges::any_of(scene.objects, [&](const Object& other) {
    return &other != &object && scene.isCaster(other) && !other.water;
  });
}

bool isAmong(const Object& object, Casters casters) {
  return casters == Casters::all || object.water.has_value() == (casters == Casters::water);
}

void addPortions(std::vector<BandQuery> queries, std::vector<std::vector<BandQuery>>& portions) {
  std::ranges::stable_sort(queries, {}, [](const BandQuery& band) { return band.query.reflections; });
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (i == 0 || queries[i].query.reflections != queries[i - 1].query.reflections) portions.emplace_back();
    portions.back().push_back(queries[i]);
  }
}

std::vector<Beam> joined(const std::vector<LightPortion>& portions) {
  std::vector<Beam> all;
  for (const LightPortion& portion : portions)
    all.insert(all.end(), portion.beams.begin(), portion.beams.end());
  return all;
}

}  // namespace

std::vector<std::vector<BandQuery>> lightThroughCasters(const SceneTransport& transport, Paths paths,
                                                        Casters casters) {
  const Scene& scene = transport.scene();
  const std::vector<Emitter> emitters = emittersOf(scene);
  std::vector<MediumStack> media;
  for (const Emitter& emitter : emitters) media.push_back(transport.mediaAround(emitter));
  std::vector<std::vector<BandQuery>> portions;
  for (uint32_t object = 0; object < scene.objects.size(); ++object) {
    if (!scene.isCaster(scene.objects[object]) || !isAmong(scene.objects[object], casters)) continue;
    const vec3 center =
        scene.objects[object].placement.point(boundingBox(scene.meshOf(scene.objects[object])).center());
    for (std::size_t first = 0, last; first < emitters.size(); first = last) {
      last = endOfLamp(center, emitters, first);
      std::vector<BandQuery> queries;
      for (std::size_t i = first; i < last; ++i)
        std::ranges::move(queriesFor(scene, object, emitters[i], media[i], paths),
                          std::back_inserter(queries));
      addPortions(std::move(queries), portions);
    }
  }
  return portions;
}

std::vector<Beam> beamsOf(const Scene& scene, const TransportSource& source,
                          std::span<const BandQuery> queries, const BeamSettings& settings) {
  std::vector<Beam> all;
  for (const BandQuery& band : queries) {
    BeamSet set = buildBeams(scene, source, band.query, band.bandColor, settings);
    if (all.empty()) {
      all = std::move(set.beams);
    } else {
      all.insert(all.end(), set.beams.begin(), set.beams.end());
    }
  }
  return all;
}

std::vector<Beam> refinedBeams(const Scene& scene, const TransportSource& source,
                               std::span<const BandQuery> queries, std::span<const ReceiverBox> boxes,
                               const BeamDivision& division, uint32_t detail) {
  BeamSettings refined{.refineDepth = 0, .targets = {}};
  const TransportQuery& query = queries.front().query;
  const Object& object = scene.objects[query.object];
  const bool isWater = object.water.has_value();
  // Water's cells are as fine as its waves, and a facet does not bend: their rays part, where they do at all.
  const bool isEven = isWater || scene.meshOf(object).isFaceted();
  if (isEven) refined.refineDepth = division.refineDepth;
  if (isWater) refined.shadowTolerance = division.shadowTolerance;
  std::vector<Beam> beams = beamsOf(scene, source, queries, refined);
  const bool isDone = isEven && !hasOtherCasters(scene, object);
  if (isDone || !source.refines(query) || division.refineDepth == 0) return beams;
  const std::vector<LightPortion> portions = portionsByAxis(std::move(beams), boxes);
  for (const LightPortion& portion : portions) {
    const PlaneSet along = planAlongLight(portion, boxes, 2, detail);
    if (along.planes == 0) continue;
    refined.targets.push_back({planeGrid(along, 0, 0), portion.leastApproach});
    refined.targets.push_back({planeGrid(along, along.planes - 1, 0), portion.leastApproach});
  }
  if (refined.targets.empty()) return joined(portions);
  refined.refineDepth = division.refineDepth + (isWater ? kCutsBeyondWaves : 0);
  refined.refineTolerance = 0.25f;
  refined.isEvenAtSurface = isWater;
  return beamsOf(scene, source, queries, refined);
}

void leaveOutWeakest(std::vector<std::vector<Beam>>& portions, double part) {
  const auto fluxOf = [](const Beam& beam) { return beam.flux.x + beam.flux.y + beam.flux.z; };
  std::vector<float> fluxes;
  double allowed = 0;
  for (const std::vector<Beam>& beams : portions)
    for (const Beam& beam : beams) {
      fluxes.push_back(fluxOf(beam));
      allowed += part * double(fluxes.back());
    }
  std::ranges::sort(fluxes);
  double sum = 0;
  const auto firstKept =
      std::ranges::find_if(fluxes, [&](float flux) { return (sum += double(flux)) > allowed; });
  if (firstKept == fluxes.end()) return;
  for (std::vector<Beam>& beams : portions)
    std::erase_if(beams, [&](const Beam& beam) { return fluxOf(beam) < *firstKept; });
}

bool areOfOneColor(std::span<const Beam> beams) {
  const vec3 first = beams.front().flux;
  return std::ranges::all_of(beams, [&](const Beam& beam) {
    const vec3 difference = abs(cross(beam.flux, first));
    return std::max({difference.x, difference.y, difference.z}) <= 1e-5f * dot(beam.flux, first);
  });
}

}  // namespace nephroid

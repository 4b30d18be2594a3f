#include "beams/ray_mesh/caster_light.h"

#include <algorithm>

#include "beams/incident_flux.h"
#include "beams/ray_mesh/lamp_on_surface.h"
#include "geometry/bounds.h"
#include "geometry/curved_triangle.h"
#include "lights/emitters.h"
#include "lights/lamp_light.h"
#include "lights/light_in_air.h"

namespace nephroid {
namespace {

// Cosine at which light that meets a surface from behind its smooth normal is taken to graze it.
constexpr float kGrazing = 0.02f;

bool disperses(const Scene& scene) {
  return std::ranges::any_of(scene.objects, [&](const Object& object) {
    const Material& material = scene.materialOf(object);
    return material.type == MaterialType::dielectric && material.isDispersive();
  });
}

struct FlatAndCurved {
  vec3 flat, curved;  // m, in the mesh's own space
};

FlatAndCurved pointsAt(const Mesh& mesh, const mat3& positions, const mat3& normals, vec3 weights) {
  const vec3 flat = positions * weights;
  return {flat, mesh.isCurved ? flat + curvedOffset(flat, weights, positions, normals) : flat};
}

struct Corners {
  mat3 positions, normals;
};

Corners cornersOf(const Mesh& mesh, uint32_t triangle) {
  const uvec3 c = mesh.triangles[triangle];
  return {mat3(mesh.positions[c.x], mesh.positions[c.y], mesh.positions[c.z]),
          mat3(mesh.normals[c.x], mesh.normals[c.y], mesh.normals[c.z])};
}

vec3 allThree(vec2 weights) {
  return {1 - weights.x - weights.y, weights};
}

// So many that the casters' own triangles are followed from them in seconds.
uint32_t mostPartsOfSkies(const Scene& scene, float error) {
  constexpr float kMostTriangles = 1e6f, kErrorOfMost = 0.01f;
  constexpr float kFewestParts = 16, kMostParts = 4096;
  std::size_t triangles = 1;
  for (const Object& object : scene.objects)
    if (scene.isCaster(object)) triangles += scene.meshOf(object).triangles.size();
  const float most = kMostTriangles * std::max(kErrorOfMost / error, 1.0f) / float(triangles);
  return uint32_t(std::clamp(most, kFewestParts, kMostParts));
}

}  // namespace

LightOntoCasters lightOntoCasters(const Scene& scene, const RayScene& rays, float error, CutSkies& skies,
                                  MediaTable& media) {
  const std::vector<const Material*> materials = materialsOf(scene);
  const int channels = disperses(scene) ? 3 : 1;
  LightOntoCasters onto;
  std::vector<CasterLight>& all = onto.lights;
  const uint32_t mostSkyParts = mostPartsOfSkies(scene, error);
  const auto add = [&](uint32_t object, const LampCell& cell, const MediumStack& around) {
    for (int channel = 0; channel < channels; ++channel) {
      CasterLight light;
      light.object = object;
      light.emitter = cell.emitter;
      light.light = shapedLight(scene, scene.lights[cell.emitter.light]);
      light.spread = cell.spread;
      if (cell.spread.hasSize()) light.light.lamp.power = cell.emitter.power;
      light.medium = media.numberOf(around);
      light.channel = uint8_t(channel);
      if (channels == 3) {
        light.bandColor = vec3(0);
        light.bandColor[channel] = 1;
      }
      light.facing = around.contains(object) ? -1.0f : 1.0f;
      all.push_back(light);
    }
  };
  // Moves the emitters off surfaces, and tells the media about them.
  const auto settled = [&](std::vector<LampCell> cells) {
    std::vector<std::pair<LampCell, MediumStack>> placed;
    for (LampCell& cell : cells) {
      MediumStack around{};
      if (cell.emitter.type != kEmitterDirectional) {
        cell.emitter.position = besideSurfaces(scene, rays, cell.emitter.position);
        around = mediaAround(rays, materials, cell.emitter.position);
      }
      placed.emplace_back(std::move(cell), around);
    }
    return placed;
  };
  for (uint32_t index = 0; index < scene.lights.size(); ++index) {
    const Light& lamp = scene.lights[index];
    const bool isSky = lamp.type == LightType::sky;
    std::vector<LampCell> same;  // for all casters
    if (isSky && lamp.hasGivenSamples) {
      same = skyCells(lamp, index, lamp.sky);
    } else if (isSky) {
      same = skyCells(lamp, index, skies.partsOf(scene.skies[lamp.skyMap], error, mostSkyParts));
      if (same.size() == mostSkyParts) onto.fewSkyParts = mostSkyParts;
    }
    if (!isSky && !hasSize(lamp))
      for (const Emitter& emitter : emittersOf(lamp, index)) same.push_back({emitter, {}});
    const auto forAll = settled(std::move(same));
    for (uint32_t object = 0; object < scene.objects.size(); ++object) {
      if (!scene.isCaster(scene.objects[object])) continue;
      for (const auto& [cell, around] : forAll) add(object, cell, around);
      if (isSky || !hasSize(lamp)) continue;
      const Placement& placement = scene.objects[object].placement;
      const Sphere sphere = boundingSphere(scene.meshOf(scene.objects[object]));
      for (const auto& [cell, around] : settled(lampCells(lamp, index, placement.point(sphere.center),
                                                          placement.scale * sphere.radius, error)))
        add(object, cell, around);
    }
  }
  return onto;
}

vec3 entryPosition(const Scene& scene, uint32_t objectIndex, uint32_t triangle, vec2 weights) {
  const Object& object = scene.objects[objectIndex];
  const Mesh& mesh = scene.meshOf(object);
  const Corners corners = cornersOf(mesh, triangle);
  return object.placement.point(pointsAt(mesh, corners.positions, corners.normals, allThree(weights)).curved);
}

EntryPoint entryPoint(const Scene& scene, const RayScene& rays, uint32_t objectIndex, uint32_t triangle,
                      vec2 weights) {
  const Object& object = scene.objects[objectIndex];
  const Mesh& mesh = scene.meshOf(object);
  const auto [positions, normals] = cornersOf(mesh, triangle);
  const vec3 all = allThree(weights);
  const FlatAndCurved points = pointsAt(mesh, positions, normals, all);
  EntryPoint entry;
  entry.flatPosition = object.placement.point(points.flat);
  entry.position = object.placement.point(points.curved);
  entry.normal = object.placement.direction(normalize(normals * all));
  const vec3 doubledArea = cross(positions[1] - positions[0], positions[2] - positions[0]);
  entry.geometricNormal = object.placement.direction(doubledArea / std::max(length(doubledArea), 1e-30f));
  entry.patch = rays.patchOf(object.mesh, triangle);
  entry.isCurved = mesh.isCurved;
  return entry;
}

Hit placeOf(const EntryPoint& entry, uint32_t object, uint32_t triangle, vec3 direction,
            const RayScene& rays) {
  Hit place;
  place.object = object;
  place.triangle = triangle;
  place.position = entry.position;
  place.flatPosition = entry.flatPosition;
  place.normal = entry.normal;
  place.geometricNormal = entry.geometricNormal;
  rays.addTouching(direction, place);
  return place;
}

PathNode firstNode(const CasterLight& light, const EntryPoint& entry, uint32_t corner) {
  PathNode node;
  node.direction = emitterDirection(light.emitter, entry.position);
  node.length =
      light.emitter.type == kEmitterDirectional ? 0 : glm::distance(light.emitter.position, entry.position);
  node.position = entry.position;
  node.flatPosition = entry.flatPosition;
  node.object = light.object;
  node.patch = entry.patch;
  node.corner = corner;
  node.medium = light.medium;
  node.channel = light.channel;
  node.state = PathState::atCaster;
  // Of a curved triangle that the light meets though the smooth normal faces away, past the silhouette; on
  // flat ones it is the triangle's own normal that counts there.
  vec3 normal = light.facing * entry.normal;
  const float cosine = -dot(node.direction, normal);
  if (entry.isCurved && cosine < kGrazing) normal = normalize(normal - (kGrazing - cosine) * node.direction);
  node.normal = light.facing * normal;
  const bool isMetRight = light.facing * dot(entry.geometricNormal, node.direction) < 0;
  node.geometricNormal = isMetRight ? entry.geometricNormal : node.normal;
  return node;
}

vec3 fluxBetween(const Scene& scene, const CasterLight& light, vec3 a, vec3 b, vec3 c) {
  const vec3 flux = light.facing * fluxOnto(light.light, light.emitter, a, b, c);
  const float air = scene.medium ? airTransmittance(scene, light.emitter, (a + b + c) / 3.0f) : 1.0f;
  return light.bandColor * glm::max(flux, vec3(0)) * air;
}

}  // namespace nephroid

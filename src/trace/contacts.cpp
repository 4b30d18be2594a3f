#include "trace/contacts.h"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/bounds.h"
#include "scene/volume.h"

namespace nephroid {
namespace {

// Cosine between the planes of triangles that may lie in each other.
constexpr float kParallel = 0.99f;

struct Face {
  mat3 corners;  // m, world space
  vec3 normal;   // unit
  Box box;
  uint32_t triangle;
};

using Meeting = std::array<uint32_t, 3>;  // an object, a triangle of it, and another object

bool overlap(const Box& a, const Box& b, float spare) {
  return glm::all(glm::lessThanEqual(a.low - spare, b.high)) &&
         glm::all(glm::lessThanEqual(b.low - spare, a.high));
}

bool isInPlaneOf(const Face& plane, const Face& face, float distance) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(dot(face.corners[i] - plane.corners[0], plane.normal)) > distance) return false;
  return true;
}

// Whether a side of `face` has `other` on its outside, seen along the normal; a common side is not enough to
// overlap.
bool isPartedBySide(const Face& face, const Face& other, float distance) {
  for (int i = 0; i < 3; ++i) {
    const vec3 from = face.corners[i];
    const vec3 outward = normalize(cross(face.corners[(i + 1) % 3] - from, face.normal));
    float least = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k) least = std::min(least, dot(other.corners[k] - from, outward));
    if (least > -distance) return true;
  }
  return false;
}

bool lieTogether(const Face& a, const Face& b, float distance) {
  if (!overlap(a.box, b.box, distance) || std::abs(dot(a.normal, b.normal)) < kParallel) return false;
  if (!isInPlaneOf(a, b, distance) && !isInPlaneOf(b, a, distance)) return false;
  return !isPartedBySide(a, b, distance) && !isPartedBySide(b, a, distance);
}

// An object's triangles in a part of the scene.
std::vector<Face> facesIn(const Scene& scene, uint32_t index, const Box& region, float spare) {
  const Object& object = scene.objects[index];
  const Mesh& mesh = scene.meshOf(object);
  std::vector<vec3> positions(mesh.positions.size());
  std::ranges::transform(mesh.positions, positions.begin(),
                         [&](vec3 position) { return object.placement.point(position); });
  std::vector<Face> faces;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const uvec3 c = mesh.triangles[t];
    Face face;
    face.corners = mat3(positions[c.x], positions[c.y], positions[c.z]);
    for (int i = 0; i < 3; ++i) face.box.include(face.corners[i]);
    if (!overlap(face.box, region, spare)) continue;
    const vec3 area = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    if (!(length(area) > 0)) continue;
    face.normal = normalize(area);
    face.triangle = t;
    faces.push_back(face);
  }
  return faces;
}

// Calls visit(a, b) for faces whose extents along the axis overlap.
template <class Visit>
void sweep(std::vector<Face>& ofA, std::vector<Face>& ofB, int axis, float spare, const Visit& visit) {
  const auto isBefore = [axis](const Face& a, const Face& b) { return a.box.low[axis] < b.box.low[axis]; };
  std::ranges::sort(ofA, isBefore);
  std::ranges::sort(ofB, isBefore);
  std::vector<const Face*> openOfA, openOfB;
  const auto meetAll = [&](const Face& face, std::vector<const Face*>& open, auto&& meet) {
    std::erase_if(open,
                  [&](const Face* other) { return other->box.high[axis] + spare < face.box.low[axis]; });
    for (const Face* other : open) meet(*other);
  };
  std::size_t a = 0, b = 0;
  while (a < ofA.size() || b < ofB.size()) {
    if (b == ofB.size() || (a < ofA.size() && isBefore(ofA[a], ofB[b]))) {
      meetAll(ofA[a], openOfB, [&](const Face& other) { visit(ofA[a], other); });
      openOfA.push_back(&ofA[a++]);
    } else {
      meetAll(ofB[b], openOfA, [&](const Face& other) { visit(other, ofB[b]); });
      openOfB.push_back(&ofB[b++]);
    }
  }
}

void findBetween(const Scene& scene, uint32_t a, uint32_t b, const std::array<Box, 2>& boxes, float distance,
                 std::vector<Meeting>& meetings) {
  Box region;
  region.low = glm::max(boxes[0].low, boxes[1].low);
  region.high = glm::min(boxes[0].high, boxes[1].high);
  std::vector<Face> ofA = facesIn(scene, a, region, distance);
  if (ofA.empty()) return;
  std::vector<Face> ofB = facesIn(scene, b, region, distance);
  const vec3 size = region.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  sweep(ofA, ofB, axis, distance, [&](const Face& one, const Face& other) {
    if (!lieTogether(one, other, distance)) return;
    meetings.push_back({a, one.triangle, b});
    meetings.push_back({b, other.triangle, a});
  });
}

bool mayTouch(const Scene& scene, const Object& object, const Box& box, float distance) {
  if (scene.materialOf(object).thinWalled) return false;
  return !object.water || box.size().y <= distance;
}

// Each set of other objects that some triangle meets, once.
Contacts contactsOf(const Scene& scene, std::vector<Meeting>& meetings) {
  Contacts contacts;
  contacts.sets.emplace_back();
  contacts.setOf.resize(scene.objects.size());
  std::ranges::sort(meetings);
  meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
  std::map<std::vector<uint32_t>, uint32_t> known;
  for (std::size_t first = 0, last = 0; first < meetings.size(); first = last) {
    const auto [object, triangle, ignored] = meetings[first];
    std::vector<uint32_t> others;
    while (last < meetings.size() && meetings[last][0] == object && meetings[last][1] == triangle)
      others.push_back(meetings[last++][2]);
    const auto [set, isNew] = known.try_emplace(others, uint32_t(contacts.sets.size()));
    if (isNew) contacts.sets.push_back(others);
    std::vector<uint32_t>& ofTriangles = contacts.setOf[object];
    if (ofTriangles.empty()) ofTriangles.assign(scene.meshOf(scene.objects[object]).triangles.size(), 0);
    ofTriangles[triangle] = set->second;
  }
  return contacts;
}

}  // namespace

Contacts findContacts(const Scene& scene, std::span<const Box> boxes, std::span<const float> roundings) {
  std::vector<Meeting> meetings;
  std::vector<Box> placed;
  for (const Object& object : scene.objects)
    placed.push_back(placedBox(boxes[object.mesh], object.placement));
  for (uint32_t a = 0; a < scene.objects.size(); ++a)
    for (uint32_t b = a + 1; b < scene.objects.size(); ++b) {
      const float distance = touchingDistance(roundings[a], roundings[b]);
      if (!overlap(placed[a], placed[b], distance)) continue;
      const Object &one = scene.objects[a], &other = scene.objects[b];
      if (!hasVolume(scene.materialOf(one)) && !hasVolume(scene.materialOf(other))) continue;
      if (!mayTouch(scene, one, placed[a], distance) || !mayTouch(scene, other, placed[b], distance))
        continue;
      findBetween(scene, a, b, {placed[a], placed[b]}, distance, meetings);
    }
  return contactsOf(scene, meetings);
}

}  // namespace nephroid

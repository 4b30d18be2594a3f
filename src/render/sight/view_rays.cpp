#include "render/sight/view_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/index_range.h"
#include "optics/refraction.h"
#include "scene/framing.h"
#include "transport/refined_triangle.h"

namespace nephroid {
namespace {

constexpr std::size_t kBlock = 256;         // triangles that one task looks at
constexpr float kSmallestSide = 3;          // pixels: shorter ones are not cut; longer ones too where
constexpr float kMostPieces = 5000;         // more pieces than this would be cut
constexpr float kLongestStraightSide = 12;  // pixels: between nearer vertices rays are taken as they are
constexpr float kLargestSide = 32;          // pixels: where sides are longer, most of the pieces are steady
constexpr uint32_t kMostCuts = 8;
constexpr float kMostBend = 0.5f;  // pixels that a side's middle may show off the mean of its ends
// Rays that differ by more go different ways: in direction, and, as parts of the caster's size, in where they
// leave it.
constexpr float kMostTurnOfRays = 0.35f;
constexpr float kMostShiftOfRays = 0.1f;
constexpr float kInset = 1e-3f;  // rays of a cut triangle start this part of the way toward its middle

struct Corner {
  vec3 weights{0};  // barycentric, in the mesh's triangle
  vec3 position{0};
  vec3 normal{0};
  OutgoingRay ray{};
};
using Triangle = std::array<Corner, 3>;

// Whether a triangle is off one side of the picture, or behind the viewer.
bool isOutside(const View& view, const Triangle& t) {
  const vec4 a = view.worldToClip * vec4(t[0].position, 1), b = view.worldToClip * vec4(t[1].position, 1),
             c = view.worldToClip * vec4(t[2].position, 1);
  if (std::max({a.w, b.w, c.w}) <= 0) return true;
  for (int axis = 0; axis < 2; ++axis)
    if ((a[axis] > a.w && b[axis] > b.w && c[axis] > c.w) ||
        (a[axis] < -a.w && b[axis] < -b.w && c[axis] < -c.w))
      return true;
  return false;
}

SightVertex vertexOf(const Corner& corner) {
  const float reach = corner.ray.reach < kUnboundedReach ? corner.ray.reach : kNoReach;
  return {corner.position,
          corner.normal,
          corner.ray.position,
          corner.ray.direction,
          corner.ray.transmittance,
          reach,
          -1,
          {},
          {},
          0,
          0};
}

bool isLost(const OutgoingRay& ray) {
  return (ray.flags & kRayLost) != 0;
}

// Cuts one triangle of the mesh where its rays part: the rules that it is refined by.
class Cutter {
 public:
  Cutter(const TransportSource& sourceToAsk, const TransportQuery& queryOf, const View& viewOf,
         float smallest, float sizeOfCaster, const CasterTriangle& surfaceOf)
      : source_(sourceToAsk),
        query_(queryOf),
        view_(viewOf),
        smallestSide_(smallest),
        size_(sizeOfCaster),
        surface_(surfaceOf) {}

  Refining judge(const Triangle& t, uint32_t cuts, std::vector<Triangle>& pieces) const {
    if (isOutside(view_, t)) return Refining::done;
    const float longest = std::max({pixels(t[0], t[1]), pixels(t[1], t[2]), pixels(t[2], t[0])});
    const bool isEven = isSteady(t);
    if (cuts > 0 && longest >= (isEven ? kLongestStraightSide : smallestSide_))
      return isEven ? Refining::askMiddles : Refining::cut;
    keep(isEven ? t : ofOneRay(t), pieces);
    return Refining::done;
  }

  // Rays go evenly along a short side whose ends go the same way.
  Corner middle(const Triangle& t, std::size_t side) const {
    const Corner &a = t[side], &b = t[(side + 1) % 3];
    const vec3 weights = 0.5f * (a.weights + b.weights);
    if (!sameWay(a, b) || pixels(a, b) > kLongestStraightSide) return at(weights, middleWeights(t));
    Corner middle{weights, surface_.positions * weights, normalize(surface_.normals * weights), a.ray};
    middle.ray.position = 0.5f * (a.ray.position + b.ray.position);
    middle.ray.direction = normalize(a.ray.direction + b.ray.direction);
    middle.ray.transmittance = 0.5f * (a.ray.transmittance + b.ray.transmittance);
    middle.ray.reach = std::max(a.ray.reach, b.ray.reach) < kUnboundedReach
                           ? 0.5f * (a.ray.reach + b.ray.reach)
                           : kUnboundedReach;
    return middle;
  }

  bool isStraight(const Triangle& t, const Triangle& middles) const {
    return !bends(t[0], t[1], middles[0]) && !bends(t[1], t[2], middles[1]) && !bends(t[2], t[0], middles[2]);
  }

  void keep(const Triangle& t, std::vector<Triangle>& pieces) const { pieces.push_back(t); }

  void countCut(std::vector<Triangle>&) const {}

 private:
  // Its ray starts a little toward `center`, off edges where two surfaces meet.
  Corner at(vec3 weights, vec3 center) const {
    return {weights, surface_.positions * weights, normalize(surface_.normals * weights),
            source_.rayAt(query_, surface_.at(mix(weights, center, kInset)))};
  }

  float pixels(const Corner& a, const Corner& b) const {
    const vec3 eye = query_.emitter.position;
    return distance(a.position, b.position) / (view_.pixelAngle * std::max(distance(a.position, eye), 1e-6f));
  }

  // By where they go: rays of a table and traced ones have no signatures in common.
  bool sameWay(const Corner& a, const Corner& b) const {
    if (isLost(a.ray) || isLost(b.ray)) return isLost(a.ray) && isLost(b.ray);
    return distance(a.ray.direction, b.ray.direction) < kMostTurnOfRays &&
           distance(a.ray.position, b.ray.position) < kMostShiftOfRays * size_;
  }

  bool isSteady(const Triangle& t) const {
    return sameWay(t[0], t[1]) && sameWay(t[0], t[2]) && sameWay(t[1], t[2]);
  }

  // Whether the ray at a side's middle is off the mean of those at its ends.
  bool bends(const Corner& a, const Corner& b, const Corner& middle) const {
    if (!sameWay(a, middle) || !sameWay(b, middle)) return true;
    const float pixel = view_.pixelAngle * distance(middle.position, query_.emitter.position);  // m
    return distance(middle.ray.direction, normalize(a.ray.direction + b.ray.direction)) >
               kMostBend * view_.pixelAngle ||
           distance(middle.ray.position, 0.5f * (a.ray.position + b.ray.position)) > kMostBend * pixel;
  }

  // What is too small to be cut looks the way of its first corner that is not lost.
  static Triangle ofOneRay(Triangle t) {
    const auto found = std::find_if(t.begin(), t.end(), [](const Corner& c) { return !isLost(c.ray); });
    const OutgoingRay ray = found == t.end() ? t[0].ray : found->ray;
    for (Corner& corner : t) corner.ray = ray;
    return t;
  }

  const TransportSource& source_;
  const TransportQuery& query_;
  const View& view_;
  const float smallestSide_;  // pixels
  const float size_;          // m
  const CasterTriangle& surface_;
};

// What became of a block of triangles: the vertices of the mesh of those that are whole, and the pieces of
// those that were cut.
struct Block {
  std::vector<uint32_t> indices;
  std::vector<Triangle> pieces;
  std::vector<Triangle> parting;  // to be cut
  float squarePixels = 0;         // of the longest sides of those whose rays part
};

class Collector {
 public:
  Collector(const Scene& scene, const TransportSource& sourceToAsk, const TransportQuery& queryOf,
            const View& viewOf)
      : source_(sourceToAsk),
        query_(queryOf),
        view_(viewOf),
        object_(scene.objects[queryOf.object]),
        mesh_(scene.meshOf(object_)),
        facing_(queryOf.media.contains(queryOf.object) ? -1.0f : 1.0f),
        rays_(mesh_.positions.size()) {
    source_.vertexRays(query_, rays_);
    corners_.reserve(rays_.size());
    for (std::size_t i = 0; i < rays_.size(); ++i)
      corners_.push_back({{},
                          object_.placement.point(mesh_.positions[i]),
                          object_.placement.direction(mesh_.normals[i]),
                          rays_[i]});
    size_ = worldBounds(scene, object_).diagonal();
  }

  SightMesh collect() const {
    const std::size_t blocks = (mesh_.triangles.size() + kBlock - 1) / kBlock;
    std::vector<Block> parts(blocks);
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      const std::size_t end = std::min(mesh_.triangles.size(), (block + 1) * kBlock);
      for (std::size_t t = block * kBlock; t < end; ++t) add(mesh_.triangles[t], parts[block]);
    });
    float squarePixels = 0;
    for (const Block& part : parts) squarePixels += part.squarePixels;
    const float smallestSide = std::max(kSmallestSide, std::sqrt(squarePixels / kMostPieces));
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      for (const Triangle& t : parts[block].parting) {
        const CasterTriangle surface({t[0].position, t[1].position, t[2].position},
                                     {t[0].normal, t[1].normal, t[2].normal}, mesh_.isCurved);
        const Cutter cutter(source_, query_, view_, smallestSide, size_, surface);
        refineTriangle(cutter, t, kMostCuts, 0, parts[block].pieces);
      }
    });
    SightMesh result;
    result.vertices.reserve(corners_.size());
    for (const Corner& corner : corners_) result.vertices.push_back(vertexOf(corner));
    for (const Block& part : parts) {
      result.indices.insert(result.indices.end(), part.indices.begin(), part.indices.end());
      for (const Triangle& piece : part.pieces)
        for (const Corner& corner : piece) {
          result.indices.push_back(uint32_t(result.vertices.size()));
          result.vertices.push_back(vertexOf(corner));
        }
    }
    return result;
  }

 private:
  bool isSeen(const uvec3& t) const {
    if (!mesh_.isClosed) return true;
    const vec3 a = corners_[t.x].position;
    const vec3 across = cross(corners_[t.y].position - a, corners_[t.z].position - a);
    return facing_ * dot(across, query_.emitter.position - a) > 0;
  }

  // By the caster itself, as far as the source can tell.
  bool isHidden(const uvec3& t) const {
    return (rays_[t.x].flags & rays_[t.y].flags & rays_[t.z].flags & kRayOccluded) != 0;
  }

  static bool isSteady(const Triangle& t) {
    return !isLost(t[0].ray) && !isLost(t[1].ray) && !isLost(t[2].ray) &&
           t[0].ray.signature == t[1].ray.signature && t[0].ray.signature == t[2].ray.signature;
  }

  float longestSide(const uvec3& t) const {  // pixels
    const vec3 a = corners_[t.x].position, b = corners_[t.y].position, c = corners_[t.z].position;
    return std::max({distance(a, b), distance(b, c), distance(c, a)}) /
           (view_.pixelAngle * std::max(distance(a, query_.emitter.position), 1e-6f));
  }

  bool isLong(const uvec3& t) const { return longestSide(t) > kLongestStraightSide; }

  bool facesAway(const Corner& corner) const {
    return facing_ * dot(corner.position - query_.emitter.position, corner.normal) >= 0;
  }

  // A corner beyond the visible part has no view ray of its own; up to the edge, those of the other corners
  // are used.
  Triangle upToRim(const uvec3& t) const {
    Triangle triangle{corners_[t.x], corners_[t.y], corners_[t.z]};
    const auto seen = std::ranges::find_if_not(triangle, [&](const Corner& c) { return facesAway(c); });
    if (seen == triangle.end()) return triangle;
    const OutgoingRay ray = seen->ray;
    for (Corner& corner : triangle)
      if (facesAway(corner)) corner.ray = ray;
    return triangle;
  }

  void add(const uvec3& t, Block& block) const {
    if (!isSeen(t)) return;
    if (!isLong(t) && isSteady({corners_[t.x], corners_[t.y], corners_[t.z]})) {
      block.indices.insert(block.indices.end(), {t.x, t.y, t.z});
      return;
    }
    Triangle whole = upToRim(t);
    if (!isLong(t) && (isSteady(whole) || isHidden(t))) {
      block.pieces.push_back(whole);
      return;
    }
    if (isOutside(view_, whole)) return;
    for (int i = 0; i < 3; ++i) whole[std::size_t(i)].weights = mat3(1)[i];
    block.parting.push_back(whole);
    if (isSteady(whole)) return;
    const float longest = std::min(longestSide(t), kLargestSide);
    block.squarePixels += longest * longest;
  }

  const TransportSource& source_;
  const TransportQuery& query_;
  const View& view_;
  const Object& object_;
  const Mesh& mesh_;
  const float facing_;  // -1 where the viewer is inside the caster
  float size_ = 0;      // m, across the caster
  std::vector<OutgoingRay> rays_;
  std::vector<Corner> corners_;
};

// What sight meets where it ends.
void findReceiver(const Scene& scene, const RayScene& rays, SightVertex& vertex) {
  if (!(vertex.reach > 0)) return;
  Hit hit;
  if (!rays.intersect({vertex.exit, vertex.direction, 0.999f * vertex.reach}, hit)) return;
  const Material& material = scene.materialOf(scene.objects[hit.object]);
  if (material.isCaster()) return;
  vertex.receiverNormal = dot(hit.normal, vertex.direction) < 0 ? hit.normal : -hit.normal;
  vertex.receiverColor = material.color;
  vertex.receiverMaterial = scene.objects[hit.object].material;
  // Of a texture the surface's place would have to be known, too.
  vertex.isReceiverKnown = material.colorTexture == kNone ? 1 : 0;
}

// Where what is reflected at a vertex comes from.
void findReflected(const Scene& scene, const RayScene& rays, uint32_t object, vec3 eye, SightVertex& vertex) {
  const vec3 incident = normalize(vertex.position - eye);
  const vec3 normal = dot(incident, vertex.normal) < 0 ? vertex.normal : -vertex.normal;
  const vec3 direction = reflectDirection(incident, normal);
  Hit hit;
  if (rays.intersect({vertex.position, direction, rays.clearance(object, normal, direction)}, hit) &&
      !scene.isCaster(scene.objects[hit.object]))
    vertex.reflectedReach = hit.distance;
}

// Calls find(vertex) for those that are seen.
template <class Find>
void forUsedVertices(SightMesh& mesh, const Find& find) {
  std::vector<bool> isUsed(mesh.vertices.size(), false);
  for (const uint32_t i : mesh.indices) isUsed[i] = true;
  oneapi::tbb::parallel_for(IndexRange(0, mesh.vertices.size(), kBlock), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      if (isUsed[i]) find(mesh.vertices[i]);
  });
}

}  // namespace

TransportQuery sightQuery(uint32_t object, vec3 eye, uint32_t channel, const MediumStack& media) {
  TransportQuery query;
  query.object = object;
  query.emitter.type = kEmitterPoint;
  query.emitter.position = eye;
  query.channel = channel;
  query.paths = Paths::all;
  query.media = media;
  query.isSight = true;
  return query;
}

SightMesh sightMesh(const Scene& scene, const TransportSource& source, const RayScene& rays,
                    const TransportQuery& query, const View& view) {
  SightMesh mesh = Collector(scene, source, query, view).collect();
  const bool reflects = scene.materialOf(scene.objects[query.object]).type == MaterialType::dielectric;
  forUsedVertices(mesh, [&](SightVertex& vertex) {
    findReceiver(scene, rays, vertex);
    if (reflects) findReflected(scene, rays, query.object, query.emitter.position, vertex);
  });
  return mesh;
}

}  // namespace nephroid

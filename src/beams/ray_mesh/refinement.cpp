#include "beams/ray_mesh/refinement.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/index_range.h"

namespace nephroid {
namespace {

constexpr int kMostLevels = 16;
// Of the most beams, what can be added to those of the casters' own triangles, however many they are.
constexpr uint64_t kPartForCuts = 4;
// A sheet whose corners differ more than this in density is taken to have one density alone.
constexpr float kSteep = 2.5f;
// Of the detail that a receiver's point shows: light that is no more off is where it should be.
constexpr float kUnseen = 0.3f, kUnseenInFold = 1;
// Of what density that changes along a side would mean if it came of bending alone.
constexpr float kUneven = 0.8f;
// Light that is denser than this, times the mean of what is lit, is focused.
constexpr double kFocus = 8;
// Of the size of what is lit, the most that one path stands for.
constexpr float kWidestPath = 1.0f / 8;
// Of the mean of what is lit, the brightest that one path may be, so that it is not seen as a speck.
constexpr float kBrightestPath = 0.02f;
// Texels that a beam has across and along, at most.
constexpr float kTexelsAcross = 2.5f, kTexelsAlong = 12;
// A sheet of so much gain is one that was chosen by lot.
constexpr float kChosen = 2;
// Area and side of a triangle whose corners are 1 off its middle.
constexpr double kTangentArea = 1.299;
constexpr float kSideOfTangent = 1.732f;
// Variance along an axis of such a triangle.
constexpr float kTangentVariance = 1.0f / 8;
// Of the standard deviation of a lamp's image, the detail that is left in light that is smeared by it.
constexpr float kDetailOfBlur = 0.7f;
// Of the standard deviation, how far the image of a lamp reaches from its middle, at most.
constexpr float kReachOfBlur = 2.5f;

// Unit, on the side of the receiver that the path's light lands on.
vec3 litNormal(const PathNode& node) {
  return dot(node.direction, node.geometricNormal) < 0 ? node.geometricNormal : -node.geometricNormal;
}

// Corners of a triangle about a point, each `radius` off.
mat3 tangentFrame(vec3 normal, float radius) {
  const vec3 aside = std::abs(normal.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
  const vec3 u = normalize(cross(normal, aside)), v = cross(normal, u);
  return {radius * u, radius * (-0.5f * u + 0.866f * v), radius * (-0.5f * u - 0.866f * v)};
}

// What lies in an area (m2), or is in it in all, for each receiver's point.
double pointsOf(const Landing& landing, float area) {
  return double(area) / (double(landing.point) * double(landing.point));
}

}  // namespace

Refinement::Refinement(LightSheets& sheetsOf, const RayMeshSettings& settingsOf, SheetMemory& memoryOf)
    : sheets_(sheetsOf), settings_(settingsOf), memory_(memoryOf) {}

void Refinement::run(std::vector<Sheet>& landed, Progress& progress) {
  mostBeams_ = std::max(settings_.mostBeams, landed.size() + settings_.mostBeams / kPartForCuts);
  for (int level = 0;; ++level) {
    progress.advance();
    describe(landed);
    if (level == 0) allowed_ = allowedSquares();
    const double squares = judge(landed);
    if (allowed_ > 0)
      sheets_.stats.error = std::sqrt((squares + chanceSquares(landed)) / allowed_) * double(settings_.error);
    if (squares <= allowed_ || level == kMostLevels || isFull(landed)) return;
    if (!cutWorst(landed, squares, progress)) return;
  }
}

bool Refinement::isFull(const std::vector<Sheet>& landed) {
  RayMeshBound& bound = sheets_.stats.bound;
  if (landed.size() >= mostBeams_) bound = RayMeshBound::beams;
  if (sheets_.bytes() > settings_.mostBytes) bound = RayMeshBound::bytes;
  return bound != RayMeshBound::none;
}

void Refinement::describeAnew(const std::vector<Sheet>& landed) {
  landings_.clear();
  around_.clear();
  describe(landed);
}

Landing Refinement::landingOf(const Sheet& sheet) const {
  const std::vector<PathNode>& nodes = sheets_.tree.nodes;
  const PathNode &a = nodes[sheet.node[0]], &b = nodes[sheet.node[1]], &c = nodes[sheet.node[2]];
  Landing landing;
  landing.flux = sheets_.carried(sheet);
  landing.luminance = luminanceOf(landing.flux);
  const vec3 across = cross(b.position - a.position, c.position - a.position);
  const float doubled = length(across);
  landing.area = 0.5f * doubled;
  landing.longest = std::max(
      {distance(a.position, b.position), distance(b.position, c.position), distance(c.position, a.position)});
  landing.width = landing.longest > 0 ? doubled / landing.longest : 0;
  landing.point = sheets_.scales.pointAt(a.position, sheets_.casterOf(sheet));
  landing.blur = blurOf(sheet);
  landing.detail = std::max(landing.point, kDetailOfBlur * landing.blur.x);
  landing.isMirrored = dot(across, a.direction) < 0;
  if (settings_.target.isPlane) {
    const PlaneGrid& grid = settings_.target.plane;
    vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const PathNode* node : {&a, &b, &c}) {
      const vec3 offset = node->position - grid.corner;
      const vec2 texel(dot(offset, grid.axisU), dot(offset, grid.axisV));
      low = min(low, texel);
      high = max(high, texel);
    }
    // And as far as the lamp's size smears it.
    const vec2 about = kReachOfBlur * landing.blur.y * vec2(length(grid.axisU), length(grid.axisV));
    low -= about;
    high += about;
    landing.isWanted = glm::all(glm::lessThan(low, settings_.wantedHigh)) &&
                       glm::all(glm::greaterThan(high, settings_.wantedLow));
  }
  return landing;
}

// Where a sheet's corners land for another place on its lamp, for each standard deviation along the lamp's
// axes.
BeamShift Refinement::shiftOf(const Sheet& sheet) const {
  BeamShift shift;
  const LampSpread& lamp = sheets_.spreadOf(sheet);
  for (int c = 0; c < 3; ++c) {
    const PathNode& node = sheets_.tree.nodes[sheet.node[c]];
    const float way = distance(sheets_.tree.nodes[node.parent].position, node.position);
    const PathSpread& spread = sheets_.tree.spreads[sheet.node[c]];
    shift.start[c] = sheets_.tree.nodes[node.parent].position;
    shift.direction[c] = node.direction;
    for (int i = 0; i < 2; ++i) {
      shift.startShift[c][i] = lamp.deviation[i] * sheets_.tree.spreads[node.parent].position[i];
      shift.directionShift[c][i] = lamp.deviation[i] * spread.direction[i];
      const vec3 moved = lamp.deviation[i] * spread.position[i];
      // It is no straight line where it is long.
      shift.corner[c][i] = moved * std::min(1.0f, 0.5f * way / std::max(length(moved), 1e-30f));
    }
  }
  return shift;
}

vec2 Refinement::blurOf(const Sheet& sheet) const {
  if (!sheets_.spreadOf(sheet).hasSize()) return vec2(0);
  const BeamShift shift = shiftOf(sheet);
  const vec3 u = (shift.corner[0][0] + shift.corner[1][0] + shift.corner[2][0]) / 3.0f;
  const vec3 v = (shift.corner[0][1] + shift.corner[1][1] + shift.corner[2][1]) / 3.0f;
  const float mean = 0.5f * (dot(u, u) + dot(v, v));
  const float apart = std::hypot(0.5f * (dot(u, u) - dot(v, v)), dot(u, v));
  return sqrt(max(vec2(mean - apart, mean + apart), vec2(0)));
}

void Refinement::describe(const std::vector<Sheet>& landed) {
  const std::size_t known = landings_.size();
  landings_.resize(landed.size());
  oneapi::tbb::parallel_for(IndexRange(known, landed.size(), 512), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) landings_[i] = landingOf(landed[i]);
  });
  around_.resize(sheets_.tree.nodes.size());
  for (std::size_t i = known; i < landed.size(); ++i) include(landed[i], landings_[i], 1);
}

// Adds a sheet to the sums at its nodes, or takes it away: `sign` is 1 or -1.
void Refinement::include(const Sheet& sheet, const Landing& landing, int sign) {
  if (sheet.cuts == kWhole) return;
  for (const uint32_t node : sheet.node) {
    Around& around = around_[node];
    around.flux += sign * double(landing.luminance);
    around.incident += sign * double(luminanceOf(sheet.flux));
    around.area += sign * double(landing.area);
    around.count[landing.isMirrored] += uint32_t(sign);
  }
}

// Where nine tenths of what points get of the light land, the densest first; how much of it all points get
// in the mean.
void Refinement::describeLit() {
  constexpr int kBuckets = 1024;
  constexpr float kBucketsAnOctave = 16, kMiddle = kBuckets / 2;
  double areaIn[kBuckets] = {}, pointsIn[kBuckets] = {}, lightIn[kBuckets] = {};
  double points = 0, light = 0;  // light: lm/m2, times points
  for (const Landing& landing : landings_) {
    if (!landing.isWanted) continue;
    points += pointsOf(landing, landing.area);
    light += pointsOf(landing, landing.luminance);
  }
  const float unit = float(light / std::max(points, 1e-30));
  for (const Landing& landing : landings_) {
    const float density = landing.luminance / std::max(landing.area, landing.detail * landing.detail);
    if (!(density > 0) || !landing.isWanted) continue;
    const float bucket = kMiddle - kBucketsAnOctave * std::log2(density / unit);
    const int i = int(std::clamp(bucket, 0.0f, float(kBuckets - 1)));
    areaIn[i] += double(landing.area);
    pointsIn[i] += pointsOf(landing, landing.area);
    lightIn[i] += pointsOf(landing, landing.luminance);
  }
  double area = 0, sum = 0;
  litPoints_ = 0;
  for (int i = 0; i < kBuckets && sum <= 0.9 * light; ++i) {
    area += areaIn[i];
    litPoints_ += pointsIn[i];
    sum += lightIn[i];
  }
  if (settings_.area > 0) {
    area = double(settings_.area);
    litPoints_ = area / (double(settings_.detail) * double(settings_.detail));
  }
  litArea_ = float(area);
  mean_ = light / std::max(litPoints_, 1e-30);
}

// What the squares of the error, times the points that have them, may add up to: (lm/m2)^2.
double Refinement::allowedSquares() {
  describeLit();
  return std::pow(double(settings_.error) * mean_, 2) * litPoints_;
}

// By how much the density of the light changes across a sheet, over its mean; a fold has no density.
float Refinement::steepness(const Sheet& sheet, const Landing& landing) const {
  const float own = luminanceOf(sheet.flux) / std::max(landing.area, 1e-30f);
  float least = own, most = own;
  for (const uint32_t node : sheet.node) {
    if (around_[node].isFold()) return kSteep;
    const float density = around_[node].bundling();
    least = std::min(least, density);
    most = std::max(most, density);
  }
  return std::min(least > 0 ? most / least - 1 : kSteep, kSteep);
}

double Refinement::errorSquares(const Sheet& sheet, const Landing& landing) const {
  if (sheet.cuts == kWhole || sheet.isSettled || !landing.isWanted) return 0;
  const float detail = landing.detail;
  const float steep = steepness(sheet, landing);
  // m that a side's middle lands off the middle of its ends, or would if what makes the density change were
  // that: light that meets the caster unevenly is no straight line between corners either.
  const float moved = 0.125f * steep * landing.longest;
  const float seen = std::max(std::min(sheet.bend, moved), kUneven * moved) -
                     (steep < kSteep ? kUnseen : kUnseenInFold) * detail;
  const float bend = std::max(seen, 0.0f);
  const float width = landing.width + detail;
  const float off = bend / width;
  const bool isSmooth = steep < kSteep;
  const float relative = std::min(1.0f, (isSmooth ? 16 * off * off : 2.5f * off) + off * detail / width);
  const float area = landing.area + detail * landing.longest + detail * detail;
  // Where light is focused, it may be off by a part of itself.
  const double density = std::min(double(landing.luminance) / double(area), kFocus * mean_);
  return std::pow(density * double(relative), 2) * pointsOf(landing, area);
}

double Refinement::judge(const std::vector<Sheet>& landed) {
  errors_.resize(landed.size());
  oneapi::tbb::parallel_for(IndexRange(0, landed.size(), 512), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      errors_[i] = errorSquares(landed[i], landings_[i]);
  });
  double sum = 0;
  for (const double error : errors_) sum += error;
  return sum;
}

// Cuts those that make the most of the error, so that the others make a third of what is allowed.
bool Refinement::cutWorst(std::vector<Sheet>& landed, double squares, Progress& progress) {
  constexpr int kBuckets = 512;
  constexpr double kBucketsAnOctave = 4;
  const auto bucketOf = [&](double error) {
    return int(glm::clamp(std::log2(squares / error) * kBucketsAnOctave, 0.0, double(kBuckets - 1)));
  };
  double inBucket[kBuckets] = {};
  std::size_t countInBucket[kBuckets] = {};
  for (const double error : errors_)
    if (error > 0) {
      const int bucket = bucketOf(error);
      inBucket[bucket] += error;
      ++countInBucket[bucket];
    }
  double left = 0.33 * allowed_;
  int last = kBuckets;  // the first that is left as it is
  while (last > 1 && left >= inBucket[last - 1]) left -= inBucket[--last];
  // Each that is cut adds three.
  std::size_t room = (mostBeams_ - std::min<uint64_t>(landed.size(), mostBeams_)) / 3 + 1;
  for (int bucket = 0; bucket < last; ++bucket) {
    if (countInBucket[bucket] > room && bucket > 0) {
      last = bucket;
      sheets_.stats.bound = RayMeshBound::beams;
    }
    room -= std::min(room, countInBucket[bucket]);
  }
  std::vector<Sheet>&worst = memory_.worst, &parts = memory_.sheets;
  worst.clear();
  parts.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < landed.size(); ++i) {
    if (errors_[i] > 0 && bucketOf(errors_[i]) < last) {
      worst.push_back(landed[i]);
      include(landed[i], landings_[i], -1);
    } else {
      landings_[kept] = landings_[i];
      landed[kept++] = landed[i];
    }
  }
  landed.resize(kept);
  landings_.resize(kept);
  if (worst.empty()) return false;
  sheets_.cut(worst, parts);
  settleChaotic(landed);
  sheets_.follow(parts, landed, progress);
  return true;
}

// Chaotic sheets whose parts go other ways stay as they were, and land again.
void Refinement::settleChaotic(std::vector<Sheet>& landed) {
  std::vector<Sheet>&worst = memory_.worst, &parts = memory_.sheets;
  const auto signatureOf = [&](uint32_t node) { return sheets_.tree.nodes[node].signature; };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const std::span<const Sheet> own = std::span(parts).subspan(4 * i, 4);
    const bool isOneWay = std::ranges::all_of(
        own[3].node, [&](uint32_t middle) { return signatureOf(middle) == signatureOf(worst[i].node[0]); });
    if (isOneWay || !sheets_.isChaotic(worst[i])) {
      for (const Sheet& part : own) parts[kept++] = part;
    } else {
      worst[i].isSettled = true;
      landed.push_back(worst[i]);
    }
  }
  parts.resize(kept);
}

// Radius (m) about the end of a single path, over which its light is spread.
float Refinement::pathRadius(const Sheet& sheet, const Landing& landing) const {
  const float faint = std::sqrt(landing.luminance / (kBrightestPath * std::max(float(mean_), 1e-30f)));
  const float widest = kWidestPath * std::sqrt(litArea_);
  return std::clamp(std::max(sheet.bend, faint), landing.detail, std::max(widest, landing.detail));
}

// The variance of what was chosen by lot, in the unit of errorSquares: of single paths, which stand for the
// light about them, and of sheets, which stand for those that were taken out.
double Refinement::chanceSquares(const std::vector<Sheet>& landed) const {
  double sum = 0;
  for (std::size_t i = 0; i < landed.size(); ++i) {
    const Landing& landing = landings_[i];
    const bool isPath = landed[i].cuts == kWhole;
    const bool isByChance = isPath || landed[i].isSettled || landed[i].gain >= kChosen;
    if (!landing.isWanted || !isByChance) continue;
    const double radius = isPath ? double(pathRadius(landed[i], landing)) : 0;
    const double area = isPath ? kTangentArea * radius * radius : double(landing.area);
    const double luminance = double(landing.luminance);
    const double point = double(settings_.detailsOfPoint * landing.detail);
    sum += pointsOf(landing, float(luminance * luminance / std::max(area, point * point)));
  }
  return sum;
}

LandedBeam Refinement::beamOf(const Sheet& sheet, const Landing& landing) const {
  LandedBeam beam;
  beam.flux = landing.flux;
  beam.width = landing.width;
  float along = landing.longest;
  beam.isPath = sheet.cuts == kWhole;
  const PathNode& first = sheets_.tree.nodes[sheet.node[0]];
  mat3 tangent(0);
  if (beam.isPath) {
    const float blur = 0.5f * dot(landing.blur, landing.blur);
    const float radius = std::sqrt(std::pow(pathRadius(sheet, landing), 2.0f) + blur / kTangentVariance);
    const bool isPlane = settings_.target.isPlane;
    tangent = tangentFrame(isPlane ? settings_.target.plane.normal : first.geometricNormal, radius);
    beam.width = 1.5f * radius;
    along = kSideOfTangent * radius;
  }
  beam.texel = std::max({landing.detail, beam.width / kTexelsAcross, along / kTexelsAlong});
  const bool isSmooth = !beam.isPath && steepness(sheet, landing) < kSteep;
  vec3 density(1);
  beam.object = first.object;
  beam.leastNormal = beam.mostNormal = litNormal(first);
  for (int c = 0; c < 3; ++c) {
    const PathNode& node = sheets_.tree.nodes[sheet.node[c]];
    beam.corner[c] = node.position + tangent[c];
    beam.leastNormal = min(beam.leastNormal, litNormal(node));
    beam.mostNormal = max(beam.mostNormal, litNormal(node));
    if (isSmooth) density[c] = around_[sheet.node[c]].density();
  }
  beam.density = isSmooth ? 3.0f * density / (density.x + density.y + density.z) : vec3(1);
  return beam;
}

// How many beams a sheet becomes: so many that the lamp's image has no gaps.
BeamCopies Refinement::copiesOf(const Sheet& sheet, const Landing& landing) const {
  if (sheet.cuts == kWhole || landing.blur.y <= 0) return {};
  return copiesFor(landing.blur.y, landing.detail, landing.longest, sheets_.spreadOf(sheet).isOneOfMore);
}

void Refinement::emit(const std::vector<Sheet>& landed, RayMesh& mesh) {
  std::vector<uint32_t> wanted;
  wanted.reserve(landed.size());
  RayMeshStats& stats = sheets_.stats;
  for (uint32_t i = 0; i < landed.size(); ++i) {
    if (!landings_[i].isWanted) {
      stats.missedFlux += double(landings_[i].luminance);
      continue;
    }
    wanted.push_back(i);
    stats.landedFlux += double(landings_[i].luminance);
    stats.singlePaths += landed[i].cuts == kWhole;
    ++stats.beamsByLevel[std::min<std::size_t>(landed[i].cuts, kToldLevels - 1)];
    ++stats.beamsByBranch[std::min<std::size_t>(landed[i].generation, kToldLevels - 1)];
  }
  // Of each, the first of the beams that it becomes.
  std::vector<std::size_t> firsts(wanted.size() + 1, mesh.beams.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    firsts[i + 1] = firsts[i] + copiesOf(landed[wanted[i]], landings_[wanted[i]]).count;
  mesh.beams.resize(firsts.back());
  oneapi::tbb::parallel_for(IndexRange(0, wanted.size(), 512), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Sheet& sheet = landed[wanted[i]];
      const LandedBeam beam = beamOf(sheet, landings_[wanted[i]]);
      const std::span<LandedBeam> beams = std::span(mesh.beams).subspan(firsts[i], firsts[i + 1] - firsts[i]);
      const vec3 normal = settings_.target.isPlane ? settings_.target.plane.normal
                                                   : sheets_.tree.nodes[sheet.node[0]].geometricNormal;
      const bool isMixed = copiesOf(sheet, landings_[wanted[i]]).areMixed;
      if (beams.size() == 1 && !isMixed)
        beams[0] = beam;
      else
        widen(beam, shiftOf(sheet), sheets_.spreadOf(sheet), normal,
              isMixed ? std::optional(i) : std::nullopt, beams);
    }
  });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Sheet& sheet = landed[wanted[i]];
    mesh.paths.insert(mesh.paths.end(), firsts[i + 1] - firsts[i],
                      {{sheet.node[0], sheet.node[1], sheet.node[2]}, sheet.cuts});
  }
}

}  // namespace nephroid

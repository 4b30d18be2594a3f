// A prism turns each wavelength by its own angle, and lays the colors out in their order.
#include <gtest/gtest.h>

#include <set>

#include "support/closed_forms.h"
#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr double kApex = double(kPi) / 3;

Material flint() {
  Material material = glass();
  material.ior = {1.60f, 1.62f, 1.66f};
  return material;
}

// Angle of incidence at which green light is turned the least.
double incidence() {
  return std::asin(std::sin(kApex / 2) * double(flint().ior.y));
}

// Light comes from the left, a little upward, and leaves to the right as much downward.
Scene prism(float radius) {
  Scene scene;
  const double upward = incidence() - kApex / 2;
  scene.lights = {sun({std::cos(upward), std::sin(upward), 0})};
  add(scene, makePrism(radius, 4 * radius), flint());
  return scene;
}

// The angles that light was turned by which left through the right face, with its band.
struct Leaving final : PhotonVisitor {
  void segment(const PhotonSegment& segment) override {
    const vec3& d = segment.ray.direction;
    const double turned = incidence() - kApex / 2 - std::atan2(double(d.y), double(d.x));
    // Light through the base goes up.
    if (segment.metCaster && segment.isInAir() && segment.ray.origin.x > 0 && d.y < 0)
      angles.emplace_back(turned, segment.band);
  }
  std::vector<std::pair<double, uint32_t>> angles;
};

TEST(Prism, TurnsEachWavelengthAsItsIndexSays) {
  const Scene scene = prism(0.5f);
  const RayScene rays(scene);
  const Boundaries boundaries(scene, rays);
  const Lights lights(scene, Aim::casters);
  const PhotonTracer tracer(scene, boundaries, lights, Paths::transmission);
  for (const Spectrum spectrum : {Spectrum::channels, Spectrum::continuous}) {
    const PhotonPass pass = photonPass(scene, spectrum, 1, 0, 1 << 14);
    FluxLedger ledger;
    std::size_t count = 0;
    for (const Leaving& group : tracePass(tracer, pass, Leaving(), ledger))
      for (const auto& [turned, band] : group.angles) {
        const double index = double(indexOfRefraction(flint(), pass.bands[band]));
        ASSERT_NEAR(turned, prismDeviation(kApex, index, incidence()), 2e-6) << band;  // single precision
        ++count;
      }
    EXPECT_GT(count, 1000u);
  }
  // At the minimum the textbook's formula gives the index.
  const double least = 2 * incidence() - kApex;
  EXPECT_NEAR(prismDeviation(kApex, double(flint().ior.y), incidence()), least, 1e-9);
}

// Degrees from red by way of green and blue.
double hue(vec3 color) {
  return glm::degrees(
      std::atan2(std::sqrt(3.0) * double(color.y - color.z), double(2 * color.x - color.y - color.z)));
}

TEST(Prism, LaysTheColorsOutInTheirOrder) {
  const Scene scene = prism(0.01f);
  const double middle = incidence() - kApex / 2;  // radians downward
  const vec3 forward(std::cos(middle), -std::sin(middle), 0), along(-std::sin(middle), -std::cos(middle), 0);
  // 2 m away, along the spectrum from the red end; a beam of 14 mm.
  constexpr uint32_t kParts = 40;
  Sensor screen{"screen", 2.0f * forward - 0.1f * along, 0.3f * along, {0, 0, 0.1f}, {kParts, 1}};
  screen.corner.z = -0.05f;
  if (dot(screen.normal(), forward) > 0) {
    screen.corner += screen.v;
    screen.v = -screen.v;
  }
  ReferenceSettings settings;
  settings.photons = 1 << 13;
  settings.paths = Paths::transmission;
  const Image image = measured(scene, screen, 64, settings);
  std::vector<vec3> lux(kParts), errors(kParts);
  float brightest = 0;
  for (uint32_t part = 0; part < kParts; ++part)
    for (int c = 0; c < 3; ++c) {
      lux[part][c] = image.find(std::string("caustics.") + "RGB"[c])->at(part);
      errors[part][c] = image.find(std::string("caustics.standard_error.") + "RGB"[c])->at(part);
      brightest = std::max(brightest, lux[part][c]);
    }
  std::set<int> sectors;  // of 15 degrees; three lines would show three
  double before = 0, first = 360, last = 0;
  for (uint32_t part = 0; part < kParts; ++part) {
    const vec3 color = lux[part];
    const float most = std::max({color.x, color.y, color.z});
    if (most < 0.05f * brightest) continue;
    double here = hue(color);
    if (here < -30) here += 360;
    // A hue turns by at most sixty degrees for each part of the strongest channel that another gains.
    const double error = 60 * double(length(errors[part]) / most);
    EXPECT_GT(here, before - 4 * error) << part;
    before = here;
    first = std::min(first, here);
    last = std::max(last, here);
    sectors.insert(static_cast<int>(std::floor(here / 15)));
  }
  EXPECT_LT(first, 5);   // red
  EXPECT_GT(last, 235);  // blue
  EXPECT_GE(sectors.size(), 12u);
}

}  // namespace
}  // namespace nephroid

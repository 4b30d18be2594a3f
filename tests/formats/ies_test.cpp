// Photometric files against closed forms, and wrong ones against one line each.
#include <cmath>
#include <random>

#include "formats/ies.h"
#include "lights/light_intensity.h"
#include "support/scratch_files.h"
#include "support/shared_data.h"

namespace nephroid {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A file without tilt: `type` as LM-63 counts (1 C, 2 B, 3 A).
std::string iesFile(int type, const std::vector<double>& verticals, const std::vector<double>& horizontals,
                    const std::vector<double>& candela, const std::string& header = "IESNA:LM-63-2002",
                    const std::string& factors = "1 1 50", double multiplier = 1) {
  std::ostringstream text;
  text << header << "\n[TEST] none\nTILT=NONE\n1 1000 " << multiplier << ' ' << verticals.size() << ' '
       << horizontals.size() << ' ' << type << " 2 0 0 0\n"
       << factors << '\n';
  for (const auto* list : {&verticals, &horizontals, &candela}) {
    for (const double value : *list) text << value << ' ';
    text << '\n';
  }
  return text.str();
}

Profile read(const std::string& text) {
  return readIes(text, "lamp.ies");
}

// cd toward type C's angles: L = 0 up, 90 to the left.
double atC(const Profile& profile, double vertical, double horizontal) {
  const double v = glm::radians(vertical), l = glm::radians(horizontal);
  return profile.peak *
         profileFraction(profile, vec3(-std::sin(v) * std::sin(l), std::sin(v) * std::cos(l), std::cos(v)));
}

// Lumens by brute force: equal steps in the cosine and around.
double fluxByMidpoints(const Profile& profile) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = (i + 0.5) * 2 / kSteps - 1, r = std::sqrt(1 - z * z);
    for (int k = 0; k < kSteps; ++k) {
      const double around = (k + 0.5) * 2 * kPi / kSteps;
      sum += profileFraction(profile, vec3(r * std::cos(around), r * std::sin(around), z));
    }
  }
  return profile.peak * sum * 4 * kPi / (double(kSteps) * kSteps);
}

TEST(Ies, AUniformSphereGivesFourPiCandela) {
  const Profile profile = read(iesFile(1, {0, 90, 180}, {0}, {100, 100, 100}));
  EXPECT_EQ(profile.peak, 100);
  EXPECT_NEAR(profileFlux(profile), 400 * kPi, 1e-9 * 400 * kPi);
  for (const double vertical : {0.0, 30.0, 90.0, 179.0, 180.0})
    EXPECT_NEAR(atC(profile, vertical, 77), 100, 1e-4);
}

TEST(Ies, ALambertianEmitterGivesPiCandela) {
  std::vector<double> verticals, candela;
  for (int i = 0; i <= 90; ++i) {
    verticals.push_back(i);
    candela.push_back(1000 * std::cos(glm::radians(double(i))));
  }
  const Profile profile = read(iesFile(1, verticals, {0}, candela));
  // Straight lines over a degree instead of the cosine: less than (pi / 180)^2 / 8 of it. Six digits in the
  // file.
  EXPECT_NEAR(profileFlux(profile), 1000 * kPi, 1000 * kPi * 5e-5);
  EXPECT_EQ(atC(profile, 91, 0), 0);
}

TEST(Ies, IsLinearBetweenAnglesAndDarkBeyondThem) {
  const Profile profile =
      read(iesFile(1, {0, 10, 40}, {0, 90, 180, 360}, {8, 4, 0, 8, 6, 3, 8, 8, 8, 8, 4, 0}));
  EXPECT_NEAR(atC(profile, 5, 0), 6, 1e-3);
  EXPECT_NEAR(atC(profile, 25, 0), 2, 1e-3);
  EXPECT_NEAR(atC(profile, 10, 45), 5, 1e-3);
  EXPECT_NEAR(atC(profile, 25, 45), 0.5 * (2 + 4.5), 1e-3);
  EXPECT_NEAR(atC(profile, 10, 270), 6, 1e-3);
  EXPECT_EQ(atC(profile, 41, 180), 0);
}

struct Symmetry {
  const char* name;
  std::vector<double> horizontals;
  double (*folded)(double horizontal);  // where the file has what goes to `horizontal`
};

class TypeCSymmetry : public testing::TestWithParam<Symmetry> {};

TEST_P(TypeCSymmetry, CompletesTheCircle) {
  const Symmetry& symmetry = GetParam();
  std::vector<double> candela;
  for (const double horizontal : symmetry.horizontals)
    for (int v = 0; v < 3; ++v) candela.push_back(100 + horizontal);
  const Profile profile = read(iesFile(1, {0, 90, 180}, symmetry.horizontals, candela));
  for (double horizontal = 2.5; horizontal < 360; horizontal += 5) {
    EXPECT_NEAR(atC(profile, 60, horizontal), 100 + symmetry.folded(horizontal), 2e-3) << horizontal;
  }
  const double flux = profileFlux(profile);
  // 100 + a linear angle, each part of the circle as often as the next: the mean is at its middle.
  const double middle = 0.5 * (symmetry.horizontals.front() + symmetry.horizontals.back());
  EXPECT_NEAR(flux, 4 * kPi * (100 + middle), 1e-6 * flux);
  EXPECT_NEAR(fluxByMidpoints(profile), flux, 1e-4 * flux);
}

INSTANTIATE_TEST_SUITE_P(
    Ies, TypeCSymmetry,
    testing::Values(Symmetry{"None", {0, 120, 240, 360}, [](double h) { return h; }},
                    Symmetry{"Quadrants",
                             {0, 45, 90},
                             [](double h) {
                               h = h > 180 ? 360 - h : h;
                               return h > 90 ? 180 - h : h;
                             }},
                    Symmetry{"Halves", {0, 90, 180}, [](double h) { return h > 180 ? 360 - h : h; }},
                    Symmetry{"HalvesAcross",
                             {90, 180, 270},
                             [](double h) { return h < 90    ? 180 - h
                                                   : h > 270 ? 540 - h
                                                             : h; }}),
    [](const auto& symmetry) { return std::string(symmetry.param.name); });

TEST(Ies, TheLastPlaneMayBeLeftOut) {
  const Profile profile = read(iesFile(1, {0, 180}, {0, 90, 180, 270}, {1, 1, 2, 2, 3, 3, 4, 4}));
  EXPECT_NEAR(atC(profile, 90, 315), 2.5, 1e-5);
  EXPECT_NEAR(atC(profile, 90, 359.999), 1, 1e-4);
}

// Latitude and longitude of types A and B, by what stands in LM-75 and EXT_lights_ies.
TEST(Ies, TypesAAndBTurnAroundTheirOwnAxes) {
  const std::vector<double> angles{-90, 0, 90};
  // Rows by horizontal angle: to the left 1, ahead 2 to 8 with the vertical angle, to the right 9.
  const std::vector<double> candela{1, 1, 1, 2, 4, 8, 9, 9, 9};
  const Profile a = read(iesFile(3, angles, angles, candela)), b = read(iesFile(2, angles, angles, candela));
  const auto at = [](const Profile& profile, vec3 local) {
    return profile.peak * profileFraction(profile, normalize(local));
  };
  for (const Profile* profile : {&a, &b}) {
    EXPECT_NEAR(at(*profile, {0, 0, 1}), 4, 1e-5);
    EXPECT_NEAR(at(*profile, {0, 1, 1}), 6, 1e-5);   // 45 up
    EXPECT_NEAR(at(*profile, {0, -1, 1}), 3, 1e-5);  // 45 down
    EXPECT_NEAR(at(*profile, {1, 0, 1}), 6.5, 1e-5);
    EXPECT_NEAR(at(*profile, {-1, 0, 1}), 2.5, 1e-5);
    EXPECT_EQ(at(*profile, {0.2f, 0.1f, -1}), 0);
  }
  // Toward (1, 1, 1) the latitude is asin(1 / sqrt 3) and the longitude 45.
  const double part = std::asin(1 / std::sqrt(3.0)) / (kPi / 2);
  EXPECT_NEAR(at(a, {1, 1, 1}), glm::mix(glm::mix(4.0, 8.0, part), 9.0, 0.5), 1e-5);
  EXPECT_NEAR(at(b, {1, 1, 1}), glm::mix(6.0, 9.0, part), 1e-5);
  for (const Profile* profile : {&a, &b})
    EXPECT_NEAR(fluxByMidpoints(*profile), profileFlux(*profile), 1e-3 * profileFlux(*profile));
}

TEST(Ies, TypesAAndBMirrorAxesThatBeginAtZero) {
  for (const int type : {2, 3}) {
    const Profile profile = read(iesFile(type, {0, 90}, {0, 45}, {7, 3, 5, 1}));
    for (const float x : {-0.3f, 0.3f})
      for (const float y : {-0.2f, 0.2f})
        EXPECT_NEAR(profileFraction(profile, normalize(vec3(x, y, 1))),
                    profileFraction(profile, normalize(vec3(0.3f, 0.2f, 1))), 1e-6);
    EXPECT_EQ(profileFraction(profile, normalize(vec3(3, 0.2f, 1))), 0) << "beyond 45 degrees";
    EXPECT_NEAR(fluxByMidpoints(profile), profileFlux(profile), 2e-3 * profileFlux(profile));
  }
}

TEST(Ies, FactorsMultiplyAsTheYearOfTheFileHasThem) {
  const auto peak = [](const std::string& header) {
    return read(iesFile(1, {0, 90}, {0}, {10, 5}, header, "0.9 0.5 50", 3)).peak;
  };
  for (const char* old : {"IESNA91", "IESNA:LM-63-1995", "Some lamp of 1986, without a format"})
    EXPECT_NEAR(peak(old), 10 * 3 * 0.9 * 0.5, 1e-5) << old;
  for (const char* recent : {"IESNA:LM-63-2002", "IESNA: LM-63-2002 ", "IES:LM-63-2019"})
    EXPECT_NEAR(peak(recent), 10 * 3 * 0.9, 1e-5) << recent;
}

TEST(Ies, NumbersFlowOverLinesWhateverSeparatesThem) {
  const std::string numbers = "1 -1 2 2 1 1 1 0 0 0 1 1 5 0 90 0 1e2 +5";
  const Profile plain = read("IESNA91\nTILT=NONE\n" + numbers);
  EXPECT_EQ(plain.peak, 200);
  std::string lines = numbers, commas = numbers;
  for (char& c : lines) c = c == ' ' ? '\n' : c;
  for (char& c : commas) c = c == ' ' ? ',' : c;
  for (const std::string& text :
       {"IESNA91\r\nTILT=NONE\r\n" + lines + "\r\n\x1a", "\xef\xbb\xbfIESNA91\nTILT=NONE\n" + commas,
        "IESNA91\rTILT=NONE\r" + numbers, "TILT = none\n" + numbers + "\n\n",
        "IESNA91\n[LUMINAIRE] TILT=INCLUDE here\nTILT=INCLUDE\n2 3\n0 90 180\n1 .5 1\n" + numbers}) {
    const Profile profile = read(text);
    EXPECT_EQ(profile.fractions, plain.fractions) << text;
    EXPECT_EQ(profile.peak, plain.peak);
  }
}

TEST(Ies, WrongFilesAreToldInOneLineWithItsNumber) {
  const std::string start = "IESNA91\nTILT=NONE\n";
  const struct {
    std::string text, says;
  } kWrong[] = {
      {"", "TILT"},
      {"IESNA91\n[TEST] x\n1 2 3\n", "lamp.ies:3"},
      {"IESNA91\nTILT=lamp.tlt\n1 1", "lamp.tlt"},
      {"IESNA91\nTILT=INCLUDE\n4 1 0 1\n", "geometry"},
      {"IESNA91\nTILT=INCLUDE\n1 2000000000\n0 1", "tilt angles"},
      {start, "number of lamps"},
      {start + "1 1000 x", "\"x\""},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1", "ends before the input watts"},
      {start + "1 1000 0 2 1 1 1 0 0 0 1 1 5 0 90 0 1 1", "multiplier is 0"},
      {start + "1 1000 1 2.5 1 1 1 0 0 0 1 1 5 0 90 0 1 1", "whole number"},
      {start + "1 1000 1 2000000000 1 1 1 0 0 0 1 1 5 0 90 0 1 1", "vertical angles"},
      {start + "1 1000 1 10 8 1 1 0 0 0 1 1 5 0 90 0 1 1", "more than the rest"},
      {start + "1 1000 1 1 1 1 1 0 0 0 1 1 5 0 0 1", "vertical angles is 1"},
      {start + "1 1000 1 2 1 4 1 0 0 0 1 1 5 0 90 0 1 1", "photometric type is 4"},
      {start + "1 1000 1 2 1 1 3 0 0 0 1 1 5 0 90 0 1 1", "units type is 3"},
      {start + "1 1000 1 2 1 1 1 0 0 0 0 1 5 0 90 0 1 1", "ballast factor is 0"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5\n90\n0\n0 1 1", "lamp.ies:5: the vertical angle 0 follows 90"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 200 0 1 1", "vertical angle is 200"},
      {start + "1 1000 1 2 2 1 1 0 0 0 1 1 5 0 90 0 100 1 1 1 1", "0 to 100"},
      {start + "1 1000 1 2 3 1 1 0 0 0 1 1 5 0 90 0 90 200 1 1 1 1 1 1", "0 to 200"},
      {start + "1 1000 1 2 2 2 1 0 0 0 1 1 5 0 90 10 90 1 1 1 1", "horizontal angles go from 10"},
      {start + "1 1000 1 2 1 3 1 0 0 0 1 1 5 0 90 0 1 1", "types A and B"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 90 0 1 -1", "candela value is -1"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 90 0 1 nan", "nan"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 90 0 1 1e400", "1e400"},
      {start + "1 1000 1e9 2 1 1 1 0 0 0 1 1 5 0 90 0 1 1e9", "1e+18"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 90 0 1", "ends before a candela value"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 90 0 1 1 1", "follows the 2 candela values"},
      {start + "1 1000 1 2 1 1 1 0 0 0 1 1 5 0 90 0 0 0", "brightest"},
  };
  for (const auto& [text, says] : kWrong) {
    const std::string error = inputErrorOf([&, &given = text] { read(given); });
    EXPECT_NE(error.find(says), std::string::npos) << text << "\ngave: " << error << "\nwithout: " << says;
    EXPECT_EQ(error.rfind("lamp.ies:", 0), 0u) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

// Whatever bytes a file holds, reading it ends in a profile or in an InputError.
TEST(Ies, MutatedFilesAreReadOrRefused) {
  const std::string good = "IESNA91\nTILT=INCLUDE\n1 2 0 90 1 1\n" +
                           iesFile(1, {0, 45, 90}, {0, 90}, {3, 2, 1, 3, 2, 0})
                               .substr(std::string("IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n").size());
  ASSERT_EQ(inputErrorOf([&] { read(good); }), "");
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (unsigned k = random() % 4 + 1; k > 0; --k) {
      const std::size_t at = random() % text.size();
      const char* kPieces[] = {"9", "-", " ", "\n", ".", "e9", "99999999999", "\r", ",", "x"};
      const std::string piece = kPieces[random() % std::size(kPieces)];
      if (random() % 2)
        text.insert(at, piece);
      else
        text.replace(at, random() % 6, piece);
    }
    if (random() % 8 == 0) text.resize(random() % text.size());
    try {
      const Profile profile = read(text);
      EXPECT_TRUE(std::isfinite(profileFlux(profile)));
      for (const vec3 local : {vec3(0, 0, 1), vec3(0, 1, 0), vec3(0.6f, 0, -0.8f)}) {
        const float fraction = profileFraction(profile, local);
        EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction << " of\n" << text;
      }
    } catch (const InputError&) {
    }
  }
}

TEST(Ies, ReadsFilesOfOthers) {
  const auto folder = sharedData() / "data" / "ies";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const struct {
    const char* file;
    std::size_t verticals, horizontals;
    float peak;
  } kFiles[] = {{"eulumdat-rs-ABSOLUTE_LED.ies", 19, 37, 3500},
                {"eulumdat-rs-TILT_TEST_SYNTHETIC.ies", 5, 1, 1000},
                {"lidrs-iesna2002_example_typec.ies", 5, 3, 100000},
                {"mdl-sdk-example_modules.ies", 16, 1, 10}};
  for (const auto& expected : kFiles) {
    const Profile profile = loadIes(folder / expected.file);
    EXPECT_EQ(profile.verticalAngles.size(), expected.verticals) << expected.file;
    EXPECT_EQ(profile.horizontalAngles.size(), expected.horizontals) << expected.file;
    EXPECT_EQ(profile.peak, expected.peak) << expected.file;
    EXPECT_NEAR(fluxByMidpoints(profile), profileFlux(profile), 1e-3 * profileFlux(profile)) << expected.file;
  }
}

}  // namespace
}  // namespace nephroid

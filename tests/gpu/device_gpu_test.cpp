#include "gpu/transfer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "optics/refraction.h"
#include "shaders/tests/gpu/affine_comp.h"
#include "shaders/tests/gpu/clash_frag.h"
#include "shaders/tests/gpu/refraction_comp.h"
#include "shaders/tests/gpu/sample_comp.h"
#include "shaders/tests/gpu/shared_frag.h"
#include "shaders/tests/gpu/shared_vert.h"
#include "shaders/tests/gpu/triangle_frag.h"
#include "shaders/tests/gpu/triangle_vert.h"
#include "shaders/tests/gpu/weigh_comp.h"
#include "support/gpu_fixture.h"

namespace nephroid {
namespace {

struct AffineConstants {
  uint64_t from, to;
  uint32_t count;
  float factor, offset;
};

gpu::Program affineProgram(gpu::Device& device) {
  return gpu::createComputeProgram(device, "affine", shaders::tests_gpu_affine_comp);
}

TEST_F(GpuTest, IsListedAndUsable) {
  const auto devices = gpu::listDevices();
  ASSERT_FALSE(devices.empty());
  EXPECT_EQ(devices[device().info().index].name, device().info().name);
  EXPECT_TRUE(device().info().missing.empty());
}

TEST_F(GpuTest, IsChosenByIndexOrPartOfItsName) {
  EXPECT_EQ(gpu::Device({"0", false}).info().index, 0u);
  std::string part = device().info().name.substr(1, 4);
  std::ranges::transform(part, part.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  EXPECT_NO_THROW(gpu::Device({part, false}));
  EXPECT_THROW(gpu::Device({"no such device", false}), InputError);
}

TEST_F(GpuTest, BuffersComeBackAsTheyWereSent) {
  std::vector<uint32_t> values(100'000);
  std::iota(values.begin(), values.end(), 7u);
  EXPECT_EQ(gpu::download<uint32_t>(device(), gpu::upload(device(), "numbers", values)), values);
}

TEST_F(GpuTest, MemoryOfWhatIsGoneIsUsedAgain) {
  const uint64_t before = device().memoryBytes();
  {
    const gpu::Buffer a = gpu::createBuffer(device(), "a", 1 << 20);
    gpu::Buffer b = gpu::createBuffer(device(), "b", 1 << 20);
    const gpu::Buffer c = gpu::createBuffer(device(), "c", 1 << 20);
    EXPECT_GE(device().memoryBytes(), before + (3u << 20));
    b = gpu::Buffer();
    const gpu::Buffer d = gpu::createBuffer(device(), "d", 1 << 19);
    EXPECT_NE(d.address(), a.address());
    EXPECT_NE(d.address(), c.address());
  }
  EXPECT_EQ(device().memoryBytes(), before);
}

TEST_F(GpuTest, TooMuchMemoryIsRefusedWithTheBytesAndTheName) {
  try {
    gpu::createImage(device(), "enormous plane", {.width = 1u << 30, .height = 1});
    FAIL() << "an image of 2^30 texels across was made";
  } catch (const RuntimeFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("enormous plane"), std::string::npos) << failure.what();
  }
  VkMemoryRequirements requirements{uint64_t{1} << 50, 16, ~0u};
  try {
    device().memory().allocate(requirements, gpu::MemoryKind::device, "enormous table");
    FAIL() << "2^50 bytes were allocated";
  } catch (const RuntimeFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("1125899906842624 bytes asked for \"enormous table\""),
              std::string::npos)
        << failure.what();
  }
}

// Each step reads what the one before wrote: without barriers the values, and synchronization validation, say
// so.
TEST_F(GpuTest, PassesSeeWhatPassesBeforeThemWrote) {
  constexpr uint32_t kCount = 10'000;
  const gpu::Program affine = affineProgram(device());
  const gpu::Buffer a = gpu::upload(device(), "a", std::vector<float>(kCount, 1.0f));
  const gpu::Buffer b = gpu::createBuffer(device(), "b", kCount * sizeof(float));
  const auto times = device().submitAndWait([&](gpu::CommandList& commands) {
    for (int i = 0; i < 5; ++i) {
      commands.pass("there", [&] {
        commands.dispatch(affine, {kCount, 1, 1}, AffineConstants{a.address(), b.address(), kCount, 2, 0});
      });
      commands.pass("back", [&] {
        commands.dispatch(affine, {kCount, 1, 1}, AffineConstants{b.address(), a.address(), kCount, 1, 1});
      });
    }
  });
  // x -> 2 x + 1, five times from 1.
  EXPECT_EQ(gpu::download<float>(device(), a), std::vector<float>(kCount, 63.0f));
  if (!times.empty()) {
    ASSERT_EQ(times.size(), 10u);
    EXPECT_EQ(times[0].name, "there");
    EXPECT_EQ(times[9].name, "back");
    for (const PassTime& time : times) EXPECT_GE(time.milliseconds, 0);
  }
}

// Also of passes that only compute, with nothing drawn between them.
TEST_F(GpuTest, PassesTakeTheTimeOfTheirOwnWork) {
  constexpr uint32_t kCount = 1 << 21;
  const gpu::Program affine = affineProgram(device());
  const gpu::Buffer a = gpu::upload(device(), "a", std::vector<float>(kCount, 1.0f));
  const gpu::Buffer b = gpu::createBuffer(device(), "b", kCount * sizeof(float));
  const auto pass = [&](gpu::CommandList& commands, uint32_t count) {
    commands.pass("affine", [&] {
      commands.dispatch(affine, {count, 1, 1}, AffineConstants{a.address(), b.address(), count, 2, 0});
    });
  };
  std::vector<PassTime> times;
  for (int run = 0; run < 2; ++run)  // of which the first may compile
    times = device().submitAndWait([&](gpu::CommandList& commands) {
      for (int i = 0; i < 5; ++i) pass(commands, 64);
      pass(commands, kCount);
      for (int i = 0; i < 5; ++i) pass(commands, 64);
    });
  if (times.empty()) GTEST_SKIP() << "the device has no timestamps";
  const double most = times[5].milliseconds;
  std::ranges::sort(times, {}, &PassTime::milliseconds);
  EXPECT_GT(most, 5 * times[5].milliseconds);  // the median
}

// What a mistake of the caller's is answered with.
std::string refusal(const std::function<void()>& mistake) {
  try {
    mistake();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "no std::logic_error";
}

TEST_F(GpuTest, ConstantsOfAnotherSizeAreRefused) {
  const gpu::Program affine = affineProgram(device());
  EXPECT_EQ(affine.reflection().pushConstantBytes, 28u);
  EXPECT_EQ(affine.reflection().localSize[0], 64u);
  device().submitAndWait([&](gpu::CommandList& commands) {
    EXPECT_EQ(refusal([&] {
                commands.dispatch(affine, {1, 1, 1}, 1.0f);
              }),
              "program affine takes 28 bytes of constants, not 4");
  });
}

TEST_F(GpuTest, ImagesThatDoNotFitTheProgramAreRefusedByName) {
  const gpu::Program affine = affineProgram(device());
  const gpu::Program sample = gpu::createComputeProgram(device(), "sample", shaders::tests_gpu_sample_comp);
  const gpu::Program weigh = gpu::createComputeProgram(device(), "weigh", shaders::tests_gpu_weigh_comp);
  const gpu::Image plain = gpu::createImage(device(), "plain", {.width = 4, .height = 4});
  const gpu::Image layered = gpu::createImage(device(), "layered", {.width = 4, .height = 4, .layers = 2});
  const gpu::Image depth =
      gpu::createImage(device(), "depth", {.format = VK_FORMAT_D32_SFLOAT, .width = 4, .height = 4});
  const gpu::Sampler sampler = gpu::createSampler(device());
  device().submitAndWait([&](gpu::CommandList& commands) {
    const auto refused = [&](const gpu::Program& program, gpu::Bindings bindings) {
      return refusal([&] { commands.dispatch(program, {1, 1, 1}, gpu::NoConstants{}, bindings); });
    };
    EXPECT_EQ(refusal([&] {
                commands.dispatch(affine, {1, 1, 1}, AffineConstants{}, {{"source", plain}});
              }),
              "program affine has no image \"source\"");
    EXPECT_EQ(refused(sample, {{"source", plain, sampler}}), "program sample is not given image \"target\"");
    EXPECT_EQ(refused(sample, {{"source", plain, sampler}, {"target", layered}, {"sauce", plain}}),
              "program sample has no image \"sauce\"");
    EXPECT_EQ(refused(sample, {{"source", plain, sampler}, {"target", layered}, {"target", layered}}),
              "program sample is given image \"target\" twice");
    EXPECT_EQ(refused(sample, {{"source", plain}, {"target", layered}}),
              "program sample given \"source\": a sampler is missing or too many");
    EXPECT_EQ(refused(sample, {{"source", plain, sampler}, {"target", plain}}),
              "program sample given image \"plain\" for \"target\": one has layers, the other not");
    EXPECT_EQ(refused(weigh, {{"sum", depth}, {"parts", {&plain, &plain}}}),
              "program weigh given image \"depth\" for \"sum\": its format cannot be used so here");
    EXPECT_EQ(refused(weigh, {{"sum", plain}, {"parts", plain}}),
              "program weigh takes 2 images as \"parts\", not 1");
  });
}

TEST_F(GpuTest, ImagesOfAnArrayAndConstantsAreKnownByTheirNames) {
  const gpu::Image first = gpu::createImage(device(), "first", {.width = 3});
  const gpu::Image second = gpu::createImage(device(), "second", {.width = 3});
  const gpu::Image sum = gpu::createImage(device(), "sum", {.width = 3});
  const gpu::Program weigh = gpu::createComputeProgram(device(), "weigh", shaders::tests_gpu_weigh_comp,
                                                       {{"kSecondWeight", 100}, {"kFirstWeight", 10}});
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("clear", [&] {
      commands.clear(first, vec4(1));
      commands.clear(second, vec4(2));
    });
    commands.pass("weigh", [&] {
      commands.dispatch(weigh, {3, 1, 1}, gpu::NoConstants{}, {{"parts", {&first, &second}}, {"sum", sum}});
    });
  });
  EXPECT_EQ(gpu::download<vec4>(device(), sum), std::vector<vec4>(3, vec4(210)));
}

gpu::Program sharedProgram(gpu::Device& device, std::span<const uint32_t> fragment,
                           const std::vector<gpu::SpecializationConstant>& constants) {
  return gpu::createRasterProgram(device, "shared", shaders::tests_gpu_shared_vert, fragment,
                                  {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT}}}, constants);
}

// The vertex and the fragment shader number neither images nor constants in the same way.
TEST_F(GpuTest, ANameIsOneImageAndOneConstantInAllStages) {
  const gpu::Image own = gpu::createImage(device(), "own", {});
  const gpu::Image shade = gpu::createImage(device(), "shade", {});
  const gpu::Image result = gpu::createImage(device(), "result", {.width = 2});
  const gpu::Program shared = sharedProgram(device(), shaders::tests_gpu_shared_frag, {{"kFactor", 2}});
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("clear", [&] {
      commands.clear(own, vec4(3));
      commands.clear(shade, vec4(4));
    });
    commands.pass("draw", [&] {
      commands.render({.colors = {{&result, 0, vec4(0)}}}, [&] {
        commands.draw(shared, 3, 1, gpu::NoConstants{}, {{"shade", shade}, {"own", own}});
      });
    });
  });
  EXPECT_EQ(gpu::download<vec4>(device(), result), std::vector<vec4>(2, vec4(2 * (4 + 300 + 40))));
}

TEST_F(GpuTest, NamesThatShadersDoNotShareAreRefused) {
  EXPECT_EQ(refusal([&] {
              sharedProgram(device(), shaders::tests_gpu_shared_frag, {{"kFacto", 2}});
            }),
            "program shared has no constant \"kFacto\"");
  EXPECT_EQ(refusal([&] { sharedProgram(device(), shaders::tests_gpu_clash_frag, {}); }),
            "program shared: its shaders declare \"shade\" as images of different kinds");
}

struct TriangleConstants {
  uint64_t corners;
  vec4 color;
};

TEST_F(GpuTest, ATriangleCoversTheTexelsWhoseCentersItHolds) {
  constexpr uint32_t kSize = 32;
  const gpu::Image color = gpu::createImage(device(), "color", {.width = kSize, .height = kSize});
  const gpu::Image depth =
      gpu::createImage(device(), "depth", {.format = VK_FORMAT_D32_SFLOAT, .width = kSize, .height = kSize});
  // Below the diagonal from the lower left to the upper right (y down), drawn twice: the farther one adds
  // nothing.
  const std::vector<vec3> corners{{-1, 1, 0.5f}, {1, 1, 0.5f}, {1, -1, 0.5f},
                                  {-1, 1, 0.7f}, {1, 1, 0.7f}, {1, -1, 0.7f}};
  const gpu::Buffer vertices = gpu::upload(device(), "corners", corners);
  const gpu::Program program = gpu::createRasterProgram(
      device(), "triangle", shaders::tests_gpu_triangle_vert, shaders::tests_gpu_triangle_frag,
      {.colors = {{color.format(), gpu::Blend::add}}, .depthFormat = depth.format()});
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("triangle", [&] {
      commands.render({.colors = {{&color, 0, vec4(0.25f)}}, .depth = gpu::DepthAttachment{&depth, 0, 1.0f}},
                      [&] {
                        commands.draw(program, 6, 1, TriangleConstants{vertices.address(), vec4(1, 2, 3, 4)});
                      });
    });
  });
  const auto texels = gpu::download<vec4>(device(), color);
  const auto depths = gpu::download<float>(device(), depth);
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      if (x + y == kSize - 1) continue;  // centers on the edge itself
      const bool inside = x + y >= kSize;
      EXPECT_EQ(texels[y * kSize + x], inside ? vec4(1.25f, 2.25f, 3.25f, 4.25f) : vec4(0.25f))
          << x << ", " << y;
      EXPECT_EQ(depths[y * kSize + x], inside ? 0.5f : 1.0f) << x << ", " << y;
    }
}

TEST_F(GpuTest, ImagesAreSampledAndStoredToByLayer) {
  const gpu::Image small = gpu::createImage(device(), "small", {.width = 2, .height = 1});
  const gpu::Image layered = gpu::createImage(device(), "layered", {.width = 9, .height = 3, .layers = 2});
  const std::vector<vec4> texels{vec4(1), vec4(3)};
  const auto bytes = std::as_bytes(std::span(texels));
  gpu::uploadImage(device(), small, {{bytes.begin(), bytes.end()}});
  const gpu::Sampler sampler = gpu::createSampler(device());
  const gpu::Program sample = gpu::createComputeProgram(device(), "sample", shaders::tests_gpu_sample_comp);
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("clear", [&] { commands.clear(layered, vec4(0)); });
    commands.pass("sample", [&] {
      commands.dispatch(sample, {9, 3, 1}, gpu::NoConstants{},
                        {{"source", small, sampler}, {"target", layered}});
    });
  });
  EXPECT_EQ(gpu::download<vec4>(device(), layered, 0), std::vector<vec4>(27, vec4(0)));
  const auto row = gpu::download<vec4>(device(), layered, 1);
  EXPECT_EQ(row[0].x, 1);
  EXPECT_NEAR(row[4].x, 2, 1e-2);  // filtering has 8 bits of weight at least
  EXPECT_EQ(row[26].x, 3);
}

struct RefractionConstants {
  uint64_t directions, results;
  uint32_t count;
  float eta;
};

TEST_F(GpuTest, RefractsAsTheHostDoes) {
  std::vector<vec3> directions;
  for (int i = 0; i < 512; ++i) {
    const float angle = 1.57f * static_cast<float>(i) / 512;
    directions.emplace_back(std::sin(angle), -std::cos(angle), 0);
  }
  const auto count = static_cast<uint32_t>(directions.size());
  const gpu::Program program =
      gpu::createComputeProgram(device(), "refraction", shaders::tests_gpu_refraction_comp);
  const gpu::Buffer from = gpu::upload(device(), "directions", directions);
  const gpu::Buffer to = gpu::createBuffer(device(), "results", count * sizeof(vec4));
  for (const float eta : {1 / 1.5f, 1.5f}) {
    device().submitAndWait([&](gpu::CommandList& commands) {
      commands.dispatch(program, {count, 1, 1},
                        RefractionConstants{from.address(), to.address(), count, eta});
    });
    const auto results = gpu::download<vec4>(device(), to);
    for (uint32_t i = 0; i < count; ++i) {
      vec3 transmitted;
      const bool passes = refractDirection(directions[i], vec3(0, 1, 0), eta, transmitted);
      const float sine = eta * directions[i].x;
      if (std::abs(sine - 1) < 1e-4f) continue;  // the critical angle itself may fall on either side
      EXPECT_LT(glm::distance(vec3(results[i]), transmitted), 1e-5f / std::sqrt(std::abs(1 - sine * sine)))
          << i;
      EXPECT_NEAR(results[i].w, passes ? fresnelReflectance(-directions[i].y, eta) : 1.0f,
                  1e-5f / std::sqrt(std::abs(1 - sine * sine)))
          << i;
    }
  }
}

TEST_F(GpuTest, ValidationSeesARaceBetweenTwoWrites) {
  const gpu::Buffer buffer = gpu::createBuffer(device(), "raced", 64);
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.fill(buffer, 1);
    commands.fill(buffer, 2);
  });
  EXPECT_FALSE(device().validationMessages().empty());
  device().clearValidationMessages();
}

}  // namespace
}  // namespace nephroid

#include "gpu/transfer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gpu_fixture.h"
#include "optics/refraction.h"
#include "shaders/gpu_test_affine_comp.h"
#include "shaders/gpu_test_refraction_comp.h"
#include "shaders/gpu_test_sample_comp.h"
#include "shaders/gpu_test_triangle_frag.h"
#include "shaders/gpu_test_triangle_vert.h"

namespace nephroid {
namespace {

struct AffineConstants {
  uint64_t from, to;
  uint32_t count;
  float factor, offset;
};

gpu::Program affineProgram(gpu::Device& device) {
  return gpu::createComputeProgram(device, "affine", shaders::gpu_test_affine_comp);
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

// Each step reads what the one before wrote: without barriers the values, and synchronisation validation, say
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

TEST_F(GpuTest, WrongConstantsOrImagesAreRefused) {
  const gpu::Program affine = affineProgram(device());
  EXPECT_EQ(affine.reflection().pushConstantBytes, 28u);
  EXPECT_EQ(affine.reflection().localSize[0], 64u);
  const gpu::Image image = gpu::createImage(device(), "image", {.width = 4, .height = 4});
  const gpu::Program sample = gpu::createComputeProgram(device(), "sample", shaders::gpu_test_sample_comp);
  device().submitAndWait([&](gpu::CommandList& commands) {
    EXPECT_THROW(commands.dispatch(affine, {1, 1, 1}, 1.0f), std::logic_error);
    EXPECT_THROW(commands.dispatch(affine, {1, 1, 1}, AffineConstants{}, {image}), std::logic_error);
    EXPECT_THROW(commands.dispatch(sample, {1, 1, 1}, gpu::NoConstants{}, {image, image}), std::logic_error);
  });
}

struct TriangleConstants {
  uint64_t corners;
  vec4 color;
};

TEST_F(GpuTest, ATriangleCoversTheTexelsWhoseCentresItHolds) {
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
      device(), "triangle", shaders::gpu_test_triangle_vert, shaders::gpu_test_triangle_frag,
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
      if (x + y == kSize - 1) continue;  // centres on the edge itself
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
  const gpu::Program sample = gpu::createComputeProgram(device(), "sample", shaders::gpu_test_sample_comp);
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("clear", [&] { commands.clear(layered, vec4(0)); });
    commands.pass("sample", [&] {
      commands.dispatch(sample, {9, 3, 1}, gpu::NoConstants{}, {{small, sampler}, layered});
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
      gpu::createComputeProgram(device(), "refraction", shaders::gpu_test_refraction_comp);
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

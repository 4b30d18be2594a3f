// What a frame leaves behind, for files and for looking into its passes.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string_view>

#include "gpu/transfer.h"
#include "render/frame.h"

namespace nephroid {
namespace {

void writeChannels(Image& layers, const std::string& prefix, std::string_view names,
                   const std::vector<vec4>& texels) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::vector<float>& values = layers.channel(prefix + names[c]);
    for (std::size_t i = 0; i < texels.size(); ++i) values[i] = texels[i][static_cast<int>(c)];
  }
}

}  // namespace

ByteImage Renderer::picture() const {
  return gpu::downloadPicture(device_, images_.picture);
}

void Renderer::tellSight(Stats& stats) const {
  if (!isByRays_ || casterRegion().size.x == 0) return;
  const RaySightCounts& counts = raySight_.counts();
  setCount(stats, "sight_pixels", counts.pixels);
  setCount(stats, "sight_traced_pixels", counts.traced);
  setCount(stats, "sight_rays", counts.rays);
  setCount(stats, "sight_points", counts.points);
  constexpr double kMillion = 1e6;
  setCount(stats, "sight_left_out_per_million", uint64_t(std::lround(kMillion * counts.leftOut)));
  setCount(stats, "sight_lost_per_million", uint64_t(std::lround(kMillion * counts.lost)));
}

ReceiverPoints Renderer::seenPoints() const {
  return {&images_.seen[kSeen].position, &images_.seen[kSeen].normal};
}

std::vector<PassOutput> Renderer::outputs() const {
  const float exposure = exposure_ / glm::pi<float>();  // of lux, as white paper shows them
  const SeenImages& seen = images_.seen[kSeen];
  std::vector<PassOutput> all;
  for (const gpu::Image* map : directLight_.shadowMaps())
    all.push_back({"shadow maps", "depths from a light", map, kShowDepth});
  for (const PassOutput& output : technique_.outputs()) all.push_back(output);
  all.insert(all.end(), {{"receivers", "albedo", &seen.albedo, kShowFactor},
                         {"receivers", "normals", &seen.normal, kShowDirection},
                         {"receivers", "positions", &seen.position, kShowPlace},
                         {"receivers", "depth", &images_.depth, kShowNearness}});
  if (casterRegion().size.x > 0) all.push_back({"casters", "normals", &images_.casterNormal, kShowDirection});
  if (sight_.region().size.x > 0)
    all.push_back({"seen through casters", "transmittance", &seen.transmittance, kShowFactor});
  if (sight_.reflects())
    all.insert(all.end(),
               {{"reflected by casters", "albedo", &images_.seen[kSeenReflected].albedo, kShowFactor},
                {"reflected by casters", "normals", &images_.seen[kSeenReflected].normal, kShowDirection}});
  all.insert(all.end(), {{"direct light", "lux", &seen.directLux, kShowLight, exposure},
                         {"caustics", "lux", &seen.causticsLux, kShowLight, exposure}});
  if (hasTurbidWater_)
    all.push_back({"light in water", "luminance", &images_.scattered, kShowLight, exposure_});
  if (shafts_) all.push_back({"shafts", "luminance", &shafts_.image(), kShowLight, exposure_});
  all.push_back({"composite", "picture", &images_.picture, kShowPicture});
  return all;
}

Image Renderer::layers() {
  // The one sample of `render`, which is not summed.
  const bool isOne = sums_.count() == 0;
  if (isOne) addLayers();
  Image layers;
  layers.width = settings_.size.x;
  layers.height = settings_.size.y;
  sums_.read(layers);
  if (isOne) sums_.begin();

  auto normals = gpu::download<vec4>(device_, images_.seen[kSeen].normal);
  const auto casterNormals = gpu::download<vec4>(device_, images_.casterNormal);
  const gpu::Region& region = casterRegion();
  const uvec2 first(region.corner);
  for (uint32_t y = first.y; y < first.y + region.size.y; ++y)
    for (uint32_t x = first.x; x < first.x + region.size.x; ++x) {
      const std::size_t i = std::size_t{y} * settings_.size.x + x;
      if (casterNormals[i].a != 0) normals[i] = casterNormals[i];
    }
  std::vector<vec4> depths;
  for (const float depth : gpu::download<float>(device_, images_.depth))
    depths.emplace_back(depth > 0 ? view_.nearest / depth : 0.0f);
  writeChannels(layers, "depth.", "Z", depths);
  writeChannels(layers, "normal.", "XYZ", normals);
  return layers;
}

}  // namespace nephroid

// Draws frames: from a scene to luminance and a picture.
#pragma once

#include "core/image.h"
#include "core/stats.h"
#include "render/air/shafts.h"
#include "render/direct_light.h"
#include "render/frame_data.h"
#include "render/frame_resources.h"
#include "render/last_scene.h"
#include "render/metering.h"
#include "render/samples/sample_sums.h"
#include "render/settings.h"
#include "render/shadows/lamp_shadows.h"
#include "render/sight/rays/ray_sight.h"
#include "render/sight/sight_pass.h"
#include "render/sight/ways_in_water.h"
#include "render/sky/sky_pass.h"
#include "render/view.h"
#include "techniques/technique.h"
#include "transport/scene_transport.h"

namespace nephroid {

// An object as it is drawn.
struct Surface {
  bool isReceiver = false;
  bool isTextured = false;
  SurfaceConstants constants{};
};

class Renderer {
 public:
  // Device, transport and technique must outlive it, and the technique was made with this transport. Objects,
  // meshes and textures are taken from the transport's scene, everything that moves from the scene of each
  // `render`.
  Renderer(gpu::Device& device, SceneTransport& transport, const RenderSettings& settings,
           Technique& technique);

  // Sets another size (pixels) for the following pictures.
  void resize(uvec2 size);
  uvec2 size() const { return settings_.size; }

  // Draws a whole frame, with as many samples of each pixel as the settings say. The surfaces that the camera
  // sees are kept from the last frame where the camera and all objects have not moved. Returns the times of
  // the passes, on the host and on the device, in the order in which they ran. Where it throws, as where
  // the technique's work is canceled, the picture stays as it was and the next frame is made anew.
  std::vector<PassTime> render(const Scene& scene);

  // Draws one more of `samples` samples of the last frame, and the picture and the layers of those that were
  // gathered so far. The first call after `render` begins anew; so does one for another number of samples.
  std::vector<PassTime> gather(uint32_t samples);
  // What multiplied the luminance of the last frame's picture: the camera's exposure, or where it has none
  // the one that was metered, on one sample in the middle of each pixel, however many are drawn.
  float exposure() const { return exposure_; }
  ToneMapping toneMapping() const { return toneMappingOf(exposure_, tone_); }  // with the camera's curve
  uint32_t gathered() const { return sums_.count(); }  // samples in the picture; 0: the one of `render`

  // The picture of the last frame, of the mean of its samples: exposed, tone-mapped, sRGB, 3 components.
  ByteImage picture() const;

  // The layers of the last frame: R,G,B, the luminance (nit); direct.R,G,B and caustics.R,G,B, the parts of
  // it by light that met no caster, and that met one; shafts.R,G,B, the part from the air and from water;
  // depth.Z (m along the view, 0 where there is nothing) and normal.X,Y,Z of the nearest surface. Luminance
  // is the mean of the samples; depth and normal are those of the last one, the nearest to the pixel's
  // middle.
  Image layers();

  // Adds the counts of the view through casters by rays, of the last frame that made it anew.
  void tellSight(Stats& stats) const;

  // The images of the last frame.
  const FrameImages& images() const { return images_; }

  // Of the last frame: the points that the camera sees, the outputs of the passes, and the slices for the
  // view through casters.
  ReceiverPoints seenPoints() const;
  std::vector<PassOutput> outputs() const;
  std::vector<Lattice> slices() const { return sight_.lattices(); }

  GpuScene& gpuScene() { return gpuScene_; }
  const Shafts& shafts() const { return shafts_; }

 private:
  std::vector<PassTime> draw(const Scene& scene);
  void place(const Scene& scene);
  void look(vec2 at, float spacing);
  void drawSample(vec2 at, float spacing, Remade remade, std::vector<PassTime>& passes);
  void addSample(const Remade& remade, std::vector<PassTime>& passes);
  void drawMean(std::vector<PassTime>& passes);
  void meter(std::vector<PassTime>& passes);
  void drawFrame(const Remade& remade, std::vector<PassTime>& passes);
  void drawReceivers(gpu::CommandList& commands);
  void illuminate(gpu::CommandList& commands);
  // What is lit, by its place in LampShadows, with the images that its light goes to.
  struct LitView {
    uint32_t view = 0;
    ReceiverPoints points;
    const gpu::Image *directLux, *causticsLux;
  };
  std::vector<LitView> litViews() const;
  void lookAtLamps();
  // The region of the picture that holds all casters.
  const gpu::Region& casterRegion() const { return isByRays_ ? raySight_.region() : sight_.region(); }
  void composite(gpu::CommandList& commands, const std::map<CasterTraits, gpu::Program>& programs,
                 const std::vector<const gpu::Image*>& targets, const std::optional<vec4>& clear);
  std::vector<PassTime> addLayers();
  void setTone(ToneCurve tone);
  void ensureImages();

  gpu::Device& device_;
  SceneTransport& transport_;
  Technique& technique_;
  RenderSettings settings_;
  bool hasTurbidWater_ = false;  // water that absorbs or scatters
  GpuScene gpuScene_;
  bool isByRays_ = false;  // the view through casters; otherwise by slices
  LuminanceTraits luminance_;
  ToneCurve tone_ = ToneCurve::neutral;  // of the programs
  FramePrograms programs_;
  FrameImages images_;
  SightPass sight_;
  RaySight raySight_;
  WaysInWater waysInWater_;
  LampShadows lampShadows_;
  SkyPass sky_;
  DirectLight directLight_;
  Shafts shafts_;
  SampleSums sums_;

  LastScene lastScene_;
  std::vector<vec2> places_;           // of the samples that are being drawn
  SampleOfMany sample_;                // that is being drawn
  std::optional<vec2> seenAt_;         // the place in each pixel that the images of surfaces are of
  bool arePlanesInAirChosen_ = false;  // for this frame
  bool hasOtherSky_ = false;           // than the frame before

  // Of the frame being made.
  View middleView_{}, view_{};     // of the pixels' middles, and of the sample
  std::vector<Surface> surfaces_;  // of the objects
  Environment environment_;
  float exposure_ = 1;
  std::vector<MeshExtent> extents_;  // of the meshes
};

}  // namespace nephroid

#include "techniques/technique.h"

namespace nephroid {

void drawCaustics(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& causticsLux,
                  const std::function<void()>& draw) {
  commands.pass("caustics", [&] {
    commands.render({.colors = {{&causticsLux, 0, std::nullopt}}, .region = points.region}, draw);
  });
}

}  // namespace nephroid

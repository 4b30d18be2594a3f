#include <core/image_io.h>
#include <optics/refraction.h>

int main() {
  nephroid::Image image{1, 1, {}};
  image.channel("reflectance")[0] = nephroid::fresnelReflectance(1, 1 / 1.5f);
  nephroid::writeExr("consumer.exr", image);
  return nephroid::readExr("consumer.exr").channels.size() == 1 ? 0 : 1;
}

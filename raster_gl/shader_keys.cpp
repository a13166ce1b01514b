#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// On the device, so that what comes back lies as the caller's image does.
constexpr const char* kSplitKeys = R"(
layout(std430, binding = DEPTHS) readonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = WINNERS) writeonly buffer Planes { uint planes[]; };

void main() {
  uint pixel = invocation();
  if (pixel >= count) return;
  planes[pixel] = keys[pixel].x;
  planes[count + pixel] = keys[pixel].y;
}
)";

}  // namespace

std::string split_keys() {
  return kernel_beginning({}, kPointGroup) + kSplitKeys;
}

}  // namespace rangezip::shader_text

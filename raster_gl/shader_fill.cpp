#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kFill = R"(
layout(std430, binding = DEPTHS) writeonly buffer Filled { uvec4 filled[]; };
uniform uint value;

void main() {
  uint i = invocation();
  if (i < count) filled[i] = uvec4(value);
}
)";

}  // namespace

std::string fill() {
  return kernel_beginning({}, kPointGroup) + kFill;
}

}  // namespace rangezip::shader_text

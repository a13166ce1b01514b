#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/speed/measure.h"

namespace rangezip::benchmark {

/// The limit of a device: bytes that it copies from one of its buffers to another, each counted
/// once, though it is read and written; by the driver (glCopyNamedBufferSubData) and by a kernel:
/// which of them is faster depends on the driver (NVIDIA's own: a twentieth of the kernel's rate).
/// @param context a name of make_gl_context()
/// @param bytes of a buffer; a run copies it several times
/// @throws BackendError if the context does not start, or has no memory for two such buffers
[[nodiscard]] std::vector<Case> device_copy_cases(const std::string& context, std::size_t bytes,
                                                  bool is_by_wall);

}  // namespace rangezip::benchmark

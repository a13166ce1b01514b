#pragma once

#include <cstddef>
#include <string>

#include "benchmarks/speed/measure.h"

namespace rangezip::benchmark {

/// The limit of a device: bytes that it copies from one of its buffers to another
/// (glCopyNamedBufferSubData), each counted once, though it is read and written.
/// @param context a name of make_gl_context()
/// @param bytes of a buffer; a run copies it several times
/// @throws BackendError if the context does not start, or has no memory for two such buffers
[[nodiscard]] Case device_copy_case(const std::string& context, std::size_t bytes, bool is_by_wall);

}  // namespace rangezip::benchmark

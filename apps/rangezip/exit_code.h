#pragma once

#include "core/base/error.h"

namespace rangezip::app {

/// What the program returns to the shell (docs/command-line.md).
enum class ExitCode : int {
  ok = 0,
  usage = 1,         ///< an option or argument is wrong
  bad_input = 2,     ///< an input is missing or not what it claims to be
  bad_output = 3,    ///< an output cannot be written
  backend = 4,       ///< the rasterizer is unknown, cannot start, or failed
  not_verified = 5,  ///< a mesh is not manifold, or crosses itself
  internal = 6,      ///< anything else, such as memory that ran out
  cancelled = 130,   ///< Ctrl-C, or asked to end
};

/// An option that parses but cannot be carried out.
class UsageError : public Error {
  using Error::Error;
};

/// An output that cannot be written; IoError stands for inputs.
class OutputError : public Error {
  using Error::Error;
};

/// The mesh was written, but is not what the program promises.
class NotVerified : public Error {
  using Error::Error;
};

}  // namespace rangezip::app

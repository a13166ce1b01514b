#pragma once

#include "core/base/error.h"

namespace rangezip::compare {

/// A file that cannot be written; IoError stands for inputs.
class OutputError : public Error {
  using Error::Error;
};

}  // namespace rangezip::compare

#pragma once

#include <stdexcept>

namespace rangezip {

/// Base of every exception the library throws on purpose.
/// An application catches this one type at its top level.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An argument breaks a documented precondition.
/// The text names the function, the argument, the rule and the value:
/// "median_filter: radius must be at least 1, got 0".
class InvalidArgument : public Error {
  using Error::Error;
};

/// A file is missing, unreadable, unwritable, or not what it claims to be.
/// The text names the file, the place in it (line or byte) and the rule.
class IoError : public Error {
  using Error::Error;
};

/// A rasterizer cannot be made, or its device failed while drawing.
class BackendError : public Error {
  using Error::Error;
};

/// A mesh is not what an operation needs (oriented, manifold, finite).
class TopologyError : public Error {
  using Error::Error;
};

/// The caller's stop token asked for the end of a long operation. No output was changed.
class Cancelled : public Error {
  using Error::Error;
};

}  // namespace rangezip

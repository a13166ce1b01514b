#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/session/command.h"

/// Random sessions as a user, or a planner gone mad, might run them.
namespace rangezip::sessions {

/// A model made by code and what is done with it. Same seed and number: the same session.
struct RandomSession {
  std::string model;
  Scene scene;
  double pixel_size = 0.0;  ///< model units, of the coarsest scans
  std::vector<Command> commands;
};

/// Three to seven commands: scans from anywhere, parallel or in perspective, of all or of a lasso,
/// at one to four times the resolution, with and without each pass, by both ways of stitching; the
/// same scan twice; erasing. Models are bodies, sheets, pairs of close sheets, clouds with noise
/// up to 0.3 % of the diagonal, and polygons.
[[nodiscard]] RandomSession make_session(std::uint64_t seed, std::uint64_t number);

}  // namespace rangezip::sessions

#pragma once

#include <functional>
#include <string>

#include "benchmarks/speed/measure.h"
#include "benchmarks/speed/raster_scenes.h"

namespace rangezip::benchmark {

/// Side of the image in pixels where nothing else is said.
inline constexpr int kSize = 1024;

/// The first of cpu_instructions().
[[nodiscard]] std::string widest_instructions();

/// Draws `item` by the CPU rasterizer, into memory that stays from call to call. What the item
/// refers to must outlive the result; so it is with all cases here.
[[nodiscard]] std::function<void()> rendering(const std::string& instructions, const View& view,
                                              const DrawItem& item);

struct PointsSetup {
  std::string instructions = widest_instructions();
  int size = kSize;
  int point_size = 1;
  bool is_central = false;
};
[[nodiscard]] Case points_case(const Cloud& cloud, const PointsSetup& setup);

/// A field with what it was made from.
struct FieldSetup {
  double pixels = 0.0;
  int size = kSize;
  Field field;
};
[[nodiscard]] FieldSetup make_field_setup(double pixels, int size);
[[nodiscard]] Case triangles_case(const FieldSetup& setup, const std::string& instructions);

[[nodiscard]] Case accumulate_case(const Cloud& cloud, const std::string& instructions);

}  // namespace rangezip::benchmark

#include "core/raster/row_transform.h"

#include <bit>
#include <cmath>

#include "core/raster/framebuffer.h"

namespace rangezip {

namespace {

constexpr double kSubpixels = 256.0;
constexpr double kDepthUnits = 1U << kDepthBits;

Row rounded_row(const Mat4& m, int row, double scale) {
  Row rounded{};
  for (int column = 0; column < 4; ++column) {
    rounded[static_cast<std::size_t>(column)] = static_cast<float>(m[column][row] * scale);
  }
  return rounded;
}

/// The coefficients of plane.value(world_from_item * p).
Row clip_row(const Plane& plane, const Mat4& world_from_item) {
  Row row{};
  for (int column = 0; column < 4; ++column) {
    double value = glm::dot(plane.normal, Vec3(world_from_item[column]));
    if (column == 3) value += plane.offset;
    row[static_cast<std::size_t>(column)] = static_cast<float>(value);
  }
  return row;
}

/// The nearest integer, ties to even. @pre |value| < 2^31
std::int32_t round_half_even(double value) {
  // In [2^52, 2^53) the doubles are the integers, so the addition itself rounds, in the default
  // rounding mode to even; the low bits of the sum are the integer in two's complement.
  constexpr double kOneAndAHalfTimes2To52 = 0x1.8p52;
  const auto bits = std::bit_cast<std::uint64_t>(value + kOneAndAHalfTimes2To52);
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
}

/// floor(numerator / w + 1/2) of the exact quotient (R4). @pre w > 0, |numerator| <= 2^25 w
std::int32_t round_quotient(double numerator, double w) {
  std::int32_t q = round_half_even(numerator / w);
  // Both products have at most 27 + 24 bits: exact.
  if (2.0 * numerator < (2.0 * q - 1.0) * w) {
    --q;
  } else if (2.0 * numerator >= (2.0 * q + 1.0) * w) {
    ++q;
  }
  return q;
}

SnappedPosition snap_parallel(const RowTransform& rows, const Vec3f& position) {
  const float x = row_product(rows.x, position);
  const float y = row_product(rows.y, position);
  const float z = row_product(rows.z, position);
  constexpr auto kMaxXY = static_cast<float>(kGuardXY);
  constexpr auto kMaxZ = static_cast<float>(kGuardZ);
  // Written so that NaN is rejected.
  if (!(std::abs(x) <= kMaxXY && std::abs(y) <= kMaxXY && std::abs(z) <= kMaxZ)) return kRejected;
  return {round_half_even(x), round_half_even(y), round_half_even(z)};
}

SnappedPosition snap_central(const RowTransform& rows, const Vec3f& position) {
  const double x = row_product(rows.x, position);
  const double y = row_product(rows.y, position);
  const double z = row_product(rows.z, position);
  const double w = row_product(rows.w, position);
  if (!(w >= 0x1p-64 && w <= 0x1p64)) return kRejected;
  const double max_xy = kGuardXY * w;
  const double max_z = kGuardZ * w;
  if (!(std::abs(x) <= max_xy && std::abs(y) <= max_xy && std::abs(z) <= max_z)) return kRejected;
  return {round_quotient(x, w), round_quotient(y, w), round_quotient(z, w)};
}

}  // namespace

RowTransform make_row_transform(const View& view, const Mat4& world_from_item) {
  const Mat4 window_from_item = view.homogeneous_window_from_world() * world_from_item;
  RowTransform rows;
  rows.x = rounded_row(window_from_item, 0, kSubpixels);
  rows.y = rounded_row(window_from_item, 1, kSubpixels);
  rows.z = rounded_row(window_from_item, 2, kDepthUnits);
  rows.w = rounded_row(window_from_item, 3, 1.0);
  rows.is_central = view.is_perspective();
  rows.clip.reserve(view.camera().clip_planes.size());
  for (const Plane& plane : view.camera().clip_planes) {
    rows.clip.push_back(clip_row(plane, world_from_item));
  }
  return rows;
}

float row_product(const Row& row, const Vec3f& position) {
  return ((row[0] * position.x + row[1] * position.y) + row[2] * position.z) + row[3];
}

std::size_t snap_positions(const RowTransform& rows, std::span<const Vec3f> positions,
                           std::span<SnappedPosition> snapped) {
  std::size_t rejected = 0;
  if (rows.is_central) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      snapped[i] = snap_central(rows, positions[i]);
      rejected += is_rejected(snapped[i]) ? 1 : 0;
    }
  } else {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      snapped[i] = snap_parallel(rows, positions[i]);
      rejected += is_rejected(snapped[i]) ? 1 : 0;
    }
  }
  return rejected;
}

void reject_clipped(const RowTransform& rows, std::span<const Vec3f> positions,
                    std::span<SnappedPosition> snapped) {
  for (const Row& plane : rows.clip) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!(row_product(plane, positions[i]) >= 0.0F)) snapped[i] = kRejected;
    }
  }
}

}  // namespace rangezip

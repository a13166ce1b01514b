#include "core/io/conf_file.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/io/raw_geometry.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

constexpr double kLengthTolerance = 1e-3;  ///< of a quaternion; files print six digits of each part

/// The rotation of a unit quaternion.
Mat3 rotation_of(const Vec3& q, double w) {
  Mat3 rotation;
  rotation[0] = {1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + w * q.z),
                 2.0 * (q.x * q.z - w * q.y)};
  rotation[1] = {2.0 * (q.x * q.y - w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
                 2.0 * (q.y * q.z + w * q.x)};
  rotation[2] = {2.0 * (q.x * q.z + w * q.y), 2.0 * (q.y * q.z - w * q.x),
                 1.0 - 2.0 * (q.x * q.x + q.y * q.y)};
  return rotation;
}

PlacedScan read_scan(const FileBytes& file, TextFields& fields, const char* place) {
  const std::string name(fields.word());
  std::array<double, 7> values{};
  for (double& value : values) {
    if (!fields.number(value) || !std::isfinite(value)) {
      file.fail_at_line(place, "a scan is 'bmesh FILE tx ty tz qx qy qz qw' with seven numbers");
    }
  }
  if (!fields.at_end()) file.fail_at_line(place, "more than seven numbers follow the file name");
  const auto& [tx, ty, tz, qx, qy, qz, qw] = values;
  const double length = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
  if (std::abs(length - 1.0) > kLengthTolerance) {
    file.fail_at_line(place, "the quaternion has length " + std::to_string(length) + ", not 1");
  }
  if (!is_usable({tx, ty, tz})) {
    file.fail_at_line(
        place, "a scan may be moved by 1e30 along an axis, no farther, as no coordinate is larger");
  }
  PlacedScan scan;
  scan.path = std::filesystem::path(file.name()).parent_path() / name;
  scan.world_from_scan = Mat4(glm::transpose(rotation_of(Vec3{qx, qy, qz} / length, qw / length)));
  scan.world_from_scan[3] = Vec4{tx, ty, tz, 1.0};
  std::error_code error;
  if (!std::filesystem::exists(scan.path, error)) {
    file.fail_at_line(place, "the scan " + scan.path.string() + " is missing");
  }
  return scan;
}

}  // namespace

std::vector<PlacedScan> read_conf(const FileBytes& file) {
  std::vector<PlacedScan> scans;
  TextLines lines(file.bytes());
  std::string_view line;
  while (lines.next(line)) {
    TextFields fields(line.substr(0, line.find('#')));
    const char* const place = fields.position();
    const std::string_view keyword = fields.word();
    if (keyword == "bmesh") {
      scans.push_back(read_scan(file, fields, place));
    } else if (!keyword.empty() && keyword != "camera" && keyword != "mesh") {
      file.fail_at_line(place,
                        "a line begins with bmesh, camera or mesh, not with " + quote(keyword));
    }
  }
  if (scans.empty())
    file.fail_at_line(file.bytes().data(), "no line of the file is a 'bmesh' scan");
  return scans;
}

}  // namespace rangezip

#include "core/io/input_file.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "core/io/conf_file.h"
#include "core/io/raw_geometry.h"
#include "core/io/read_opened.h"
#include "core/io/repeated_points.h"

namespace rangezip {

namespace {

Mat4 translation(const Vec3& offset) {
  Mat4 matrix{1.0};
  matrix[3] = Vec4(offset, 1.0);
  return matrix;
}

/// Reads about the origin that the reader foresees and, if the data turn out to have another one,
/// once more about that: most files are read once, and never are more than the floats in memory.
RawGeometry read_about_best_origin(const FileBytes& file, const Progress& progress) {
  constexpr auto kPrecision = PositionList::Precision::local_float;
  Vec3 origin{0.0};
  {
    RawGeometry geometry = read_geometry(file, kPrecision, std::nullopt, progress);
    origin = geometry.positions.best_origin();
    if (origin == geometry.positions.origin()) return geometry;
  }
  return read_geometry(file, kPrecision, origin, progress);
}

/// Drops the positions that are not finite; indices of the others move down.
void compact(std::vector<Vec3f>& positions, std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> new_index(positions.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    new_index[i] = next;
    if (!std::isfinite(positions[i].x)) continue;
    positions[next++] = positions[i];
  }
  positions.resize(next);
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& corner : triangle)
      corner = new_index[corner];
  }
}

PointCloud points_of(RawGeometry& geometry) {
  PointCloud cloud;
  if (geometry.polygons == 0) {
    cloud.positions = geometry.positions.take_local();
    if (geometry.positions.nonfinite() != 0) {
      std::erase_if(cloud.positions, [](const Vec3f& p) { return !std::isfinite(p.x); });
    }
    return cloud;
  }
  for (const std::uint32_t index : geometry.point_elements) {
    if (geometry.positions.is_finite(index)) {
      cloud.positions.emplace_back(geometry.positions[index]);
    }
  }
  return cloud;
}

void note_unused(const RawGeometry& geometry, std::vector<std::string>& notes) {
  std::vector<bool> is_used(geometry.positions.size(), false);
  for (const std::uint32_t corner : geometry.corners)
    is_used[corner] = true;
  for (const std::uint32_t index : geometry.point_elements)
    is_used[index] = true;
  const auto unused = std::count(is_used.begin(), is_used.end(), false);
  if (unused != 0) notes.push_back(std::to_string(unused) + " vertices in no polygon are left out");
}

std::string reason_for_nothing(const InputReport& report) {
  if (report.polygons != 0) {
    return "none of its " + std::to_string(report.polygons) +
           " polygons has three distinct finite corners";
  }
  if (report.nonfinite_points != 0) {
    return "none of its " + std::to_string(report.nonfinite_points) + " points is finite";
  }
  return "there is no point and no polygon in it";
}

InputFile read_one(const FileBytes& file, const Mat4& world_from_file, const Progress& progress) {
  RawGeometry geometry = read_about_best_origin(file, progress);
  InputReport report{.path = file.name(),
                     .format = geometry.format,
                     .polygons = geometry.polygons,
                     .nonfinite_points = geometry.positions.nonfinite(),
                     .bounds = geometry.positions.bounds(),
                     .origin = geometry.positions.origin(),
                     .notes = std::move(geometry.notes)};
  InputFile input;
  const Mat4 world_from_item = world_from_file * translation(geometry.positions.origin());
  if (geometry.polygons != 0) note_unused(geometry, report.notes);
  SplitPolygons split = split_polygons(geometry, progress);
  report.nonfinite_polygons = split.nonfinite;
  report.degenerate_polygons = split.degenerate;
  report.triangles = split.triangles.size();
  PointCloud cloud = points_of(geometry);
  report.repeated_points = drop_repeated_points(cloud.positions);
  report.points = cloud.positions.size();
  if (!cloud.positions.empty()) {
    input.items.push_back({.cloud = std::make_shared<const PointCloud>(std::move(cloud)),
                           .world_from_item = world_from_item});
  }
  if (!split.triangles.empty()) {
    TriangleSoup soup{.positions = geometry.positions.take_local(),
                      .triangles = std::move(split.triangles)};
    if (report.nonfinite_points != 0) compact(soup.positions, soup.triangles);
    input.items.push_back({.soup = std::make_shared<const TriangleSoup>(std::move(soup)),
                           .world_from_item = world_from_item});
  }
  if (input.items.empty()) file.fail("whole file: " + reason_for_nothing(report));
  input.reports.push_back(std::move(report));
  return input;
}

}  // namespace

bool is_list_of_scans(const std::filesystem::path& path) {
  return file_type(path) == kListOfScans;
}

InputFile read_opened_input(const FileBytes& file, const Progress& progress) {
  return read_one(file, Mat4{1.0}, progress);
}

InputFile read_input(const std::filesystem::path& path, const Progress& progress) {
  if (!is_list_of_scans(path)) {
    check_geometry_type(path, kListOfScans);
    return read_opened_input(FileBytes(path, FileBytes::Packing::unpack, progress), progress);
  }
  const FileBytes file(path, FileBytes::Packing::unpack, progress);
  InputFile all;
  for (const PlacedScan& scan : read_conf(file)) {
    progress.check_stop();
    if (is_list_of_scans(scan.path)) file.fail("a list of scans must not name another list");
    check_geometry_type(scan.path);
    InputFile one = read_one(FileBytes(scan.path, FileBytes::Packing::unpack, progress),
                             scan.world_from_scan, progress);
    std::move(one.items.begin(), one.items.end(), std::back_inserter(all.items));
    std::move(one.reports.begin(), one.reports.end(), std::back_inserter(all.reports));
  }
  return all;
}

}  // namespace rangezip

#include "apps/rangezip-compare/drawing_report.h"

#include <array>
#include <sstream>
#include <string_view>
#include <variant>

namespace rangezip::compare {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, kDifferences> kDifferenceNames{"coverage", "id", "depth"};
constexpr std::array<std::string_view, kCauses> kCauseNames{"edge", "depth_tie", "depth_rounding",
                                                            "depth_plane", "unexplained"};

std::string name_of(Difference difference) {
  return std::string(kDifferenceNames[static_cast<std::size_t>(difference)]);
}

std::string name_of(Cause cause) {
  return std::string(kCauseNames[static_cast<std::size_t>(cause)]);
}

/// "3 coverage, 1 id", without what there is none of.
template <class Of, std::size_t N>
std::string list_of(const DrawingCounts& counts, const std::array<std::string_view, N>& names) {
  std::string text;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t count = counts.of(static_cast<Of>(i));
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(names[i]);
  }
  return text;
}

/// "1: 30, 2-3: 4", the sizes of steps with their pixels.
std::string steps_text(const DrawingCounts& counts) {
  std::string text;
  for (std::size_t k = 0; k < counts.depth_steps.size(); ++k) {
    if (counts.depth_steps[k] == 0) continue;
    const std::size_t first = std::size_t{1} << k;
    text += (text.empty() ? "" : ", ") + std::to_string(first);
    if (k > 0) text += "-" + std::to_string(2 * first - 1);
    text += ": " + std::to_string(counts.depth_steps[k]);
  }
  return text;
}

std::string covering_text(const PixelFit& fit) {
  if (!fit.may_cover) return "does not cover it";
  return std::string(fit.must_cover ? "covers it" : "has an edge here") + ", depth " +
         std::to_string(fit.nearest) + ".." + std::to_string(fit.farthest);
}

void print_corner(std::ostream& out, const SnappedPosition& p) {
  out << " (" << p.x << ", " << p.y << ", " << p.z << ")";
}

void print_content(std::ostream& out, const char* title, const PixelContent& content) {
  out << "    " << title << ": ";
  if (content.id == kNoPrimitive && content.depth == kNoDepth) {
    out << "nothing\n";
    return;
  }
  out << "ID " << content.id << ", depth " << content.depth;
  if (!content.primitive) {
    out << ", which belongs to no item\n";
    return;
  }
  const SnappedPrimitive& primitive = *content.primitive;
  if (primitive.point_size > 0) {
    out << "; point of size " << primitive.point_size << " at";
    print_corner(out, primitive.point);
  }
  for (const SnappedTriangle& piece : primitive.pieces) {
    out << "; triangle";
    for (const SnappedPosition& corner : piece)
      print_corner(out, corner);
  }
  out << "; " << covering_text(content.fit) << '\n';
}

Json json_of(const SnappedPosition& p) {
  return Json::array({p.x, p.y, p.z});
}

Json json_of(const PixelContent& content) {
  Json json = Json::object();
  if (content.id != kNoPrimitive) json["id"] = content.id;
  if (content.depth != kNoDepth) json["depth"] = content.depth;
  if (!content.primitive) return json;
  if (content.primitive->point_size > 0) {
    json["point_size"] = content.primitive->point_size;
    json["point"] = json_of(content.primitive->point);
  } else {
    json["triangles"] = Json::array();
    for (const SnappedTriangle& piece : content.primitive->pieces) {
      json["triangles"].push_back({json_of(piece[0]), json_of(piece[1]), json_of(piece[2])});
    }
  }
  json["may_cover"] = content.fit.may_cover;
  json["must_cover"] = content.fit.must_cover;
  if (content.fit.may_cover) json["depths"] = {content.fit.nearest, content.fit.farthest};
  return json;
}

}  // namespace

std::string text_of(const DrawingCounts& counts) {
  std::string text =
      std::to_string(counts.pixels) + " pixels, " + std::to_string(counts.covered) + " covered, ";
  if (counts.different_pixels() == 0) return text + "identical";
  text += std::to_string(counts.different_pixels()) + " differ (" +
          list_of<Difference>(counts, kDifferenceNames) +
          "), causes: " + list_of<Cause>(counts, kCauseNames);
  if (counts.largest_depth_step > 0) text += "; steps of depth " + steps_text(counts);
  return text;
}

std::string text_of(const PixelDifference& difference) {
  std::ostringstream out;
  out << "pixel (" << difference.pixel.x << ", " << difference.pixel.y
      << ") from the lower left, with its centre at (" << 256 * difference.pixel.x + 128 << ", "
      << 256 * difference.pixel.y + 128 << ") / 256: " << name_of(difference.difference)
      << " differs, " << name_of(difference.cause) << '\n';
  print_content(out, "reference", difference.reference);
  print_content(out, "candidate", difference.candidate);
  return out.str();
}

Json json_of(const DrawingCounts& counts) {
  Json different = Json::object();
  for (std::size_t d = 0; d < kDifferences; ++d) {
    for (std::size_t c = 0; c < kCauses; ++c) {
      different[std::string(kDifferenceNames[d])][std::string(kCauseNames[c])] =
          counts.different[d][c];
    }
  }
  Json steps = Json::array();
  for (std::size_t k = 0; k < counts.depth_steps.size(); ++k) {
    if (counts.depth_steps[k] == 0) continue;
    const std::size_t first = std::size_t{1} << k;
    steps.push_back({{"from", first}, {"to", 2 * first - 1}, {"pixels", counts.depth_steps[k]}});
  }
  return {{"pixels", counts.pixels},
          {"covered", counts.covered},
          {"identical", counts.identical},
          {"different", std::move(different)},
          {"unexplained", counts.of(Cause::unexplained)},
          {"depth_steps", std::move(steps)},
          {"largest_depth_step", counts.largest_depth_step}};
}

Json json_of(const PixelDifference& difference) {
  return {{"pixel", {difference.pixel.x, difference.pixel.y}},
          {"difference", name_of(difference.difference)},
          {"cause", name_of(difference.cause)},
          {"reference", json_of(difference.reference)},
          {"candidate", json_of(difference.candidate)}};
}

Json json_of(const DrawingTolerance& tolerance) {
  return {{"edge", tolerance.edge}, {"slope", tolerance.slope}, {"depth", tolerance.depth}};
}

Json json_of(const Camera& camera) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    Json numbers = Json::array();
    for (int column = 0; column < 4; ++column)
      numbers.push_back(camera.eye_from_world[column][row]);
    rows.push_back(std::move(numbers));
  }
  Json json{{"eye_from_world", std::move(rows)}};
  if (const auto* parallel = std::get_if<Orthographic>(&camera.lens)) {
    json["height"] = parallel->height;
  } else {
    json["fov_y"] = std::get<Perspective>(camera.lens).fov_y;
  }
  json["near_depth"] = camera.near_depth;
  json["far_depth"] = camera.far_depth;
  return json;
}

}  // namespace rangezip::compare

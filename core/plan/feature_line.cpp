#include "core/plan/feature_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/solve.h"

namespace rangezip {

namespace {

// Lengths are in pixels, heights in pixel sides, slopes are heights over pixels.
constexpr int kReach = 2;             // of the second differences
constexpr double kMaxStep = 4.0;      // between neighbours: more is a step of depth
constexpr double kMinBend = 0.36;     // change of slope at a crease: 20 degrees
constexpr double kVoteUnit = 16.0;    // votes for a change of slope of 1
constexpr int kMostVotes = 64;        // of a pixel for a line
constexpr int kDirections = 256;      // from -45 to 45 degrees, about each axis
constexpr double kVoteCosine = 0.9;   // of a pixel's own direction to that of a line
constexpr double kOnLine = 2.0;       // pixels as near take part in a line
constexpr double kPiece = 6.0;        // length in which planes are fitted
constexpr int kMinPixelsOfPiece = 3;  // of the crease
constexpr double kNearest = 1.5;      // to the line, of samples that take part in the planes
constexpr double kFarthest = 6.5;     // the same
constexpr int kMinSamplesOfPlane = 8;
constexpr double kMinSpread = 1e-6;   // determinant over the product of the squares: less is a line
constexpr double kMaxResidual = 0.1;  // of the samples from their plane
constexpr double kMaxOutlier = 0.3;   // of a piece from the line, once there is one
constexpr std::size_t kMinPieces = 3;
constexpr int kFits = 4;        // each with pieces along the line of the one before
constexpr int kCandidates = 8;  // lines by votes that may turn out to be no creases

/// Heights that are linear over the image of a plane under either projection, in pixel sides at
/// some depth of the scene.
class Heights {
 public:
  explicit Heights(const RangeImage& image) : image_(image) {
    for (const double depth : image.depth().pixels()) {
      if (depth == kNoSample) continue;
      reference_ = depth;
      break;
    }
    side_ = image.view().pixel_size(reference_);
  }

  [[nodiscard]] double operator[](Pixel p) const {
    const double depth = image_[p];
    if (image_.view().is_perspective()) return (1.0 - reference_ / depth) * reference_ / side_;
    return (depth - reference_) / side_;
  }
  /// Whether there are samples at the pixels, with no step between them.
  [[nodiscard]] bool are_joined(Pixel p, Pixel q) const {
    return image_.has_sample(p) && image_.has_sample(q) &&
           std::abs((*this)[p] - (*this)[q]) <= kMaxStep;
  }

 private:
  const RangeImage& image_;
  double reference_ = 1.0;
  double side_ = 1.0;
};

/// A pixel at which the surface bends sharply.
struct CreasePixel {
  Vec2 place;   ///< window coordinates
  Vec2 across;  ///< unit: the rough direction of the bend
  int votes = 0;
};

bool is_joined_around(const Heights& heights, Pixel p) {
  for (const Pixel step : {Pixel{1, 0}, Pixel{0, 1}, Pixel{1, 1}, Pixel{1, -1}}) {
    for (int i = -kReach; i < kReach; ++i) {
      const Pixel from{p.x + i * step.x, p.y + i * step.y};
      if (!heights.are_joined(from, {from.x + step.x, from.y + step.y})) return false;
    }
  }
  return true;
}

std::vector<CreasePixel> crease_pixels(const RangeImage& image, const Heights& heights) {
  std::vector<CreasePixel> found;
  for (int y = kReach; y + kReach < image.extent().height; ++y) {
    for (Pixel p{kReach, y}; p.x + kReach < image.extent().width; ++p.x) {
      if (!is_joined_around(heights, p)) continue;
      const auto at = [&](int x, int dy) { return heights[{p.x + kReach * x, p.y + kReach * dy}]; };
      const double xx = (at(1, 0) + at(-1, 0) - 2.0 * at(0, 0)) / kReach;
      const double yy = (at(0, 1) + at(0, -1) - 2.0 * at(0, 0)) / kReach;
      const double bend = std::sqrt(xx * xx + yy * yy);
      if (!(bend >= kMinBend)) continue;
      const double xy = at(1, 1) + at(-1, -1) - at(1, -1) - at(-1, 1);
      const double sign = (xy >= 0.0) == (xx + yy >= 0.0) ? 1.0 : -1.0;
      found.push_back({{p.x + 0.5, p.y + 0.5},
                       Vec2{std::abs(xx), sign * std::abs(yy)} / bend,
                       std::min(kMostVotes, static_cast<int>(bend * kVoteUnit))});
    }
  }
  return found;
}

/// Normals of lines: the first half within 45 degrees of the x axis, the others of the y axis.
std::vector<Vec2> line_normals() {
  std::vector<Vec2> normals;
  for (int i = 0; i < 2 * kDirections; ++i) {
    const double tangent = (2.0 * (i % kDirections) + 1.0) / kDirections - 1.0;
    const Vec2 normal = i < kDirections ? Vec2{1.0, tangent} : Vec2{tangent, 1.0};
    normals.push_back(normal / std::sqrt(1.0 + tangent * tangent));
  }
  return normals;
}

/// The line with most votes. @pre there are pixels
FeatureLine most_voted_line(const std::vector<CreasePixel>& pixels, Extent extent) {
  // Offsets are those of places in the image: not below -width, not above width + height.
  const auto offsets =
      2 * static_cast<std::size_t>(extent.width) + static_cast<std::size_t>(extent.height) + 2;
  FeatureLine best;
  std::int64_t most = -1;
  std::vector<std::int64_t> votes(offsets);
  for (const Vec2& normal : line_normals()) {
    std::fill(votes.begin(), votes.end(), 0);
    for (const CreasePixel& pixel : pixels) {
      if (std::abs(glm::dot(pixel.across, normal)) < kVoteCosine) continue;
      votes[static_cast<std::size_t>(glm::dot(pixel.place, normal) + extent.width)] += pixel.votes;
    }
    for (std::size_t i = 0; i + 1 < offsets; ++i) {  // lines lie between two counters
      const std::int64_t sum = votes[i] + votes[i + 1];
      if (sum <= most) continue;
      most = sum;
      best = {.normal = normal, .offset = static_cast<double>(i) + 1.0 - extent.width};
    }
  }
  return best;
}

/// Sums for the least squares of h = level + rise d + tilt u.
struct PlaneSums {
  Mat3 matrix{0.0};
  Vec3 right{0.0};
  double squares = 0.0;
  int count = 0;

  void add(double d, double u, double h) {
    const Vec3 terms{1.0, d, u};
    for (int i = 0; i < 3; ++i)
      matrix[i] += terms[i] * terms;
    right += h * terms;
    squares += h * h;
    ++count;
  }
  /// Nothing if the samples are few or lie on no plane.
  [[nodiscard]] std::optional<Vec3> plane() const {
    if (count < kMinSamplesOfPlane) return std::nullopt;
    const double least = kMinSpread * matrix[0][0] * matrix[1][1] * matrix[2][2];
    const std::optional<Vec3> solution = solve(matrix, right, least);
    if (!solution) return std::nullopt;
    const double residual2 = (squares - glm::dot(*solution, right)) / count;
    if (residual2 > kMaxResidual * kMaxResidual) return std::nullopt;
    return solution;
  }
};

/// A piece of a line: what is on its two sides, and where these meet.
struct Piece {
  int crease_pixels = 0;
  std::array<PlaneSums, 2> sides;
};
struct Crossing {
  double along = 0.0;
  double offset = 0.0;  ///< from the line
  double weight = 0.0;
};

class LineFit {
 public:
  LineFit(const RangeImage& image, const Heights& heights, const std::vector<CreasePixel>& pixels)
      : image_(image),
        heights_(heights),
        pixels_(pixels),
        first_(-static_cast<double>(image.extent().width + image.extent().height)) {}

  /// The crease along the line; nothing if there is none.
  [[nodiscard]] std::optional<FeatureLine> run(FeatureLine line) const {
    for (int fit = 0; fit < kFits; ++fit) {
      const double most = fit == 0 ? kOnLine : kMaxOutlier;
      const std::vector<Crossing> crossings = crossings_along(line, most);
      if (crossings.size() < kMinPieces) return std::nullopt;
      move(line, crossings);
      line.length = kPiece * static_cast<double>(crossings.size());
    }
    return line;
  }

 private:
  [[nodiscard]] static Vec2 along(const FeatureLine& line) {
    return {-line.normal.y, line.normal.x};
  }

  [[nodiscard]] std::size_t number_of(double u) const {
    return static_cast<std::size_t>((u - first_) / kPiece);
  }
  [[nodiscard]] double middle_of(std::size_t piece) const {
    return first_ + kPiece * (static_cast<double>(piece) + 0.5);
  }

  [[nodiscard]] std::vector<Piece> pieces_along(const FeatureLine& line) const {
    std::vector<Piece> pieces(number_of(-first_) + 1);
    for (const CreasePixel& pixel : pixels_) {
      if (std::abs(glm::dot(line.normal, pixel.place) - line.offset) > kOnLine) continue;
      ++pieces[number_of(glm::dot(along(line), pixel.place))].crease_pixels;
    }
    for (int y = 0; y < image_.extent().height; ++y) {
      for (Pixel p{0, y}; p.x < image_.extent().width; ++p.x) {
        const Vec2 place{p.x + 0.5, p.y + 0.5};
        const double d = glm::dot(line.normal, place) - line.offset;
        if (std::abs(d) < kNearest || std::abs(d) > kFarthest || !image_.has_sample(p)) continue;
        const double u = glm::dot(along(line), place);
        const std::size_t i = number_of(u);
        pieces[i].sides[d < 0.0 ? 0 : 1].add(d, u - middle_of(i), heights_[p]);
      }
    }
    return pieces;
  }

  /// The creases of the pieces that have one within `most` of the line.
  [[nodiscard]] std::vector<Crossing> crossings_along(const FeatureLine& line, double most) const {
    const std::vector<Piece> pieces = pieces_along(line);
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (const auto crossing = crossing_of(pieces[i], middle_of(i), most))
        crossings.push_back(*crossing);
    }
    return crossings;
  }

  [[nodiscard]] static std::optional<Crossing> crossing_of(const Piece& piece, double middle,
                                                           double most) {
    if (piece.crease_pixels < kMinPixelsOfPiece) return std::nullopt;
    const auto below = piece.sides[0].plane(), above = piece.sides[1].plane();
    if (!below || !above) return std::nullopt;
    const double bend = above->y - below->y;
    if (std::abs(bend) < kMinBend) return std::nullopt;
    const double offset = (below->x - above->x) / bend;
    if (std::abs(offset) > most) return std::nullopt;
    return Crossing{.along = middle, .offset = offset, .weight = bend * bend};
  }

  /// Onto the line that is nearest to the places.
  static void move(FeatureLine& line, const std::vector<Crossing>& crossings) {
    double weight = 0.0, u = 0.0, d = 0.0;
    for (const Crossing& c : crossings) {
      weight += c.weight;
      u += c.weight * c.along;
      d += c.weight * c.offset;
    }
    u /= weight;
    d /= weight;
    double uu = 0.0, ud = 0.0;
    for (const Crossing& c : crossings) {
      uu += c.weight * (c.along - u) * (c.along - u);
      ud += c.weight * (c.along - u) * (c.offset - d);
    }
    const double turn = ud / uu;
    const double length = std::sqrt(1.0 + turn * turn);
    const Vec2 tangent = along(line);
    line.offset = (line.offset + d - turn * u) / length;
    line.normal = (line.normal - turn * tangent) / length;
  }

  const RangeImage& image_;
  const Heights& heights_;
  const std::vector<CreasePixel>& pixels_;
  double first_;  ///< where places along lines are counted from: none in the image is farther back
};

}  // namespace

std::optional<FeatureLine> find_feature_line(const RangeImage& image) {
  const Heights heights(image);
  std::vector<CreasePixel> pixels = crease_pixels(image, heights);
  for (int i = 0; i < kCandidates && !pixels.empty(); ++i) {
    const FeatureLine voted = most_voted_line(pixels, image.extent());
    if (const auto line = LineFit(image, heights, pixels).run(voted)) return line;
    std::erase_if(pixels, [&](const CreasePixel& pixel) {
      return std::abs(glm::dot(voted.normal, pixel.place) - voted.offset) <= kOnLine;
    });
  }
  return std::nullopt;
}

}  // namespace rangezip

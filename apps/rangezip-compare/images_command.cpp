#include "apps/rangezip-compare/images_command.h"

#include <ostream>
#include <string>
#include <string_view>

#include "compare/framebuffer_diff.h"
#include "core/base/error.h"
#include "core/io/file_bytes.h"
#include "core/io/image_file.h"

namespace rangezip::compare {

namespace {

enum class ImageKind { depths, ids, mask };

/// PFM holds depths; a PNG tells by its colour type: four channels are IDs, one is a mask.
ImageKind kind_of(const std::filesystem::path& path) {
  if (path.extension() == ".pfm") return ImageKind::depths;
  if (path.extension() != ".png") {
    throw IoError(path.string() + ": must be an image of depths (.pfm), IDs or a mask (.png)");
  }
  // Signature (8 bytes), length and name of the first chunk (8), width, height (8), bit depth (1).
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::size_t kColourType = 25;
  constexpr unsigned char kGrey = 0;
  constexpr unsigned char kRedGreenBlueAlpha = 6;
  const FileBytes file(path);
  const std::string_view bytes = file.bytes();
  if (!bytes.starts_with(kSignature)) file.fail("must be a PNG file");
  if (bytes.size() <= kColourType) file.fail("the file ends within its header");
  const auto colour_type = static_cast<unsigned char>(bytes[kColourType]);
  if (colour_type == kGrey) return ImageKind::mask;
  if (colour_type == kRedGreenBlueAlpha) return ImageKind::ids;
  file.fail_at_byte(&bytes[kColourType],
                    "must be a PNG of IDs (RGBA) or a mask (grey), got colour type " +
                        std::to_string(colour_type));
}

GridDiff compare_files(ImageKind kind, const std::filesystem::path& reference,
                       const std::filesystem::path& candidate) {
  switch (kind) {
    case ImageKind::depths:
      return compare_depths(read_pfm(reference), read_pfm(candidate));
    case ImageKind::ids:
      return compare_ids(read_id_png(reference), read_id_png(candidate));
    case ImageKind::mask:
      break;
  }
  return compare_masks(read_mask_png(reference), read_mask_png(candidate));
}

void print_diff(std::ostream& out, ImageKind kind, const GridDiff& diff) {
  out << diff.pixels << " pixels, ";
  if (diff.identical()) {
    out << "identical\n";
    return;
  }
  out << diff.differences << " differ: " << diff.missing << " missing in the second, "
      << diff.unexpected << " in the second only, "
      << diff.differences - diff.missing - diff.unexpected << " of another value";
  if (kind == ImageKind::depths) out << " (by up to " << diff.largest_step << " model units)";
  out << "; first at (" << diff.first->x << ", " << diff.first->y << ") from the lower left\n";
}

}  // namespace

bool run_images_command(const ImagesCommand& command, std::ostream& out) {
  const auto& [reference, candidate] = command;
  const ImageKind kind = kind_of(reference);
  if (kind != kind_of(candidate)) {
    throw IoError(candidate.string() + ": must be of the same kind as " + reference.string());
  }
  try {
    const GridDiff diff = compare_files(kind, reference, candidate);
    print_diff(out, kind, diff);
    return diff.identical();
  } catch (const InvalidArgument& error) {
    throw IoError(candidate.string() + ": does not match " + reference.string() + ": " +
                  error.what());
  }
}

}  // namespace rangezip::compare

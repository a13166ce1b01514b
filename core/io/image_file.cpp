#include "core/io/image_file.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/byte_order.h"
#include "core/io/file_bytes.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

void check_not_empty(Extent extent, const char* function) {
  if (extent.count() == 0) {
    throw InvalidArgument(std::string(function) + ": image must not be empty");
  }
}

/// Pixels of a PNG, channel after channel, bottom row first.
struct PngPixels {
  Extent extent;
  std::vector<png_byte> bytes;
};

/// Frees what libpng keeps of an image at the end of the scope. Its simplified interface needs no
/// setjmp.
struct PngImage {
  png_image image{};

  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

/// libpng's stride of one row. Negative: the buffer holds the bottom row first, the file the top
/// row first. The one place where an image is turned over.
png_int_32 bottom_up_stride(const png_image& image) {
  return -static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(image));
}

void write_png(const std::filesystem::path& path, png_uint_32 format, const PngPixels& pixels) {
  PngImage holder;
  png_image& image = holder.image;
  image.width = static_cast<png_uint_32>(pixels.extent.width);
  image.height = static_cast<png_uint_32>(pixels.extent.height);
  image.format = format;
  image.flags = PNG_IMAGE_FLAG_FAST;
  std::string stored(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = stored.size();
  if (png_image_write_to_memory(&image, stored.data(), &size, 0, pixels.bytes.data(),
                                bottom_up_stride(image), nullptr) == 0) {
    throw IoError(path.string() + ": the PNG cannot be made: " + image.message);
  }
  AtomicFile file(path);
  file.write(std::string_view(stored).substr(0, size));
  file.commit();
}

PngPixels read_png(const std::filesystem::path& path, png_uint_32 format, const char* wanted) {
  const FileBytes file(path);
  const char* const begin = file.bytes().data();
  PngImage holder;
  png_image& image = holder.image;
  if (png_image_begin_read_from_memory(&image, begin, file.bytes().size()) == 0) {
    file.fail_at_byte(begin, std::string("not a PNG file: ") + image.message);
  }
  constexpr std::size_t kColourTypeAt = 25;
  constexpr std::size_t kExtentAt = 16;
  if (image.format != format) {
    file.fail_at_byte(begin + kColourTypeAt, std::string("the PNG is not ") + wanted);
  }
  constexpr std::size_t kBestRatio = 1032;  // of deflate; a larger image cannot be in the file
  const std::size_t row = std::size_t{image.width} * PNG_IMAGE_PIXEL_SIZE(format);
  if (row > kBestRatio * file.bytes().size() / image.height) {
    file.fail_at_byte(begin + kExtentAt, "an image of " + std::to_string(image.width) + " x " +
                                             std::to_string(image.height) +
                                             " pixels cannot be in a file this short");
  }
  PngPixels pixels;
  pixels.extent = {static_cast<int>(image.width), static_cast<int>(image.height)};
  pixels.bytes.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.bytes.data(), bottom_up_stride(image),
                            nullptr) == 0) {
    file.fail(std::string("in the image data: ") + image.message);
  }
  return pixels;
}

/// One word of a PFM header; one white character after it is taken too.
std::string_view header_word(const FileBytes& file, std::size_t& at) {
  const std::string_view bytes = file.bytes();
  const std::size_t end = std::min(bytes.find_first_of(" \t\r\n", at), bytes.size());
  const std::string_view word = bytes.substr(at, end - at);
  if (word.empty() || end == bytes.size()) {
    file.fail_at_byte(bytes.data() + at, "the header of a PFM file is 'Pf', width, height, scale");
  }
  at = end + 1;
  return word;
}

double header_number(const FileBytes& file, std::size_t& at, const char* what) {
  const std::string_view word = header_word(file, at);
  const char* begin = word.data();
  double value = 0.0;
  if (!parse_number(begin, word.data() + word.size(), value) || !std::isfinite(value)) {
    file.fail_at_byte(word.data(), std::string(what) + " is a number, not " + quote(word));
  }
  return value;
}

int header_size(const FileBytes& file, std::size_t& at, const char* what) {
  constexpr double kLargest = 1 << 24;  // no image of ours comes near, and no product overflows
  const std::size_t place = at;
  const double size = header_number(file, at, what);
  if (!(size >= 1.0 && size <= kLargest) || size != std::floor(size)) {
    file.fail_at_byte(file.bytes().data() + place,
                      std::string(what) + " is a whole number from 1 to 2^24");
  }
  return static_cast<int>(size);
}

}  // namespace

void write_pfm(const std::filesystem::path& path, const Grid<double>& image) {
  check_not_empty(image.extent(), "write_pfm");
  AtomicFile file(path);
  file.write("Pf\n" + std::to_string(image.extent().width) + " " +
             std::to_string(image.extent().height) + "\n-1.0\n");  // negative: lowest byte first
  for (const double value : image.pixels()) {
    const auto bytes = little_bytes(static_cast<float>(value));
    file.write({bytes.data(), bytes.size()});
  }
  file.commit();
}

Grid<double> read_pfm(const std::filesystem::path& path) {
  const FileBytes file(path);
  std::size_t at = 0;
  if (header_word(file, at) != "Pf") {
    file.fail_at_byte(file.bytes().data(), "a PFM file of one channel begins with 'Pf'");
  }
  Extent extent;
  extent.width = header_size(file, at, "the width");
  extent.height = header_size(file, at, "the height");
  const bool is_swapped = (header_number(file, at, "the scale") < 0.0) != kIsLittleEndian;
  const std::string_view data = file.bytes().substr(at);
  if (data.size() != extent.count() * sizeof(float)) {
    file.fail_at_byte(data.data(),
                      "the header promises " + std::to_string(extent.count() * sizeof(float)) +
                          " bytes of pixels, but " + std::to_string(data.size()) + " follow");
  }
  Grid<double> image(extent);
  const char* place = data.data();
  for (double& value : image.pixels()) {
    value = static_cast<double>(load_bytes<float>(place, is_swapped));
    place += sizeof(float);
  }
  return image;
}

void write_mask_png(const std::filesystem::path& path, const Mask& mask) {
  check_not_empty(mask.extent(), "write_mask_png");
  PngPixels pixels{.extent = mask.extent()};
  pixels.bytes.reserve(mask.pixels().size());
  for (const std::uint8_t active : mask.pixels())
    pixels.bytes.push_back(active != 0 ? 255 : 0);
  write_png(path, PNG_FORMAT_GRAY, pixels);
}

Mask read_mask_png(const std::filesystem::path& path) {
  const PngPixels pixels = read_png(path, PNG_FORMAT_GRAY, "grey with 8 bits");
  constexpr png_byte kHalf = 128;
  Mask mask(pixels.extent);
  std::transform(pixels.bytes.begin(), pixels.bytes.end(), mask.pixels().begin(),
                 [](png_byte grey) { return static_cast<std::uint8_t>(grey >= kHalf ? 1 : 0); });
  return mask;
}

void write_id_png(const std::filesystem::path& path, const Grid<PrimitiveId>& ids) {
  check_not_empty(ids.extent(), "write_id_png");
  PngPixels pixels{.extent = ids.extent()};
  pixels.bytes.reserve(4 * ids.pixels().size());
  for (const PrimitiveId id : ids.pixels()) {
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
      pixels.bytes.push_back(static_cast<png_byte>((id >> shift) & 0xffU));
    }
  }
  write_png(path, PNG_FORMAT_RGBA, pixels);
}

Grid<PrimitiveId> read_id_png(const std::filesystem::path& path) {
  const PngPixels pixels = read_png(path, PNG_FORMAT_RGBA, "RGBA with 8 bits a channel");
  Grid<PrimitiveId> ids(pixels.extent);
  const png_byte* at = pixels.bytes.data();
  for (PrimitiveId& id : ids.pixels()) {
    id = PrimitiveId{at[0]} << 24U | PrimitiveId{at[1]} << 16U | PrimitiveId{at[2]} << 8U | at[3];
    at += 4;
  }
  return ids;
}

void write_rgb_png(const std::filesystem::path& path, const Grid<Rgb>& image) {
  check_not_empty(image.extent(), "write_rgb_png");
  PngPixels pixels{.extent = image.extent()};
  pixels.bytes.reserve(3 * image.pixels().size());
  for (const Rgb& colour : image.pixels()) {
    pixels.bytes.insert(pixels.bytes.end(), colour.begin(), colour.end());
  }
  write_png(path, PNG_FORMAT_RGB, pixels);
}

Grid<Rgb> read_rgb_png(const std::filesystem::path& path) {
  const PngPixels pixels = read_png(path, PNG_FORMAT_RGB, "RGB with 8 bits a channel");
  Grid<Rgb> image(pixels.extent);
  const png_byte* at = pixels.bytes.data();
  for (Rgb& colour : image.pixels()) {
    std::copy_n(at, colour.size(), colour.begin());
    at += colour.size();
  }
  return image;
}

}  // namespace rangezip

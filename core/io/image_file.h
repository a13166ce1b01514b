#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "core/base/grid.h"
#include "core/mask/mask.h"
#include "core/raster/draw_item.h"

namespace rangezip {

/// Images on disk (docs/file-formats.md). In memory and in PFM the bottom row comes first; PNG has
/// the top row first and is turned over here and nowhere else. All are written in full or not at
/// all. Writers: @throws IoError if the file cannot be written in full
///          @throws InvalidArgument if the image is empty
/// Readers: @throws IoError naming file, place and rule

/// Depths as 32-bit floats, one channel. kNoSample (+infinity) is stored as it is.
void write_pfm(const std::filesystem::path& path, const Grid<double>& image);
[[nodiscard]] Grid<double> read_pfm(const std::filesystem::path& path);

/// Active pixels white, others black; 8-bit grey. What is at least half white reads as active.
void write_mask_png(const std::filesystem::path& path, const Mask& mask);
[[nodiscard]] Mask read_mask_png(const std::filesystem::path& path);

/// IDs of 32 bits, the highest byte as red, then green, blue, and the lowest as alpha.
void write_id_png(const std::filesystem::path& path, const Grid<PrimitiveId>& ids);
[[nodiscard]] Grid<PrimitiveId> read_id_png(const std::filesystem::path& path);

/// Red, green and blue, 8 bits each, sRGB.
using Rgb = std::array<std::uint8_t, 3>;
void write_rgb_png(const std::filesystem::path& path, const Grid<Rgb>& image);
[[nodiscard]] Grid<Rgb> read_rgb_png(const std::filesystem::path& path);

}  // namespace rangezip

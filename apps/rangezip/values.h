#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/base/geometry.h"
#include "core/base/grid.h"

namespace rangezip::app {

/// Values of options as they are typed. All throw CLI::ValidationError naming the rule and the
/// text.
[[nodiscard]] double parse_number(const std::string& text);
[[nodiscard]] Vec3 parse_vector(const std::string& text);                ///< "x,y,z", not all 0
[[nodiscard]] Vec3 parse_position(const std::string& text);              ///< "x,y,z"
[[nodiscard]] Extent parse_extent(const std::string& text);              ///< "w,h", 1..8192
[[nodiscard]] std::vector<Vec2> parse_polygon(const std::string& text);  ///< "x,y x,y x,y ..."
[[nodiscard]] Plane parse_plane(const std::string& text);                ///< "nx,ny,nz,d"

/// Adds an option whose text is parsed by `parse` and stored in `target`.
template <class Target, class Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, Target& target,
                        const Parse& parse, const std::string& text, const std::string& form) {
  return command
      .add_option_function<std::string>(
          name,
          [&target, parse, name](const std::string& value) {
            try {
              target = parse(value);
            } catch (const CLI::ValidationError& error) {
              throw CLI::ValidationError(name, error.what());
            }
          },
          text)
      ->type_name(form);
}

/// The same for an option that may be given several times: each adds to `list`.
template <class Item, class Parse>
CLI::Option* add_repeated(CLI::App& command, const std::string& name, std::vector<Item>& list,
                          const Parse& parse, const std::string& text, const std::string& form) {
  return command
      .add_option_function<std::vector<std::string>>(
          name,
          [&list, parse, name](const std::vector<std::string>& values) {
            try {
              for (const std::string& value : values)
                list.push_back(parse(value));
            } catch (const CLI::ValidationError& error) {
              throw CLI::ValidationError(name, error.what());
            }
          },
          text)
      ->type_name(form)
      ->allow_extra_args(false);
}

/// A number greater than 0.
[[nodiscard]] double parse_positive(const std::string& text);
/// A whole number greater than 0.
[[nodiscard]] std::size_t parse_count(const std::string& text);
/// A number of at least 0.
[[nodiscard]] double parse_not_negative(const std::string& text);

}  // namespace rangezip::app

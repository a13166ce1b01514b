#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace rangezip::app {

/// The files that a run will write. Checked before the work starts, so that hours are not spent on
/// a result that has no place to go.
class Outputs {
 public:
  /// @param option as typed, for messages ("-o")
  /// @param types extensions without dot that the writer knows
  /// @throws OutputError if the extension is unknown, the folder is missing, or the file or folder
  ///     is not writable; UsageError if another output has the same path.
  void add(const std::string& option, const std::filesystem::path& path,
           std::initializer_list<std::string_view> types);

  [[nodiscard]] bool empty() const noexcept { return outputs_.empty(); }

  /// @throws UsageError if an output would overwrite one of the `inputs`, which is only wrong
  ///     where the inputs are needed again.
  void refuse_overwriting(const std::vector<std::filesystem::path>& inputs) const;

 private:
  struct Output {
    std::string option;
    std::filesystem::path path;
  };
  std::vector<Output> outputs_;
};

/// Calls `write` and turns its IoError into OutputError.
void write_output(const std::function<void()>& write);

}  // namespace rangezip::app

#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace rangezip::benchmark {

/// Processor time of all threads of the process, and wall time.
struct Seconds {
  double cpu = 0.0;
  double wall = 0.0;
};
[[nodiscard]] Seconds seconds_since_start();
[[nodiscard]] Seconds operator-(const Seconds& end, const Seconds& begin) noexcept;

/// What the parts of a run took, by name.
using Parts = std::map<std::string, Seconds>;

/// One thing to measure.
struct Case {
  nlohmann::ordered_json name;  ///< what tells its row from others: {"what": "points", ...}
  double items = 0.0;           ///< what one run of `work` deals with
  std::function<void()> work;
  int threads = 1;
  double fragments = 0.0;  ///< pixels that the triangles cover; 0: not counted
  /// Rates are by wall time: several threads share the work, or a device does it.
  bool is_by_wall = false;
  std::function<Parts()> parts = {};  ///< those of the last run, if they are known
};

/// How long a group is measured: until both the rounds and the time are reached.
struct Effort {
  int rounds = 3;
  double seconds_per_case = 1.0;
  int runs_per_turn = 2;  ///< from the second on a case finds the caches as it left them
};

using Bytes = std::span<const std::byte>;
[[nodiscard]] std::size_t size_of(const std::vector<Bytes>& input);

/// What no program beats that needs these bytes: reading each once; and copying them.
[[nodiscard]] std::vector<Case> limits_of(const std::vector<Bytes>& input);

/// The rows measured so far.
class Results {
 public:
  /// Runs the cases in turn, so that what else the machine does hits all of them, and keeps the
  /// best time of each case. A case of the same name as an earlier one shares its row.
  void measure(const std::vector<Case>& cases, const Effort& effort);

  /// The rows; those whose name holds "bytes" with their share of the limit of reading that many.
  [[nodiscard]] nlohmann::ordered_json rows() const;

 private:
  struct Row {
    nlohmann::ordered_json name;
    double items = 0.0;
    double fragments = 0.0;
    bool is_by_wall = false;
    Seconds seconds;
    Parts parts;
    int runs = 0;
    double load_before = 0.0;  ///< load average of the machine
    double load_after = 0.0;
  };

  void add(const Row& row);
  [[nodiscard]] static double rate_seconds(const Row& row);
  [[nodiscard]] static nlohmann::ordered_json json_of(const Row& row);
  [[nodiscard]] const Row* find(const nlohmann::ordered_json& name) const;

  std::vector<Row> rows_;
};

}  // namespace rangezip::benchmark

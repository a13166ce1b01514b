#include "apps/rangezip-compare/json_file.h"

#include "apps/rangezip/outputs.h"
#include "core/io/atomic_file.h"

namespace rangezip::compare {

void check_json_place(const std::filesystem::path& path) {
  app::Outputs().add("--json", path, {"json"});
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
  app::write_output([&] {
    AtomicFile file(path);
    // Names of files need not be UTF-8.
    file.write(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
    file.commit();
  });
}

}  // namespace rangezip::compare

#include "apps/rangezip-compare/stages_report.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace rangezip::compare;

namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kCommands{"scan", "fill", "undo"};

/// A session that goes astray in its second command, of three.
JudgedSession astray() {
  const StageVerdict drawn{.name = "framebuffers", .compared = 4};
  const StageVerdict mask{.name = "mask", .compared = 100, .different = 2, .first = "pixel (3, 4)"};
  const StageVerdict mesh{.name = "mesh", .compared = 50, .different = 9, .first = "face 12"};
  return {.name = "gl:egl", .renderer = "a GPU", .verdicts = {{{drawn}}, {{drawn, mask, mesh}}}};
}

}  // namespace

TEST_CASE("the report on a session that differs names the command, the stage and the place") {
  std::ostringstream out;
  print_session(out, kCommands, "cpu", astray());
  CHECK(out.str() ==
        "command 0, scan\n"
        "  framebuffers: 4 equal\n"
        "command 1, fill\n"
        "  framebuffers: 4 equal\n"
        "  mask: 2 of 100 differ, first pixel (3, 4)\n"
        "  mesh: 9 of 50 differ, first face 12\n"
        "gl:egl against cpu: first difference: command 1, mask, pixel (3, 4)\n");

  const Json json = json_of(kCommands, astray());
  CHECK(json["name"] == "gl:egl");
  CHECK(json["renderer"] == "a GPU");
  CHECK(json["identical"] == false);
  const Json first{{"command", 1}, {"stage", "mask"}, {"place", "pixel (3, 4)"}};
  CHECK(json["first_difference"] == first);
  REQUIRE(json["commands"].size() == 2);
  CHECK(json["commands"][1]["command"] == "fill");
  const Json mesh{{"stage", "mesh"}, {"compared", 50}, {"different", 9}, {"first", "face 12"}};
  CHECK(json["commands"][1]["stages"][2] == mesh);
}

TEST_CASE("the report on a session without a difference has none") {
  JudgedSession judged = astray();
  judged.verdicts.pop_back();
  std::ostringstream out;
  print_session(out, kCommands, "cpu", judged);
  CHECK(out.str() ==
        "command 0, scan\n"
        "  framebuffers: 4 equal\n"
        "gl:egl against cpu: 1 command, all stages equal\n");
  const Json json = json_of(kCommands, judged);
  CHECK(json["identical"] == true);
  CHECK_FALSE(json.contains("first_difference"));
  const Json drawn{{"stage", "framebuffers"}, {"compared", 4}, {"different", 0}};
  CHECK(json["commands"][0]["stages"][0] == drawn);
}

#include "pillowmesh/adapt/options.h"

#include "../catch.h"

namespace options_test {

using namespace pillowmesh;

TEST_CASE("by default quads are adapted in full, and layers are the paper's") {
  const AdaptOptions options;
  CHECK(full_adaptation(options));
  CHECK(options.effort == Effort::normal);
  CHECK(options.align == 1.0);
  CHECK(options.threshold == 2.0);
  CHECK(options.thickness == 1);
  CHECK(options.augment == -1);  // one ring in 2D, as the paper; none in 3D
  CHECK(options.dice == 1);
  CHECK(options.smoothing == Smoothing::end);
}

TEST_CASE("each option is set by its command-line name") {
  AdaptOptions options;
  CHECK(set_option(options, "threshold", "1.4").ok());
  CHECK(set_option(options, "smooth", "between").ok());
  CHECK(set_option(options, "dice", "3").ok());
  CHECK(set_option(options, "thickness", "2").ok());
  CHECK(set_option(options, "augment", "0").ok());
  CHECK(set_option(options, "max-iterations", "7").ok());
  CHECK(set_option(options, "max-cells", "123456").ok());
  CHECK(set_option(options, "max-sweeps", "0").ok());
  CHECK(set_option(options, "method", "paper").ok());
  CHECK(set_option(options, "effort", "best").ok());
  CHECK(set_option(options, "align", "0.25").ok());
  CHECK(set_option(options, "seed", "17").ok());
  CHECK(set_option(options, "geometry", "smooth").ok());
  CHECK(set_option(options, "corner-angle", "60").ok());
  CHECK(options.geometry == BoundaryShape::smooth);
  CHECK(options.boundary.corner_cosine == Approx(0.5));
  CHECK(set_option(options, "geometry", "linear").ok());
  CHECK(options.geometry == BoundaryShape::linear);
  CHECK(options.method == Method::paper);
  CHECK(options.effort == Effort::best);
  CHECK(options.align == 0.25);
  CHECK(options.seed == 17);
  CHECK(set_option(options, "method", "full").ok());
  CHECK(options.method == Method::full);
  CHECK(options.threshold == 1.4);
  CHECK(options.smoothing == Smoothing::between);
  CHECK(options.dice == 3);
  CHECK(options.thickness == 2);
  CHECK(options.augment == 0);
  CHECK(options.max_iterations == 7);
  CHECK(options.max_cells == 123456);
  CHECK(options.max_sweeps == 0);
  for (const auto& [name, value] : {std::pair("none", Smoothing::none), std::pair("end", Smoothing::end)}) {
    CHECK(set_option(options, "smooth", name).ok());
    CHECK(options.smoothing == value);
  }
}

TEST_CASE("a wrong value is refused with the option, what is allowed and what was given; nothing changes") {
  const std::pair<const char*, const char*> wrong[] = {
      {"threshold", "1"},  {"threshold", "two"}, {"threshold", ""},   {"threshold", "nan"}, {"threshold", "2x"},
      {"dice", "0"},       {"dice", "1.5"},      {"dice", "17"},      {"thickness", "0"},   {"augment", "-1"},
      {"max-cells", "0"},  {"max-cells", "many"}, {"max-sweeps", "-1"}, {"smooth", "always"}, {"max-iterations", "0"},
      {"method", "both"},  {"effort", "more"},   {"align", "1.5"},    {"seed", "-1"},
      {"geometry", "round"}, {"corner-angle", "0"}, {"corner-angle", "200"}};
  for (const auto& [name, value] : wrong) {
    AdaptOptions options;
    const Status s = set_option(options, name, value);
    INFO("--" << name << " " << value << ": " << s.message);
    CHECK(s.code == StatusCode::usage);
    CHECK(s.message.find("--" + std::string(name)) != std::string::npos);
    CHECK(s.message.find("'" + std::string(value) + "'") != std::string::npos);
    CHECK(options.threshold == 2.0);
    CHECK(options.dice == 1);
    CHECK(options.max_cells == AdaptOptions{}.max_cells);
  }
}

TEST_CASE("an unknown option is refused by name") {
  AdaptOptions options;
  const Status s = set_option(options, "treshold", "2");
  CHECK(s.code == StatusCode::usage);
  CHECK(s.message.find("--treshold") != std::string::npos);
}

TEST_CASE("an option of the paper's method chooses it, unless full adaptation is asked for") {
  for (const auto& [name, value] : {std::pair("smooth", "none"), std::pair("dice", "2"), std::pair("thickness", "3")}) {
    AdaptOptions options;
    REQUIRE(set_option(options, name, value).ok());
    CHECK_FALSE(full_adaptation(options));
    REQUIRE(set_option(options, "method", "full").ok());
    CHECK(full_adaptation(options));
    REQUIRE(set_option(options, "method", "paper").ok());
    CHECK_FALSE(full_adaptation(options));
  }
}

}  // namespace options_test

// Renderings with other options must tell themselves apart, lest a comparison goes on with both.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <sstream>

#include "integrator.hpp"
#include "report.hpp"

namespace ppm::compare {
namespace {

using render::Settings;

const std::map<std::string, std::function<void(Settings&)>> kChanges = {
    {"--photons", [](Settings& settings) { settings.photons_per_pass += 1; }},
    {"--alpha", [](Settings& settings) { settings.alpha = 0.5; }},
    {"--radius", [](Settings& settings) { settings.radius_mode = render::RadiusMode::footprint; }},
    {"--map-photons", [](Settings& settings) { settings.map_photons += 1; }},
    {"--nearest", [](Settings& settings) { settings.nearest += 1; }},
};

TEST(MethodOptions, EachShowsInThePicturesAttributes) {
  for (const render::Method& method : render::methods()) {
    Settings usual;
    usual.integrator = method.name;
    const auto attributes = render::picture_attributes(usual, {}, {});
    std::istringstream options{std::string(method.options)};
    for (std::string option; options >> option;) {
      ASSERT_TRUE(kChanges.contains(option)) << option << " of " << method.name;
      Settings changed = usual;
      kChanges.at(option)(changed);
      EXPECT_NE(render::picture_attributes(changed, {}, {}), attributes)
          << option << " of " << method.name;
    }
  }
}

}  // namespace
}  // namespace ppm::compare

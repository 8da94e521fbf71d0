// Methods beside the default one, and budgets, on the command line.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lit_floor.hpp"
#include "program.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Words = std::vector<std::string>;

class CliMethods : public ::testing::Test {
 protected:
  CliMethods() { lit_floor().write(folder_ / "s.glb"); }

  std::string file(const char* name) const { return (folder_ / name).string(); }
  Words words(const char* method, const Words& more) const {
    Words all = {"render",       file("s.glb"), "--width", "16",
                 "--integrator", method,        "--stats", file("s.json")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  nlohmann::json statistics() const { return nlohmann::json::parse(file_text(folder_ / "s.json")); }

  TemporaryFolder folder_;
};

TEST_F(CliMethods, SamplesAreCountedAsSamples) {
  const Result result = run(words("pt", {"-o", file("o.exr"), "--spp", "3"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("sample 3 of 3, "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" samples/s, "), std::string::npos) << result.err;
  EXPECT_EQ(statistics()["integrator"], "pt");
  EXPECT_EQ(statistics()["samples"], 3);
  EXPECT_EQ(statistics()["passes"], 3);
  EXPECT_EQ(statistics()["photons_emitted"], 0);
  const PictureFile picture = read_picture(folder_ / "o.exr");
  EXPECT_GT(*std::max_element(picture.values.begin(), picture.values.end()), 0.0f);
  EXPECT_NE(picture.spec.find_attribute("ppm-vk:samples"), nullptr);
  EXPECT_EQ(picture.spec.find_attribute("ppm-vk:photons"), nullptr);
}

TEST_F(CliMethods, TimeAndPassesEndARendering) {
  for (const char* const method : {"ppm", "pt-mis", "bdpt", "mlt"}) {
    SCOPED_TRACE(method);
    EXPECT_EQ(run(words(method, {"-o", file("o.exr"), "--time", "0.3s"})).exit_code, 0);
    EXPECT_GE(statistics()["passes"], 1);
    EXPECT_GE(statistics()["seconds"]["total"], 0.3);
    EXPECT_EQ(run(words(method, {"-o", file("o.exr"), "--time", "1h", "--passes", "2"})).exit_code,
              0);
    EXPECT_EQ(statistics()["passes"], 2);
  }
}

TEST_F(CliMethods, InterruptedRenderingEqualsAShorterOne) {
  Program program(words("pt", {"-o", file("a.hdr"), "--time", "100h"}));
  ASSERT_TRUE(program.wait_for("sample 2"));
  program.send(SIGINT);
  EXPECT_EQ(program.finish().exit_code, 130);
  const std::uint64_t samples = statistics()["samples"];
  EXPECT_GE(samples, 2u);
  EXPECT_EQ(run(words("pt", {"-o", file("b.hdr"), "--spp", std::to_string(samples)})).exit_code, 0);
  EXPECT_EQ(file_text(folder_ / "a.hdr"), file_text(folder_ / "b.hdr"));
}

}  // namespace
}  // namespace ppm::test

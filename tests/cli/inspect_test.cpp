// `ppm-vk inspect` and --memory-budget as users meet them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lit_floor.hpp"
#include "program.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Words = std::vector<std::string>;

class CliInspect : public ::testing::Test {
 protected:
  CliInspect() { lit_floor().write(folder_ / "s.glb"); }
  std::string scene() const { return (folder_ / "s.glb").string(); }

  TemporaryFolder folder_;
};

bool one_error_line(const Result& result, const char* part) {
  return result.exit_code == 1 && result.err.starts_with("ppm-vk: error: ") &&
         result.err.find('\n') == result.err.size() - 1 &&
         result.err.find(part) != std::string::npos;
}

TEST_F(CliInspect, NeedsNoVulkanDevice) {
  const Result result = Program({"inspect", scene()}, [] {
                          setenv("VK_ICD_FILENAMES", "/nonexistent", 1);
                          setenv("VK_DRIVER_FILES", "/nonexistent", 1);
                        }).finish();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* part : {"triangles: 2", "\"above\"", "from 1 point", "memory of a rendering"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  }
}

// The keys that the README lists.
TEST_F(CliInspect, JsonHasItsSchema) {
  const Result result = run({"inspect", scene(), "--json", "--width", "64"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto report = nlohmann::json::parse(result.out);
  for (const char* key : {"file", "file_bytes", "bounds", "triangles", "left_out", "cameras",
                          "lights", "materials", "textures", "extensions", "warnings", "memory"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["memory"]["width"], 64);
  EXPECT_EQ(report["memory"]["height"], 32);
  EXPECT_GT(report["file_bytes"], 0);
}

TEST_F(CliInspect, UsageAndBrokenFilesAreRefused) {
  EXPECT_EQ(run({"inspect"}).exit_code, 2);
  EXPECT_EQ(run({"inspect", scene(), "--quiet"}).exit_code, 2);
  EXPECT_EQ(run({"help", "inspect"}).exit_code, 0);
  EXPECT_TRUE(one_error_line(run({"inspect", (folder_ / "none.glb").string()}), "none.glb"));
}

TEST_F(CliInspect, WhatIsBeyondTheMemoryBudgetIsRefusedBeforeItIsBegun) {
  const std::string picture = (folder_ / "o.exr").string();
  EXPECT_TRUE(one_error_line(run({"inspect", scene(), "--memory-budget", "100M"}),
                             "--memory-budget: a rendering takes "));
  EXPECT_TRUE(one_error_line(run({"render", scene(), "-o", picture, "--memory-budget", "100M"}),
                             "--memory-budget: a rendering takes "));
  // The picture's size is what is too much here, and the line says which would do.
  EXPECT_TRUE(one_error_line(
      run({"render", scene(), "-o", picture, "--width", "30000", "--memory-budget", "4G"}),
      " or --memory-budget "));
  EXPECT_FALSE(std::filesystem::exists(picture));
  EXPECT_TRUE(one_error_line(run({"bench", scene(), "--quiet", "--memory-budget", "100M"}),
                             "--memory-budget: a rendering takes "));
}

}  // namespace
}  // namespace ppm::test

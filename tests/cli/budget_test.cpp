// Renderings that are given little memory, on the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "layer_environment.hpp"
#include "lit_floor.hpp"
#include "program.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {
namespace {

using Words = std::vector<std::string>;

class CliBudget : public ::testing::Test {
 protected:
  CliBudget() { lit_floor().write(folder_ / "s.glb"); }

  std::string file(const char* name) const { return (folder_ / name).string(); }
  Words words(const Words& more) const {
    Words all = {"render", file("s.glb"), "--width",     "320",     "--photons",
                 "20000",  "-o",          file("o.pfm"), "--stats", file("s.json")};
    if (std::ranges::find(more, "--passes") == more.end()) all.insert(all.end(), {"--passes", "2"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Renders, and returns the picture's bytes.
  std::string picture(const Words& more, std::string* said = nullptr) {
    const Result result = run(words(more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    if (said) *said = result.err;
    return file_text(folder_ / "o.pfm");
  }
  std::uint64_t device_bytes() const {
    return nlohmann::json::parse(file_text(folder_ / "s.json"))["device_memory_bytes"];
  }

  TemporaryFolder folder_;
};

// The least budget is what the refusal of a smaller one says.
TEST_F(CliBudget, LeastThatIsToldSufficesAndMakesTheSamePicture) {
  std::string said;
  const std::string expected = picture({}, &said);
  EXPECT_EQ(said.find("so that it fits"), std::string::npos) << said;
  const std::uint64_t usual = device_bytes();

  const Result refused = run(words({"--memory-budget", "185M"}));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  std::smatch least;
  ASSERT_TRUE(std::regex_search(refused.err, least,
                                std::regex("--width (\\d+), --spp \\d or --memory-budget (\\d+)M "
                                           "would do")))
      << refused.err;
  const int width = std::stoi(least[1]), megabytes = std::stoi(least[2]);
  EXPECT_GT(megabytes, 185);
  EXPECT_TRUE(picture({"--memory-budget", std::to_string(megabytes) + "M"}, &said) == expected);
  EXPECT_NE(said.find("tiles of "), std::string::npos) << said;
  EXPECT_NE(said.find("eye paths traced anew for each pass"), std::string::npos) << said;
  EXPECT_NE(said.find("so that it fits " + std::to_string(megabytes) + " MiB"), std::string::npos)
      << said;
  EXPECT_LT(device_bytes(), usual);
  const std::string one_less = std::to_string(megabytes - 1) + "M";
  EXPECT_EQ(run(words({"--memory-budget", one_less})).exit_code, 1);

  // Before the scene is known that much is.
  const Result hopeless = run(words({"--memory-budget", "1M"}));
  expect_one_error(hopeless, 1, "may take 1 MiB: raise --memory-budget to ");
  ASSERT_TRUE(std::regex_search(hopeless.err, least, std::regex("to (\\d+)M or more\n$")))
      << hopeless.err;
  EXPECT_GT(std::stoi(least[1]), 1);
  EXPECT_LE(std::stoi(least[1]), megabytes);

  // And what else would do.
  const auto narrow = [&](int wide) {
    Words narrower = words({"--memory-budget", "185M"});
    narrower[3] = std::to_string(wide);
    return run(narrower).exit_code;
  };
  EXPECT_EQ(narrow(width), 0);
  EXPECT_EQ(narrow(width + 1), 1);
}

// Begun with much, resumed with little.
TEST_F(CliBudget, ResumedUnderAnotherBudgetItIsTheSamePicture) {
  const std::string expected = picture({"--passes", "4"});
  ASSERT_EQ(run(words({"--checkpoint", file("c")})).exit_code, 0);
  const Result resumed = run({"resume", file("c"), "--passes", "4", "--memory-budget", "230M"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("so that it fits 230 MiB"), std::string::npos) << resumed.err;
  EXPECT_TRUE(file_text(folder_ / "o.pfm") == expected);
}

// Others took the memory that the device had: when the photons' buffers are made, and when the eye
// paths' are.
TEST_F(CliBudget, AllocationsThatFailCostPiecesAndNoPicture) {
  const std::string expected = picture({});
  for (const char* const fault : {"vkAllocateMemory 20 -2", "vkAllocateMemory 42 -2"}) {
    SCOPED_TRACE(fault);
    std::filesystem::remove(folder_ / "o.pfm");
    const Result result = Program(words({}), [&] { load_layer(fault); }).finish();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("warning: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("the rendering goes on with less"), std::string::npos) << result.err;
    EXPECT_TRUE(file_text(folder_ / "o.pfm") == expected);
  }
}

}  // namespace
}  // namespace ppm::test

// A small rendering by the program that keeps a checkpoint, for tests that disturb it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lit_floor.hpp"
#include "program.hpp"
#include "temporary_folder.hpp"

namespace ppm::test {

using Words = std::vector<std::string>;

class KeptRendering : public ::testing::Test {
 protected:
  KeptRendering() { lit_floor().write(folder_ / "s.glb"); }

  std::string path(std::string_view name) const { return (folder_ / name).string(); }
  std::filesystem::path checkpoint() const { return place_ / "c"; }
  std::filesystem::path picture() const { return place_ / "o.exr"; }

  Words render(const Words& more) const {
    Words words = {"render", path("s.glb"), "--width", "16", "--photons", "2000"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// Keeps a checkpoint after each pass and says so.
  Words kept(const Words& more) const {
    Words words = render({"-o", picture(), "--checkpoint", checkpoint(), "--checkpoint-every",
                          "0.0001", "--progress", "json"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Words resume(const Words& more) const {
    Words words = {"resume", checkpoint(), "--progress", "json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string one_go(const Words& more) const {
    Words words = render({"-o", path("whole.exr"), "--quiet"});
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).exit_code, 0);
    return file_text(folder_ / "whole.exr");
  }
  /// Of the checkpoint, which must be sound.
  std::uint64_t kept_passes() const {
    const Result result = run({"info", checkpoint(), "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    if (result.exit_code != 0) return 0;
    return nlohmann::json::parse(result.out)["passes"];
  }

  TemporaryFolder folder_;
  std::filesystem::path place_ = folder_.path();  ///< of the checkpoint "c" and the picture "o.exr"
};

}  // namespace ppm::test

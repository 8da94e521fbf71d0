// Renderings whose disk is full, and that are killed while it is: what was kept before stays sound,
// and once there is space they go on to the same bytes.
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "kept_rendering.hpp"
#include "small_disk.hpp"

namespace ppm::test {
namespace {

constexpr const char* kPasses = "300";
constexpr int kMoments = 5;

class FullDisk : public KeptRendering {
 protected:
  void pause(int most_milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(
        std::uniform_int_distribution<int>(0, most_milliseconds)(random_)));
  }

  /// `fill` leaves the program that runs no space, `free` makes some for the next; each begins with
  /// `in_child`.
  void expect_to_survive(
      const std::function<void(const Program&)>& fill, const std::function<void()>& free,
      const std::function<void()>& in_child = [] {}) {
    const std::string expected = one_go({"--passes", kPasses});
    std::uint64_t passes = 0;
    int killed = 0, told = 0;
    for (int moment = 0; moment < kMoments; ++moment) {
      const bool is_there = std::filesystem::exists(checkpoint());
      Program program(is_there ? resume({}) : kept({"--passes", kPasses}), in_child);
      program.wait_for("\"passes\":");
      pause(40);
      fill(program);
      if (moment % 2 == 0) program.wait_for("the rendering goes on");
      pause(200);
      program.send(SIGKILL);
      const Result result = program.finish();
      // It may have come to its end, without space for the picture.
      EXPECT_TRUE(result.signal == SIGKILL || result.exit_code.value_or(2) <= 1) << result.err;
      killed += result.signal == SIGKILL ? 1 : 0;
      told += result.err.find("the rendering goes on") != std::string::npos ? 1 : 0;
      const std::uint64_t now = kept_passes();
      EXPECT_GE(now, passes);
      passes = now;
      EXPECT_TRUE(!std::filesystem::exists(picture()) || file_text(picture()) == expected);
      free();
    }
    EXPECT_GT(killed, 0);
    EXPECT_GT(told, 0) << "the disk was never full";
    const Result last = run(resume({}));
    EXPECT_EQ(last.exit_code, 0) << last.err;
    EXPECT_TRUE(file_text(picture()) == expected) << "after " << killed << " kills";
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(place_)) {
      names.insert(entry.path().filename().string());
    }
    EXPECT_EQ(names, (std::set<std::string>{"c", "o.exr"}));
  }

 private:
  std::mt19937 random_{std::random_device{}()};
};

TEST_F(FullDisk, KilledOnItTheRenderingGoesOnToTheSameBytes) {
  const SmallDisk disk(folder_ / "disk", "128k");
  if (!disk.is_there()) GTEST_SKIP() << "nothing can be mounted here, even in an own name space";
  place_ = disk.path();
  expect_to_survive([&](const Program&) { disk.fill(); }, [&] { disk.free(); });
}

// Wherever nothing can be mounted: files of more than some bytes find no space.
TEST_F(FullDisk, KilledUnderALimitTheRenderingGoesOnToTheSameBytes) {
  place_ = folder_ / "disk";
  std::filesystem::create_directory(place_);
  const auto fill = [](const Program& program) {
    const rlimit full{1000, 1000};
    EXPECT_EQ(prlimit(program.id(), RLIMIT_FSIZE, &full, nullptr), 0);
  };
  // Mesa would have its own files cut short.
  const auto no_cache = [] { setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); };
  expect_to_survive(
      fill, [] {}, no_cache);
}

}  // namespace
}  // namespace ppm::test

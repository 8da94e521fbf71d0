// Every Vulkan call of a rendering that can fail does so: the rendering ends with one clear line
// (or goes on, where a shortage can be got round), its files are whole, its checkpoint leads to the
// same picture, and nothing is left behind.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "call_watch.hpp"
#include "failure.hpp"
#include "implementation.hpp"
#include "layer_guard.hpp"
#include "rendering_rig.hpp"
#include "source_calls.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace ppm::test {
namespace {

std::unique_ptr<gpu::Device> make_device(bool validation = false) {
  const char* const selector = std::getenv("PPM_TEST_DEVICE");
  return std::make_unique<gpu::Device>(gpu::DeviceOptions{.selector = selector ? selector : "",
                                                          .validation = validation,
                                                          .dispatch_milliseconds = 1000.0});
}

class Faults : public ::testing::Test {
 protected:
  Faults() {
    layer();
#ifdef __SANITIZE_ADDRESS__
    keep_drivers_loaded();
#endif
  }
  void TearDown() override {
    EXPECT_EQ(layer().live(), 0) << "Vulkan objects were left behind";
#ifdef __SANITIZE_ADDRESS__
    EXPECT_EQ(__lsan_do_recoverable_leak_check(), 0) << "memory was left behind";
#endif
  }

  /// LeakSanitizer knows what leaked in drivers and layers only while they are there.
  [[maybe_unused]] static void keep_drivers_loaded() {
    const auto device = make_device(true);
    dl_iterate_phdr(
        [](dl_phdr_info* library, std::size_t, void*) {
          if (*library->dlpi_name)
            dlopen(library->dlpi_name, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
          return 0;
        },
        nullptr);
  }

  /// A rendering with this fault on a device that others use, too.
  void fail(gpu::Device& device, Fault fault, bool resume_after) {
    SCOPED_TRACE(::testing::PrintToString(fault));
    const std::int64_t live = layer().live();
    const std::uint64_t allocated = device.allocated_bytes();
    std::optional<std::string> message;
    for (bool again = true; again;) {
      CallWatch watch(fault);
      watch.wait_idle = [&] { vkDeviceWaitIdle(device.implementation().handle); };
      message = rig_.render(device);
      // On a slow machine the work may have been cut otherwise, with fewer calls.
      const std::uint64_t calls = watch.calls().at(fault.site);
      again = watch.failed().empty() && calls < fault.number;
      if (again) fault.number = calls;
      if (!again) take_in(watch, fault, message);
    }
    EXPECT_EQ(layer().live(), live) << "Vulkan objects were left behind";
    EXPECT_EQ(device.allocated_bytes(), allocated);
    if (fault.result == VK_ERROR_DEVICE_LOST) {
      EXPECT_EQ(rig_.warnings(), std::vector<std::string>{}) << "more than one line";
    }
    rig_.expect_whole_files(!message);
    if (resume_after) rig_.expect_resumable(device);
  }

  /// The same on a device of its own, while it is made, too.
  void fail_from_the_start(const Fault& fault, bool validation) {
    SCOPED_TRACE(::testing::PrintToString(fault));
    const std::int64_t live = layer().live();
    std::optional<std::string> message;
    bool rendered = false;
    {
      CallWatch watch(fault);
      try {
        const auto device = make_device(validation);
        watch.wait_idle = [&] { vkDeviceWaitIdle(device->implementation().handle); };
        rendered = true;
        message = rig_.render(*device);
      } catch (const Failure& failure) {
        message = failure.what();
      }
      take_in(watch, fault, message);
    }
    EXPECT_EQ(layer().live(), live) << "Vulkan objects were left behind";
    if (rendered) rig_.expect_whole_files(!message);
  }

  void take_in(const CallWatch& watch, const Fault& fault,
               const std::optional<std::string>& message) {
    ++runs_;
    ASSERT_FALSE(watch.failed().empty()) << "the call was not reached";
    failed_.insert(watch.failed().begin(), watch.failed().end());
    if (message) {
      EXPECT_TRUE(is_clear(*message, fault.site.call, gpu::result_name(fault.result)));
    } else {
      ++survived_;
      EXPECT_NE(fault.result, VK_ERROR_DEVICE_LOST) << "the rendering went on";
      // Smaller pieces of work may get round too little of the device's memory, without a warning.
      if (fault.result == VK_ERROR_OUT_OF_DEVICE_MEMORY) return;
      const auto& warnings = rig_.warnings();
      EXPECT_TRUE(std::ranges::any_of(warnings, [&](const std::string& warning) {
        return warning.find(gpu::result_name(fault.result)) != std::string::npos;
      })) << "nobody was told";
    }
  }

  static std::map<std::string, std::uint64_t> layer_calls() {
    std::map<std::string, std::uint64_t> calls;
    for (const std::string& name : layer().functions()) calls[name] = layer().calls(name.c_str());
    return calls;
  }

  RenderingRig rig_;
  std::set<Site> failed_;
  unsigned runs_ = 0, survived_ = 0;
};

/// The first, the second and the last of a site's calls, each with all that it may return.
template <class Deed>
void for_each_fault(const Site& site, std::uint64_t calls, const Deed& deed) {
  for (const std::uint64_t number :
       std::set<std::uint64_t>{1, std::min<std::uint64_t>(2, calls), calls}) {
    for (const VkResult result : results_of(site.call)) {
      deed(Fault{.site = site,
                 .number = number,
                 .result = result,
                 .stays = result == VK_ERROR_DEVICE_LOST});
    }
  }
}

// A new call is swept as soon as it goes through the seam, and if it does not this test fails.
TEST(Seam, TakesEveryCallThatCanFail) {
  const SourceCalls calls = read_sources(PPM_HOST_SOURCES);
  EXPECT_GT(calls.checked.size(), 25u);
  EXPECT_GT(calls.direct.size(), 25u);
  for (const auto& [function, place] : calls.direct) {
    EXPECT_TRUE(cannot_fail(function))
        << place << " calls " << function << ", which can fail, past PPM_VK_TRY and PPM_VK_CALL; "
        << "or source_calls.cpp does not know that it cannot";
  }
  for (const auto& [function, place] : calls.pointed) {
    EXPECT_TRUE(cannot_fail(function) || function == "vkSetDebugUtilsObjectNameEXT" ||
                function == "vkCreateDebugUtilsMessengerEXT")
        << place << " has a pointer to " << function << ", which may be called past PPM_VK_TRY_AS";
  }
}

TEST_F(Faults, OfEverySiteOfARenderingAreSurvivedByItsFiles) {
  std::map<Site, std::uint64_t> on_the_way;
  {
    const auto device = make_device();
    rig_.take(*device, "ppm");
    {
      CallWatch watch;
      ASSERT_EQ(rig_.render(*device), std::nullopt);
      on_the_way = watch.calls();
    }
    for (const auto& [site, calls] : on_the_way) {
      std::set<VkResult> resumed;
      for_each_fault(site, calls, [&](const Fault& fault) {
        fail(*device, fault, resumed.insert(fault.result).second);
      });
    }
  }
  // On a device that others used, pipelines and much else is there already.
  std::map<Site, std::uint64_t> from_the_start;
  {
    const auto before = layer_calls();
    CallWatch watch;
    {
      const auto device = make_device();
      ASSERT_EQ(rig_.render(*device), std::nullopt);
    }
    from_the_start = watch.calls();
    // What reaches the driver has gone through the seam. (Loaders and their layers enumerate, too.)
    for (const auto& [function, calls] : layer_calls()) {
      const std::uint64_t below = calls - before.at(function), through = watch.calls_of(function);
      EXPECT_GE(below, through) << function;
      EXPECT_TRUE(below == through || function.starts_with("vkEnumerate")) << function;
    }
  }
  for (const auto& [site, calls] : from_the_start) {
    const std::uint64_t most = on_the_way.contains(site) ? 1 : calls;
    for_each_fault(site, most, [&](const Fault& fault) { fail_from_the_start(fault, false); });
  }
  std::map<Site, std::uint64_t> of_validation;
  {
    CallWatch watch;
    make_device(true);
    of_validation = watch.calls();
  }
  for (const auto& [site, calls] : of_validation) {
    if (failed_.contains(site)) continue;
    for_each_fault(site, calls, [&](const Fault& fault) { fail_from_the_start(fault, true); });
  }

  std::set<std::string> places;
  for (const Site& site : failed_) places.insert(site.file + ":" + std::to_string(site.line));
  EXPECT_EQ(places, read_sources(PPM_HOST_SOURCES).checked) << "sites, and those in the sources";
  std::cout << failed_.size() << " sites, " << runs_ << " renderings with a fault, of which "
            << survived_ << " got round it\n";
  RecordProperty("sites", static_cast<int>(failed_.size()));
  RecordProperty("renderings", static_cast<int>(runs_));
}

// Each buffer and each submission of a method, by the chain of callers that asks for it.
TEST_F(Faults, OnThePathsOfEveryMethodAreSurvivedByItsFiles) {
#ifdef __SANITIZE_ADDRESS__
  constexpr std::size_t kSome = 40;
#else
  constexpr std::size_t kSome = 5;
#endif
  // Every path of ppm and some of each other method's: all of these took half a minute, and were
  // survived.
  const std::size_t stride = std::getenv("PPM_TEST_ALL_PATHS") ? 1 : kSome;
  const auto device = make_device();
  std::set<Path> seen;
  std::size_t all = 0;
  for (const render::Method& method : render::methods()) {
    SCOPED_TRACE(method.name);
    rig_.take(*device, method.name);
    for (const bool resumes : {false, true}) {
      if (resumes) rig_.resume_from_now_on();
      std::vector<std::pair<Path, Site>> paths;
      {
        CallWatch watch(true);
        ASSERT_EQ(rig_.render(*device), std::nullopt);
        paths = watch.paths();
      }
      for (const auto& [path, site] : paths) {
        if (site.call != "vkAllocateMemory" && site.call != "vkQueueSubmit") continue;
        if (!seen.insert(path).second || (all++ % stride != 0 && method.name != "ppm")) continue;
        const VkResult result = results_of(site.call).back();
        const bool stays = result == VK_ERROR_DEVICE_LOST;
        fail(*device, {.site = site, .path = path, .result = result, .stays = stays}, false);
      }
    }
  }
  std::cout << seen.size() << " call paths, " << runs_ << " renderings with a fault, of which "
            << survived_ << " got round it\n";
  RecordProperty("paths", static_cast<int>(seen.size()));
  RecordProperty("renderings", static_cast<int>(runs_));
}

}  // namespace
}  // namespace ppm::test

// A device whose memory runs out at any moment of a rendering: one line that names the buffer, and
// nothing is left behind.
#include <string>

#include "call.hpp"
#include "failure.hpp"
#include "implementation.hpp"
#include "log.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

class Shortage : public RenderTest {
 protected:
  void TearDown() override {
    gpu::fault_injection() = {};
    RenderTest::TearDown();
  }
};

// What happens when call number `call` finds no memory; `failed` is that call, null: there are
// fewer.
std::string outcome(gpu::Device& device, const scene::Scene& scene, std::uint64_t call,
                    const char*& failed) {
  gpu::FaultInjection& injection = gpu::fault_injection();
  injection = {.fail_at = call, .result = VK_ERROR_OUT_OF_DEVICE_MEMORY};
  std::string message;
  try {
    Log log(Verbosity::quiet);
    const auto integrator = render::make_integrator(room_settings(scene), scene, device, log, 1);
    integrator->prepare([] { return false; });
  } catch (const Failure& failure) {
    message = failure.what();
  }
  failed = injection.failed;
  injection = {};
  return message;
}

TEST_F(Shortage, NamesTheBufferAndFreesTheOthers) {
  const scene::Scene scene = load(small_room());
  const std::uint64_t before = device().allocated_bytes();
  unsigned allocations = 0;
  // Calls 7 apart meet every kind in time: those of a buffer are a few.
  for (std::uint64_t call = 5; allocations < 2 && call < 400; call += 7) {
    const char* failed = nullptr;
    const std::string message = outcome(device(), scene, call, failed);
    ASSERT_NE(failed, nullptr) << "call " << call;
    EXPECT_NE(message.find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos) << message;
    EXPECT_EQ(device().allocated_bytes(), before) << failed;
    if (std::string(failed) != "vkAllocateMemory") continue;
    ++allocations;
    if (device().implementation().memory.memoryTypeCount > 1) continue;
    EXPECT_NE(message.find("of the buffer "), std::string::npos) << message;
    EXPECT_NE(message.find("--device"), std::string::npos) << message;
  }
  EXPECT_EQ(allocations, 2u);
}

}  // namespace
}  // namespace ppm::test

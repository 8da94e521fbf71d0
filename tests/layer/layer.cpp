// A Vulkan layer between the program and the driver: counts calls and the objects that live, and
// lets one call fail where the environment says so. It knows nothing of the program's own path of
// calls, which it therefore holds to account.
//
// PPM_TEST_LAYER_FAULT="vkQueueSubmit 7 -4": the 7th vkQueueSubmit of the process returns
// VK_ERROR_DEVICE_LOST without reaching the driver; that one code then stays, as lost devices do.
// PPM_TEST_LAYER_REPORT=FILE: when an instance is destroyed, a line `failed N live M`.
#include "layer.hpp"

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace {

// ---- What is counted

struct Fault {
  std::string call;
  std::uint64_t at = 0;
  VkResult result = VK_SUCCESS;
};

Fault fault_of_environment() {
  Fault fault;
  int result = 0;
  if (const char* const text = std::getenv("PPM_TEST_LAYER_FAULT")) {
    std::istringstream(text) >> fault.call >> fault.at >> result;
    fault.result = static_cast<VkResult>(result);
  }
  return fault;
}

struct Tally {
  std::mutex access;
  std::map<std::string, std::uint64_t, std::less<>> calls;
  std::map<std::string, std::int64_t, std::less<>> live;  // by kind of object
  std::uint64_t failed = 0;
  const Fault fault = fault_of_environment();
};
Tally& tally() {
  static Tally tally;
  return tally;
}

/// Those among the calls of the test that may return it.
bool may_lose_the_device(std::string_view call) {
  constexpr std::string_view kCalls[] = {"vkCreateDevice", "vkQueueSubmit", "vkWaitForFences",
                                         "vkDeviceWaitIdle", "vkGetQueryPoolResults"};
  return std::ranges::find(kCalls, call) != std::end(kCalls);
}

/// Counts the call; whether it is to fail.
bool fails(const char* call) {
  Tally& all = tally();
  const std::scoped_lock lock(all.access);
  const std::uint64_t number = ++all.calls[call];
  const bool due = all.fault.call == call && number == all.fault.at;
  const bool stays = all.failed > 0 && all.fault.result == VK_ERROR_DEVICE_LOST;
  if (!due && !(stays && may_lose_the_device(call))) return false;
  ++all.failed;
  return true;
}

/// "vkCreateBuffer" makes and "vkDestroyBuffer" unmakes a "Buffer". Empty: no object, or one that
/// goes with its pool.
std::string kind_of(std::string_view call) {
  if (call == "vkAllocateCommandBuffers" || call == "vkAllocateDescriptorSets") return "";
  if (call == "vkCreateComputePipelines") return "Pipeline";
  for (const std::string_view deed : {"vkCreate", "vkDestroy", "vkAllocate", "vkFree"}) {
    if (call.starts_with(deed)) return std::string(call.substr(deed.size()));
  }
  return "";
}

void note_life(std::string_view call, int change) {
  const std::string kind = kind_of(call);
  if (kind.empty()) return;
  const std::scoped_lock lock(tally().access);
  tally().live[kind] += change;
}

std::int64_t total_live() {
  const std::scoped_lock lock(tally().access);
  std::int64_t total = 0;
  for (const auto& [kind, count] : tally().live) total += count;
  return total;
}

void report() {
  const char* const file = std::getenv("PPM_TEST_LAYER_REPORT");
  if (!file) return;
  const std::int64_t live = total_live();
  const std::scoped_lock lock(tally().access);
  std::ofstream(file, std::ios::app) << "failed " << tally().failed << " live " << live << '\n';
}

// ---- The chain below, by what an instance's or device's dispatchable handles begin with

struct Chain {
  PFN_vkGetInstanceProcAddr instance_address = nullptr;
  PFN_vkGetDeviceProcAddr device_address = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::map<std::string, PFN_vkVoidFunction, std::less<>> functions;
};
std::mutex chains_access;
std::map<void*, Chain> chains;

template <class Handle>
void* key_of(Handle handle) {
  return *reinterpret_cast<void**>(handle);
}

PFN_vkVoidFunction next(void* key, const char* name) {
  const std::scoped_lock lock(chains_access);
  Chain& chain = chains.at(key);
  PFN_vkVoidFunction& function = chain.functions[name];
  if (!function) {
    function = chain.device ? chain.device_address(chain.device, name)
                            : chain.instance_address(chain.instance, name);
  }
  return function;
}

// ---- Calls that only need to be counted

template <std::size_t N>
struct Text {
  char value[N]{};
  constexpr Text(const char (&text)[N]) { std::copy_n(text, N, value); }
};

template <Text kName, class Function>
struct Hook;

template <Text kName, class Handle, class... Rest>
struct Hook<kName, VkResult(VKAPI_PTR*)(Handle, Rest...)> {
  static VKAPI_ATTR VkResult VKAPI_CALL call(Handle handle, Rest... rest) {
    const auto real =
        reinterpret_cast<VkResult(VKAPI_PTR*)(Handle, Rest...)>(next(key_of(handle), kName.value));
    if (fails(kName.value)) {
      // What a lost device was doing has ended.
      if (std::string_view(kName.value) == "vkDeviceWaitIdle") real(handle, rest...);
      return tally().fault.result;
    }
    const VkResult result = real(handle, rest...);
    if (result >= 0) note_life(kName.value, 1);
    return result;
  }
};

template <Text kName, class Handle, class Object>
struct Hook<kName, void(VKAPI_PTR*)(Handle, Object, const VkAllocationCallbacks*)> {
  using Function = void(VKAPI_PTR*)(Handle, Object, const VkAllocationCallbacks*);
  static VKAPI_ATTR void VKAPI_CALL call(Handle handle, Object object,
                                         const VkAllocationCallbacks* allocator) {
    if (object) note_life(kName.value, -1);
    reinterpret_cast<Function>(next(key_of(handle), kName.value))(handle, object, allocator);
  }
};

// ---- Instances and devices

/// The loader's link to the layer below, in what it adds to the create info.
template <class Link, class Info>
Link* link_of(const Info* info, VkStructureType type) {
  for (auto* link = static_cast<const Link*>(info->pNext); link;
       link = static_cast<const Link*>(link->pNext)) {
    if (link->sType == type && link->function == VK_LAYER_LINK_INFO) return const_cast<Link*>(link);
  }
  return nullptr;
}

/// What lies below this layer, as the loader tells it there; the link is moved on for the next
/// layer. Nothing where the loader tells nothing.
template <class Link, class Info>
std::optional<Chain> chain_below(const Info* info, VkStructureType type) {
  Link* const link = link_of<Link>(info, type);
  if (!link) return std::nullopt;
  auto*& below = link->u.pLayerInfo;
  Chain chain;
  chain.instance_address = below->pfnNextGetInstanceProcAddr;
  if constexpr (std::is_same_v<Link, VkLayerDeviceCreateInfo>) {
    chain.device_address = below->pfnNextGetDeviceProcAddr;
  }
  below = below->pNext;
  return chain;
}

template <class Handle>
void begin_chain(const char* call, Handle handle, Chain chain) {
  note_life(call, 1);
  const std::scoped_lock lock(chains_access);
  chains[key_of(handle)] = std::move(chain);
}

template <class Function, class Handle>
void end_chain(const char* call, Handle handle, const VkAllocationCallbacks* allocator) {
  void* const key = key_of(handle);
  reinterpret_cast<Function>(next(key, call))(handle, allocator);
  note_life(call, -1);
  const std::scoped_lock lock(chains_access);
  chains.erase(key);
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  if (fails("vkCreateInstance")) return tally().fault.result;
  std::optional<Chain> chain =
      chain_below<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (!chain) return VK_ERROR_INITIALIZATION_FAILED;
  const auto real = reinterpret_cast<PFN_vkCreateInstance>(
      chain->instance_address(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = real(info, allocator, instance);
  if (result < 0) return result;
  chain->instance = *instance;
  begin_chain("vkCreateInstance", *instance, std::move(*chain));
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance,
                                            const VkAllocationCallbacks* allocator) {
  if (!instance) return;
  end_chain<PFN_vkDestroyInstance>("vkDestroyInstance", instance, allocator);
  report();
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
  if (fails("vkCreateDevice")) return tally().fault.result;
  std::optional<Chain> chain =
      chain_below<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (!chain) return VK_ERROR_INITIALIZATION_FAILED;
  const auto real = reinterpret_cast<PFN_vkCreateDevice>(next(key_of(physical), "vkCreateDevice"));
  const VkResult result = real(physical, info, allocator, device);
  if (result < 0) return result;
  chain->device = *device;
  begin_chain("vkCreateDevice", *device, std::move(*chain));
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (device) end_chain<PFN_vkDestroyDevice>("vkDestroyDevice", device, allocator);
}

PFN_vkVoidFunction instance_address(VkInstance instance, const char* name);
PFN_vkVoidFunction device_address(VkDevice device, const char* name);

// ---- All that the layer takes part in

const std::map<std::string_view, PFN_vkVoidFunction>& hooks() {
#define PPM_AS(name, function) \
  { name, reinterpret_cast<PFN_vkVoidFunction>(function) }
#define PPM_HOOK(name) PPM_AS(#name, (&Hook<#name, PFN_##name>::call))
  static const std::map<std::string_view, PFN_vkVoidFunction> hooks = {
      PPM_AS("vkGetInstanceProcAddr", instance_address),
      PPM_AS("vkGetDeviceProcAddr", device_address),
      PPM_AS("vkCreateInstance", create_instance),
      PPM_AS("vkDestroyInstance", destroy_instance),
      PPM_AS("vkCreateDevice", create_device),
      PPM_AS("vkDestroyDevice", destroy_device),
      PPM_HOOK(vkEnumeratePhysicalDevices),
      PPM_HOOK(vkEnumerateDeviceExtensionProperties),
      PPM_HOOK(vkCreateDebugUtilsMessengerEXT),
      PPM_HOOK(vkDestroyDebugUtilsMessengerEXT),
      PPM_HOOK(vkSetDebugUtilsObjectNameEXT),
      PPM_HOOK(vkCreateCommandPool),
      PPM_HOOK(vkDestroyCommandPool),
      PPM_HOOK(vkResetCommandPool),
      PPM_HOOK(vkAllocateCommandBuffers),
      PPM_HOOK(vkBeginCommandBuffer),
      PPM_HOOK(vkEndCommandBuffer),
      PPM_HOOK(vkCreateFence),
      PPM_HOOK(vkDestroyFence),
      PPM_HOOK(vkResetFences),
      PPM_HOOK(vkWaitForFences),
      PPM_HOOK(vkQueueSubmit),
      PPM_HOOK(vkDeviceWaitIdle),
      PPM_HOOK(vkCreateQueryPool),
      PPM_HOOK(vkDestroyQueryPool),
      PPM_HOOK(vkGetQueryPoolResults),
      PPM_HOOK(vkCreateDescriptorPool),
      PPM_HOOK(vkDestroyDescriptorPool),
      PPM_HOOK(vkResetDescriptorPool),
      PPM_HOOK(vkAllocateDescriptorSets),
      PPM_HOOK(vkCreateDescriptorSetLayout),
      PPM_HOOK(vkDestroyDescriptorSetLayout),
      PPM_HOOK(vkCreatePipelineLayout),
      PPM_HOOK(vkDestroyPipelineLayout),
      PPM_HOOK(vkCreateShaderModule),
      PPM_HOOK(vkDestroyShaderModule),
      PPM_HOOK(vkCreateComputePipelines),
      PPM_HOOK(vkDestroyPipeline),
      PPM_HOOK(vkCreateBuffer),
      PPM_HOOK(vkDestroyBuffer),
      PPM_HOOK(vkCreateBufferView),
      PPM_HOOK(vkDestroyBufferView),
      PPM_HOOK(vkAllocateMemory),
      PPM_HOOK(vkFreeMemory),
      PPM_HOOK(vkBindBufferMemory),
      PPM_HOOK(vkMapMemory),
  };
#undef PPM_HOOK
#undef PPM_AS
  return hooks;
}

PFN_vkVoidFunction hook_or(PFN_vkVoidFunction below, const char* name) {
  const auto found = hooks().find(name);
  return found == hooks().end() ? below : found->second;
}

PFN_vkVoidFunction instance_address(VkInstance instance, const char* name) {
  if (!instance) return hook_or(nullptr, name);
  const PFN_vkVoidFunction below = next(key_of(instance), name);
  return below ? hook_or(below, name) : nullptr;
}

PFN_vkVoidFunction device_address(VkDevice device, const char* name) {
  const PFN_vkVoidFunction below = next(key_of(device), name);
  return below ? hook_or(below, name) : nullptr;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* negotiation) {
  negotiation->loaderLayerInterfaceVersion = 2;
  negotiation->pfnGetInstanceProcAddr = instance_address;
  negotiation->pfnGetDeviceProcAddr = device_address;
  negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

__attribute__((visibility("default"))) std::uint64_t ppm_layer_calls(const char* call) {
  const std::scoped_lock lock(tally().access);
  const auto found = tally().calls.find(call);
  return found == tally().calls.end() ? 0 : found->second;
}

__attribute__((visibility("default"))) const char* ppm_layer_function(unsigned index) {
  if (index >= hooks().size()) return nullptr;
  return std::next(hooks().begin(), index)->first.data();
}

__attribute__((visibility("default"))) std::int64_t ppm_layer_live(const char* kind) {
  if (*kind == '\0') return total_live();
  const std::scoped_lock lock(tally().access);
  const auto found = tally().live.find(kind);
  return found == tally().live.end() ? 0 : found->second;
}
}

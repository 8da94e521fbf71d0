#include "spirv_reflection.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "failure.hpp"

namespace ppm::gpu {
namespace {

// Numbers from the SPIR-V specification, sections 3.4 to 3.42 (version 1.6).
enum Op : std::uint32_t {
  kExecutionMode = 16,
  kTypeInt = 21,
  kTypeFloat = 22,
  kTypeVector = 23,
  kTypeMatrix = 24,
  kTypeImage = 25,
  kTypeSampledImage = 27,
  kTypeArray = 28,
  kTypeStruct = 30,
  kTypePointer = 32,
  kConstant = 43,
  kFunction = 54,
  kFunctionCall = 57,
  kVariable = 59,
  kImageTexelPointer = 60,
  kLoad = 61,
  kStore = 62,
  kCopyMemory = 63,
  kAccessChain = 65,
  kInBoundsAccessChain = 66,
  kPtrAccessChain = 67,
  kArrayLength = 68,
  kDecorate = 71,
  kMemberDecorate = 72,
  kExecutionModeId = 331,
};
enum Decoration : std::uint32_t {
  kSpecId = 1,
  kArrayStride = 6,
  kMatrixStride = 7,
  kBinding = 33,
  kSet = 34,
  kOffset = 35
};
enum StorageClass : std::uint32_t {
  kUniformConstant = 0,
  kUniform = 2,
  kPushConstant = 9,
  kStorageBuffer = 12
};
constexpr std::uint32_t kLocalSize = 17;
constexpr std::uint32_t kLocalSizeId = 38;
constexpr std::uint32_t kDimBuffer = 5;
constexpr std::uint32_t kMagic = 0x07230203;
constexpr std::size_t kHeaderWords = 5;

using Instruction = std::span<const std::uint32_t>;  // the first word holds length and opcode

std::uint32_t opcode(Instruction instruction) {
  return instruction[0] & 0xffffu;
}

// Everything of the module that the questions need, by id.
struct Module {
  std::map<std::uint32_t, Instruction> definitions;  // types and constants
  std::vector<Instruction> variables;
  std::set<std::uint32_t> used;  // ids that memory instructions of functions name
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> decorations;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<std::uint32_t, std::uint32_t>>
      member_decorations;
  std::uint32_t workgroup_size = 1;
  std::set<std::uint32_t> constants;
};

std::uint32_t last_word(Instruction instruction) {
  return instruction[instruction.size() - 1];
}

void note_use(Module& module, Instruction i) {
  switch (opcode(i)) {
    case kStore:
      module.used.insert(i[1]);
      break;
    case kCopyMemory:
      module.used.insert({i[1], i[2]});
      break;
    case kFunctionCall:
      module.used.insert(i.begin() + 4, i.end());
      break;
    case kLoad:
    case kImageTexelPointer:
    case kAccessChain:
    case kInBoundsAccessChain:
    case kPtrAccessChain:
    case kArrayLength:
      module.used.insert(i[3]);
      break;
    default:
      break;
  }
}

void note_declaration(Module& module, Instruction i, const std::string& name) {
  switch (opcode(i)) {
    case kExecutionModeId:
      PPM_ASSERT(i[2] != kLocalSizeId, "shader " + name + " has a specialised workgroup size");
      break;
    case kExecutionMode:
      if (i[2] != kLocalSize) break;
      PPM_ASSERT(i[4] == 1 && i[5] == 1,
                 "shader " + name + " has a workgroup of more than one dimension");
      module.workgroup_size = i[3];
      break;
    case kTypeInt:
    case kTypeFloat:
    case kTypeVector:
    case kTypeMatrix:
    case kTypeImage:
    case kTypeSampledImage:
    case kTypeArray:
    case kTypeStruct:
    case kTypePointer:
      module.definitions[i[1]] = i;
      break;
    case kConstant:
      module.definitions[i[2]] = i;
      break;
    case kVariable:
      module.variables.push_back(i);
      break;
    case kDecorate:
      module.decorations[i[1]][i[2]] = last_word(i);
      if (i[2] == kSpecId) module.constants.insert(i[3]);
      break;
    case kMemberDecorate:
      module.member_decorations[{i[1], i[2]}][i[3]] = last_word(i);
      break;
    default:
      break;
  }
}

Module parse(std::span<const std::uint32_t> words, const std::string& name) {
  PPM_ASSERT(words.size() > kHeaderWords && words[0] == kMagic,
             "shader " + name + " is not SPIR-V");
  Module module;
  bool in_functions = false;
  for (std::size_t at = kHeaderWords; at < words.size();) {
    const std::size_t length = words[at] >> 16;
    PPM_ASSERT(length > 0 && length <= words.size() - at, "shader " + name + " is cut short");
    const Instruction instruction = words.subspan(at, length);
    in_functions = in_functions || opcode(instruction) == kFunction;
    if (in_functions) {
      note_use(module, instruction);
    } else {
      note_declaration(module, instruction, name);
    }
    at += length;
  }
  return module;
}

// Bytes from the start of a value of this type to its end; `matrix_stride` is its member's, if it
// is a matrix.
std::uint32_t size_of(const Module& module, std::uint32_t type, std::uint32_t matrix_stride) {
  const Instruction i = module.definitions.at(type);
  switch (opcode(i)) {
    case kTypeInt:
    case kTypeFloat:
      return i[2] / 8;
    case kTypeVector:
      return i[3] * size_of(module, i[2], 0);
    case kTypeMatrix:
      return (i[3] - 1) * matrix_stride + size_of(module, i[2], 0);
    case kTypeArray: {
      const std::uint32_t length = module.definitions.at(i[3])[3];
      return (length - 1) * module.decorations.at(type).at(kArrayStride) +
             size_of(module, i[2], matrix_stride);
    }
    default:
      break;
  }
  PPM_ASSERT(opcode(i) == kTypeStruct,
             "opcode " + std::to_string(opcode(i)) + " in a push constant block");
  std::uint32_t end = 0;
  for (std::uint32_t member = 0; member + 2 < i.size(); ++member) {
    const auto& decorations = module.member_decorations.at({type, member});
    const auto stride = decorations.find(kMatrixStride);
    end = std::max(
        end, decorations.at(kOffset) +
                 size_of(module, i[member + 2], stride == decorations.end() ? 0 : stride->second));
  }
  return end;
}

VkDescriptorType descriptor_type(const Module& module, std::uint32_t storage_class,
                                 std::uint32_t type, const std::string& name) {
  if (storage_class == kStorageBuffer) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  if (storage_class == kUniform) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  Instruction image = module.definitions.at(type);
  if (opcode(image) == kTypeSampledImage) image = module.definitions.at(image[2]);
  const bool is_texels = opcode(image) == kTypeImage && image[3] == kDimBuffer && image[7] == 1;
  PPM_ASSERT(is_texels, "shader " + name + " has an image that is no uniform texel buffer");
  return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

}  // namespace

Reflection reflect(std::span<const std::uint32_t> words, const std::string& name) {
  const Module module = parse(words, name);
  Reflection reflection;
  reflection.workgroup_size = module.workgroup_size;
  reflection.constants = module.constants;
  for (const Instruction variable : module.variables) {
    const std::uint32_t id = variable[2], storage_class = variable[3];
    std::uint32_t type = module.definitions.at(variable[1])[3];
    if (storage_class == kPushConstant) reflection.push_bytes = size_of(module, type, 0);
    if (storage_class != kUniformConstant && storage_class != kUniform &&
        storage_class != kStorageBuffer) {
      continue;
    }
    if (!module.used.contains(id)) continue;
    const auto& decorations = module.decorations.at(id);
    const std::uint32_t binding = decorations.at(kBinding);
    PPM_ASSERT(decorations.at(kSet) == 0,
               "shader " + name + " uses set " + std::to_string(decorations.at(kSet)));
    if (const Instruction array = module.definitions.at(type); opcode(array) == kTypeArray) {
      const auto length = module.decorations.find(array[3]);
      PPM_ASSERT(length != module.decorations.end() && length->second.contains(kSpecId),
                 "shader " + name + " has an array of buffers of fixed length");
      reflection.arrays.emplace(binding, length->second.at(kSpecId));
      type = array[2];
    }
    const VkDescriptorType descriptor = descriptor_type(module, storage_class, type, name);
    const auto [entry, is_new] = reflection.bindings.emplace(binding, descriptor);
    PPM_ASSERT(is_new || entry->second == descriptor,
               "shader " + name + " declares binding " + std::to_string(binding) + " in two ways");
  }
  return reflection;
}

}  // namespace ppm::gpu

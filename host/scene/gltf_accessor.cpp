#include "gltf_accessor.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace ppm::scene::gltf {
namespace {

// Zeros need no bytes behind them; a file may not claim more of them than this.
constexpr std::uint64_t kMostUnbacked = std::uint64_t{1} << 24;

std::uint64_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
    case ComponentType::u8:
      return 1;
    case ComponentType::i16:
    case ComponentType::u16:
      return 2;
    case ComponentType::u32:
    case ComponentType::f32:
      return 4;
  }
  return 0;
}

ComponentType component_type_of(const Element& owner) {
  const Element element = owner.require("componentType");
  switch (element.whole()) {
    case 5120:
      return ComponentType::i8;
    case 5121:
      return ComponentType::u8;
    case 5122:
      return ComponentType::i16;
    case 5123:
      return ComponentType::u16;
    case 5125:
      return ComponentType::u32;
    case 5126:
      return ComponentType::f32;
    default:
      element.fail("is not a component type of glTF 2.0", "use 5120 to 5126 but 5124");
  }
}

/// Components per element; 0 for matrices, which nothing here reads.
int components_of(const Element& accessor) {
  const Element type = accessor.require("type");
  constexpr std::array<std::pair<const char*, int>, 7> kTypes{{{"SCALAR", 1},
                                                               {"VEC2", 2},
                                                               {"VEC3", 3},
                                                               {"VEC4", 4},
                                                               {"MAT2", 0},
                                                               {"MAT3", 0},
                                                               {"MAT4", 0}}};
  for (const auto& [name, components] : kTypes) {
    if (type.text() == name) return components;
  }
  type.fail("is not an accessor type", "use SCALAR, VEC2, VEC3 or VEC4");
}

template <typename T>
double load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);  // glTF and the hosts of Vulkan are little-endian
  return static_cast<double>(value);
}

double load_component(const Items& items, std::uint64_t i, int component) {
  const std::uint8_t* at = items.bytes.data() + i * items.stride +
                           static_cast<std::uint64_t>(component) * size_of(items.type);
  switch (items.type) {
    case ComponentType::i8:
      return load<std::int8_t>(at);
    case ComponentType::u8:
      return load<std::uint8_t>(at);
    case ComponentType::i16:
      return load<std::int16_t>(at);
    case ComponentType::u16:
      return load<std::uint16_t>(at);
    case ComponentType::u32:
      return load<std::uint32_t>(at);
    case ComponentType::f32:
      return load<float>(at);
  }
  return 0;
}

double normalized_value(double value, ComponentType type) {
  switch (type) {
    case ComponentType::i8:
      return std::max(value / 127.0, -1.0);
    case ComponentType::u8:
      return value / 255.0;
    case ComponentType::i16:
      return std::max(value / 32767.0, -1.0);
    case ComponentType::u16:
      return value / 65535.0;
    default:
      return value;
  }
}

/// `count` items of `size` bytes, `stride` apart, from `owner`'s bufferView and byteOffset.
Items items_of(const Element& owner, Buffers& buffers, ComponentType type, std::uint64_t count,
               std::uint64_t size, bool may_stride) {
  const Element view = owner.follow("bufferView", "bufferViews");
  const ByteView bytes = buffers.view(view);
  std::uint64_t stride = size;
  if (const std::optional<Element> given = view.find("byteStride"); given && may_stride) {
    stride = given->whole();
    if (stride < size || stride > 252) {
      given->fail("is no stride for elements of " + std::to_string(size) + " bytes",
                  "use a multiple of 4 in [4, 252] that holds an element");
    }
  }
  const std::uint64_t offset = owner.whole_or("byteOffset", 0);
  const std::uint64_t needed = count == 0 ? 0 : (count - 1) * stride + size;
  if (offset > bytes.size() || needed > bytes.size() - offset) {
    owner.fail("needs " + std::to_string(offset + needed) + " bytes of a bufferView of " +
                   std::to_string(bytes.size()),
               "correct count, byteOffset or the bufferView");
  }
  return {bytes.subspan(offset), stride, type};
}

}  // namespace

Accessor::Accessor(const Element& element, Buffers& buffers) : path_(element.path()) {
  count_ = element.require("count").whole();
  if (count_ == 0) element.fail("is empty", "remove it or give it elements");
  components_ = components_of(element);
  if (components_ == 0) element.fail("holds matrices", "use SCALAR, VEC2, VEC3 or VEC4 here");
  normalized_ = element.boolean_or("normalized", false);
  read_base(element, buffers);
  if (const std::optional<Element> sparse = element.find("sparse")) read_sparse(*sparse, buffers);
}

void Accessor::read_base(const Element& element, Buffers& buffers) {
  base_.type = component_type_of(element);
  const std::uint64_t size = size_of(base_.type) * static_cast<std::uint64_t>(components_);
  if (element.find("bufferView")) {
    base_ = items_of(element, buffers, base_.type, count_, size, true);
  } else if (count_ > kMostUnbacked) {
    element.fail("claims " + std::to_string(count_) + " elements without a bufferView",
                 "give it a bufferView");
  }
}

void Accessor::read_sparse(const Element& sparse, Buffers& buffers) {
  sparse_count_ = sparse.require("count").whole();
  if (sparse_count_ > count_)
    sparse.fail("substitutes more elements than there are", "correct count");
  const std::uint64_t size = size_of(base_.type) * static_cast<std::uint64_t>(components_);
  const Element indices = sparse.require("indices");
  const ComponentType type = component_type_of(indices);
  if (type != ComponentType::u8 && type != ComponentType::u16 && type != ComponentType::u32) {
    indices.fail("are not unsigned integers", "use componentType 5121, 5123 or 5125");
  }
  sparse_indices_ = items_of(indices, buffers, type, sparse_count_, size_of(type), false);
  sparse_values_ =
      items_of(sparse.require("values"), buffers, base_.type, sparse_count_, size, false);
  double previous = -1.0;
  for (std::uint64_t i = 0; i < sparse_count_; ++i) {
    const double index = load_component(sparse_indices_, i, 0);
    if (index <= previous || index >= static_cast<double>(count_)) {
      indices.fail("do not increase strictly below the accessor's count", "sort them");
    }
    previous = index;
  }
}

double Accessor::real(std::uint64_t i, int component) const {
  double value = 0.0;
  const Items* items = &base_;
  std::uint64_t position = i;
  if (sparse_count_ > 0) {
    std::uint64_t low = 0, high = sparse_count_;
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (load_component(sparse_indices_, middle, 0) < static_cast<double>(i)) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    if (low < sparse_count_ && load_component(sparse_indices_, low, 0) == static_cast<double>(i)) {
      items = &sparse_values_;
      position = low;
    }
  }
  if (!items->bytes.empty()) value = load_component(*items, position, component);
  return normalized_ ? normalized_value(value, base_.type) : value;
}

}  // namespace ppm::scene::gltf

#include "gltf_accessor.hpp"

#include <algorithm>
#include <cstring>

namespace ppm::scene::gltf {
namespace {

// Zeros need no bytes behind them. But sparse accessors, which are mostly zeros, stand beside
// others of as many elements, which take at least a bit each even where they are compressed. So a
// file may claim these few of them, and some more for each byte of its buffers.
constexpr std::uint64_t kMostUnbacked = std::uint64_t{1} << 12;
constexpr std::uint64_t kMostUnbackedPerByte = 16;

ComponentType component_type_of(const Place& owner, int number) {
  switch (number) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return ComponentType::i8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return ComponentType::u8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return ComponentType::i16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return ComponentType::u16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return ComponentType::u32;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return ComponentType::f32;
    default:
      owner.member("componentType")
          .fail("is not a component type of glTF 2.0", "use 5120 to 5126 but 5124");
  }
}

int components_of(const Element<tinygltf::Accessor>& accessor) {
  switch (accessor->type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      accessor.fail("holds small matrices", "use SCALAR, VEC2, VEC3, VEC4 or MAT4 here");
  }
}

template <typename T>
double load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);  // glTF and the hosts of Vulkan are little-endian
  return static_cast<double>(value);
}

bool may_be_unbacked(const Place& place, std::uint64_t count) {
  std::uint64_t most = kMostUnbacked;
  if (count <= most) return true;
  for (const tinygltf::Buffer& buffer : place.model().buffers) {
    most += kMostUnbackedPerByte * buffer.data.size();
  }
  return count <= most;
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

/// Where the items of an accessor, or of a part of a sparse one, begin.
struct Start {
  Place owner;
  int buffer_view;
  std::uint64_t byte_offset;
};

/// `count` items of `size` bytes from `start`, as far apart as the bufferView says where it may.
Items items_of(const Start& start, ComponentType type, std::uint64_t count, std::uint64_t size,
               bool may_stride) {
  const Place& owner = start.owner;
  const auto view = follow(owner.member("bufferView"), start.buffer_view, owner.model().bufferViews,
                           "bufferViews");
  const ByteView bytes = bytes_of(view);
  std::uint64_t stride = size;
  if (may_stride && view->byteStride != 0) {
    stride = view->byteStride;
    if (stride < size) {
      view.member("byteStride")
          .fail("is no stride for elements of " + std::to_string(size) + " bytes",
                "use a multiple of 4 in [4, 252] that holds an element");
    }
  }
  const std::uint64_t offset = owner.member("byteOffset").size(start.byte_offset);
  const std::uint64_t needed = count == 0 ? 0 : (count - 1) * stride + size;
  if (offset > bytes.size() || needed > bytes.size() - offset) {
    owner.fail("needs " + std::to_string(offset + needed) + " bytes of a bufferView of " +
                   std::to_string(bytes.size()),
               "correct count, byteOffset or the bufferView");
  }
  return {bytes.subspan(offset), stride, type};
}

}  // namespace

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

Accessor::Accessor(const Element<tinygltf::Accessor>& element) : path_(element.path()) {
  count_ = element.member("count").size(element->count);
  if (count_ == 0) element.fail("is empty", "remove it or give it elements");
  components_ = components_of(element);
  normalized_ = element->normalized;
  read_base(element);
  if (element->sparse.isSparse) read_sparse(element);
  is_plain_ = base_.type == ComponentType::f32 && sparse_count_ == 0 && !base_.bytes.empty();
}

Accessor::Accessor(const Element<tinygltf::Accessor>& element, ByteView decoded)
    : path_(element.path()),
      count_(element->count),
      components_(components_of(element)),
      normalized_(element->normalized) {
  base_.type = component_type_of(element, element->componentType);
  base_.bytes = decoded;
  base_.stride = size_of(base_.type) * static_cast<std::uint64_t>(components_);
  is_plain_ = base_.type == ComponentType::f32 && !base_.bytes.empty();
}

void Accessor::read_base(const Element<tinygltf::Accessor>& element) {
  base_.type = component_type_of(element, element->componentType);
  const std::uint64_t size = size_of(base_.type) * static_cast<std::uint64_t>(components_);
  if (element->bufferView != -1) {
    base_ = items_of({element, element->bufferView, element->byteOffset}, base_.type, count_, size,
                     true);
  } else if (!may_be_unbacked(element, count_)) {
    element.fail("claims " + std::to_string(count_) + " elements without a bufferView",
                 "give it a bufferView");
  }
}

void Accessor::read_sparse(const Element<tinygltf::Accessor>& element) {
  const auto& [count, is_sparse, indices, values] = element->sparse;
  const Place sparse = element.member("sparse");
  // What is negative becomes huge here, and is refused as such.
  sparse_count_ = static_cast<std::uint64_t>(count);
  if (sparse_count_ > count_)
    sparse.fail("substitutes more elements than there are", "correct count");
  const std::uint64_t size = size_of(base_.type) * static_cast<std::uint64_t>(components_);
  const Place place = sparse.member("indices");
  const ComponentType type = component_type_of(place, indices.componentType);
  if (type != ComponentType::u8 && type != ComponentType::u16 && type != ComponentType::u32) {
    place.fail("are not unsigned integers", "use componentType 5121, 5123 or 5125");
  }
  sparse_indices_ =
      items_of({place, indices.bufferView, static_cast<std::uint64_t>(indices.byteOffset)}, type,
               sparse_count_, size_of(type), false);
  sparse_values_ = items_of(
      {sparse.member("values"), values.bufferView, static_cast<std::uint64_t>(values.byteOffset)},
      base_.type, sparse_count_, size, false);
  // Many primitives may share one accessor.
  if (!element.document().sound_sparse.insert(path_).second) return;
  double previous = -1.0;
  for (std::uint64_t i = 0; i < sparse_count_; ++i) {
    const double index = load_component(sparse_indices_, i, 0);
    if (index <= previous || index >= static_cast<double>(count_)) {
      place.fail("do not increase strictly below the accessor's count", "sort them");
    }
    previous = index;
  }
}

const Items* Accessor::find(std::uint64_t i, std::uint64_t& position) const {
  position = i;
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
      position = low;
      return &sparse_values_;
    }
  }
  return base_.bytes.empty() ? nullptr : &base_;
}

double Accessor::real(std::uint64_t i, int component) const {
  std::uint64_t position = 0;
  const Items* const items = find(i, position);
  if (!items) return 0.0;
  const double value = load_component(*items, position, component);
  return normalized_ ? normalized_value(value, base_.type) : value;
}

glm::dmat4 Accessor::mat4(std::uint64_t i) const {
  glm::dmat4 matrix;
  for (int component = 0; component < 16; ++component) {
    matrix[component / 4][component % 4] = real(i, component);
  }
  return matrix;
}

}  // namespace ppm::scene::gltf

#include "gltf_meshopt.hpp"

#include <meshoptimizer.h>

namespace ppm::scene::gltf {
namespace {

constexpr const char* kName = "EXT_meshopt_compression";
constexpr const char* kRemedy = "pack the file again";

/// What a stream says of itself.
struct Stream {
  Extension place;
  ByteView bytes;
  std::uint64_t count, stride;
  std::string mode, filter;
};

/// Whether a stream of so many bytes can hold so many elements: what it costs at least follows from
/// the formats. Attributes: two bits for each 16 values of one byte of the elements; triangles: a
/// byte each; indices: a byte each.
bool can_hold(const Stream& stream) {
  const std::uint64_t bytes = stream.bytes.size();
  if (stream.mode == "TRIANGLES") return stream.count / 3 <= bytes;
  if (stream.mode == "INDICES") return stream.count <= bytes;
  return stream.count <= 64 * bytes / stream.stride;
}

void check_attributes(const Stream& stream) {
  const std::uint64_t stride = stream.stride;
  if (stride == 0 || stride > 256 || stride % 4 != 0) {
    stream.place.member("byteStride").fail("is no stride of attributes", "use 4, 8, ... 256");
  }
  const bool is_octahedral = stream.filter == "OCTAHEDRAL";
  const bool is_quaternion = stream.filter == "QUATERNION";
  if (!is_octahedral && !is_quaternion && stream.filter != "NONE" &&
      stream.filter != "EXPONENTIAL") {
    stream.place.member("filter").fail("is not a filter",
                                       "use NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
  }
  if ((is_octahedral && stride != 4 && stride != 8) || (is_quaternion && stride != 8)) {
    stream.place.member("byteStride")
        .fail("does not suit the filter", "use 4 or 8 with OCTAHEDRAL, 8 with QUATERNION");
  }
}

void check_indices(const Stream& stream) {
  if (stream.stride != 2 && stream.stride != 4) {
    stream.place.member("byteStride").fail("is no size of indices", "use 2 or 4");
  }
  if (stream.mode == "TRIANGLES" && stream.count % 3 != 0) {
    stream.place.member("count").fail("is no whole number of triangles", "use a multiple of 3");
  }
  if (stream.filter != "NONE") {
    stream.place.member("filter").fail("filters indices", "use NONE");
  }
}

Stream read_stream(const Extension& extension) {
  const auto buffer = follow(extension.member("buffer"), extension.index("buffer"),
                             extension.model().buffers, "buffers");
  const ByteView whole(buffer->data);
  const std::uint64_t offset = extension.whole("byteOffset", 0);
  const std::uint64_t length = extension.whole("byteLength");
  if (offset > whole.size() || length > whole.size() - offset) {
    extension.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                       std::to_string(whole.size()),
                   "correct byteOffset and byteLength");
  }
  Stream stream{extension,
                whole.subspan(offset, length),
                extension.whole("count"),
                extension.whole("byteStride"),
                extension.text("mode").value_or(""),
                extension.text("filter").value_or("NONE")};
  if (stream.mode == "ATTRIBUTES") {
    check_attributes(stream);
  } else if (stream.mode == "TRIANGLES" || stream.mode == "INDICES") {
    check_indices(stream);
  } else {
    extension.member("mode").fail("is not a mode", "use ATTRIBUTES, TRIANGLES or INDICES");
  }
  return stream;
}

bool unpack(const Stream& stream, std::vector<std::uint8_t>& out) {
  const ByteView in = stream.bytes;
  if (stream.mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(out.data(), stream.count, stream.stride, in.data(),
                                     in.size()) == 0;
  }
  if (stream.mode == "INDICES") {
    return meshopt_decodeIndexSequence(out.data(), stream.count, stream.stride, in.data(),
                                       in.size()) == 0;
  }
  return meshopt_decodeVertexBuffer(out.data(), stream.count, stream.stride, in.data(),
                                    in.size()) == 0;
}

void undo_filter(const Stream& stream, std::vector<std::uint8_t>& bytes) {
  if (stream.filter == "OCTAHEDRAL") {
    meshopt_decodeFilterOct(bytes.data(), stream.count, stream.stride);
  } else if (stream.filter == "QUATERNION") {
    meshopt_decodeFilterQuat(bytes.data(), stream.count, stream.stride);
  } else if (stream.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(bytes.data(), stream.count, stream.stride);
  }
}

}  // namespace

std::optional<std::vector<std::uint8_t>> unpacked_bytes(const Element<tinygltf::BufferView>& view) {
  const auto extension = Extension::find(view, view->extensions, kName);
  if (!extension) return std::nullopt;
  const Stream stream = read_stream(*extension);
  if (!can_hold(stream)) {
    extension->fail("claims " + std::to_string(stream.count) + " elements in " +
                        std::to_string(stream.bytes.size()) + " bytes, which cannot hold them",
                    kRemedy);
  }
  const std::uint64_t size = stream.count * stream.stride;
  if (size < view.member("byteLength").size(view->byteLength)) {
    extension->fail("unpacks to " + std::to_string(size) + " bytes, fewer than its bufferView's",
                    "correct count, byteStride or byteLength");
  }
  view.document().claim_decoded(size, 0);
  std::vector<std::uint8_t> bytes(size);
  if (!unpack(stream, bytes)) extension->fail("its stream is corrupt", kRemedy);
  undo_filter(stream, bytes);
  return bytes;
}

}  // namespace ppm::scene::gltf

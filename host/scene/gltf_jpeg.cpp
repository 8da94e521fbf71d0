#include "gltf_jpeg.hpp"

// jpeglib.h needs FILE and size_t but does not include them.
#include <csetjmp>
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

namespace ppm::scene::gltf {
namespace {

constexpr int kMostScans = 200;  // a progressive file of a few KB can ask for hours of them
constexpr int kChannels = 4;

/// One file being decompressed. libjpeg reports errors by a function that must not return; here it
/// jumps back to the member that called, so between setjmp and there no object with a destructor
/// may be made.
class Decompressor {
 public:
  explicit Decompressor(std::span<const std::uint8_t> file) : file_(file) {
    state_.err = jpeg_std_error(&errors_);
    errors_.error_exit = [](j_common_ptr state) { give_up(state); };
    errors_.emit_message = [](j_common_ptr state, int level) {
      if (level < 0) ++state->err->num_warnings;
    };
    state_.client_data = &jump_;
    progress_.progress_monitor = [](j_common_ptr state) {
      if (reinterpret_cast<j_decompress_ptr>(state)->input_scan_number > kMostScans) give_up(state);
    };
  }
  ~Decompressor() { jpeg_destroy_decompress(&state_); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;

  bool read_header() {
    if (setjmp(jump_) != 0) return false;
    jpeg_create_decompress(&state_);
    state_.progress = &progress_;
    jpeg_mem_src(&state_, file_.data(), file_.size());
    return jpeg_read_header(&state_, TRUE) == JPEG_HEADER_OK;
  }

  /// `rgba` has room for width() * height() texels.
  bool read_texels(std::uint8_t* rgba) {
    if (setjmp(jump_) != 0) return false;
    state_.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&state_);
    while (state_.output_scanline < state_.output_height) {
      JSAMPROW row = rgba + std::size_t{state_.output_scanline} * state_.output_width * kChannels;
      jpeg_read_scanlines(&state_, &row, 1);
    }
    jpeg_finish_decompress(&state_);
    return true;
  }

  std::uint32_t width() const { return state_.image_width; }
  std::uint32_t height() const { return state_.image_height; }
  bool damaged() const { return errors_.num_warnings > 0; }

 private:
  [[noreturn]] static void give_up(j_common_ptr state) {
    std::longjmp(*static_cast<std::jmp_buf*>(state->client_data), 1);
  }

  std::span<const std::uint8_t> file_;
  jpeg_decompress_struct state_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf jump_{};
};

}  // namespace

std::optional<JpegSize> jpeg_size(std::span<const std::uint8_t> file) {
  if (file.size() < 2 || file[0] != 0xff || file[1] != 0xd8) return std::nullopt;
  Decompressor decompressor(file);
  if (!decompressor.read_header()) return std::nullopt;
  return JpegSize{decompressor.width(), decompressor.height()};
}

std::optional<JpegTexels> decode_jpeg(std::span<const std::uint8_t> file) {
  Decompressor decompressor(file);
  if (!decompressor.read_header()) return std::nullopt;
  JpegTexels texels;
  texels.rgba.resize(std::size_t{decompressor.width()} * decompressor.height() * kChannels);
  if (!decompressor.read_texels(texels.rgba.data())) return std::nullopt;
  texels.damaged = decompressor.damaged();
  return texels;
}

}  // namespace ppm::scene::gltf

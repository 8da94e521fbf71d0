#include "rendering_rig.hpp"

#include <gtest/gtest.h>

#include "checkpoint.hpp"
#include "failure.hpp"
#include "gltf_writer.hpp"
#include "layers.hpp"
#include "load_gltf.hpp"

namespace ppm::test {
namespace {

constexpr std::uint64_t kPasses = 3, kOldPasses = 1;
const char* const kPicture = "o.exr";
const char* const kCheckpoint = "c";
const char* const kPreview = "v.pfm";

/// A floor below a ball of glass, and a lamp.
scene::Scene lit_glass() {
  GltfWriter writer;
  writer.mesh(quad({-1.0f, 0.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}),
              writer.material(lambert(glm::dvec3(0.5))));
  writer.mesh(quad({-0.3f, 1.2f, -0.3f}, {0.6f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.6f}),
              writer.material(emitter({8.0, 7.0, 6.0})));
  writer.mesh(icosphere(1), writer.material(glass(1.5, {0.7, 0.9, 0.8}, 0.5)),
              placed({0.0, 0.4, 0.0}, 0.3));
  writer.camera("above", {0.0, 1.0, 1.5}, {0.0, 0.2, 0.0}, 1.0);
  const TemporaryFolder folder;
  writer.write(folder / "s.glb");
  Log log(Verbosity::quiet);
  return scene::load_gltf(folder / "s.glb", log);
}

}  // namespace

RenderingRig::RenderingRig() : scene_(lit_glass()) {
  settings_.width = 12;
  settings_.height = 8;
  settings_.samples_per_pixel = 2;
  settings_.photons_per_pass = 600;
  settings_.map_photons = 4000;
  settings_.nearest = 10;
  settings_.mlt_chains = 32;
  settings_.tile_hits = 100;        // several of them
  settings_.photon_capacity = 600;  // a pass takes several times
  settings_.camera = scene_.cameras.at(0);
}

void RenderingRig::take(gpu::Device& device, std::string_view method) {
  resumes_ = false;
  settings_.integrator = method;
  std::filesystem::remove(folder_ / kCheckpoint);
  previews_.clear();
  for (std::uint64_t passes = 0; passes <= kPasses; ++passes) {
    run(device, passes, false);
    previews_.insert(text(kPreview));
    if (passes == kOldPasses) {
      old_picture_ = text(kPicture);
      old_checkpoint_ = text(kCheckpoint);
      old_preview_ = text(kPreview);
    }
  }
  whole_picture_ = text(kPicture);
  run(device, kPasses, false, false);
  bare_picture_ = text(kPicture);
  ASSERT_NE(whole_picture_, bare_picture_);
  ASSERT_NE(whole_picture_, old_picture_);
}

void RenderingRig::run(gpu::Device& device, std::uint64_t passes, bool resumes, bool with_layers) {
  render::Outputs outputs;
  outputs.pictures = {folder_ / kPicture};
  if (with_layers) {
    for (const render::LayerFacts& facts : render::all_layers()) {
      if (render::method_has_layer(settings_.integrator, facts.kind)) {
        outputs.layers.push_back(facts.kind);
      }
    }
  }
  outputs.keeping = {folder_ / kCheckpoint, 0.0, {"s.glb"}, {{"scene", 1}}};
  outputs.preview = folder_ / kPreview;
  outputs.preview_seconds = 1e9;  // after the first pass and at the end, however long they take
  render::Circumstances circumstances;
  circumstances.program = "ppm-vk test";
  circumstances.scene = "s.glb";
  circumstances.device_memory_bytes = [&] { return device.peak_bytes(); };
  std::optional<render::Checkpoint> checkpoint;
  if (resumes) checkpoint = render::read_checkpoint(folder_ / kCheckpoint);
  log_ = Log(Verbosity::quiet);
  const auto integrator = render::make_integrator(settings_, scene_, device, log_, 1);
  render::drive(*integrator, settings_, {passes, {}}, outputs, circumstances, interruption_, log_,
                checkpoint ? &*checkpoint : nullptr);
}

std::optional<std::string> RenderingRig::render(gpu::Device& device) {
  write_text(folder_ / kPicture, old_picture_);
  write_text(folder_ / kPreview, old_preview_);
  std::filesystem::remove(folder_ / kCheckpoint);
  if (resumes_) write_text(folder_ / kCheckpoint, old_checkpoint_);
  try {
    run(device, kPasses, resumes_);
    return std::nullopt;
  } catch (const Failure& failure) {
    return failure.what();
  }
}

void RenderingRig::expect_whole_files(bool complete) const {
  std::set<std::string> names = folder_.names();
  const bool is_kept = names.erase(kCheckpoint) > 0;
  EXPECT_EQ(names, (std::set<std::string>{kPicture, kPreview}));
  EXPECT_TRUE(is_kept || (!complete && !resumes_)) << "the checkpoint is gone";
  const Bytes picture = text(kPicture), preview = text(kPreview);
  EXPECT_TRUE(picture == whole_picture_ ||
              (!complete && (picture == old_picture_ || picture == bare_picture_)))
      << "a picture of " << picture.size() << " bytes";
  EXPECT_TRUE(preview == old_preview_ || previews_.contains(preview))
      << "a preview of " << preview.size() << " bytes";
  if (!is_kept) return;
  const render::Checkpoint checkpoint = render::read_checkpoint(folder_ / kCheckpoint);
  EXPECT_GE(checkpoint.statistics.passes, resumes_ ? kOldPasses : 0);
  EXPECT_LE(checkpoint.statistics.passes, kPasses);
  if (complete) {
    EXPECT_EQ(checkpoint.statistics.passes, kPasses);
  }
}

void RenderingRig::expect_resumable(gpu::Device& device) {
  if (!folder_.names().contains(kCheckpoint)) return;
  run(device, kPasses, true);
  EXPECT_TRUE(text(kPicture) == whole_picture_) << "resumed, it is another picture";
}

::testing::AssertionResult is_clear(const std::string& message, const std::string& call,
                                    const std::string& result) {
  const std::string cause = call + ": " + result;
  const std::size_t found = message.find(cause);
  ::testing::AssertionResult failure = ::testing::AssertionFailure() << "\"" << message << "\" ";
  if (found == std::string::npos) return failure << "does not name " << cause;
  if (message.find('\n') != std::string::npos) return failure << "is several lines";
  const std::size_t remedy = message.find(": ", found + cause.size());
  if (remedy == std::string::npos || message.size() < remedy + 20) {
    return failure << "does not say what would mend it";
  }
  return ::testing::AssertionSuccess();
}

}  // namespace ppm::test

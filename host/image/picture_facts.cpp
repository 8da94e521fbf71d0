#include "picture_facts.hpp"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <string_view>

#include "failure.hpp"
#include "input_file.hpp"

namespace ppm::image {
namespace {

constexpr std::string_view kPrefix = "ppm-vk:";
constexpr const char* kRemedy = "name a checkpoint or an .exr of ppm-vk";

}  // namespace

PictureFacts read_facts(const std::filesystem::path& file) {
  const std::string why = why_unreadable(file);
  if (!why.empty()) throw Failure(file.string(), "", why, kRemedy);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
  if (!input) throw Failure(file.string(), "cannot read the picture", OIIO::geterror(), kRemedy);
  const OIIO::ImageSpec& spec = input->spec();
  PictureFacts facts{
      static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), {}, {}};
  for (int channel = 0; channel < spec.nchannels; ++channel) {
    facts.channels.emplace_back(spec.channel_name(channel), spec.channelformat(channel).c_str());
  }
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    const std::string name = attribute.name().string();
    if (!name.starts_with(kPrefix)) continue;
    if (attribute.type() == OIIO::TypeDesc::STRING) {
      facts.attributes.emplace_back(name, attribute.get_string());
    } else if (attribute.type() == OIIO::TypeDesc::INT) {
      facts.attributes.emplace_back(name, attribute.get_int());
    } else if (attribute.type() == OIIO::TypeDesc::DOUBLE) {
      facts.attributes.emplace_back(name, *static_cast<const double*>(attribute.data()));
    }
  }
  if (facts.attributes.empty()) {
    throw Failure(file.string(), "", "was not written by ppm-vk", kRemedy);
  }
  return facts;
}

}  // namespace ppm::image

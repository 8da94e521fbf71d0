#include "gltf_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "failure.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr double kLargestWhole = 281474976710656.0;  // 2^48
constexpr int kDeepestNesting = 256;                 // glTF itself needs about ten
constexpr std::size_t kLongestPrintable = 100;
constexpr std::size_t kMostListed = 10;

std::string quoted(std::string_view key) {
  return "\"" + std::string(key) + "\"";
}

bool nested_too_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestNesting) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

std::string without_library_prefix(std::string message) {
  const std::size_t end = message.find("] ");
  return printable(end == std::string::npos ? message : message.substr(end + 2));
}

constexpr std::array kKnownExtensions{
    "KHR_materials_specular",          "KHR_materials_ior",
    "KHR_materials_transmission",      "KHR_materials_volume",
    "KHR_materials_emissive_strength", "KHR_lights_punctual",
    "KHR_mesh_quantization",
};

bool is_known_extension(std::string_view name) {
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) !=
         kKnownExtensions.end();
}

/// Every name that stands as a member of some "extensions" object.
std::set<std::string> extensions_in(const nlohmann::json& root) {
  std::set<std::string> names;
  std::vector<const nlohmann::json*> pending{&root};
  while (!pending.empty()) {
    const nlohmann::json& value = *pending.back();
    pending.pop_back();
    if (!value.is_structured()) continue;
    for (const auto& [key, member] : value.items()) {
      if (key == "extras") continue;
      if (key == "extensions" && member.is_object()) {
        for (const auto& [name, unused] : member.items()) names.insert(name);
      }
      if (member.is_structured()) pending.push_back(&member);
    }
  }
  return names;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result(text.substr(0, kLongestPrintable));
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  if (text.size() > kLongestPrintable) result += "...";
  return result;
}

std::optional<Element> Element::find(std::string_view key) const {
  if (!value_->is_object()) fail("is not a JSON object", "write {...} here");
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return Element(*origin_, *member,
                 path_.empty() ? std::string(key) : path_ + "." + std::string(key));
}

Element Element::require(std::string_view key) const {
  if (std::optional<Element> member = find(key)) return *member;
  fail("has no " + quoted(key), "add it, glTF requires it");
}

std::optional<Element> Element::extension(std::string_view name) const {
  const std::optional<Element> extensions = find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::uint32_t Element::as_index(std::string_view array) const {
  const std::uint64_t position = whole();
  const std::optional<Element> items = top_level(*origin_, array);
  const std::size_t count = items ? items->size() : 0;
  if (position >= count || position > std::numeric_limits<std::uint32_t>::max()) {
    fail("refers to " + std::string(array) + "[" + std::to_string(position) +
             "], but the file has " + std::to_string(count) + " of them",
         "use an index below that");
  }
  return static_cast<std::uint32_t>(position);
}

std::uint32_t Element::index(std::string_view key, std::string_view array) const {
  return require(key).as_index(array);
}

Element Element::follow(std::string_view key, std::string_view array) const {
  const std::uint32_t position = index(key, array);
  return (*top_level(*origin_, array))[position];
}

std::size_t Element::size() const {
  if (!value_->is_array()) fail("is not a JSON array", "write [...] here");
  return value_->size();
}

Element Element::operator[](std::size_t position) const {
  PPM_ASSERT(position < size(), path_ + " has no item " + std::to_string(position));
  return Element(*origin_, (*value_)[position], path_ + "[" + std::to_string(position) + "]");
}

double Element::number() const {
  if (!value_->is_number()) fail("is not a number", "write a number here");
  const double value = value_->get<double>();
  if (!std::isfinite(value)) fail("is not a finite number", "write a finite number here");
  return value;
}

std::uint64_t Element::whole() const {
  const double value = number();
  if (!(value >= 0.0 && value <= kLargestWhole) || value != std::floor(value)) {
    fail("is not a whole number in the range that glTF allows",
         "write a non-negative whole number");
  }
  return static_cast<std::uint64_t>(value);
}

bool Element::boolean() const {
  if (!value_->is_boolean()) fail("is not a boolean", "write true or false here");
  return value_->get<bool>();
}

const std::string& Element::text() const {
  if (!value_->is_string()) fail("is not a string", "write a string here");
  return value_->get_ref<const std::string&>();
}

void Element::numbers(std::span<double> out) const {
  if (size() != out.size()) {
    fail("has " + std::to_string(size()) + " items",
         "write " + std::to_string(out.size()) + " numbers");
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*this)[i].number();
}

double Element::number_or(std::string_view key, double otherwise) const {
  const std::optional<Element> member = find(key);
  return member ? member->number() : otherwise;
}

std::uint64_t Element::whole_or(std::string_view key, std::uint64_t otherwise) const {
  const std::optional<Element> member = find(key);
  return member ? member->whole() : otherwise;
}

bool Element::boolean_or(std::string_view key, bool otherwise) const {
  const std::optional<Element> member = find(key);
  return member ? member->boolean() : otherwise;
}

std::string Element::name() const {
  const std::optional<Element> member = find("name");
  return member ? printable(member->text()) : std::string();
}

double Element::clamped(std::string_view key, double value, double low, double high) const {
  if (value >= low && value <= high) return value;
  warn("range of " + std::string(key), "lies outside its range and was clamped to it");
  return std::clamp(value, low, high);
}

float Element::factor(std::string_view key, double otherwise, double low, double high) const {
  const std::optional<Element> member = find(key);
  if (!member) return static_cast<float>(otherwise);
  return static_cast<float>(member->clamped(key, member->number(), low, high));
}

void Element::factors(std::string_view key, std::span<float> out, double low, double high) const {
  const std::optional<Element> member = find(key);
  if (!member) return;
  std::vector<double> values(out.size());
  member->numbers(values);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<float>(member->clamped(key, values[i], low, high));
  }
}

void Element::fail(std::string_view what_is_wrong, std::string_view remedy) const {
  throw Failure(origin_->file, path_, what_is_wrong, remedy);
}

void Element::warn(std::string_view kind, std::string_view text) const {
  if (!origin_->warned.emplace(kind).second) return;
  origin_->log->warn(origin_->file + ": " + path_ + ": " + std::string(text));
}

std::optional<Element> top_level(Origin& origin, std::string_view array) {
  return Element(origin, *origin.root, "").find(array);
}

nlohmann::json parse_json(std::string_view text, const std::string& file) {
  if (nested_too_deep(text)) {
    throw Failure(file, "", "its JSON is nested deeper than any glTF", "check the file");
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw Failure(file, "", "its JSON cannot be read: " + without_library_prefix(error.what()),
                  "export the file again");
  }
}

void check_extensions(Origin& origin) {
  const Element root(origin, *origin.root, "");
  if (const std::optional<Element> required = root.find("extensionsRequired")) {
    for (std::size_t i = 0; i < required->size(); ++i) {
      const Element item = (*required)[i];
      if (!is_known_extension(item.text())) {
        item.fail("the file requires the extension " + printable(item.text()) +
                      ", which this program does not know",
                  "export the file without it");
      }
    }
  }
  std::set<std::string> names = extensions_in(*origin.root);
  if (const std::optional<Element> used = root.find("extensionsUsed")) {
    for (std::size_t i = 0; i < used->size(); ++i) names.insert((*used)[i].text());
  }
  std::erase_if(names, [](const std::string& name) { return is_known_extension(name); });
  if (names.empty()) return;
  std::string list;
  std::size_t listed = 0;
  for (const std::string& name : names) {
    if (++listed > kMostListed) break;
    list += (list.empty() ? "" : ", ") + printable(name);
  }
  if (names.size() > kMostListed) list += " and more";
  origin.log->warn(origin.file + ": unknown extensions are ignored: " + list);
}

}  // namespace ppm::scene::gltf

#include "gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <new>

#include "failure.hpp"
#include "gltf_container.hpp"
#include "gltf_gate.hpp"
#include "gltf_mending.hpp"
#include "gltf_meshopt.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kLargestSize = std::uint64_t{1} << 48;
constexpr std::size_t kLongestPrintable = 200;
constexpr std::size_t kMostListed = 10;
std::string item_of(const std::string& array, std::size_t position) {
  return array + "[" + std::to_string(position) + "]";
}

/// Called for every image. `bytes` may point anywhere where the image lies in a bufferView.
bool keep_encoded(tinygltf::Image* image, int, std::string* error, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView != -1) return true;
  if (size < 0) {
    *error += "an image is larger than 2 GiB";
    return false;
  }
  image->image.assign(bytes, bytes + size);
  return true;
}

/// tinygltf asks with URIs alone (its base directory is empty) and learns by reading whether it
/// may.
tinygltf::FsCallbacks callbacks_for(Surroundings& surroundings) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& uri, void*) { return uri; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string* error,
                               const std::string& uri, void* user) {
    *error = static_cast<Surroundings*>(user)->read(uri, *bytes);
    return error->empty();
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
  callbacks.user_data = &surroundings;
  return callbacks;
}

/// Where tinygltf stopped: behind what the model holds already. The order is that of its parser.
std::string stopped_at(const tinygltf::Model& model, const Survey& survey,
                       const std::string& error) {
  const std::array<std::pair<const char*, std::size_t>, 13> read{{
      {"buffers", model.buffers.size()},
      {"bufferViews", model.bufferViews.size()},
      {"accessors", model.accessors.size()},
      {"meshes", model.meshes.size()},
      {"nodes", model.nodes.size()},
      {"scenes", model.scenes.size()},
      {"materials", model.materials.size()},
      {"images", model.images.size()},
      {"textures", model.textures.size()},
      {"animations", model.animations.size()},
      {"skins", model.skins.size()},
      {"samplers", model.samplers.size()},
      {"cameras", model.cameras.size()},
  }};
  for (const auto& [array, count] : read) {
    const auto length = survey.lengths.find(array);
    if (length == survey.lengths.end() || count >= length->second) continue;
    // It looks into the accessors of indices when all meshes are read.
    const bool is_of_indices = array == std::string_view("nodes") && !error.starts_with("`nodes'");
    return is_of_indices ? "meshes" : item_of(array, count);
  }
  return item_of("extensions.KHR_lights_punctual.lights", model.lights.size());
}

/// Its complaints end in line breaks; the first is the cause of the others.
std::string first_line(const std::string& text) {
  return printable(text.substr(0, text.find('\n')));
}

tinygltf::Model parse(const std::vector<unsigned char>& bytes, bool is_binary,
                      const std::filesystem::path& file, const Survey& survey) {
  Surroundings surroundings(file.parent_path(), survey.external_lengths);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks(callbacks_for(surroundings));
  parser.SetImageLoader(keep_encoded, nullptr);
  tinygltf::Model model;
  std::string error, warning;  // of images that are missing, which matter only where they are used
  bool succeeded = false;
  try {
    const auto size = static_cast<unsigned int>(bytes.size());
    succeeded =
        is_binary
            ? parser.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size)
            : parser.LoadASCIIFromString(&model, &error, &warning,
                                         reinterpret_cast<const char*>(bytes.data()), size, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    error += exception.what();
  }
  if (!succeeded || !error.empty()) {
    const std::string place = succeeded ? "" : stopped_at(model, survey, error);
    throw Failure(file.string(), place, first_line(error), "export it again, or see glTF 2.0");
  }
  return model;
}

/// What the file uses, by name, as the table treats it.
std::vector<UsedExtension> used_extensions(const std::set<std::string>& names,
                                           const std::vector<std::string>& required) {
  std::vector<UsedExtension> used;
  for (const std::string& name : names) {
    const ExtensionEntry* entry = find_extension(name);
    used.push_back({printable(name), std::ranges::find(required, name) != required.end(),
                    entry ? entry->treatment : Treatment::ignored,
                    std::string(entry ? entry->note : "")});
  }
  return used;
}

void refuse_required(Document& document) {
  const auto& required = document.model.extensionsRequired;
  for (std::size_t i = 0; i < required.size(); ++i) {
    const ExtensionEntry* entry = find_extension(required[i]);
    if (entry && entry->treatment != Treatment::ignored) continue;
    Place(document, "extensionsRequired")
        .item(i)
        .fail("the file requires the extension " + printable(required[i]) +
                  ", which this program " + (entry ? "does not implement" : "does not know"),
              "export the file without it");
  }
}

void warn_of_ignored(const Document& document) {
  std::string list;
  std::size_t listed = 0;
  for (const UsedExtension& extension : document.extensions) {
    if (extension.treatment != Treatment::ignored) continue;
    if (++listed > kMostListed) break;
    list += (list.empty() ? "" : ", ") + extension.name;
    if (!extension.note.empty()) list += " (" + extension.note + ")";
  }
  if (listed == 0) return;
  if (listed > kMostListed) list += " and more";
  document.log->warn(document.file + ": extensions are ignored: " + list);
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

Document read_document(const std::filesystem::path& file, Log& log) {
  std::vector<unsigned char> bytes = read_container(file);
  const JsonText json = json_text(bytes, file.string());
  const Survey found = survey(json.text, json.is_binary, file.string());
  if (found.mended_json) {
    bytes = json.is_binary
                ? with_json_chunk(bytes, *found.mended_json)
                : std::vector<unsigned char>(found.mended_json->begin(), found.mended_json->end());
  }
  Document document{
      file.string(), parse(bytes, json.is_binary, file, found), &log, {}, {}, {}, {}, {}, {}};
  refuse_required(document);
  document.extensions = used_extensions(found.extensions, document.model.extensionsRequired);
  warn_of_ignored(document);
  for (const tinygltf::Buffer& buffer : document.model.buffers) {
    document.size.file_bytes += buffer.data.size();
  }
  for (const tinygltf::Image& image : document.model.images) {
    document.size.file_bytes += image.image.size();
  }
  if (found.has_animations) {
    Place(document, "animations").warn("animations", "animations are ignored");
  }
  return document;
}

Place Place::member(std::string_view key) const {
  return {*document_, path_.empty() ? std::string(key) : path_ + "." + std::string(key)};
}

Place Place::item(std::size_t position) const {
  return {*document_, item_of(path_, position)};
}

void Place::fail(std::string_view what_is_wrong, std::string_view remedy) const {
  throw Failure(document_->file, path_, what_is_wrong, remedy);
}

void Place::warn(std::string_view kind, std::string_view text) const {
  if (!document_->warned.emplace(kind).second) return;
  document_->log->warn(document_->file + ": " + path_ + ": " + std::string(text));
}

std::string Place::last_key() const {
  return path_.substr(path_.rfind('.') + 1);
}

double Place::clamped(double value, double low, double high) const {
  if (value >= low && value <= high) return value;
  warn("range of " + last_key(), "lies outside its range and was clamped to it");
  return std::clamp(value, low, high);
}

void Place::clamped(const std::vector<double>& values, std::span<float> out, double low,
                    double high) const {
  check_length(values.size(), out.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<float>(clamped(values[i], low, high));
  }
}

std::uint64_t Place::size(std::uint64_t value) const {
  if (value > kLargestSize) fail("is larger than any file", "correct it");
  return value;
}

void Place::check_length(std::size_t actual, std::size_t expected) const {
  if (actual == expected) return;
  fail("has " + std::to_string(actual) + " items", "write " + std::to_string(expected));
}

ByteView bytes_of(const Element<tinygltf::BufferView>& view) {
  const auto position = static_cast<int>(&*view - view.model().bufferViews.data());
  std::map<int, std::vector<std::uint8_t>>& known = view.document().unpacked;
  if (const auto entry = known.find(position); entry != known.end()) return entry->second;
  if (auto unpacked = unpacked_bytes(view)) {
    return known.emplace(position, std::move(*unpacked)).first->second;
  }
  const auto buffer = follow(view.member("buffer"), view->buffer, view.model().buffers, "buffers");
  const ByteView bytes(buffer->data);
  const std::uint64_t offset = view.member("byteOffset").size(view->byteOffset);
  const std::uint64_t length = view.member("byteLength").size(view->byteLength);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    view.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                  std::to_string(bytes.size()),
              "correct byteOffset and byteLength");
  }
  return bytes.subspan(offset, length);
}

std::optional<Extension> Extension::find(const Place& owner,
                                         const tinygltf::ExtensionMap& extensions,
                                         const std::string& name) {
  const auto extension = extensions.find(name);
  if (extension == extensions.end() || !extension->second.IsObject()) return std::nullopt;
  return Extension(owner.member("extensions").member(name),
                   extension->second.Get<tinygltf::Value::Object>());
}

std::optional<double> Extension::number(const std::string& key) const {
  const auto found = members_->find(key);
  if (found == members_->end()) return std::nullopt;
  if (!found->second.IsNumber()) member(key).fail("is not a number", "write a number here");
  return found->second.GetNumberAsDouble();
}

std::optional<std::string> Extension::text(const std::string& key) const {
  const auto found = members_->find(key);
  if (found == members_->end()) return std::nullopt;
  if (!found->second.IsString()) member(key).fail("is not a string", "write a string here");
  return found->second.Get<std::string>();
}

namespace {

int index_in(const Place& place, const tinygltf::Value& value) {
  // tinygltf keeps integers in 32 bits; the gate has refused longer ones.
  const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
  if (!(number >= 0.0 && number <= 2147483647.0) || number != std::floor(number)) {
    place.fail("is not a whole number of at most 2^31 - 1", "write such a number");
  }
  return static_cast<int>(number);
}

}  // namespace

std::uint64_t Extension::whole(const std::string& key,
                               std::optional<std::uint64_t> otherwise) const {
  const auto found = members_->find(key);
  if (found == members_->end() && otherwise) return *otherwise;
  return static_cast<std::uint64_t>(index(key));
}

int Extension::index(const std::string& key) const {
  const auto found = members_->find(key);
  if (found == members_->end()) fail("has no " + key, "give it one");
  return index_in(member(key), found->second);
}

std::map<std::string, int> Extension::indices(const std::string& key) const {
  const auto found = members_->find(key);
  if (found == members_->end() || !found->second.IsObject()) {
    member(key).fail("is no object", "write {...} here");
  }
  std::map<std::string, int> result;
  for (const auto& [name, value] : found->second.Get<tinygltf::Value::Object>()) {
    result[name] = index_in(member(key).member(printable(name)), value);
  }
  return result;
}

float Extension::factor(const std::string& key, double otherwise, double low, double high) const {
  const std::optional<double> value = number(key);
  return static_cast<float>(value ? member(key).clamped(*value, low, high) : otherwise);
}

void Extension::factors(const std::string& key, std::span<float> out, double low,
                        double high) const {
  const auto found = members_->find(key);
  if (found == members_->end()) return;
  std::vector<double> values;
  for (std::size_t i = 0; i < found->second.ArrayLen(); ++i) {
    const tinygltf::Value& value = found->second.Get(static_cast<int>(i));
    if (!value.IsNumber()) member(key).item(i).fail("is not a number", "write a number here");
    values.push_back(value.GetNumberAsDouble());
  }
  member(key).clamped(values, out, low, high);
}

std::optional<Extension> Extension::object(const std::string& key) const {
  const auto found = members_->find(key);
  if (found == members_->end()) return std::nullopt;
  if (!found->second.IsObject()) member(key).fail("is no object", "write {...} here");
  return Extension(member(key), found->second.Get<tinygltf::Value::Object>());
}

}  // namespace ppm::scene::gltf

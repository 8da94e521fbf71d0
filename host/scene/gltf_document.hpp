// A glTF file as tinygltf reads it, and its places, so that every complaint can name one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "extensions.hpp"
#include "log.hpp"
#include "scene_size.hpp"
#include "tiny_gltf.hpp"

namespace ppm::scene::gltf {

using ByteView = std::span<const std::uint8_t>;

/// The file. What the model holds is of the right types, but nothing else about it may be trusted:
/// tinygltf checks neither indices nor offsets.
struct Document {
  std::string file;  ///< as the user named it
  tinygltf::Model model;
  Log* log = nullptr;
  std::set<std::string, std::less<>> warned;          ///< kinds of warnings given so far
  std::vector<UsedExtension> extensions;              ///< by name
  std::map<int, std::vector<std::uint8_t>> unpacked;  ///< bufferViews that are compressed
  std::set<std::string> sound_sparse;  ///< accessors whose sparse indices were checked
  SceneSize size;                      ///< as far as it is known
  std::function<void(const SceneSize&, const Scene*)> admit;  ///< LoadOptions::admit

  /// To be called when `size` has grown, before what it counts is allocated. `scene`: where the
  /// size is all there is.
  void ask_admission(const Scene* scene = nullptr) const {
    if (admit) admit(size, scene);
  }
  /// For compressed geometry of so many bytes, whose decoder takes so many more for a while.
  void claim_decoded(std::uint64_t bytes, std::uint64_t for_decoder) {
    size.decoded_bytes += bytes;
    size.decoder_bytes = std::max(size.decoder_bytes, for_decoder);
    ask_admission();
  }
};

/// Reads a .gltf or .glb file, told by its first bytes, and the files beside or below it that it
/// refers to. Images stay encoded, those in a bufferView stay there. Warns once of all extensions
/// that the loader does not know. Throws Failure where a file cannot be read, is malformed, refers
/// to other places or requires such an extension.
Document read_document(const std::filesystem::path& file, Log& log);

/// Text from the file as it may be printed: short, without control characters.
std::string printable(std::string_view text);

/// A place in a document, which must outlive it.
class Place {
 public:
  Place(Document& document, std::string path) : document_(&document), path_(std::move(path)) {}

  /// As in `meshes[2].primitives[0].attributes.POSITION`.
  const std::string& path() const { return path_; }
  Document& document() const { return *document_; }
  const tinygltf::Model& model() const { return document_->model; }

  Place member(std::string_view key) const;
  Place item(std::size_t position) const;

  [[noreturn]] void fail(std::string_view what_is_wrong, std::string_view remedy) const;
  /// Warns, naming this path, unless a warning of this `kind` was given before.
  void warn(std::string_view kind, std::string_view text) const;

  /// A number found here that has a legal range: what lies outside is clamped, with a warning.
  double clamped(double value, double low, double high) const;
  /// The same for an array of numbers, which must be as many as `out`.
  void clamped(const std::vector<double>& values, std::span<float> out, double low,
               double high) const;
  /// A byte count or offset found here, below 2^48 so that no product with a stride overflows.
  std::uint64_t size(std::uint64_t value) const;
  /// Fails unless there are `expected` items here.
  void check_length(std::size_t actual, std::size_t expected) const;

 private:
  std::string last_key() const;

  Document* document_;
  std::string path_;
};

/// A part of the model and its place.
template <typename T>
class Element : public Place {
 public:
  Element(Place place, const T& value) : Place(std::move(place)), value_(&value) {}

  const T* operator->() const { return value_; }
  const T& operator*() const { return *value_; }
  std::string name() const { return printable(value_->name); }

 private:
  const T* value_;
};

/// What the index that stands at `reference` refers to in the top-level array `array` named `name`.
template <typename T>
Element<T> follow(const Place& reference, int index, const std::vector<T>& array,
                  const char* name) {
  if (index < 0 || static_cast<std::size_t>(index) >= array.size()) {
    reference.fail("refers to " + std::string(name) + "[" + std::to_string(index) +
                       "], but the file has " + std::to_string(array.size()) + " of them",
                   "use an index below that");
  }
  const auto position = static_cast<std::size_t>(index);
  return {Place(reference.document(), name).item(position), array[position]};
}

/// The bytes of a bufferView, in bounds. They stay valid as long as the document.
ByteView bytes_of(const Element<tinygltf::BufferView>& view);

/// The members of an extension, of which tinygltf knows nothing.
class Extension : public Place {
 public:
  /// The extension `name` at `owner`, whose extensions these are, if it is there.
  static std::optional<Extension> find(const Place& owner, const tinygltf::ExtensionMap& extensions,
                                       const std::string& name);

  bool has(const std::string& key) const { return members_->contains(key); }
  /// The member as it stands there, of any type; null where there is none.
  const tinygltf::Value* value(const std::string& key) const {
    const auto found = members_->find(key);
    return found == members_->end() ? nullptr : &found->second;
  }
  std::optional<double> number(const std::string& key) const;
  std::optional<std::string> text(const std::string& key) const;
  /// A count, offset or the like; must be there where there is no value `otherwise`.
  std::uint64_t whole(const std::string& key,
                      std::optional<std::uint64_t> otherwise = std::nullopt) const;
  /// An index to `follow`; must be there.
  int index(const std::string& key) const;
  /// An object of indices to `follow`; must be there.
  std::map<std::string, int> indices(const std::string& key) const;
  /// A number with a legal range, see Place::clamped.
  float factor(const std::string& key, double otherwise, double low, double high) const;
  /// The same for an array of as many numbers as `out`, which comes in with the default.
  void factors(const std::string& key, std::span<float> out, double low, double high) const;
  /// A member that is an object, if it is there.
  std::optional<Extension> object(const std::string& key) const;

  /// An object within an extension.
  Extension(Place place, const tinygltf::Value::Object& members)
      : Place(std::move(place)), members_(&members) {}

 private:
  const tinygltf::Value::Object* members_;
};

}  // namespace ppm::scene::gltf

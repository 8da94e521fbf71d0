// A value of a glTF file's JSON that knows its own path, so that every complaint can name the
// place.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "log.hpp"

namespace ppm::scene::gltf {

/// What every element of one file shares.
struct Origin {
  std::string file;                      ///< as the user named it
  const nlohmann::json* root = nullptr;  ///< the whole document
  Log* log = nullptr;
  std::set<std::string, std::less<>> warned;  ///< kinds of warnings given so far
};

/// A value within the document. Refers to its Origin and the document; both must outlive it.
/// Every member that reads throws Failure, naming the path, where the value is not what it asks
/// for.
class Element {
 public:
  Element(Origin& origin, const nlohmann::json& value, std::string path)
      : origin_(&origin), value_(&value), path_(std::move(path)) {}

  /// As in `meshes[2].primitives[0].attributes.POSITION`.
  const std::string& path() const { return path_; }
  Origin& origin() const { return *origin_; }

  /// The member `key` of an object, if it has one.
  std::optional<Element> find(std::string_view key) const;
  Element require(std::string_view key) const;
  /// The extension `name` of this object, if it has it.
  std::optional<Element> extension(std::string_view name) const;
  /// The element of the document's top-level array `array` whose index the member `key` holds.
  Element follow(std::string_view key, std::string_view array) const;
  /// The index that the member `key` holds, checked against the document's top-level array `array`.
  std::uint32_t index(std::string_view key, std::string_view array) const;
  /// As `index`, of this very value.
  std::uint32_t as_index(std::string_view array) const;

  std::size_t size() const;                        ///< of an array
  Element operator[](std::size_t position) const;  ///< of an array; `position` < size()

  double number() const;
  /// A whole number in [0, 2^48], so that a product with any stride or element size fits 64 bits.
  std::uint64_t whole() const;
  bool boolean() const;
  const std::string& text() const;
  /// An array of exactly `out.size()` numbers.
  void numbers(std::span<double> out) const;

  double number_or(std::string_view key, double otherwise) const;
  std::uint64_t whole_or(std::string_view key, std::uint64_t otherwise) const;
  bool boolean_or(std::string_view key, bool otherwise) const;
  /// The member `name`, fit for printing, or nothing.
  std::string name() const;

  /// A number that has a legal range: what lies outside is clamped, with a warning.
  float factor(std::string_view key, double otherwise, double low, double high) const;
  /// The same for an array of as many numbers as `out`, which comes in with the default.
  void factors(std::string_view key, std::span<float> out, double low, double high) const;

  [[noreturn]] void fail(std::string_view what_is_wrong, std::string_view remedy) const;
  /// Warns, naming this path, unless a warning of this `kind` was given before.
  void warn(std::string_view kind, std::string_view text) const;

 private:
  double clamped(std::string_view key, double value, double low, double high) const;

  Origin* origin_;
  const nlohmann::json* value_;
  std::string path_;
};

/// The top-level array `array`, or nothing where the document has none.
std::optional<Element> top_level(Origin& origin, std::string_view array);

/// Text from the file as it may be printed: short, without control characters.
std::string printable(std::string_view text);

/// Parses a document. Throws Failure where it is not JSON, or nested so deep that no glTF would be.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// Warns once of every extension the document uses beyond those the loader knows, and throws
/// Failure where such a one is required.
void check_extensions(Origin& origin);

}  // namespace ppm::scene::gltf

// The picture so far, for whoever looks on.
#pragma once

#include <filesystem>
#include <functional>

namespace ppm::render {

class Preview {
 public:
  /// No file: none is ever due.
  Preview(std::filesystem::path file, double every_seconds);

  /// Whether so many seconds have passed since the last one, or nine times what that took where it
  /// was more; at once before the first.
  bool due() const;
  /// Calls `write(file)`, which replaces it; what that throws passes through.
  void show(const std::function<void(const std::filesystem::path&)>& write);
  bool wanted() const { return !file_.empty(); }

 private:
  std::filesystem::path file_;
  double every_seconds_;
  double next_ = 0.0;  // reading of the clock
};

}  // namespace ppm::render

#include "resume_command.hpp"

#include <utility>

#include "checkpoint.hpp"
#include "render_command.hpp"
#include "resume_options.hpp"

namespace ppm::cli {

int resume_command(const ResumeOptions& options) {
  render::Checkpoint checkpoint = render::read_checkpoint(options.checkpoint);
  const std::vector<std::string> words = resumed_words(checkpoint.words, options);
  std::vector<const char*> arguments{"ppm-vk", "render"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  const Options parsed = parse(static_cast<int>(arguments.size()), arguments.data());
  if (parsed.verb != Verb::render) return parsed.exit_code;
  return render_from(parsed.render, std::move(checkpoint));
}

}  // namespace ppm::cli

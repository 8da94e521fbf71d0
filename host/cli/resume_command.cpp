#include "resume_command.hpp"

#include <utility>

#include "checkpoint.hpp"
#include "render_command.hpp"
#include "resume_options.hpp"

namespace ppm::cli {

int resume_command(const ResumeOptions& options) {
  render::Checkpoint checkpoint = render::read_checkpoint(options.checkpoint);
  const Options parsed = parse_resumed(resumed_words(checkpoint.words, options));
  if (parsed.verb != Verb::render) return parsed.exit_code;
  return render_from(parsed.render, std::move(checkpoint));
}

}  // namespace ppm::cli

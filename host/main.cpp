// ppm-vk: progressive photon mapping on Vulkan devices.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include "bench_command.hpp"
#include "compare_command.hpp"
#include "devices_command.hpp"
#include "exit_code.hpp"
#include "failure.hpp"
#include "info_command.hpp"
#include "inspect_command.hpp"
#include "options.hpp"
#include "render_command.hpp"
#include "resume_command.hpp"
#include "view_command.hpp"

namespace {

int act(const ppm::cli::Options& options) {
  switch (options.verb) {
    case ppm::cli::Verb::render:
      return ppm::cli::render_command(options.render);
    case ppm::cli::Verb::view:
      return ppm::cli::view_command(options.view);
    case ppm::cli::Verb::compare:
      return ppm::cli::compare_command(options.compare);
    case ppm::cli::Verb::bench:
      return ppm::cli::bench_command(options.bench);
    case ppm::cli::Verb::inspect:
      return ppm::cli::inspect_command(options.inspect);
    case ppm::cli::Verb::resume:
      return ppm::cli::resume_command(options.resume);
    case ppm::cli::Verb::info:
      return ppm::cli::info_command(options.info);
    case ppm::cli::Verb::devices:
      return ppm::cli::devices_command();
    case ppm::cli::Verb::nothing:
      return options.exit_code;
  }
  return options.exit_code;
}

/// What was printed may still wait in a buffer, and the disk behind it be full.
int run(const ppm::cli::Options& options) {
  const int exit_code = act(options);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw ppm::Failure("standard output", "cannot write", std::generic_category().message(errno),
                       "send it elsewhere");
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that grows too large is an error of write(), as a full disk is
  try {
    return run(ppm::cli::parse(argc, argv));
  } catch (const std::bad_alloc&) {
    std::fputs("ppm-vk: error: out of memory: use a smaller scene or picture\n", stderr);
  } catch (const std::exception& error) {  // Failure among them
    std::fprintf(stderr, "ppm-vk: error: %s\n", error.what());
  }
  return ppm::cli::kFailed;
}

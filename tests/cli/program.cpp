#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <utility>

namespace ppm::test {
namespace {

constexpr int kLimitMilliseconds = 120000;

/// Moves what has arrived to `text`; closes `descriptor` at its end.
void drain(int& descriptor, std::string& text) {
  std::array<char, 4096> buffer;
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  if (count > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  } else {
    close(descriptor);
    descriptor = -1;
  }
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const std::function<void()>& in_child) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), PPM_VK_PROGRAM);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no fork");
  if (process_ == 0) {
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    in_child();
    execv(PPM_VK_PROGRAM, argv.data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

Program::~Program() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  if (out_ >= 0) close(out_);
  if (err_ >= 0) close(err_);
}

/// False at the end of both streams, or when nothing came for too long.
bool Program::read_more() {
  if (out_ < 0 && err_ < 0) return false;
  std::array<pollfd, 2> streams{pollfd{out_, POLLIN, 0}, pollfd{err_, POLLIN, 0}};
  if (poll(streams.data(), streams.size(), kLimitMilliseconds) <= 0) return false;
  if (streams[0].revents != 0) drain(out_, result_.out);
  if (streams[1].revents != 0) drain(err_, result_.err);
  return true;
}

bool Program::wait_for(std::string_view text) {
  while (result_.err.find(text) == std::string::npos) {
    if (!read_more()) return false;
  }
  return true;
}

std::optional<std::string> Program::next_line() {
  std::size_t end = std::string::npos;
  while ((end = result_.out.find('\n', lines_taken_)) == std::string::npos) {
    if (!read_more()) return std::nullopt;
  }
  const std::size_t first = std::exchange(lines_taken_, end + 1);
  return result_.out.substr(first, end - first);
}

void Program::send(int signal) const {
  kill(process_, signal);
}

Result Program::finish() {
  while (read_more()) {
  }
  if (out_ >= 0 || err_ >= 0) kill(process_, SIGKILL);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  if (WIFEXITED(status)) result_.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result_.signal = WTERMSIG(status);
  return result_;
}

void expect_one_error(const Result& result, int exit_code, const std::string& named) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.err.find("ppm-vk: error: "), result.err.rfind("ppm-vk: error: ")) << result.err;
  const std::size_t start = result.err.rfind("ppm-vk: error: ");
  ASSERT_NE(start, std::string::npos) << result.err;
  const std::string line = result.err.substr(start);
  EXPECT_EQ(line.find('\n'), line.size() - 1) << line;  // the last line, and one alone
  EXPECT_NE(line.find(named), std::string::npos) << line;
}

}  // namespace ppm::test

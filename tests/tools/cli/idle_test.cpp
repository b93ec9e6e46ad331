// A window that nobody touches does nothing: measured on the process, from outside.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "program.h"

namespace stillframe::cli {
namespace {

using namespace std::chrono_literals;

/// The program at work in a window.
class Window {
 public:
  explicit Window(const std::string& file) {
    std::vector<std::string> words{STILLFRAME_PROGRAM, "view", file};
    std::vector<char*> arguments;
    for (std::string& word : words) {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    if (::posix_spawn(&id_, STILLFRAME_PROGRAM, nullptr, nullptr, arguments.data(), environ) != 0) {
      id_ = 0;
    }
  }
  ~Window() {
    if (id_ != 0) {
      ::kill(id_, SIGTERM);
      ::waitpid(id_, nullptr, 0);
    }
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// What all threads have used so far, in ticks of the system's clock (10 ms); nullopt when it has ended.
  [[nodiscard]] std::optional<long> cpuTicks() const {
    if (id_ == 0 || ::waitpid(id_, nullptr, WNOHANG) != 0) {
      return std::nullopt;
    }
    std::ifstream stat("/proc/" + std::to_string(id_) + "/stat");
    std::string text;
    std::getline(stat, text);
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int i = 0; i < 11; ++i) {
      fields >> skipped;
    }
    long user = 0;
    long system = 0;
    fields >> user >> system;
    return user + system;
  }

 private:
  ::pid_t id_ = 0;
};

TEST(IdleWindow, TakesNoCpuAndSoDrawsNoFrameForTenSeconds) {
  const TestFolder folder;
  ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);  // what a person has set here is neither read nor changed
  const Window window(folder.makeSample());
  // Until it has loaded, decoded and drawn, and been still for two seconds: drawing is done on the processor here.
  auto before = window.cpuTicks();
  auto still_since = std::chrono::steady_clock::now();
  const auto limit = still_since + 120s;
  bool has_worked = false;
  while (before && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(50ms);
    const auto now = window.cpuTicks();
    if (now != before) {
      has_worked = has_worked || (now && *now > 20);
      before = now;
      still_since = std::chrono::steady_clock::now();
    } else if (has_worked && std::chrono::steady_clock::now() - still_since > 2s) {
      break;
    }
  }
  ASSERT_TRUE(before) << "the window is gone";
  ASSERT_TRUE(has_worked);
  std::this_thread::sleep_for(10s);
  const auto after = window.cpuTicks();
  ASSERT_TRUE(after);
  EXPECT_EQ(*after - *before, 0) << "ticks of 10 ms; a frame of this scene takes one at least";
}

}  // namespace
}  // namespace stillframe::cli

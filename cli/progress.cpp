#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace hamilcar::cli {

namespace {
bool hidden = false;  // set before any command runs
}  // namespace

void hide_progress() {
    hidden = true;
}

Progress::Progress(std::string label)
    : label_(std::move(label)),
      visible_(!hidden && isatty(STDERR_FILENO) != 0),
      color_(std::getenv("NO_COLOR") == nullptr) {}

void Progress::show(double share) {
    if (!visible_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    constexpr int width = 30;
    const int filled = static_cast<int>(share * width);
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < filled ? "#" : ".";
    fmt::print(stderr, "\r{} {}[{}]{} {:3.0f} %", label_, color_ ? "\033[36m" : "", bar, color_ ? "\033[0m" : "",
               100 * share);
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::clear() {
    if (!drawn_) return;
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
    drawn_ = false;
}

}  // namespace hamilcar::cli

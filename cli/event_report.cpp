#include "event_report.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>

#include "hamilcar/base/event_log.hpp"

namespace hamilcar::cli {

void tell(std::string message) {
    std::ranges::replace_if(
        message, [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == '\x7f'; }, '?');
    std::fputs(("hamilcar: " + message + "\n").c_str(), stderr);  // in one call: several threads may tell something
}

namespace {

void tell_event(const std::string& line) {
    tell(line);
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

EventReport::EventReport(bool wanted) : wanted_(wanted) {
    if (wanted) listen_to_events(tell_event);
}

EventReport::~EventReport() {
    if (!wanted_) return;
    listen_to_events(nullptr);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const double megabytes = static_cast<double>(used.ru_maxrss) / 1024;  // Linux counts in KiB
    tell(fmt::format("took {:.2f} s, {:.2f} s of processor time, {:.0f} MB of memory at most", passed.count(),
                     seconds(used.ru_utime) + seconds(used.ru_stime), megabytes));
}

}  // namespace hamilcar::cli

// What is told on standard error: mistakes, and with --verbose events as they come and what the command took.
#pragma once

#include <chrono>
#include <string>

namespace hamilcar::cli {

// A line on standard error, which may be full: nothing throws here. Names out of files may hold anything; what a terminal would obey is
// shown as '?'.
void tell(std::string message);

class EventReport {
public:
    explicit EventReport(bool wanted);
    ~EventReport();
    EventReport(const EventReport&) = delete;
    EventReport& operator=(const EventReport&) = delete;

private:
    bool wanted_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace hamilcar::cli

// A progress bar on standard error, only where a person watches: a terminal. NO_COLOR is honored.
#pragma once

#include <chrono>
#include <string>

namespace hamilcar::cli {

// None is shown from here on.
void hide_progress();

class Progress {
public:
    explicit Progress(std::string label);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // `share` from 0 to 1; redraws at most ten times a second.
    void show(double share);
    void clear();

private:
    std::string label_;
    bool visible_, color_, drawn_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace hamilcar::cli

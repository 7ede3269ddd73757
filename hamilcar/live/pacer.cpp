#include "hamilcar/live/pacer.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar::live {

namespace {
constexpr double nanosecond = 1e-9;
constexpr Nanoseconds second = 1'000'000'000;
constexpr Nanoseconds longest_without_rest = 95'000'000, rest = 5'000'000;
}  // namespace

Pacer::Pacer(double step, double pace) : step_(step), pace_(pace), period_(step / pace / nanosecond) {}

void Pacer::restart(Nanoseconds now) {
    origin_ = rested_ = now;
    since_origin_ = 0;
    first_ = true;
    window_ = {.start = now};
}

void Pacer::set_pace(double pace, Nanoseconds now) {
    pace_ = pace;
    period_ = step_ / pace / nanosecond;
    full_window_ = false;
    restart(now);
}

Nanoseconds Pacer::deadline() const {
    return origin_ + std::llround(static_cast<double>(since_origin_) * period_);
}

Nanoseconds Pacer::wake_time(Nanoseconds now) {
    const Nanoseconds due = deadline();
    if (due > now) return rested_ = due;
    if (now - rested_ < longest_without_rest) return now;
    return rested_ = now + rest;
}

void Pacer::begin(Nanoseconds now) {
    const Nanoseconds late = now - deadline();
    report_.worst_delay = std::max(report_.worst_delay, nanosecond * static_cast<double>(late));
    if (static_cast<double>(late) > period_) ++report_.overruns;
    if (late > skip_threshold) {
        origin_ += late;
        ++report_.skips;
        report_.skipped_time += nanosecond * static_cast<double>(late);
    }
    if (!first_) {
        window_.periods += now - began_;
        ++window_.begun;
    }
    first_ = false;
    began_ = now;
}

void Pacer::end(Nanoseconds now) {
    window_.computing += now - began_;
    ++window_.ended;
    ++since_origin_;
    ++report_.steps;
    const bool full = now - window_.start >= second;
    if (full || !full_window_) update_means();
    if (!full) return;
    full_window_ = true;
    window_ = {.start = now};
}

void Pacer::update_means() {
    const auto mean = [](Nanoseconds sum, long count) {
        return nanosecond * static_cast<double>(sum) / static_cast<double>(std::max(count, 1L));
    };
    report_.period = mean(window_.periods, window_.begun);
    report_.compute = mean(window_.computing, window_.ended);
}

}  // namespace hamilcar::live

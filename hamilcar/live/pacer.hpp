// Deadlines of the steps, and statistics on how well they are met.
//
// Deadlines are absolute: the n-th is n periods after the start, so that errors do not accumulate. A loop that is a little late
// catches up without sleeping; one that is late by more than `skip_threshold`, for example after suspend, skips the lost time. The
// pacer has no clock: times are arguments, so it can be tested without one.
#pragma once

#include <cstdint>

namespace hamilcar::live {

using Nanoseconds = std::int64_t;

struct PaceReport {
    long steps = 0;
    double period = 0;        // real time between steps, mean over the last full second (at first: so far) [s]
    double compute = 0;       // from begin to end of a step, likewise [s]
    long overruns = 0;        // steps that began more than one period late
    double worst_delay = 0;   // of the beginning of a step, maximum [s]
    long skips = 0;           // times that lost time was skipped
    double skipped_time = 0;  // total [s]
};

class Pacer {
public:
    static constexpr Nanoseconds skip_threshold = 250'000'000;

    // Simulated time of a step [s]; the pace is simulated over real time.
    explicit Pacer(double step, double pace = 1);

    // The next step is due now; a preceding pause does not count as a delay.
    void restart(Nanoseconds now);
    void set_pace(double pace, Nanoseconds now);
    double pace() const { return pace_; }

    Nanoseconds deadline() const;  // of the next step
    // To sleep until before it: at once where it is late. Who is late all the time still leaves a twentieth of the time to others,
    // which matters where the thread has real-time priority.
    Nanoseconds wake_time(Nanoseconds now);
    void begin(Nanoseconds now);  // of a step
    void end(Nanoseconds now);
    const PaceReport& report() const { return report_; }

private:
    struct Window {
        Nanoseconds start = 0, periods = 0, computing = 0;  // sums of the latter two
        long begun = 0, ended = 0;
    };
    void update_means();

    double step_, pace_, period_;  // [s], [1], [ns]
    Nanoseconds origin_ = 0, began_ = 0, rested_ = 0;
    long since_origin_ = 0;     // steps
    bool first_ = true;         // after a restart: nothing to measure a period from
    bool full_window_ = false;  // a full second has been evaluated
    Window window_;
    PaceReport report_;
};

}  // namespace hamilcar::live

// When each step is due, and how well that is kept.
//
// Deadlines are absolute: the n-th is n periods after the start, so that no error of a single one adds up. Whoever is a
// little late runs after them without waiting; whoever is late by more than `patience`, as a laptop is that slept, gives
// up the lost time. The pacer has no clock: it is told what time it is, so it can be tested without any.
#pragma once

#include <cstdint>

namespace hamilcar::live {

using Nanoseconds = std::int64_t;

struct PaceReport {
    long steps = 0;
    double period = 0;   // real time from step to step, mean over the last full second; of the first so far [s]
    double compute = 0;  // from begin to end of a step, likewise [s]
    long overruns = 0;   // steps that began more than one period late
    double worst = 0;    // latest beginning of a step [s]
    long given_up = 0;   // times that lost time was
    double lost = 0;     // that was given up [s]
};

class Pacer {
public:
    static constexpr Nanoseconds patience = 250'000'000;

    // Simulated time of a step [s]; the pace is simulated over real time.
    explicit Pacer(double step, double pace = 1);

    // The next step is due now; what came before, a pause say, is nobody's delay.
    void restart(Nanoseconds now);
    void set_pace(double pace, Nanoseconds now);
    double pace() const { return pace_; }

    Nanoseconds deadline() const;  // of the next step
    void begin(Nanoseconds now);   // of a step
    void end(Nanoseconds now);
    const PaceReport& report() const { return report_; }

private:
    struct Window {
        Nanoseconds start = 0, periods = 0, computing = 0;  // sums of the latter two
        long begun = 0, ended = 0;
    };
    void look_back();

    double step_, pace_, period_;  // [s], [1], [ns]
    Nanoseconds origin_ = 0, began_ = 0;
    long since_origin_ = 0;  // steps
    bool first_ = true;      // after a restart: nothing to measure a period from
    bool whole_ = false;     // a second has been looked back on
    Window window_;
    PaceReport report_;
};

}  // namespace hamilcar::live

// The pacer with simulated time: no test waits.
#include "hamilcar/live/pacer.hpp"

#include <gtest/gtest.h>

namespace hamilcar::live {
namespace {

constexpr Nanoseconds microsecond = 1000, millisecond = 1000 * microsecond, second = 1000 * millisecond;

// Steps at their deadlines plus a delay, each computing for a while; returns the time when the last one is done.
Nanoseconds run(Pacer& pacer, int steps, Nanoseconds now, Nanoseconds delay, Nanoseconds computing) {
    for (int i = 0; i < steps; ++i) {
        now = std::max(now, pacer.deadline()) + delay;
        pacer.begin(now);
        now += computing;
        pacer.end(now);
    }
    return now;
}

TEST(Pacer, KeepsDeadlinesOverAMillionPeriods) {
    for (const double pace : {1.0, 0.3}) {
        Pacer pacer(1e-3, pace);
        pacer.restart(5 * second);
        run(pacer, 1'000'000, 5 * second, 40 * microsecond, 10 * microsecond);
        EXPECT_NEAR(static_cast<double>(pacer.deadline() - 5 * second), 1e12 / pace, 1);
        EXPECT_EQ(pacer.report().steps, 1'000'000);
        EXPECT_EQ(pacer.report().overruns, 0);
        EXPECT_NEAR(pacer.report().period, 1e-3 / pace, 1e-9);
        EXPECT_NEAR(pacer.report().compute, 10e-6, 1e-9);
        EXPECT_NEAR(pacer.report().worst_delay, 40e-6, 1e-9);
    }
}

TEST(Pacer, CountsOverruns) {
    Pacer pacer(1e-3);
    pacer.restart(0);
    Nanoseconds now = run(pacer, 10, 0, 0, 0);
    now = run(pacer, 1, now + 5 * millisecond, 0, 0);  // 4 ms late, and so the next three are late
    EXPECT_NEAR(pacer.report().worst_delay, 4e-3, 1e-6);
    run(pacer, 100, now, 0, 0);
    EXPECT_EQ(pacer.report().overruns, 3);
    EXPECT_EQ(pacer.report().skips, 0);
    EXPECT_EQ(pacer.deadline(), 111 * millisecond);  // caught up
}

TEST(Pacer, SkipsTimeLostInSuspend) {
    Pacer pacer(1e-3);
    pacer.restart(0);
    run(pacer, 100, 0, 0, 0);
    const Nanoseconds woke = 3600 * second;
    pacer.begin(woke);
    pacer.end(woke);
    EXPECT_EQ(pacer.report().skips, 1);
    EXPECT_NEAR(pacer.report().skipped_time, 3599.9, 1e-3);
    EXPECT_EQ(pacer.report().overruns, 1);
    EXPECT_EQ(pacer.deadline(), woke + millisecond);
}

// A step that costs more than it simulates: the thread is late at every one, and others still get a twentieth of the time.
TEST(Pacer, LeavesTimeToOthersWhenItCannotKeepUp) {
    Pacer pacer(1e-6);
    pacer.restart(0);
    Nanoseconds now = 0, slept = 0;
    while (now < 10 * second) {
        const Nanoseconds woke = std::max(now, pacer.wake_time(now));
        slept += woke - now;
        pacer.begin(woke);
        now = woke + 50 * microsecond;
        pacer.end(now);
    }
    EXPECT_NEAR(static_cast<double>(slept) / static_cast<double>(now), 0.05, 0.005);
}

TEST(Pacer, RestsOnlyWhereItIsLateForLong) {
    Pacer pacer(1e-3);
    pacer.restart(0);
    EXPECT_EQ(pacer.wake_time(-5), 0);
    Nanoseconds now = 90 * millisecond;  // late once: it catches up without a rest
    for (int i = 0; i < 90; ++i) {
        EXPECT_EQ(pacer.wake_time(now), now);
        pacer.begin(now);
        now += 10 * microsecond;
        pacer.end(now);
    }
    for (int i = 0; i < 1000; ++i) {
        const Nanoseconds woke = pacer.wake_time(now);
        EXPECT_EQ(woke, std::max(now, pacer.deadline()));
        pacer.begin(woke);
        now = woke + 30 * microsecond;
        pacer.end(now);
    }
}

TEST(Pacer, RestartKeepsCounts) {
    Pacer pacer(1e-3);
    pacer.restart(0);
    run(pacer, 2000, 0, 2 * millisecond, 0);
    const PaceReport before = pacer.report();
    pacer.restart(100 * second);
    EXPECT_EQ(pacer.deadline(), 100 * second);
    run(pacer, 2000, 100 * second, 0, 0);
    EXPECT_EQ(pacer.report().overruns, before.overruns);
    EXPECT_EQ(pacer.report().steps, 4000);
    EXPECT_NEAR(pacer.report().period, 1e-3, 1e-9);
}

TEST(Pacer, StretchesThePeriodInSlowMotion) {
    Pacer pacer(1e-3);
    pacer.restart(0);
    Nanoseconds now = run(pacer, 10, 0, 0, 0);
    pacer.set_pace(0.05, now);
    const Nanoseconds from = now;
    now = run(pacer, 101, now, 0, 0);
    EXPECT_EQ(now - from, 2 * second);
    EXPECT_EQ(pacer.pace(), 0.05);
    EXPECT_EQ(pacer.report().overruns, 0);
}

}  // namespace
}  // namespace hamilcar::live

// What passes between two threads without a lock: nothing torn, nothing out of order; a ring loses only what it refuses.
#include "hamilcar/live/newest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "hamilcar/live/bell.hpp"
#include "hamilcar/live/row_ring.hpp"

namespace hamilcar::live {
namespace {

TEST(Newest, IsWhatWasPublishedLast) {
    Newest<int> number(7);
    EXPECT_EQ(number.value(), 7);
    EXPECT_FALSE(number.fetch());
    for (int i = 1; i <= 3; ++i) {
        number.draft() = i;
        number.publish();
    }
    EXPECT_EQ(number.value(), 7);
    EXPECT_TRUE(number.fetch());
    EXPECT_EQ(number.value(), 3);
    EXPECT_FALSE(number.fetch());
    EXPECT_EQ(number.value(), 3);
}

TEST(Newest, IsNeverTornAndNeverOlder) {
    constexpr int last = 100000;
    Newest<std::vector<int>> numbers(std::vector<int>(200));
    std::jthread writer([&] {
        for (int i = 1; i <= last; ++i) {
            std::fill(numbers.draft().begin(), numbers.draft().end(), i);
            numbers.publish();
        }
    });
    int before = 0, seen = 0;
    while (before < last) {
        if (!numbers.fetch()) continue;
        const std::vector<int>& now = numbers.value();
        ASSERT_GT(now.front(), before);
        ASSERT_TRUE(std::all_of(now.begin(), now.end(), [&](int number) { return number == now.front(); }));
        before = now.front();
        ++seen;
    }
    EXPECT_GT(seen, 0);
}

TEST(RowRing, KeepsOrderAndLosesOnlyWhatItRefuses) {
    constexpr int pushed = 50000;
    RowRing ring(8, 3);
    int refused = 0;
    std::atomic<bool> done{false};
    std::jthread writer([&] {
        for (int i = 1; i <= pushed; ++i) {
            const auto row = ring.room();
            if (row.empty()) {
                ++refused;
                continue;
            }
            std::fill(row.begin(), row.end(), i);
            ring.push();
        }
        done = true;
    });
    double before = 0;
    int read = 0;
    while (true) {
        const bool last_look = done;
        for (auto row = ring.oldest(); !row.empty(); row = ring.oldest()) {
            ASSERT_GT(row[0], before);
            ASSERT_TRUE(row[1] == row[0] && row[2] == row[0]);
            before = row[0];
            ++read;
            ring.pop();
        }
        if (last_look) break;
    }
    EXPECT_EQ(read + refused, pushed);
}

TEST(RowRing, RefusesWhenFull) {
    RowRing ring(2, 1);
    for (int i = 0; i < 2; ++i) {
        ASSERT_FALSE(ring.room().empty());
        ring.push();
    }
    EXPECT_TRUE(ring.room().empty());
    ring.pop();
    EXPECT_FALSE(ring.room().empty());
}

TEST(Bell, MayBeRungAndSilencedAnyNumberOfTimes) {
    const Bell bell;
    bell.silence();
    for (int i = 0; i < 1000; ++i) bell.ring();
    bell.silence();
    bell.silence();
    EXPECT_GE(bell.descriptor(), 0);
}

}  // namespace
}  // namespace hamilcar::live

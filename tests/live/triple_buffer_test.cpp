// Communication between two threads without a lock: no torn values, no reordering; a ring loses only rows that it refuses.
#include "hamilcar/live/triple_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "hamilcar/live/row_ring.hpp"
#include "hamilcar/live/wake_up.hpp"

namespace hamilcar::live {
namespace {

TEST(TripleBuffer, ReturnsLastPublishedValue) {
    TripleBuffer<int> number(7);
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

TEST(TripleBuffer, IsNeverTornOrOutOfOrder) {
    constexpr int last = 100000;
    TripleBuffer<std::vector<int>> numbers(std::vector<int>(200));
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

TEST(RowRing, KeepsOrderAndLosesOnlyRefusedRows) {
    constexpr int pushed = 50000;
    RowRing ring(8, 3);
    int refused = 0;
    std::atomic<bool> done{false};
    std::jthread writer([&] {
        for (int i = 1; i <= pushed; ++i) {
            const auto row = ring.free_row();
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
        ASSERT_FALSE(ring.free_row().empty());
        ring.push();
    }
    EXPECT_TRUE(ring.free_row().empty());
    ring.pop();
    EXPECT_FALSE(ring.free_row().empty());
}

TEST(WakeUp, MayBeSignaledAndClearedRepeatedly) {
    const WakeUp wake_up;
    wake_up.clear();
    for (int i = 0; i < 1000; ++i) wake_up.signal();
    wake_up.clear();
    wake_up.clear();
    EXPECT_GE(wake_up.descriptor(), 0);
}

}  // namespace
}  // namespace hamilcar::live

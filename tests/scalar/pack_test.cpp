// A lane is a number: every operation gives in each lane the bits that a lone number gives, special values included.
#include "hamilcar/scalar/pack.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {
namespace {

using P = Pack<double, 2>;
static_assert(!std::is_constructible_v<bool, Mask<double, 2>>, "no `if` may ask a mask");

std::vector<double> numbers() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::vector<double> all{0.0, -0.0, 1.0, -1.0, 0.5, 1e-310, -1e-310, 1e308, inf, -inf, std::nan("")};
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> some(-10, 10);
    for (int i = 0; i < 40; ++i) all.push_back(some(random));
    return all;
}

template <class F>
void expect_same_bits(F&& f) {
    const std::vector<double> all = numbers();
    for (const double a : all) {
        for (const double b : all) {
            const P result = f(P(std::array{a, b}), P(std::array{b, a}));
            const double expected[] = {f(a, b), f(b, a)};
            for (int i = 0; i < 2; ++i) {
                if (std::isnan(expected[i])) {
                    EXPECT_TRUE(std::isnan(lane(result, i)));
                } else {
                    EXPECT_EQ(std::bit_cast<std::uint64_t>(lane(result, i)), std::bit_cast<std::uint64_t>(expected[i]))
                        << a << " " << b;
                }
            }
        }
    }
}

TEST(Pack, ComputesAsALoneNumberDoes) {
    expect_same_bits([](auto a, auto b) { return a + b; });
    expect_same_bits([](auto a, auto b) { return a - b; });
    expect_same_bits([](auto a, auto b) { return a * b; });
    expect_same_bits([](auto a, auto b) { return a / b; });
    expect_same_bits([](auto a, auto) { return -a; });
    expect_same_bits([](auto a, auto) { return sqrt(a); });
    expect_same_bits([](auto a, auto) { return abs(a); });
    expect_same_bits([](auto a, auto b) { return min(a, b); });
    expect_same_bits([](auto a, auto b) { return max(a, b); });
    expect_same_bits([](auto a, auto b) { return select(a < b, a, b); });
    expect_same_bits([](auto a, auto b) { return select(a >= b || a == -b, a, b); });
    expect_same_bits([](auto a, auto b) { return select(!(a > b) && a != b, a, b); });
    expect_same_bits([](auto a, auto) { return sincos(a).sine; });
    expect_same_bits([](auto a, auto) { return sincos(a).cosine; });
}

TEST(Pack, HasLanesThatAreSetOneByOne) {
    P pack(3.0);
    set_lane(pack, 1, 7.0);
    EXPECT_EQ(lane(pack, 0), 3);
    EXPECT_EQ(lane(pack, 1), 7);
    EXPECT_TRUE(any(pack > P(5)));
    EXPECT_FALSE(any(pack > P(9)));
}

}  // namespace
}  // namespace hamilcar

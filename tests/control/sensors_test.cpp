// What sensors show of a known course of numbers.
#include "hamilcar/control/sensors.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace hamilcar {
namespace {

constexpr double step = 1e-3;

// What is shown at every step of a course that rises by one each step.
std::vector<double> shown(const SensorDescription& sensor, long steps, std::uint64_t seed = 1) {
    const Sensors sensors({{sensor, 0, 1}}, seed, step);
    std::vector<double> memory(sensors.memory_size()), out;
    for (long i = 0; i < steps; ++i) {
        const std::array<double, 1> measured{static_cast<double>(i)};
        std::array<double, 1> shown{};
        sensors.look(i, measured, memory, shown);
        out.push_back(shown[0]);
    }
    return out;
}

TEST(Sensors, ShowWhatIsThere) {
    EXPECT_EQ(shown({}, 4), (std::vector<double>{0, 1, 2, 3}));
    EXPECT_FALSE(Sensors({{SensorDescription{}, 0, 1}}, 1, step).looks_always());
}

TEST(Sensors, HoldASampleUntilTheNext) {
    EXPECT_EQ(shown({.interval = 3e-3}, 8), (std::vector<double>{0, 0, 0, 3, 3, 3, 6, 6}));
}

TEST(Sensors, ShowASampleLate) {
    EXPECT_EQ(shown({.delay = 2e-3}, 6), (std::vector<double>{0, 0, 0, 1, 2, 3}));
    // A delay is rounded up to whole intervals.
    EXPECT_EQ(shown({.interval = 2e-3, .delay = 3e-3}, 8), (std::vector<double>{0, 0, 0, 0, 0, 0, 2, 2}));
}

TEST(Sensors, RoundToTheirResolution) {
    EXPECT_EQ(shown({.resolution = 2.5}, 5), (std::vector<double>{0, 0, 2.5, 2.5, 5}));
}

TEST(Sensors, AddNoiseOfTheirStandardDeviation) {
    constexpr long count = 20000;
    const std::vector<double> values = shown({.noise = 0.5}, count);
    double mean = 0, square = 0;
    for (long i = 0; i < count; ++i) {
        const double error = values[static_cast<std::size_t>(i)] - static_cast<double>(i);
        mean += error / count, square += error * error / count;
    }
    EXPECT_NEAR(mean, 0, 4 * 0.5 / std::sqrt(count));  // four standard errors
    EXPECT_NEAR(std::sqrt(square), 0.5, 4 * 0.5 / std::sqrt(2.0 * count));
}

TEST(Sensors, HaveTheirNoiseFromTheSeed) {
    EXPECT_EQ(shown({.noise = 0.5}, 50, 7), shown({.noise = 0.5}, 50, 7));
    EXPECT_NE(shown({.noise = 0.5}, 50, 7), shown({.noise = 0.5}, 50, 8));
}

}  // namespace
}  // namespace hamilcar

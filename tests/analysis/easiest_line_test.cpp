// The line through lanes that bends least.
#include "hamilcar/analysis/easiest_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamilcar {
namespace {

const Footprint box{.front = 2, .rear = -2, .left = 0.9, .right = -0.9};

// The sum of squared second differences, over points at even distances.
double bend(const std::vector<std::array<double, 2>>& line) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        EXPECT_NEAR(line[i + 1][0] - line[i][0], line[i][0] - line[i - 1][0], 1e-9);
        const double second = line[i + 1][1] - 2 * line[i][1] + line[i - 1][1];
        sum += second * second;
    }
    return sum;
}

TEST(EasiestLine, IsStraightInOneLane) {
    for (const auto& [x, y] : easiest_line({{0, 30, 1, 4}}, box)) EXPECT_NEAR(y, 2.5, 1e-9) << x;
}

TEST(EasiestLine, KeepsTheBoxBetweenAllBordersAndBendsLessThanCosines) {
    const std::vector<Lane> lanes{{0, 15, -1.5, 1.5}, {45, 70, 2, 5.2}, {95, 125, -1.5, 1.8}};
    const auto line = easiest_line(lanes, box);
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const double slope = (line[i + 1][1] - line[i - 1][1]) / (line[i + 1][0] - line[i - 1][0]);
        for (const Lane& lane : lanes) {
            for (const double ahead : {box.front, box.rear}) {
                const double x = line[i][0] + ahead, y = line[i][1] + ahead * slope;
                if (x < lane.begin || x > lane.end) continue;
                EXPECT_LT(y + box.left, lane.left) << x;
                EXPECT_GT(y + box.right, lane.right) << x;
            }
        }
    }
    // One that could be driven as well: along the middle of each lane, and by half a cosine to the next.
    std::vector<std::array<double, 2>> by_cosines = line;
    for (auto& [x, y] : by_cosines) {
        const auto share = [x = x](double from, double to) {
            return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp((x - from) / (to - from), 0.0, 1.0));
        };
        const double middle = lanes[1].center(), last = lanes[2].center();
        y = middle * share(15, 45) + (last - middle) * share(70, 95);
    }
    std::printf("bend over that by cosines: %.3f\n", bend(line) / bend(by_cosines));
    EXPECT_LT(bend(line), 0.8 * bend(by_cosines));
}

}  // namespace
}  // namespace hamilcar

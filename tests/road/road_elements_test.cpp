// The elements of an uneven road: heights from geometry, and continuity of height and slope everywhere, by finite differences.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "hamilcar/road/friction_patch.hpp"
#include "hamilcar/road/height_grid.hpp"
#include "hamilcar/road/obstacle.hpp"
#include "hamilcar/road/wave.hpp"
#include "hamilcar/scalar/dual.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

using Number = Dual<double, 2>;
constexpr double pi = std::numbers::pi;

// Height and slope at (x, y), along and across: the derivatives carried along are those of differences, and neither
// jumps within a nanometer. `bound` is on the curvature [1/m].
template <class F>
void expect_smooth_at(const F& surface, double x, double y, double bound) {
    const auto at = [&](double u, double v) { return surface(Number::variable(u, 0), Number::variable(v, 1)); };
    const double step = 1e-6, tiny = 1e-9, tolerance = 2 * bound * step + 1e-8;
    const Number here = at(x, y);
    EXPECT_EQ(here.value(), surface(x, y));
    EXPECT_NEAR(here.partial(0), test::derivative([&](double u) { return surface(u, y); }, x, step), tolerance);
    EXPECT_NEAR(here.partial(1), test::derivative([&](double v) { return surface(x, v); }, y, step), tolerance);
    for (const Number& other : {at(x - tiny, y), at(x + tiny, y), at(x, y - tiny), at(x, y + tiny)}) {
        EXPECT_NEAR(other.value(), here.value(), 1e-7);
        EXPECT_NEAR(other.partial(0), here.partial(0), 2 * bound * tiny + 1e-12);
        EXPECT_NEAR(other.partial(1), here.partial(1), 2 * bound * tiny + 1e-12);
    }
}

// At all joints, given by their x and y, and at points spread between and beyond them.
template <class F>
void expect_smooth(const F& surface, std::vector<double> xs, std::vector<double> ys, double bound) {
    const auto spread = [](std::vector<double>& joints) {
        const double low = joints.front() - 0.1, high = joints.back() + 0.1;
        for (int i = 0; i <= 40; ++i) joints.push_back(low + (high - low) * i / 40);
    };
    spread(xs), spread(ys);
    for (const double x : xs)
        for (const double y : ys) {
            SCOPED_TRACE(testing::Message() << "at " << x << ", " << y);
            expect_smooth_at(surface, x, y, bound);
            if (testing::Test::HasFailure()) return;
        }
}
template <class Element>
auto height_of(const Element& element) {
    return [&element]<class N>(const N& x, const N& y) { return element.height(x, y); };
}

ObstacleDescription plate() {
    return {.start = 3, .length = 0.5, .height = 0.02, .ramp = 0.1, .right = -1, .left = 0.4, .side_ramp = 0.2};
}

TEST(Obstacle, APlateauIsLevelBetweenItsRamps) {
    const Obstacle obstacle(plate());
    for (const double x : {3.1, 3.25, 3.4}) EXPECT_DOUBLE_EQ(obstacle.height(x, 0.0), 0.02);
    for (const double x : {-100.0, 2.999, 3.0, 3.5, 3.501, 1e9}) EXPECT_EQ(obstacle.height(x, 0.0), 0);
    for (const double y : {-1.0, 0.4, -5.0, 5.0}) EXPECT_EQ(obstacle.height(3.25, y), 0);
    EXPECT_NEAR(obstacle.height(3.05, 0.0), 0.01, 1e-15) << "half way up";
    EXPECT_NEAR(obstacle.height(3.45, 0.0), 0.01, 1e-15) << "half way down";
    EXPECT_NEAR(obstacle.height(3.05, -0.9), 0.005, 1e-15) << "half way in x and y";
    EXPECT_NEAR(obstacle.height(3.025, 0.0), 0.02 * (1 - std::cos(pi / 4)) / 2, 1e-15);
    expect_smooth(height_of(obstacle), {3, 3.1, 3.25, 3.4, 3.5}, {-1, -0.8, 0.2, 0.4}, 10);
}

TEST(Obstacle, APotholeSpansTheRoadByDefault) {
    const Obstacle obstacle({.start = -2, .length = 1, .height = -0.05, .ramp = 0.2});
    for (const double y : {-1e6, -1.0, 0.0, 1.0, 1e6}) EXPECT_DOUBLE_EQ(obstacle.height(-1.5, y), -0.05);
    expect_smooth(height_of(obstacle), {-2, -1.8, -1.2, -1}, {-0.5, 0.5}, 20);
}

TEST(Obstacle, ASpeedBumpIsARaisedCosine) {
    const Obstacle obstacle({.shape = ObstacleShape::hump, .start = 10, .length = 0.9, .height = 0.05, .ramp = 7});
    for (int i = 0; i <= 90; ++i)
        EXPECT_NEAR(obstacle.height(10 + 0.01 * i, 0.0), 0.05 * (1 - std::cos(2 * pi * i / 90)) / 2, 1e-15);
    expect_smooth(height_of(obstacle), {10, 10.45, 10.9}, {-0.5, 0.5}, 10);
}

TEST(Obstacle, ARowRepeatsTheFirst) {
    ObstacleDescription d = plate();
    const Obstacle one(d);
    d.repeat_every = 1.25, d.count = 3;
    const Obstacle row(d);
    for (int i = 0; i < 3; ++i)
        for (double x = 2.9; x < 3.7; x += 0.03) EXPECT_NEAR(row.height(x + 1.25 * i, 0.1), one.height(x, 0.1), 1e-15);
    for (const double x : {2.0, 3.8, 6.1, 7.0, 9.0}) EXPECT_EQ(row.height(x, 0.1), 0) << x;
    d.repeat_every = 0.5;  // one beside the other
    expect_smooth(height_of(Obstacle(d)), {3, 3.1, 3.5, 3.6, 4, 4.5}, {-1, 0.4}, 10);
}

TEST(Obstacle, RampsThatMeetStaySmooth) {
    const Obstacle short_one({.start = 0, .length = 0.1, .height = 0.01, .ramp = 0.3, .right = 0, .left = 0.1});
    EXPECT_NEAR(short_one.height(0.05, 0.05), 0.01, 1e-15);
    expect_smooth(height_of(short_one), {0, 0.05, 0.1}, {0, 0.05, 0.1}, 50);
    const Obstacle sudden({.start = 0, .length = 1, .height = 0.01, .ramp = 0});
    EXPECT_DOUBLE_EQ(sudden.height(1e-8, 0.0), 0.01);
    EXPECT_EQ(sudden.height(-1e-8, 0.0), 0);
}

TEST(Wave, IsASineOnceFadedIn) {
    const Wave wave({.start = 5, .amplitude = 0.03, .wavelength = 2, .right_phase = pi / 3});
    for (double x = 7; x < 60; x += 0.37) {
        EXPECT_NEAR(wave.height(x, 0.5), 0.03 * std::sin(pi * (x - 5)), 1e-15);
        EXPECT_NEAR(wave.height(x, -0.5), 0.03 * std::sin(pi * (x - 5) - pi / 3), 1e-15);
        EXPECT_NEAR(wave.height(x, 0.0), 0.03 * std::sin(pi * (x - 5) - pi / 6), 1e-15) << "half of the lag";
        EXPECT_EQ(wave.height(x, 0.7), wave.height(x, 0.5));
        EXPECT_EQ(wave.height(x, -3.0), wave.height(x, -0.5));
    }
    EXPECT_EQ(wave.height(5.0, 0.5), 0);
    EXPECT_EQ(wave.height(-5.0, -0.5), 0);
    expect_smooth(height_of(wave), {5, 7, 9.3}, {-0.5, 0, 0.5}, 2);
}

// Between zero crossings a parabola of phase gains pi; its frequency half way is 1/2 over their distance, exactly.
TEST(Wave, ASweepChangesItsFrequencyLinearly) {
    const double start = -3, length = 80, first = 8, last = 0.5;
    const Wave wave({start, length, 0.01, first, last, 0});
    std::vector<double> crossings;
    for (double x = start + 0.01; x < start + length - 0.01; x += 0.02) {
        double low = x, high = x + 0.02;
        if (!(wave.height(low, 1.0) * wave.height(high, 1.0) < 0)) continue;
        const bool falls = wave.height(low, 1.0) > 0;
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            ((wave.height(middle, 1.0) > 0) == falls ? low : high) = middle;
        }
        crossings.push_back(low);
    }
    const double half_waves = length * (1 / first + 1 / last);
    EXPECT_EQ(static_cast<double>(crossings.size()), half_waves - 1) << "between them";
    for (std::size_t i = 1; i < crossings.size(); ++i) {
        const double along = ((crossings[i] + crossings[i - 1]) / 2 - start) / length;
        const double frequency = 1 / first + (1 / last - 1 / first) * along;
        EXPECT_NEAR(0.5 / (crossings[i] - crossings[i - 1]), frequency, 1e-9 * frequency);
    }
    expect_smooth(height_of(wave), {start, start + first, 40, start + length - last, start + length}, {-1, 1}, 4);
}

TEST(Wave, ShorterThanItsFadesStaysSmooth) {
    const Wave wave({.start = 0, .length = 3, .amplitude = 0.01, .wavelength = 2, .right_phase = -2});
    expect_smooth(height_of(wave), {0, 1, 2, 3}, {-0.5, 0, 0.5}, 1);
}

HeightGridDescription grid_of(std::size_t rows, std::size_t columns, auto&& height) {
    HeightGridDescription d{
        .x = -1, .y = 2, .spacing_x = 0.5, .spacing_y = 0.25, .rows = rows, .columns = columns, .heights = {}};
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j)
            d.heights.push_back(height(-1 + 0.5 * static_cast<double>(j), 2 + 0.25 * static_cast<double>(i)));
    return d;
}

TEST(HeightGrid, InterpolatesItsNodesSmoothly) {
    const auto rough = [](double x, double y) { return 0.1 * std::sin(37 * x * x + 11 * y * y * x); };
    const HeightGrid grid(grid_of(5, 7, rough));
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 7; ++j) {
            const double x = -1 + 0.5 * j, y = 2 + 0.25 * i;
            EXPECT_NEAR(grid.height(x, y), rough(x, y), 1e-15);
        }
    EXPECT_EQ(grid.height(-9.0, 2.3), grid.height(-1.0, 2.3));
    EXPECT_EQ(grid.height(9.0, 2.3), grid.height(2.0, 2.3));
    EXPECT_EQ(grid.height(0.3, -9.0), grid.height(0.3, 2.0));
    EXPECT_EQ(grid.height(0.3, 9.0), grid.height(0.3, 3.0));
    EXPECT_EQ(grid.height(1e300, -1e300), grid.height(2.0, 2.0));
    expect_smooth(height_of(grid), {-1, -0.5, 0, 0.5, 1, 1.5, 2}, {2, 2.25, 2.5, 2.75, 3}, 30);
}

TEST(HeightGrid, ReproducesBilinearSurfacesExceptInTheOutermostCells) {
    const auto plane = [](double x, double y) { return 0.3 - 0.2 * x + 0.1 * y + 0.05 * x * y; };
    const HeightGrid grid(grid_of(6, 7, plane));
    for (double x = -0.5; x < 1.5; x += 0.0371)
        for (double y = 2.25; y < 3.0; y += 0.0293) EXPECT_NEAR(grid.height(x, y), plane(x, y), 1e-15);
}

TEST(HeightGrid, MayBeEmpty) {
    EXPECT_EQ(HeightGrid().height(1.0, 2.0), 0);
    for (const std::size_t rows : {1U, 2U, 3U})
        for (const std::size_t columns : {1U, 2U, 3U}) {
            const auto tilted = [](double x, double y) { return x + 2 * y; };
            const HeightGrid grid(grid_of(rows, columns, tilted));
            const double end_x = -1.5 + 0.5 * static_cast<double>(columns), end_y = 1.75 + 0.25 * double(rows);
            EXPECT_NEAR(grid.height(end_x, end_y), tilted(end_x, end_y), 1e-15);
            EXPECT_NEAR(grid.height(-1.0, 2.0), 3, 1e-15);
            expect_smooth(height_of(grid), {-1, end_x + 0.01}, {2, end_y + 0.01}, 40);
        }
}

TEST(FrictionPatch, WeightIsOneInsideAndZeroOutside) {
    const FrictionPatch patch({.start = 10, .end = 20, .right = 0, .friction = 0.3, .ramp = 0.5});
    EXPECT_EQ(patch.friction, 0.3);
    for (const double y : {0.5, 1.0, 1e9}) EXPECT_EQ(patch.weight(15.0, y), 1);
    for (const double y : {0.0, -1.0, -1e9}) EXPECT_EQ(patch.weight(15.0, y), 0);
    for (const double x : {9.0, 10.0, 20.0, 21.0}) EXPECT_EQ(patch.weight(x, 1.0), 0);
    EXPECT_NEAR(patch.weight(10.25, 0.25), 0.25, 1e-15);
    EXPECT_EQ(FrictionPatch({.friction = 0.8}).weight(1e5, -1e5), 1) << "everywhere by default";
    const auto weight = [&]<class N>(const N& x, const N& y) { return patch.weight(x, y); };
    expect_smooth(weight, {10, 10.5, 19.5, 20}, {0, 0.5}, 30);
}

}  // namespace
}  // namespace hamilcar

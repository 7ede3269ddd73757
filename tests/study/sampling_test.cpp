// Grids, hypercubes and sequences.
#include "hamilcar/study/sampling.hpp"

#include <gmock/gmock.h>

#include <set>

namespace hamilcar {
namespace {

using testing::ElementsAre;

// Every one of `parts` equal intervals holds as many of the points.
void expect_even(const std::vector<std::vector<double>>& points, std::size_t dimension, std::size_t parts) {
    std::vector<std::size_t> held(parts);
    for (const auto& point : points) {
        ASSERT_GE(point[dimension], 0);
        ASSERT_LT(point[dimension], 1);
        ++held[static_cast<std::size_t>(point[dimension] * static_cast<double>(parts))];
    }
    for (const std::size_t count : held) EXPECT_EQ(count, points.size() / parts) << dimension;
}

TEST(FullFactorial, HasEveryCombinationOnce) {
    const auto points = full_factorial({2, 3});
    EXPECT_THAT(points, ElementsAre(ElementsAre(0, 0), ElementsAre(0, 1), ElementsAre(0, 2), ElementsAre(1, 0),
                                    ElementsAre(1, 1), ElementsAre(1, 2)));
    EXPECT_EQ(full_factorial({}).size(), 1u);
}

TEST(LatinHypercube, HasOnePointInEveryInterval) {
    const auto points = latin_hypercube(37, 5, 1);
    for (std::size_t k = 0; k < 5; ++k) expect_even(points, k, 37);
    EXPECT_EQ(points, latin_hypercube(37, 5, 1));
    EXPECT_NE(points, latin_hypercube(37, 5, 2));
    std::set<std::vector<double>> orders;  // dimensions are not sorted alike
    for (std::size_t k = 0; k < 5; ++k) orders.insert({points[0][k], points[1][k], points[2][k]});
    EXPECT_EQ(orders.size(), 5u);
}

// The beginning as Joe and Kuo's own program prints it for their direction numbers.
TEST(Sobol, BeginsAsPublished) {
    const auto points = sobol(7, 3);
    EXPECT_THAT(points,
                ElementsAre(ElementsAre(0.5, 0.5, 0.5), ElementsAre(0.75, 0.25, 0.25), ElementsAre(0.25, 0.75, 0.75),
                            ElementsAre(0.375, 0.375, 0.625), ElementsAre(0.875, 0.875, 0.125),
                            ElementsAre(0.625, 0.125, 0.875), ElementsAre(0.125, 0.625, 0.375)));
}

// With the origin 2^k points have one in every interval of 2^-k, in each dimension; the first two fill every elementary
// rectangle of area 2^-k.
TEST(Sobol, FillsEveryDimensionEvenly) {
    auto points = sobol(255, max_sobol_dimensions);
    points.emplace_back(max_sobol_dimensions, 0.0);
    for (std::size_t k = 0; k < max_sobol_dimensions; ++k) expect_even(points, k, 256);
    for (std::size_t across = 1; across <= 256; across *= 2) {
        std::set<std::pair<int, int>> rectangles;
        const double along = 256.0 / static_cast<double>(across);
        for (const auto& p : points) {
            rectangles.emplace(static_cast<int>(p[0] * static_cast<double>(across)), static_cast<int>(p[1] * along));
        }
        EXPECT_EQ(rectangles.size(), 256u) << across;
    }
    const auto fewer = sobol(100, 4), more = sobol(200, 4);
    EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), more.begin()));
}

// Means of products over the cube, as an integral of a smooth function has them: far better than drawn points would.
TEST(Sobol, IntegratesInSixteenDimensions) {
    double sum = 0;
    const auto points = sobol(4095, max_sobol_dimensions);
    for (const auto& p : points) {
        double product = 1;
        for (std::size_t k = 0; k < p.size(); ++k) product *= 1 + (p[k] - 0.5) / static_cast<double>(k + 1);
        sum += product;
    }
    EXPECT_NEAR(sum / static_cast<double>(points.size() + 1), 1, 2e-3);
}

}  // namespace
}  // namespace hamilcar

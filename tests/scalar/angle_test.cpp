// Angles all around and arcsines against the C library's.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {
namespace {

TEST(AngleOf, IsThatOfTheCLibraryAllAround) {
    for (const double radius : {1e-12, 1e-3, 1.0, 1e6}) {
        for (int i = -1800; i <= 1800; ++i) {
            const double angle = i * std::numbers::pi / 1800.5;
            const double y = radius * std::sin(angle), x = radius * std::cos(angle);
            EXPECT_NEAR(angle_of(y, x), std::atan2(y, x), 1e-15 * (1 + std::abs(angle))) << radius << " at " << angle;
        }
    }
    EXPECT_EQ(angle_of(0.0, 0.0), 0);
    EXPECT_DOUBLE_EQ(angle_of(1.0, 0.0), std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(angle_of(-1.0, 0.0), -std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(angle_of(0.0, -1.0), std::numbers::pi);
}

TEST(Arcsine, IsThatOfTheCLibrary) {
    for (int i = -1000; i <= 1000; ++i) {
        EXPECT_NEAR(arcsine(i / 1000.0), std::asin(i / 1000.0), 4.5e-16) << i;  // two units of the last place of pi / 2
    }
    EXPECT_DOUBLE_EQ(arcsine(1 + 1e-15), std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(arcsine(-1 - 1e-15), -std::numbers::pi / 2);
}

}  // namespace
}  // namespace hamilcar

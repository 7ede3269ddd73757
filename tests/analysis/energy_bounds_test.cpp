// What an energy account that does not close means, for runs and maneuvers alike.
#include "hamilcar/analysis/energy_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hamilcar {
namespace {

TEST(EnergyBounds, FailWhatIsATenthOff) {
    EXPECT_EQ(judge_energy(0.9, 0), EnergyVerdict::fine);  // a vehicle that stands
    EXPECT_EQ(judge_energy(99, 1e5), EnergyVerdict::fine);
    EXPECT_EQ(judge_energy(101, 1e5), EnergyVerdict::doubtful);
    EXPECT_EQ(judge_energy(9999, 1e5), EnergyVerdict::doubtful);
    EXPECT_EQ(judge_energy(10001, 1e5), EnergyVerdict::wrong);
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(judge_energy(infinite, 1e5), EnergyVerdict::wrong);
    EXPECT_EQ(judge_energy(infinite, infinite), EnergyVerdict::wrong);
    EXPECT_EQ(judge_energy(10001, std::nan("")), EnergyVerdict::wrong);
}

TEST(EnergyBounds, FailWhatIsNoNumberButNotWhatIsNotKept) {
    EXPECT_EQ(account_error(-3, true), 3);
    EXPECT_EQ(judge_energy(account_error(std::nan(""), true), 1e5), EnergyVerdict::wrong);
    EXPECT_EQ(judge_energy(account_error(std::nan(""), false), 1e5), EnergyVerdict::fine);
    EXPECT_EQ(judge_energy(account_error(1e9, false), 1e5), EnergyVerdict::fine);
}

}  // namespace
}  // namespace hamilcar

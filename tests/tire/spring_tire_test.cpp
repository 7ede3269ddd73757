// The spring tire: a line through the origin that pulls as it pushes, and nothing else.
#include "hamilcar/tire/spring_tire.hpp"

#include <gtest/gtest.h>

#include "support/difference.hpp"

namespace hamilcar {
namespace {

TEST(SpringTire, IsMinusTheGradientOfItsPotentialInBothDirections) {
    const SpringTire<double> tire({.radius = 0.3, .rolling_radius = 0.29, .vertical_stiffness = 180e3});
    for (const double depth : {-0.05, 0.0, 0.017, 0.2}) {
        const TireContact<double> contact{.depth = depth,
                                          .depth_rate = 0.4,
                                          .v_sx = 3,
                                          .v_sy = -2,
                                          .v_x = 20,
                                          .omega = 60,
                                          .friction = 1,
                                          .u = 0.01,
                                          .v = 0.02};
        const auto force = tire.force(contact);
        const double gradient = test::derivative([&](double at) { return tire.potential(at); }, depth);
        EXPECT_NEAR(force.Fz, gradient, 1e-8) << "quadratic: round-off of 3.6 kJ over 1e-3 m";
        EXPECT_EQ(force.Fz, force.elastic) << "nothing is lost";
        for (const double none : {force.Fx, force.Fy, force.rolling_moment, force.u_rate, force.v_rate}) {
            EXPECT_EQ(none, 0);
        }
    }
}

}  // namespace
}  // namespace hamilcar

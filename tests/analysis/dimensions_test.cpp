// The size of a vehicle on the ground, against sizes that are printed on tires and in data sheets.
#include "hamilcar/analysis/dimensions.hpp"

#include <gtest/gtest.h>

#include "support/fleet.hpp"

namespace hamilcar {
namespace {

constexpr double truck_tire = 0.279;  // width of an 11 R 22.5 [m]

TEST(Footprint, BothDualTiresCount) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const double spread = 72 * 0.0254, spacing = 0.335;  // of the rear axles: between the pairs' middles, within a pair
    EXPECT_NEAR(footprint(truck).width(), spread + spacing + truck_tire, 0.02);
}

TEST(Footprint, IsAsWideAsTheHullAllows) {
    EXPECT_NEAR(footprint(test::shipped("bmw_323i")).width(), 1.645, 0.02);
    VehicleDescription bare = test::shipped("bmw_323i");
    const double track = 2 * bare.suspensions[0].wheels[0].wheel.center[1];
    bare.hull.points.clear();
    EXPECT_NEAR(footprint(bare).width(), track + 0.195, 0.02);  // 195/60 R 14
}

TEST(Footprint, EndsWithTheLastTrailersWheels) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const double axle = -14.92, radius = 0.526, center = -1.25;
    EXPECT_NEAR(rear_end(truck), axle - radius - center, 0.05);
    const VehicleDescription car = test::shipped("bmw_323i");
    EXPECT_EQ(rear_end(car), footprint(car).rear);
}

}  // namespace
}  // namespace hamilcar

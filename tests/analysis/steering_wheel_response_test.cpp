// Responses to the steering wheel: slow ones are those of steady driving.
#include "hamilcar/analysis/steering_wheel_response.hpp"

#include <gtest/gtest.h>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/base/units.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

constexpr double speed = 80 * units::kilometer_per_hour, slow = 1e-3, quick = 2;  // [m/s], [Hz]

TEST(SteeringWheelResponse, IsThatOfSteadyDrivingWhereNothingIsInAHurry) {
    const VehicleDescription car = test::shipped_car();
    const SteadyHandling steady = steady_handling(car, speed);
    const auto yaw = steering_wheel_response(car, speed, output_yaw_rate, {slow, quick});
    const auto lateral = steering_wheel_response(car, speed, output_lateral_acceleration, {slow, quick});
    const double yaw_gain = steady.yaw_rate_gain * steady.rack_per_angle;
    const double lateral_gain = steady.lateral_acceleration_gain * steady.rack_per_angle * units::degree;
    EXPECT_NEAR(std::abs(yaw.at(0)), yaw_gain, 0.01 * yaw_gain);
    EXPECT_NEAR(std::abs(lateral.at(0)), lateral_gain, 0.01 * lateral_gain);
    EXPECT_LT(std::arg(yaw.at(1)), std::arg(yaw.at(0))) << "it lags";
}

}  // namespace
}  // namespace hamilcar

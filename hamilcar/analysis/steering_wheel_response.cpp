#include "hamilcar/analysis/steering_wheel_response.hpp"

#include <array>
#include <numbers>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

// Place of the motor vehicle's center of mass, from that of its chassis: ahead and above [m].
std::array<double, 2> center_from_chassis(const VehicleDescription& vehicle) {
    const Point& chassis = vehicle.chassis.center_of_mass;
    double mass = vehicle.chassis.mass, ahead = 0, above = 0;
    const auto add = [&](const BodyDescription& body) {
        mass += body.mass;
        ahead += body.mass * (body.center_of_mass[0] - chassis[0]);
        above += body.mass * (body.center_of_mass[2] - chassis[2]);
    };
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        if (suspension.unit != 0) continue;
        for (const SuspensionBodyDescription& body : suspension.bodies) add(body.body);
    }
    return {ahead / mass, above / mass};
}

// The output of the linear model is the whole combination's. Of the motor vehicle alone: v_y' + v r at its center of mass, which
// yaw and roll move against the chassis's.
std::vector<std::complex<double>> motor_vehicle_response(const VehicleDescription& vehicle, const LinearModel& model,
                                                         double speed, double ratio,
                                                         const std::vector<double>& angular) {
    std::vector<std::complex<double>> out = steering_response(model, ratio, output_lateral_velocity, angular);
    const auto yaw_rate = steering_response(model, ratio, output_yaw_rate, angular),
               roll = steering_response(model, ratio, output_roll, angular);
    const auto [ahead, above] = center_from_chassis(vehicle);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::complex<double> iw(0, angular[i]);
        out[i] = iw * out[i] + (speed + iw * ahead) * yaw_rate[i] - iw * iw * above * roll[i];
    }
    return out;
}

}  // namespace

std::vector<std::complex<double>> steering_wheel_response(const VehicleDescription& vehicle, double speed,
                                                          LinearOutput output, const std::vector<double>& frequency) {
    const Linearizer linearizer(vehicle);
    const OperatingPoint straight = linearizer.operating_point({.speed = speed});
    if (!straight.found) return {};
    const LinearModel model = linearizer.linearize(straight);
    const double ratio = Column(vehicle.steering).center_ratio();
    const std::vector<double> angular = scaled(frequency, 2 * std::numbers::pi);
    if (output == output_yaw_rate) return steering_response(model, ratio, output, angular);
    std::vector<std::complex<double>> out = vehicle.trailers.empty()
                                                ? steering_response(model, ratio, output, angular)
                                                : motor_vehicle_response(vehicle, model, speed, ratio, angular);
    for (auto& response : out) response *= units::degree;
    return out;
}

}  // namespace hamilcar
